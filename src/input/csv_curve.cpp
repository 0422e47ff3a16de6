// CSV files: tables with units, and a column as a table in time.
#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <stdexcept>

#include "input/functions.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

using Column = CsvTable::Column;

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

/// "force z [kN]"; place: file and line.
Column column_of(const std::string& head, const std::string& place) {
  const std::size_t open = head.find('[');
  if (open == std::string::npos || head.back() != ']') return {head, {1, dim::none, true}};
  const std::string unit = head.substr(open + 1, head.size() - open - 2);
  Column column{trimmed(head.substr(0, open)), {1, dim::none, false}};
  if (unit == "-" || unit == "1") return column;
  try {
    column.unit = parse_quantity("1 " + unit);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: '{}': {}", place, head, error.what()));
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

CsvTable read_csv_table(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::invalid_argument(file + ": cannot be read");
  CsvTable table{.file = file};
  std::string line;
  int number = 1;
  while (std::getline(stream, line) && line.starts_with('#')) ++number;
  for (const std::string& head : cells_of(line)) {
    table.columns.push_back(column_of(head, fmt::format("{}:{}", file, number)));
  }
  for (++number; std::getline(stream, line); ++number) {
    if (trimmed(line).empty()) continue;
    table.lines.push_back(number);
    table.cells.push_back(cells_of(line));
  }
  if (table.lines.empty()) throw std::invalid_argument(file + ": no line with numbers");
  return table;
}

std::vector<double> numbers_of(const CsvTable& table, std::size_t column) {
  std::vector<double> numbers;
  for (std::size_t k = 0; k < table.lines.size(); ++k) {
    const std::vector<std::string>& cells = table.cells[k];
    if (cells.size() <= column) {
      throw std::invalid_argument(fmt::format("{}:{}: {} values under {} columns", table.file,
                                              table.lines[k], cells.size(), table.columns.size()));
    }
    numbers.push_back(number_of(cells[column], table.file, table.lines[k]) *
                      table.columns[column].unit.value);
  }
  return numbers;
}

Curve read_csv_curve(const std::string& file, const std::string& column) {
  const CsvTable table = read_csv_table(file);
  const std::size_t at = pick(table.columns, column, file);
  const Quantity& time = table.columns[0].unit;
  if (!time.bare && time.dimension != dim::time) {
    throw std::invalid_argument(fmt::format("{}:1: the first column is no time", file));
  }
  Curve curve;
  curve.dimension = table.columns[at].unit.dimension;
  curve.bare = table.columns[at].unit.bare;
  curve.table = {numbers_of(table, 0), numbers_of(table, at)};
  const std::vector<double>& t = curve.table.t;
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] > t[k - 1]) continue;
    throw std::invalid_argument(fmt::format("{}:{}: times do not rise", file, table.lines[k]));
  }
  return curve;
}

}  // namespace gannet
