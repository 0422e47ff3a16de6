#include "study/study_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace gannet {

namespace {

constexpr double lowest_order = 0.1;
constexpr double highest_order = 8;

/// The order at which f is smallest: a look over the whole range, then golden sections.
double best_order(const std::function<double(double)>& f) {
  const int n = 400;
  const double step = (highest_order - lowest_order) / n;
  double best = lowest_order;
  for (int k = 1; k <= n; ++k) {
    const double p = lowest_order + k * step;
    if (f(p) < f(best)) best = p;
  }
  double lo = std::max(best - step, lowest_order);
  double hi = std::min(best + step, highest_order);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  while (hi - lo > 1e-10) {
    const double left = hi - ratio * (hi - lo);
    const double right = lo + ratio * (hi - lo);
    if (f(left) < f(right)) {
      hi = right;
    } else {
      lo = left;
    }
  }
  return (lo + hi) / 2;
}

/// Near a bound the minimum lies beyond it, or so flat that the limit is anybody's guess.
bool at_a_bound(double p) { return p < lowest_order + 0.02 || p > highest_order - 0.02; }

double mean_of(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double squares_about_mean(const std::vector<double>& x) {
  const double mean = mean_of(x);
  double sum = 0;
  for (const double value : x) sum += (value - mean) * (value - mean);
  return sum;
}

/// Levels whose errors can be fitted; sizes are relative to `unit`, so that powers stay near 1.
struct Levels {
  std::vector<double> h;
  std::vector<double> log_e;
  double h_ref = 0;
  double unit = 1;

  [[nodiscard]] double log_shape(double size, double p) const {
    const double ref = h_ref > 0 ? std::pow(h_ref, p) : 0;
    return std::log(std::pow(size, p) - ref);
  }
  /// log e - log(h^p - h_ref^p): constant where the law holds.
  [[nodiscard]] std::vector<double> log_coefficients(double p) const {
    std::vector<double> c;
    for (std::size_t i = 0; i < h.size(); ++i) c.push_back(log_e[i] - log_shape(h[i], p));
    return c;
  }
  [[nodiscard]] std::vector<double> gradients(double p) const {
    std::vector<double> g;
    const double ref = h_ref > 0 ? std::pow(h_ref, p) : 0;
    const double ref_log = h_ref > 0 ? ref * std::log(h_ref) : 0;
    for (const double size : h) {
      const double power = std::pow(size, p);
      g.push_back((power * std::log(size) - ref_log) / (power - ref));
    }
    return g;
  }
};

Levels levels_of(std::span<const double> h, std::span<const double> error, double h_ref) {
  Levels levels;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (!(error[i] > 0) || !std::isfinite(error[i]) || !(h[i] > h_ref * (1 + 1e-9))) continue;
    levels.h.push_back(h[i]);
    levels.log_e.push_back(std::log(error[i]));
  }
  if (levels.h.empty()) return levels;
  levels.unit = *std::max_element(levels.h.begin(), levels.h.end());
  for (double& size : levels.h) size /= levels.unit;
  levels.h_ref = h_ref / levels.unit;
  return levels;
}

}  // namespace

double OrderFit::error_at(double h) const {
  const double ref = h_ref > 0 ? std::pow(h_ref, order) : 0;
  return coefficient * (std::pow(h, order) - ref);
}

double OrderFit::size_for(double e) const {
  const double ref = h_ref > 0 ? std::pow(h_ref, order) : 0;
  return std::pow(e / coefficient + ref, 1 / order);
}

OrderFit fit_order(std::span<const double> h, std::span<const double> error, double h_ref) {
  OrderFit fit;
  fit.h_ref = h_ref;
  const Levels levels = levels_of(h, error, h_ref);
  const std::size_t n = levels.h.size();
  if (n < 2) {
    fit.reason = fmt::format("an order needs two levels with an error, there {}",
                             n == 0 ? "is none" : "is one");
    return fit;
  }
  const auto residual = [&](double p) { return squares_about_mean(levels.log_coefficients(p)); };
  const double p = best_order(residual);
  if (at_a_bound(p)) {
    fit.reason = "errors do not shrink like a power of the size";
    return fit;
  }
  fit.valid = true;
  fit.order = p;
  fit.coefficient = std::exp(mean_of(levels.log_coefficients(p))) / std::pow(levels.unit, p);
  if (n > 2) {
    const double s = std::sqrt(residual(p) / static_cast<double>(n - 2));
    const double spread = std::sqrt(squares_about_mean(levels.gradients(p)));
    const double half = student_95(static_cast<int>(n) - 2) * s / spread;
    fit.low = p - half;
    fit.high = p + half;
  }
  return fit;
}

