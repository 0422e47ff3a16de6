// A column of a CSV file as a table in time.
#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <stdexcept>

#include "input/functions.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

struct Column {
  std::string name;
  Quantity unit{1, dim::none, true};  ///< what 1 in the file is [SI]
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  return cells;
}

/// "force z [kN]"
Column column_of(const std::string& head, const std::string& file) {
  const std::size_t open = head.find('[');
  if (open == std::string::npos || head.back() != ']') return {head, {1, dim::none, true}};
  const std::string unit = head.substr(open + 1, head.size() - open - 2);
  Column column{trimmed(head.substr(0, open)), {1, dim::none, false}};
  if (unit == "-" || unit == "1") return column;
  try {
    column.unit = parse_quantity("1 " + unit);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}:1: '{}': {}", file, head, error.what()));
  }
  return column;
}

std::size_t pick(const std::vector<Column>& columns, const std::string& wanted,
                 const std::string& file) {
  std::vector<std::string> names;
  std::size_t last_word = 0;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    names.push_back(columns[k].name);
    if (columns[k].name == wanted) return k;
    if (!wanted.empty() && columns[k].name.ends_with(" " + wanted)) last_word = k;
  }
  if (wanted.empty() && columns.size() == 2) return 1;
  if (last_word != 0) return last_word;
  throw std::invalid_argument(fmt::format(
      "{}: {}; columns behind the time: {}", file,
      wanted.empty() ? std::string("say which column is meant: 'column: NAME'")
                     : fmt::format("no column '{}'{}", wanted, did_you_mean(wanted, names)),
      comma_list(names)));
}

double number_of(const std::string& cell, const std::string& file, int line) {
  double x = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  if (cell.empty() || error != std::errc() || end != cell.data() + cell.size()) {
    throw std::invalid_argument(fmt::format("{}:{}: '{}' is no number", file, line, cell));
  }
  return x;
}

}  // namespace

Curve read_csv_curve(const std::string& file, const std::string& column) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  std::vector<Column> columns;
  for (const std::string& head : cells_of(line)) columns.push_back(column_of(head, file));
  const std::size_t at = pick(columns, column, file);
  const Quantity& time = columns[0].unit;
  if (!time.bare && time.dimension != dim::time) {
    throw std::invalid_argument(fmt::format("{}:1: the first column is no time", file));
  }
  Curve curve;
  curve.dimension = columns[at].unit.dimension;
  curve.bare = columns[at].unit.bare;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() <= at) {
      throw std::invalid_argument(fmt::format("{}:{}: {} values under {} columns", file, number,
                                              cells.size(), columns.size()));
    }
    const double t = number_of(cells[0], file, number) * time.value;
    if (!curve.table.t.empty() && t <= curve.table.t.back()) {
      throw std::invalid_argument(fmt::format("{}:{}: times do not rise", file, number));
    }
    curve.table.t.push_back(t);
    curve.table.y.push_back(number_of(cells[at], file, number) * columns[at].unit.value);
  }
  if (curve.table.t.empty()) throw std::invalid_argument(file + ": no line with numbers");
  return curve;
}

}  // namespace gannet
