#include "study/study_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace gannet {

namespace {

struct Column {
  std::string name;  ///< "slam_force z"
  std::string unit;
};

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    parts.push_back(line.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return parts;
}

std::vector<Column> header_of(const std::string& line) {
  std::vector<Column> columns;
  for (const std::string& text : split_line(line)) {
    const std::size_t open = text.find(" [");
    if (open == std::string::npos) {
      columns.push_back({text, ""});
    } else {
      columns.push_back({text.substr(0, open), text.substr(open + 2, text.size() - open - 3)});
    }
  }
  return columns;
}

bool ends_with_word(const std::string& name, const std::string& word) {
  return name == word || (name.size() > word.size() && name.ends_with(" " + word));
}

/// Which columns make the value: one, or three of a vector.
std::vector<std::size_t> pick(const std::string& file, const std::vector<Column>& columns,
                              const std::string& wanted) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    names.push_back(columns[i].name);
    if (!wanted.empty() && ends_with_word(columns[i].name, wanted)) found.push_back(i);
  }
  if (found.size() == 1) return found;
  const bool vector = columns.size() == 4 && ends_with_word(columns[1].name, "x") &&
                      ends_with_word(columns[2].name, "y") && ends_with_word(columns[3].name, "z");
  if (wanted.empty() && columns.size() == 2) return {1};
  if (wanted.empty() && vector) return {1, 2, 3};
  throw std::runtime_error(
      fmt::format("{}: {}; it has: {}", file,
                  wanted.empty() ? "a column must be named" : "no one column '" + wanted + "'",
                  fmt::join(names, ", ")));
}

double number_of(const std::string& text, const std::string& file, std::size_t line) {
  double x = 0;
  const char* begin = text.data() + text.find_first_not_of(" \t\r");
  const auto result = std::from_chars(begin, text.data() + text.size(), x);
  if (text.find_first_not_of(" \t\r") == std::string::npos || result.ec != std::errc()) {
    throw std::runtime_error(fmt::format("{}:{}: '{}' is no number", file, line, text));
  }
  return x;
}

void add_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& picked,
              const std::string& place, std::size_t line, TimeSeries& series) {
  const double t = number_of(cells[0], place, line);
  if (!series.t.empty() && !(t > series.t.back())) {
    throw std::runtime_error(fmt::format("{}:{}: times do not rise", place, line));
  }
  double sum = 0;
  for (const std::size_t i : picked) {
    const double x = number_of(cells.at(i), place, line);
    sum = picked.size() == 1 ? x : sum + x * x;
  }
  series.t.push_back(t);
  series.y.push_back(picked.size() == 1 ? sum : std::sqrt(sum));
}

}  // namespace

TimeSeries read_time_series(const std::string& file, const std::string& column) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  std::string line;
  std::getline(stream, line);
  if (line.ends_with('\r')) line.pop_back();
  const std::vector<Column> columns = header_of(line);
  const std::vector<std::size_t> picked = pick(file, columns, column);
  TimeSeries series;
  series.unit = columns[picked.front()].unit;
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::vector<std::string> cells = split_line(line);
    if (cells.size() != columns.size()) {
      if (stream.eof()) break;  // a line that is still being written
      throw std::runtime_error(fmt::format("{}:{}: {} values under {} columns", file, number,
                                           cells.size(), columns.size()));
    }
    add_line(cells, picked, file, number, series);
  }
  return series;
}

TimeSeries window_of(const TimeSeries& series, double from, double until) {
  TimeSeries part;
  part.unit = series.unit;
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    if (series.t[i] < from || series.t[i] > until) continue;
    part.t.push_back(series.t[i]);
    part.y.push_back(series.y[i]);
  }
  return part;
}

const std::vector<std::string>& measure_kinds() {
  static const std::vector<std::string> kinds = {"peak",  "time_of_peak", "maximum", "minimum",
                                                 "final", "mean",         "impulse", "percentile",
                                                 "slope", "rms",          "distance"};
  return kinds;
}

namespace {

std::size_t index_of_peak(const std::vector<double>& y) {
  return static_cast<std::size_t>(
      std::max_element(y.begin(), y.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      y.begin());
}

/// Trapezoids of y^power.
double integral(const TimeSeries& s, int power) {
  double sum = 0;
  for (std::size_t i = 1; i < s.t.size(); ++i) {
    const double a = power == 1 ? s.y[i - 1] : s.y[i - 1] * s.y[i - 1];
    const double b = power == 1 ? s.y[i] : s.y[i] * s.y[i];
    sum += (a + b) / 2 * (s.t[i] - s.t[i - 1]);
  }
  return sum;
}

double percentile_of(std::vector<double> y, double percent) {
  std::sort(y.begin(), y.end());
  const double at = std::clamp(percent, 0.0, 100.0) / 100 * static_cast<double>(y.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, y.size() - 1);
  return y[below] + (at - static_cast<double>(below)) * (y[above] - y[below]);
}

double slope_of(const TimeSeries& s) {
  const auto n = static_cast<double>(s.t.size());
  double t_mean = 0;
  double y_mean = 0;
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    t_mean += s.t[i] / n;
    y_mean += s.y[i] / n;
  }
  double ty = 0;
  double tt = 0;
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    ty += (s.t[i] - t_mean) * (s.y[i] - y_mean);
    tt += (s.t[i] - t_mean) * (s.t[i] - t_mean);
  }
  return ty / tt;
}

}  // namespace

