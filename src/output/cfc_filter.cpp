#include "output/cfc_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "output/files.hpp"

namespace gannet {

namespace {

/// A filter of two poles.
struct TwoPoles {
  double a0, b1, b2;
};

/// SAE J211-1: poles of the Butterworth filter with the corner at 2.0775 cfc, by the bilinear map.
TwoPoles two_poles(double cfc, double dt) {
  const double w_d = 2 * std::numbers::pi * 2.0775 * cfc;
  const double w_a = std::tan(0.5 * w_d * dt);
  const double all = 1 + std::numbers::sqrt2 * w_a + w_a * w_a;
  return {w_a * w_a / all, -2 * (w_a * w_a - 1) / all,
          (-1 + std::numbers::sqrt2 * w_a - w_a * w_a) / all};
}

/// One pass over a signal that was at rest at its first value before.
void pass(std::span<double> x, const TwoPoles& p) {
  double x1 = x[0];
  double x2 = x[0];
  double y1 = x[0];
  double y2 = x[0];
  for (double& value : x) {
    const double y = p.a0 * (value + 2 * x1 + x2) + p.b1 * y1 + p.b2 * y2;
    x2 = x1;
    x1 = value;
    y2 = y1;
    y1 = y;
    value = y;
  }
}

/// A table of a history: header, and the values line by line.
struct Table {
  std::string header;
  std::size_t n_columns = 0;
  std::vector<double> values;
  [[nodiscard]] std::size_t n_lines() const { return values.size() / n_columns; }
  [[nodiscard]] double at(std::size_t line, std::size_t column) const {
    return values[line * n_columns + column];
  }
};

Table read_table(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  Table table;
  std::getline(in, table.header);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc() || read.ptr == end) break;
    table.values.push_back(value);
    if (*read.ptr == '\n' && table.n_columns == 0) table.n_columns = table.values.size();
    at = read.ptr + 1;
  }
  if (table.n_columns == 0) table.n_columns = 1;
  table.values.resize(table.n_lines() * table.n_columns);
  return table;
}

/// A column at the times t_0 + k dt.
std::vector<double> evenly(const Table& table, std::size_t column, double dt, std::size_t n) {
  std::vector<double> values(n);
  std::size_t line = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double t = table.at(0, 0) + static_cast<double>(k) * dt;
    while (line + 2 < table.n_lines() && table.at(line + 1, 0) < t) ++line;
    const double t0 = table.at(line, 0);
    const double part = (t - t0) / (table.at(line + 1, 0) - t0);
    values[k] = table.at(line, column) +
                std::clamp(part, 0.0, 1.0) * (table.at(line + 1, column) - table.at(line, column));
  }
  return values;
}

std::string filtered_text(const Table& table, double cfc, double dt) {
  const double length = table.at(table.n_lines() - 1, 0) - table.at(0, 0);
  const auto n = static_cast<std::size_t>(length / dt * (1 + 1e-12)) + 1;
  std::vector<std::vector<double>> columns;
  for (std::size_t c = 1; c < table.n_columns; ++c) {
    columns.push_back(evenly(table, c, dt, n));
    cfc_filter(columns.back(), cfc, dt);
  }
  std::string text = table.header + "\n";
  for (std::size_t k = 0; k < n; ++k) {
    fmt::format_to(std::back_inserter(text), "{}", table.at(0, 0) + static_cast<double>(k) * dt);
    for (const auto& column : columns) {
      fmt::format_to(std::back_inserter(text), ",{}", column[k]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void cfc_filter(std::span<double> signal, double cfc, double dt) {
  const std::size_t n = signal.size();
  if (n < 2) return;
  // The filter forgets within a few periods of its corner.
  const auto memory = static_cast<std::size_t>(std::ceil(4 / (2.0775 * cfc * dt)));
  const std::size_t pad = std::min(n - 1, memory);
  std::vector<double> x(n + 2 * pad);
  for (std::size_t k = 0; k < pad; ++k) {
    x[k] = 2 * signal[0] - signal[pad - k];
    x[pad + n + k] = 2 * signal[n - 1] - signal[n - 2 - k];
  }
  std::copy(signal.begin(), signal.end(), x.begin() + static_cast<std::ptrdiff_t>(pad));
  const TwoPoles poles = two_poles(cfc, dt);
  pass(x, poles);
  std::reverse(x.begin(), x.end());
  pass(x, poles);
  std::reverse(x.begin(), x.end());
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(pad), n, signal.begin());
}

void write_filtered_histories(const RunRecord& record) {
  for (const HistoryFilter& filter : record.filters) {
    const std::string path = record.folder + "/history/" + filter.history;
    if (!std::filesystem::exists(path + ".csv")) continue;
    const Table table = read_table(path + ".csv");
    if (table.n_lines() < 2) continue;
    write_whole_file(path + "_filtered.csv",
                     filtered_text(table, filter.cfc, record.plan.history.interval));
  }
}

}  // namespace gannet
