#include "output/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/error.hpp"

namespace gannet {

namespace fs = std::filesystem;

namespace {

/// A cell of a CSV header, quoted where it has to be.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

/// Unit of a component: measures have one unit, or as many as components with commas between.
std::string unit_of(const Measure& m, std::size_t component) {
  std::size_t begin = 0;
  std::size_t end = m.unit.find(',');
  for (std::size_t k = 0; k < component && end != std::string::npos; ++k) {
    begin = end + 1;
    end = m.unit.find(',', begin);
  }
  const std::string unit = m.unit.substr(begin, end - begin);
  return unit.empty() ? "-" : unit;
}

std::string measure_header(const Measure& m, const std::string& name) {
  std::string header = "time [s]";
  for (std::size_t k = 0; k < m.components.size(); ++k) {
    const std::string column = m.components.size() == 1 ? name : name + " " + m.components[k];
    header += "," + quoted(fmt::format("{} [{}]", column, unit_of(m, k)));
  }
  return header + "\n";
}

std::string energy_header(const Ledger& ledger) {
  std::string header = "time [s],held [J],external [J],error [-]";
  for (const LedgerEntry& e : ledger.entries()) {
    header += "," + quoted(e.part.empty() ? e.name + " [J]" : e.part + " " + e.name + " [J]");
  }
  return header + "\n";
}

/// Puts the header into a new file; an existing one must begin with it.
void start_table(GrowingFile& file, const std::string& header) {
  if (fs::file_size(file.path()) == 0) {
    file.append(header);
    return;
  }
  std::ifstream in(file.path());
  std::string first;
  std::getline(in, first);
  if (first + "\n" == header) return;
  throw InputError(Location{file.path(), 1},
                   "the table has other columns than this run; give --out DIR to write elsewhere");
}

void add_number(std::string& line, double value) {
  fmt::format_to(std::back_inserter(line), ",{}", value);
}

std::string read_whole(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Bytes of the header and the whole lines with time below t.
std::size_t length_before(const std::string& text, double t) {
  std::size_t kept = 0;
  while (true) {
    const std::size_t end = text.find('\n', kept);
    if (end == std::string::npos) return kept;
    if (kept > 0) {
      double time = 0;
      const auto read = std::from_chars(text.data() + kept, text.data() + end, time);
      if (read.ec != std::errc() || !(time < t)) return kept;
    }
    kept = end + 1;
  }
}

}  // namespace

std::string history_name(const Measure& measure) {
  constexpr std::string_view probe = "probe.";
  if (measure.name.starts_with(probe)) return file_name_of(measure.name.substr(probe.size()));
  constexpr std::string_view shown[] = {"contact.", "wall.",  "cable.", "tie.",
                                        "mooring.", "shell.", "solid.", "beam."};
  const auto begins = [&](std::string_view kind) { return measure.name.starts_with(kind); };
  if (std::ranges::none_of(shown, begins)) return "";
  std::string name = measure.name;
  for (char& c : name) {
    if (c == '.') c = '_';
  }
  return file_name_of(name);
}

void History::open(const std::string& output_folder) {
  const std::string folder = output_folder + "/history/";
  const auto add = [&](const std::string& name, const Measure* measure, const std::string& header) {
    Table& table = tables_.emplace_back(folder + name + ".csv", measure);
    if (measure != nullptr) table.values.resize(measure->components.size());
    start_table(table.file, header);
  };
  add("energy", nullptr, energy_header(*ledger_));
  for (const Measure& m : scene_->measures) {
    const std::string name = history_name(m);
    if (!name.empty()) add(name, &m, measure_header(m, name));
  }
  n_entries_ = ledger_->entries().size();
  open_ = true;
}

void History::write(double t, const EnergyBalance& balance, const std::string& folder) {
  if (!open_) open(folder);
  if (ledger_->entries().size() != n_entries_) {
    throw std::logic_error("the ledger got the entry '" + ledger_->entries().back().part + " " +
                           ledger_->entries().back().name +
                           "' after the first line of energy.csv; make entries before the run");
  }
  for (Table& table : tables_) {
    line_.clear();
    fmt::format_to(std::back_inserter(line_), "{}", t);
    if (table.measure != nullptr) {
      table.measure->sample(table.values.data());
      for (const double value : table.values) add_number(line_, value);
    } else {
      add_number(line_, ledger_->held());
      add_number(line_, ledger_->external());
      add_number(line_, balance.error());
      for (const LedgerEntry& e : ledger_->entries()) add_number(line_, e.value);
    }
    line_ += '\n';
    table.file.append(line_);
  }
}

void cut_histories(const std::string& folder, double t) {
  const fs::path history = fs::path(folder) / "history";
  if (!fs::is_directory(history)) return;
  for (const auto& entry : fs::directory_iterator(history)) {
    if (entry.path().extension() != ".csv") continue;
    const std::string text = read_whole(entry.path());
    const std::size_t kept = length_before(text, t);
    if (kept < text.size()) fs::resize_file(entry.path(), kept);
  }
}

}  // namespace gannet
