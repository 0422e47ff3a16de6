#include "base/function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gannet {

namespace {

std::string text_of(const TimeTable& table, double factor) {
  std::string points;
  for (std::size_t k = 0; k < table.t.size(); ++k) {
    points += fmt::format("{}[{} s, {}]", k == 0 ? "" : ", ", table.t[k], table.y[k]);
  }
  if (factor == 1) return fmt::format("[{}]", points);
  return fmt::format("{{table: [{}], factor: {}}}", points, factor);
}

}  // namespace

Function::Function(double constant) : text(fmt::format("{}", constant)), factor(constant) {}

Function::Function(TimeTable points, double times)
    : text(text_of(points, times)), factor(times), table(std::move(points)) {}

double value_at(const Function& f, double t, const Vec3& x) {
  if (f.formula) return f.formula(t, x);
  return f.table.t.empty() ? f.factor : f.factor * value_at(f.table, t);
}

double mean_over(const Function& f, double from, double to) {
  if (f.constant()) return f.factor;
  if (!f.formula) return f.factor * mean_over(f.table, from, to);
  const double middle = 0.5 * (from + to);
  const double away = 0.5 * (to - from) * std::sqrt(0.6);
  const auto at = [&f](double t) { return f.formula(t, Vec3::Zero()); };
  return (5 * at(middle - away) + 8 * at(middle) + 5 * at(middle + away)) / 18;
}

Function product(const Function& a, const Function& b) {
  if (b.constant() && !a.constant()) return product(b, a);
  if (a.constant() && a.factor == 0) return Function(0.0);
  Function f = b;
  if (a.constant() && !b.formula) {
    if (b.constant()) return Function(a.factor * b.factor);
    return Function(b.table, a.factor * b.factor);
  }
  f.text = fmt::format("({})*({})", a.text, b.text);
  f.formula = [a, b](double t, const Vec3& x) { return value_at(a, t, x) * value_at(b, t, x); };
  f.table = {};
  f.of_place = a.of_place || b.of_place;
  return f;
}

VectorFunction::VectorFunction(const Vec3& constant)
    : component{Function(constant.x()), Function(constant.y()), Function(constant.z())} {}

bool VectorFunction::constant() const {
  return std::all_of(component.begin(), component.end(),
                     [](const Function& f) { return f.constant(); });
}

Vec3 value_at(const VectorFunction& f, double t, const Vec3& x) {
  return {value_at(f.component[0], t, x), value_at(f.component[1], t, x),
          value_at(f.component[2], t, x)};
}

}  // namespace gannet
