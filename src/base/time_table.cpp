#include "base/time_table.hpp"

#include <algorithm>

namespace gannet {

namespace {

/// Integral of y from the first point of the table to t, negative before it.
double integral_to(const TimeTable& table, double t) {
  if (t <= table.t.front()) return (t - table.t.front()) * table.y.front();
  double sum = 0;
  for (std::size_t k = 1; k < table.t.size(); ++k) {
    const double length = table.t[k] - table.t[k - 1];
    const double part = std::min(t, table.t[k]) - table.t[k - 1];
    if (t <= table.t[k - 1]) return sum;
    if (!(length > 0)) continue;  // a jump
    sum += part * (table.y[k - 1] + 0.5 * part / length * (table.y[k] - table.y[k - 1]));
  }
  return sum + std::max(0.0, t - table.t.back()) * table.y.back();
}

}  // namespace

double value_at(const TimeTable& table, double t) {
  if (table.t.empty()) return 1;
  // The first point after t: of two points at one time (a jump) the later one holds.
  const auto after = std::upper_bound(table.t.begin(), table.t.end(), t);
  if (after == table.t.begin()) return table.y.front();
  if (after == table.t.end()) return table.y.back();
  const auto k = static_cast<std::size_t>(after - table.t.begin());
  const double s = (t - table.t[k - 1]) / (table.t[k] - table.t[k - 1]);
  return table.y[k - 1] + s * (table.y[k] - table.y[k - 1]);
}

double mean_over(const TimeTable& table, double from, double to) {
  if (table.t.empty()) return 1;
  // Within one straight line the mean is the value in the middle, free of the cancellation of two
  // long integrals.
  const auto a = std::upper_bound(table.t.begin(), table.t.end(), from);
  const auto b = std::lower_bound(table.t.begin(), table.t.end(), to);
  if (a == b) return value_at(table, 0.5 * (from + to));
  return (integral_to(table, to) - integral_to(table, from)) / (to - from);
}

TimeTable step_from(double from, double ramp) { return {{from, from + ramp}, {0, 1}}; }

}  // namespace gannet