namespace {

struct Line2 {
  double constant = 0;
  double slope = 0;
  double squares = 0;  ///< of what is left
};

/// y = constant + slope x by least squares.
Line2 fit_line(const std::vector<double>& x, std::span<const double> y) {
  const double x_mean = mean_of(x);
  const double y_mean = mean_of({y.begin(), y.end()});
  double xy = 0;
  double xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - x_mean) * (y[i] - y_mean);
    xx += (x[i] - x_mean) * (x[i] - x_mean);
  }
  Line2 line;
  line.slope = xy / xx;
  line.constant = y_mean - line.slope * x_mean;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - line.constant - line.slope * x[i];
    line.squares += r * r;
  }
  return line;
}

/// "" where results change one way only, from coarse to fine.
std::string why_not_monotone(const std::vector<double>& phi) {
  for (std::size_t i = 2; i < phi.size(); ++i) {
    if ((phi[i] - phi[i - 1]) * (phi[i - 1] - phi[i - 2]) <= 0) {
      return fmt::format("results are not monotone: {:.5g}, {:.5g}, {:.5g}", phi[i - 2], phi[i - 1],
                         phi[i]);
    }
  }
  return "";
}

}  // namespace

LimitFit fit_limit(std::span<const double> h, std::span<const double> phi) {
  LimitFit fit;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (std::isfinite(phi[i]) && h[i] > 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return h[a] > h[b]; });
  if (order.size() < 3) {
    fit.reason = fmt::format("three levels are needed, there are {}", order.size());
    return fit;
  }
  std::vector<double> size;
  std::vector<double> value;
  for (const std::size_t i : order) {
    size.push_back(h[i] / h[order.front()]);
    value.push_back(phi[i]);
  }
  fit.reason = why_not_monotone(value);
  if (!fit.reason.empty()) return fit;
  const auto line_at = [&](double p) {
    std::vector<double> x;
    for (const double s : size) x.push_back(std::pow(s, p));
    return fit_line(x, value);
  };
  const double p = best_order([&](double q) { return line_at(q).squares; });
  if (at_a_bound(p)) {
    fit.reason = "changes do not shrink like a power of the size";
    return fit;
  }
  const Line2 line = line_at(p);
  fit.valid = true;
  fit.order = p;
  fit.limit = line.constant;
  fit.coefficient = line.slope / std::pow(h[order.front()], p);
  const std::size_t n = value.size();
  if (n > 3) fit.scatter = std::sqrt(line.squares / static_cast<double>(n - 3));
  fit.gci = (1.25 * std::abs(fit.limit - value.back()) + fit.scatter) / std::abs(value.back());
  return fit;
}

double PowerLaw::at(double x) const { return coefficient * std::pow(x, exponent); }

PowerLaw fit_power(std::span<const double> x, std::span<const double> y, std::size_t last) {
  const std::size_t first = last > 0 && last < x.size() ? x.size() - last : 0;
  std::vector<double> log_x;
  std::vector<double> log_y;
  for (std::size_t i = first; i < x.size(); ++i) {
    log_x.push_back(std::log(x[i]));
    log_y.push_back(std::log(y[i]));
  }
  PowerLaw law;
  if (log_x.size() < 2 || squares_about_mean(log_x) < 1e-12) return law;
  const Line2 line = fit_line(log_x, log_y);
  law.exponent = line.slope;
  law.coefficient = std::exp(line.constant);
  return law;
}

double student_95(int degrees_of_freedom) {
  constexpr std::array<double, 10> table = {12.706, 4.303, 3.182, 2.776, 2.571,
                                            2.447,  2.365, 2.306, 2.262, 2.228};
  if (degrees_of_freedom < 1) return std::numeric_limits<double>::infinity();
  if (degrees_of_freedom <= 10) return table[static_cast<std::size_t>(degrees_of_freedom - 1)];
  return 1.96 + 2.6 / degrees_of_freedom;  // within 0.3 % of the quantile from 11 on
}

}  // namespace gannet
