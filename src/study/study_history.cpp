#include "study/study_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
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
  std::size_t number = 1;
  while (std::getline(stream, line) && line.starts_with('#')) ++number;
  if (line.ends_with('\r')) line.pop_back();
  const std::vector<Column> columns = header_of(line);
  const std::vector<std::size_t> picked = pick(file, columns, column);
  TimeSeries series;
  series.unit = columns[picked.front()].unit;
  for (++number; std::getline(stream, line); ++number) {
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
  static const std::vector<std::string> kinds = {
      "peak",      "time_of_peak", "maximum", "minimum",      "final",
      "mean",      "impulse",      "slope",   "percentile",   "rms",
      "amplitude", "phase",        "midline", "largest_mean", "time_of_largest_mean",
      "arrival",   "rise",         "distance"};
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

/// Integral of y from the first time to t, y linear between samples; s.t.front() <= t <=
/// s.t.back(). `upto`: the integral up to each sample.
double integral_to(const TimeSeries& s, const std::vector<double>& upto, double t) {
  const auto above = std::lower_bound(s.t.begin() + 1, s.t.end(), t);
  const auto i = static_cast<std::size_t>(above - s.t.begin());
  return upto[i - 1] + (t - s.t[i - 1]) * 0.5 * (s.y[i - 1] + value_of(s, t));
}

struct MeanAt {
  double mean = unknown;
  double time = unknown;  ///< middle of the window [s]
};

MeanAt largest_mean(const TimeSeries& s, double width) {
  std::vector<double> upto(s.t.size(), 0);
  for (std::size_t i = 1; i < s.t.size(); ++i) {
    upto[i] = upto[i - 1] + 0.5 * (s.y[i - 1] + s.y[i]) * (s.t[i] - s.t[i - 1]);
  }
  MeanAt largest;
  const auto look = [&](double begin, double end) {
    if (begin < s.t.front() || end > s.t.back()) return;
    const double mean = (integral_to(s, upto, end) - integral_to(s, upto, begin)) / width;
    if (!(mean <= largest.mean)) largest = {mean, 0.5 * (begin + end)};
  };
  for (const double t : s.t) {
    look(t, t + width);
    look(t - width, t);
  }
  return largest;
}

/// m + a sin(w t) + b cos(w t) by least squares; w = 2 pi/period.
struct SineFit {
  double m = 0, a = 0, b = 0;
};

SineFit fit_sine(const TimeSeries& s, double period) {
  // Rows of the normal equations: sums of (1, sin, cos) with (1, sin, cos, y).
  double n[3][4] = {};
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    const double angle = 2 * std::numbers::pi * s.t[i] / period;
    const double f[4] = {1, std::sin(angle), std::cos(angle), s.y[i]};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) n[r][c] += f[r] * f[c];
    }
  }
  for (int p = 0; p < 3; ++p) {  // positive definite: no pivots needed
    for (int r = 0; r < 3; ++r) {
      if (r == p) continue;
      const double factor = n[r][p] / n[p][p];
      for (int c = p; c < 4; ++c) n[r][c] -= factor * n[p][c];
    }
  }
  return {n[0][3] / n[0][0], n[1][3] / n[1][1], n[2][3] / n[2][2]};
}

double arrival_of(const TimeSeries& s, double level) {
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    if (s.y[i] < level) continue;
    if (i == 0) return s.t[0];
    return s.t[i - 1] + (s.t[i] - s.t[i - 1]) * (level - s.y[i - 1]) / (s.y[i] - s.y[i - 1]);
  }
  return unknown;
}

/// The measures that take options of their own; nothing where the kind is another.
std::optional<double> evaluate_with_options(const StudyMeasure& measure, const TimeSeries& s) {
  const std::string& kind = measure.kind;
  if (kind == "percentile") return percentile_of(s.y, measure.percent);
  if (kind == "arrival") return arrival_of(s, measure.level);
  if (kind == "largest_mean") return largest_mean(s, measure.width).mean;
  if (kind == "time_of_largest_mean") return largest_mean(s, measure.width).time;
  if (kind == "amplitude" || kind == "phase" || kind == "midline") {
    const SineFit fit = fit_sine(s, measure.period);
    if (kind == "midline") return fit.m;
    return kind == "phase" ? std::atan2(fit.b, fit.a) : std::hypot(fit.a, fit.b);
  }
  return std::nullopt;
}

/// Samples that a measure of that kind cannot do without.
std::size_t samples_for(const std::string& kind) {
  for (const char* sine : {"amplitude", "phase", "midline"}) {
    if (kind == sine) return 3;
  }
  for (const char* area : {"slope", "mean", "rms", "impulse", "largest_mean"}) {
    if (kind == area || kind == std::string("time_of_") + area) return 2;
  }
  return 1;
}

}  // namespace

double evaluate(const StudyMeasure& measure, const TimeSeries& series) {
  const TimeSeries s = window_of(series, measure.from, measure.until);
  const std::string& kind = measure.kind;
  if (s.t.size() < samples_for(kind)) {
    throw std::runtime_error(fmt::format("{}: too few samples in its window", measure.name));
  }
  if (kind == "peak") return s.y[index_of_peak(s.y)];
  if (kind == "time_of_peak") return s.t[index_of_peak(s.y)];
  if (kind == "maximum") return *std::max_element(s.y.begin(), s.y.end());
  if (kind == "minimum") return *std::min_element(s.y.begin(), s.y.end());
  if (kind == "rise") return *std::max_element(s.y.begin(), s.y.end()) - s.y.front();
  if (kind == "final") return s.y.back();
  if (kind == "impulse") return integral(s, 1);
  if (kind == "mean") return integral(s, 1) / (s.t.back() - s.t.front());
  if (kind == "rms") return std::sqrt(integral(s, 2) / (s.t.back() - s.t.front()));
  if (kind == "slope") return slope_of(s);
  if (const auto value = evaluate_with_options(measure, s)) return *value;
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
    if (!std::isfinite(d)) continue;  // one of them has no value there: no water at a gauge yet
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
  if (measure.kind.starts_with("time_of_") || measure.kind == "arrival") return "s";
  if (measure.kind == "phase") return "rad";
  if (unit.empty() || unit == "1" || unit == "-") {
    if (measure.kind == "impulse") return "s";
    return measure.kind == "slope" ? "1/s" : "";
  }
  if (measure.kind == "impulse") return unit + " s";
  return measure.kind == "slope" ? unit + "/s" : unit;
}

}  // namespace gannet
