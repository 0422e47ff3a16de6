#include "input/formula.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace gannet;

namespace {

Formulas names() {
  Formulas f;
  f.define("V", parse_quantity("6 m/s"));
  f.define("beta", parse_quantity("25 deg"));
  f.define("dx", parse_quantity("10 mm"));
  return f;
}

std::string trouble_of(const std::string& text) {
  const Formulas f = names();
  try {
    static_cast<void>(f.read(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("formula: the spray-root speed of a wedge", "[input]") {
  const Quantity q = names().read("V*pi/(2*tan(beta))");
  CHECK(q.bare);
  // V pi / (2 tan beta) at 6 m/s, 25 degrees; the parser may order the factors otherwise.
  const double expected = 6 * std::numbers::pi / (2 * std::tan(25 * std::numbers::pi / 180));
  CHECK(q.value == Approx(expected).epsilon(1e-15));
  CHECK(q.value == Approx(20.2114).epsilon(1e-5));
}

TEST_CASE("formula: a lone name keeps its dimension, a formula has none", "[input]") {
  const Formulas f = names();
  CHECK(f.read("dx").value == 0.01);
  CHECK(f.read("dx").dimension == dim::length);
  CHECK(f.read("-V").value == -6);
  CHECK(f.read(" - V").dimension == dim::velocity);
  CHECK(f.read("2*dx").bare);
  CHECK(f.read("2*dx").value == 0.02);
  CHECK(f.read("1e-3*dx").value == Approx(1e-5).epsilon(1e-15));
  CHECK(f.read("-2*dx").value == -0.02);
  CHECK(f.read("pi").value == std::numbers::pi);
  CHECK(f.read("3 mm").value == 0.003);
  CHECK(f.read("sqrt(2*9.81*0.5)").value == Approx(std::sqrt(9.81)).epsilon(1e-15));
}

TEST_CASE("formula: what is not understood is named", "[input]") {
  CHECK(trouble_of("2*dxx") ==
        "'2*dxx': unknown name 'dxx'; did you mean 'dx'? (names under let: V, beta, dx)");
  CHECK(trouble_of("tann(beta)") == "'tann(beta)': unknown function 'tann'; did you mean 'tan'?");
  CHECK(trouble_of("2*(dx") == "'2*(dx' cannot be worked out: Missing parenthesis");
  CHECK(trouble_of("dx/0") == "'dx/0' gives inf, not a finite number");
  CHECK(trouble_of("dx=3") == "'dx=3' is not a number");
  CHECK(trouble_of("2*1,2") == "'2*1,2' has a comma; write one number");
  CHECK(trouble_of("thick") == "'thick' is not a number");
  CHECK(trouble_of("3 mss") == "'3 mss': unknown unit 'mss'");
  CHECK(trouble_of(".nan") == "'.nan' is not a number");
}

TEST_CASE("formula: names that could not be told apart are refused", "[input]") {
  Formulas f;
  CHECK_THROWS_AS(f.define("sin", {}), std::invalid_argument);
  CHECK_THROWS_AS(f.define("pi", {}), std::invalid_argument);
  CHECK_THROWS_AS(f.define("2a", {}), std::invalid_argument);
  CHECK_THROWS_AS(f.define("a b", {}), std::invalid_argument);
}

TEST_CASE("formula: what rests on a broken name fails without a message of its own", "[input]") {
  Formulas f;
  f.define_broken("a");
  CHECK_THROWS_WITH(f.read("2*a"), "");
  CHECK_THROWS_WITH(f.read("a"), "");
}
