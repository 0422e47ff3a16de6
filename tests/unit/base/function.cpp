#include "base/function.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace gannet;

namespace {

Function formula(const std::string& text, std::function<double(double, const Vec3&)> f) {
  Function result;
  result.text = text;
  result.formula = std::move(f);
  return result;
}

}  // namespace

TEST_CASE("function: constants, tables and formulas by their values", "[base]") {
  CHECK(value_at(Function(), 3) == 0);
  CHECK(value_at(Function(2.5), 3) == 2.5);
  CHECK(Function(2.5).constant());
  CHECK(value_at(Function(TimeTable{{1, 3}, {2, 6}}, 10), 2) == 40);
  const Function place = formula("x*t", [](double t, const Vec3& x) { return x.x() * t; });
  CHECK(value_at(place, 3, {2, 0, 0}) == 6);
  const VectorFunction v(Vec3(1, 2, 3));
  CHECK(v.constant());
  CHECK(value_at(v, 7) == Vec3(1, 2, 3));
}

TEST_CASE("function: means are exact for tables and for fifth powers", "[base]") {
  CHECK(mean_over(Function(4.0), 1, 2) == 4);
  CHECK(mean_over(Function(TimeTable{{0, 1, 2}, {0, 1, 0}}, 3), 0, 2) ==
        Approx(1.5).epsilon(1e-15));
  const Function power = formula("t^5", [](double t, const Vec3&) { return std::pow(t, 5); });
  // Integral from 1 to 3: (729 - 1)/6; over 2.
  CHECK(mean_over(power, 1, 3) == Approx(728.0 / 12).epsilon(1e-14));
}

TEST_CASE("function: products keep constants and tables what they are", "[base]") {
  const Function table(TimeTable{{0, 1}, {0, 1}});
  const Function scaled = product(table, Function(4.0));
  CHECK(scaled.factor == 4);
  CHECK(!scaled.formula);
  CHECK(value_at(scaled, 0.5) == 2);
  CHECK(product(Function(2.0), Function(3.0)) == Function(6.0));
  const Function square = product(table, table);
  CHECK(value_at(square, 0.5) == 0.25);
  CHECK(mean_over(square, 0, 1) == Approx(1.0 / 3).epsilon(1e-15));
  CHECK(product(formula("t", [](double t, const Vec3&) { return t; }), Function(3.0)).formula);
  CHECK(value_at(product(Function(3.0), formula("t", [](double t, const Vec3&) { return t; })),
                 2) == 6);
}