double evaluate(const StudyMeasure& measure, const TimeSeries& series) {
  const TimeSeries s = window_of(series, measure.from, measure.until);
  const std::string& kind = measure.kind;
  const bool needs_two = kind == "slope" || kind == "mean" || kind == "rms" || kind == "impulse";
  if (s.t.size() < (needs_two ? 2 : 1)) {
    throw std::runtime_error(fmt::format("{}: too few samples in its window", measure.name));
  }
  if (kind == "peak") return s.y[index_of_peak(s.y)];
  if (kind == "time_of_peak") return s.t[index_of_peak(s.y)];
  if (kind == "maximum") return *std::max_element(s.y.begin(), s.y.end());
  if (kind == "minimum") return *std::min_element(s.y.begin(), s.y.end());
  if (kind == "final") return s.y.back();
  if (kind == "impulse") return integral(s, 1);
  if (kind == "mean") return integral(s, 1) / (s.t.back() - s.t.front());
  if (kind == "rms") return std::sqrt(integral(s, 2) / (s.t.back() - s.t.front()));
  if (kind == "percentile") return percentile_of(s.y, measure.percent);
  if (kind == "slope") return slope_of(s);
  throw std::runtime_error(fmt::format("{}: '{}' is no kind of measure", measure.name, kind));
}

double value_of(const TimeSeries& s, double t) {
  const auto above = std::lower_bound(s.t.begin(), s.t.end(), t);
  if (above == s.t.begin()) return s.y.front();
  if (above == s.t.end()) return s.y.back();
  const auto i = static_cast<std::size_t>(above - s.t.begin());
  if (*above == t) return s.y[i];  // to the last bit: a history has no distance from itself
  const double part = (t - s.t[i - 1]) / (s.t[i] - s.t[i - 1]);
  return s.y[i - 1] + part * (s.y[i] - s.y[i - 1]);
}

namespace {

/// Mean square of a(t + shift) - b(t) over the common times; infinite where there are too few.
double mean_square(const TimeSeries& a, const TimeSeries& b, double shift) {
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < b.t.size(); ++i) {
    const double t = b.t[i] + shift;
    if (t < a.t.front() || t > a.t.back()) continue;
    const double d = value_of(a, t) - b.y[i];
    sum += d * d;
    ++n;
  }
  return n < 2 ? std::numeric_limits<double>::infinity() : sum / n;
}

/// A coarse look over the whole range, then golden sections about the best.
double best_shift(const TimeSeries& a, const TimeSeries& b, double max_shift) {
  const int n = 100;
  double best = 0;
  for (int k = -n; k <= n; ++k) {
    const double s = max_shift * k / n;
    if (mean_square(a, b, s) < mean_square(a, b, best)) best = s;
  }
  double lo = std::max(best - max_shift / n, -max_shift);
  double hi = std::min(best + max_shift / n, max_shift);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int k = 0; k < 40; ++k) {
    const double left = hi - ratio * (hi - lo);
    const double right = lo + ratio * (hi - lo);
    (mean_square(a, b, left) < mean_square(a, b, right) ? hi : lo) =
        mean_square(a, b, left) < mean_square(a, b, right) ? right : left;
  }
  const double refined = (lo + hi) / 2;
  return mean_square(a, b, refined) < mean_square(a, b, best) ? refined : best;
}

}  // namespace

Distance distance_of(const TimeSeries& a, const TimeSeries& b, double max_shift) {
  if (a.t.empty() || b.t.empty()) throw std::runtime_error("a history without samples");
  Distance d;
  if (max_shift > 0) d.shift = best_shift(a, b, max_shift);
  const double square = mean_square(a, b, d.shift);
  if (!std::isfinite(square)) throw std::runtime_error("two histories without common times");
  d.rms = std::sqrt(square);
  const auto [lo, hi] = std::minmax_element(b.y.begin(), b.y.end());
  d.range = *hi - *lo;
  return d;
}

std::string unit_of(const StudyMeasure& measure, const std::string& unit) {
  if (measure.kind == "time_of_peak") return "s";
  if (unit.empty() || unit == "1" || unit == "-") {
    if (measure.kind == "impulse") return "s";
    return measure.kind == "slope" ? "1/s" : "";
  }
  if (measure.kind == "impulse") return unit + " s";
  return measure.kind == "slope" ? unit + "/s" : unit;
}

}  // namespace gannet
