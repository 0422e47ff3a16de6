#include "base/units.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace gannet;

namespace {

struct Example {
  const char* text;
  double value;
  Dimension dimension;
};

std::string trouble_of(const char* text) {
  try {
    parse_quantity(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("units: quantities become SI, correctly rounded where the factor is a power of ten",
          "[base]") {
  const Example examples[] = {
      {"6 m/s", 6, dim::velocity},
      {"2.5 mm", 0.0025, dim::length},
      {"9 mm", 0.009, dim::length},
      {"-600 mm", -0.6, dim::length},
      {"+3cm", 0.03, dim::length},
      {"1.2 km", 1200, dim::length},
      {"70 GPa", 70e9, dim::pressure},
      {"68.9 MPa", 68.9e6, dim::pressure},
      {"1 bar", 1e5, dim::pressure},
      {"20 ms", 0.02, dim::time},
      {"10 us", 1e-5, dim::time},
      {"10 \u00b5s", 1e-5, dim::time},
      {"5 min", 300, dim::time},
      {"2 h", 7200, dim::time},
      {"3 kg", 3, dim::mass},
      {"27700 t", 27.7e6, dim::mass},
      {"250 g", 0.25, dim::mass},
      {"4 kN", 4000, dim::force},
      {"5 kJ", 5000, dim::energy},
      {"12 N*m", 12, dim::moment},
      {"12 kNm", 12000, dim::moment},
      {"1.5 kHz", 1500, dim::frequency},
      {"2 1/s", 2, dim::frequency},
      {"300 K", 300, dim::temperature},
      {"9.81 m/s^2", 9.81, dim::acceleration},
      {"9.81 m/s\u00b2", 9.81, dim::acceleration},
      {"7.85 g/cm^3", 7850, dim::density},
      {"1000 kg*m^-3", 1000, dim::density},
      {"1 mm^2/s", 1e-6, dim::kinematic_viscosity},
      {"1 mPa*s", 1e-3, dim::dynamic_viscosity},
      {"2 %", 0.02, dim::none},
      {"0.3 -", 0.3, dim::none},
      {"1 kN/mm", 1e6, {{0, 1, -2, 0, 0}}},
      {"4 MPa/s", 4e6, {{-1, 1, -3, 0, 0}}},
      {"5 W/(m*K)", 5, {{1, 1, -3, -1, 0}}},
      {"every 0.25 ms", 0.00025, dim::time},
      {"every 5 min of wall time", 300, dim::time},
  };
  for (const Example& e : examples) {
    INFO(e.text);
    const Quantity q = parse_quantity(e.text);
    CHECK(q.dimension == e.dimension);
    CHECK_FALSE(q.bare);
    CHECK(q.value == e.value);  // one rounding only, so the same bits as the literal
  }
}

TEST_CASE("units: units whose factor is no power of ten", "[base]") {
  const double pi = std::numbers::pi;
  const Example examples[] = {
      {"25 deg", 25 * pi / 180, dim::angle},
      {"30\u00b0", pi / 6, dim::angle},
      {"10 deg/s", pi / 18, dim::angular_velocity},
      {"60 rpm", 2 * pi, dim::angular_velocity},
      {"36 km/h", 10, dim::velocity},
      {"2 kn", 2 * 1852.0 / 3600, dim::velocity},
      {"10 ft", 3.048, dim::length},
      {"1 in", 0.0254, dim::length},
      {"3 psi", 3 * 6894.757293168361, dim::pressure},
  };
  for (const Example& e : examples) {
    INFO(e.text);
    const Quantity q = parse_quantity(e.text);
    CHECK(q.dimension == e.dimension);
    // Two or three roundings of 1.1e-16 each.
    CHECK(q.value == Approx(e.value).epsilon(4e-16));
  }
}

TEST_CASE("units: a number without a unit is bare", "[base]") {
  const Quantity q = parse_quantity(" -1.5e-3 ");
  CHECK(q.bare);
  CHECK(q.value == -1.5e-3);
  CHECK(q.dimension == dim::none);
}

TEST_CASE("units: what is not understood is named", "[base]") {
  CHECK(trouble_of("3 mss") == "unknown unit 'mss'");
  CHECK(trouble_of("3 kft") == "unknown unit 'kft'");
  CHECK(trouble_of("3 m/") == "unknown unit 'm/'");
  CHECK(trouble_of("3 m/s^") == "unknown unit 'm/s^'");
  CHECK(trouble_of("3 (m") == "unknown unit '(m'");
  CHECK(trouble_of("3 m)") == "unknown unit 'm)'");
  CHECK(trouble_of("3 kg m") == "unknown unit 'kg m'");
  CHECK(trouble_of("1e999 m") == "out of reach");
  for (const char* text : {"", " ", "m", "-", ".", "--3", ".nan", "nan", "inf", "-.inf", "dx"}) {
    INFO(text);
    CHECK(trouble_of(text) == "not a number");
  }
}

TEST_CASE("units: dimensions have names, SI units and examples", "[base]") {
  CHECK(name_of(dim::length) == "length");
  CHECK(name_of(dim::length / dim::time) == "velocity");
  CHECK(name_of(dim::force / dim::area) == "pressure");
  CHECK(si_unit_of(dim::pressure) == "Pa");
  CHECK(si_unit_of(dim::none) == "-");
  CHECK(wanted_text(dim::length) == "a length is wanted (m, mm, ft, ...)");
  CHECK(wanted_text(dim::angle) == "an angle is wanted (deg, rad, ...)");
  const Dimension odd{{1, 2, -3, -1, 0}};
  CHECK(name_of(odd) == "quantity in m*kg^2/s^3/K");
  CHECK(si_unit_of({{0, 0, -2, 0, 0}}) == "1/s^2");
}

TEST_CASE("units: every SI unit that is printed reads back as itself", "[base]") {
  for (int m = -3; m <= 3; ++m) {
    for (int kg = -1; kg <= 1; ++kg) {
      for (int s = -3; s <= 2; ++s) {
        const Dimension d{{m, kg, s, m % 2, 0}};
        const Quantity q = parse_quantity("2 " + si_unit_of(d));
        INFO(si_unit_of(d));
        CHECK(q.dimension == d);
        CHECK(q.value == 2);
      }
    }
  }
}
