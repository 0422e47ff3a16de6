// From numbers to colours, and to the numbers beside the colour bar.
#pragma once

#include <string>
#include <vector>

#include "output/picture_image.hpp"

namespace gannet {

/// Colour of t in [0, 1], clamped: from blue over green to yellow, in even steps of brightness. It
/// is viridis (Smith and van der Walt), nine colours with straight lines in between, without its
/// darkest fifth, which would be black on the dark side of a sphere.
Rgb colour_at(double t);

/// Numbers that a colour bar runs over, SI.
struct Span {
  double low = 0;
  double high = 1;
};

/// Least and largest value without the `tail` (share) of values at either end, so that a few
/// stray particles do not use up the colours. {0, 1} of no values; NaN are left out.
Span trimmed_span(std::vector<double> values, double tail);

/// The step of 1, 2 or 5 times a power of ten that cuts a span into 3 to 7 pieces, and the span
/// widened to whole steps; a span without width is widened by 1 (or 1e-6 of its value, if larger).
struct Ticks {
  Span span;
  double step = 1;
  [[nodiscard]] int count() const;
};
Ticks ticks_of(Span span);

/// A unit with prefix that suits a span, and what SI values are divided by: {"kPa", 1e3}.
struct ShownUnit {
  std::string name;
  double divisor = 1;
};
ShownUnit shown_unit(const std::string& si_unit, Span span);

}  // namespace gannet
