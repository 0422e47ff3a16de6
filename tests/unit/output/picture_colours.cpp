#include "output/picture_colours.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "output/picture_legend.hpp"

using namespace gannet;

namespace {

/// Relative luminance of sRGB (IEC 61966-2-1) without its linear toe, enough to order colours.
double luminance(Rgb c) {
  const auto linear = [](double v) { return std::pow(v / 255, 2.2); };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

}  // namespace

TEST_CASE("picture colours: both ends, the clamp beyond them, and a middle", "[output]") {
  // The blue end is at 0.2 of the whole map: 0.6 of the way from (71, 45, 123) to (59, 82, 139).
  CHECK(colour_at(0) == Rgb{64, 67, 133});
  CHECK(colour_at(1) == Rgb{253, 231, 37});
  CHECK(colour_at(-7) == colour_at(0));
  CHECK(colour_at(7) == colour_at(1));
  CHECK(colour_at(std::numeric_limits<double>::quiet_NaN()) == colour_at(0));
  // 0.2 + 0.8 * 0.375 = 0.5: the fifth of nine colours.
  CHECK(colour_at(0.375) == Rgb{33, 144, 140});
}

TEST_CASE("picture colours: brightness rises all the way", "[output]") {
  for (int k = 0; k < 32; ++k) {
    CAPTURE(k);
    CHECK(luminance(colour_at((k + 1) / 32.0)) > luminance(colour_at(k / 32.0)));
  }
}

TEST_CASE("picture colours: a few strays do not count", "[output]") {
  std::vector<double> values;
  for (int k = 0; k <= 1000; ++k) values.push_back(k);
  values[500] = std::numeric_limits<double>::quiet_NaN();
  values.push_back(1e9);
  values.push_back(-1e9);
  const Span whole = trimmed_span(values, 0);
  CHECK(whole.low == -1e9);
  CHECK(whole.high == 1e9);
  // 1002 numbers in order, from -1e9: number 10 is 9, number 991 of 1001 is 991 without 500.
  const Span most = trimmed_span(values, 0.01);
  CHECK(most.low == 9);
  CHECK(most.high == 991);
  CHECK(trimmed_span({}, 0.1).high == 1);
}

TEST_CASE("picture colours: ticks are 1, 2 or 5 times a power of ten", "[output]") {
  const Ticks speed = ticks_of({0.3, 11.2});
  CHECK(speed.span.low == 0);
  CHECK(speed.step == Approx(2));
  CHECK(speed.span.high == Approx(12));
  CHECK(speed.count() == 7);
  const Ticks pressure = ticks_of({-640e3, 1470e3});
  CHECK(pressure.step == Approx(500e3));
  CHECK(pressure.span.low == Approx(-1e6));
  CHECK(pressure.span.high == Approx(1.5e6));
  CHECK(ticks_of({0, 0}).span.high == Approx(1));
  const Ticks same = ticks_of({1000, 1000});
  CHECK(same.span.low <= 1000);
  CHECK(same.span.high > 1000);
}

TEST_CASE("picture colours: units and numbers as one writes them", "[output]") {
  CHECK(shown_unit("Pa", {-2e5, 1.5e6}).name == "MPa");
  CHECK(shown_unit("Pa", {-2e5, 1e5}).divisor == 1e3);
  CHECK(shown_unit("m/s", {0, 5000}).name == "m/s");
  CHECK(shown_unit("m", {0, 0.003}).name == "mm");
  CHECK(tick_text(1.5, 0.5) == "1.5");
  CHECK(tick_text(-2, 2) == "-2");
  CHECK(tick_text(-1e-17, 0.02) == "0.00");
  CHECK(time_text(0.008, 0.025) == "8.00 ms");
  CHECK(time_text(0.25, 2) == "0.250 s");
}
