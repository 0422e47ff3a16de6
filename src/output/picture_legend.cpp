#include "output/picture_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/picture_text.hpp"

namespace gannet {

namespace {

constexpr Rgb ink{30, 30, 35};
constexpr Rgb pale_ink{90, 90, 95};

/// Lengths of the layout are for a picture of 1280 x 720 and grow with it.
double unit_of(int width, int height) { return std::min(width / 1280.0, height / 720.0); }

constexpr double margin = 24;
constexpr double bar_width = 18;
constexpr double bar_to_edge = 84;  ///< from the bar's right side to that of the picture

}  // namespace

Area scene_area(int width, int height) {
  const double u = unit_of(width, height);
  const double top = 84 * u;
  return {margin * u, top, width - (2 * margin + bar_width + bar_to_edge) * u,
          height - top - margin * u};
}

std::string time_text(double t, double last) {
  const double largest = std::max(std::abs(t), std::abs(last));
  if (largest >= 1 || largest == 0) return fmt::format("{:.3f} s", t);
  if (largest >= 1e-3) return fmt::format("{:.2f} ms", t * 1e3);
  return fmt::format("{:.2f} us", t * 1e6);
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) value = 0;
  if (step >= 1e6 || step < 1e-4) return fmt::format("{:.3g}", value);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

void draw_title(Raster& image, const std::string& title, const std::string& time) {
  const double u = unit_of(image.width, image.height);
  draw_text(image, margin * u, 40 * u, title, {.height = 16 * u, .colour = ink});
  draw_text(image, margin * u, 70 * u, "t = " + time, {.height = 14 * u, .colour = pale_ink});
}

void draw_colour_bar(Raster& image, const std::string& label, const std::string& si_unit,
                     const Ticks& ticks) {
  const double u = unit_of(image.width, image.height);
  const double right = image.width - bar_to_edge * u;
  const double left = right - bar_width * u;
  const double top = 0.24 * image.height;
  const double bottom = 0.80 * image.height;
  for (int row = static_cast<int>(top); row < static_cast<int>(bottom); ++row) {
    const Rgb colour = colour_at((bottom - row - 0.5) / (bottom - top));
    for (int c = std::max(0, static_cast<int>(left)); c < static_cast<int>(right); ++c) {
      image.pixels[image.at(c, row)] = colour;
    }
  }
  const ShownUnit unit = shown_unit(si_unit, ticks.span);
  for (int k = 0; k < ticks.count(); ++k) {
    const double value = ticks.span.low + k * ticks.step;
    const double row =
        bottom - (bottom - top) * (value - ticks.span.low) / (ticks.span.high - ticks.span.low);
    draw_stroke(image, {right, row, right + 5 * u, row}, std::max(1.0, u), pale_ink);
    draw_text(image, right + 11 * u, row + 6 * u,
              tick_text(value / unit.divisor, ticks.step / unit.divisor),
              {.height = 12 * u, .colour = ink});
  }
  const std::string text = unit.name.empty() ? label : fmt::format("{} [{}]", label, unit.name);
  const double text_left = std::min(left, image.width - margin * u - text_width(text, 13 * u));
  draw_text(image, text_left, top - 18 * u, text, {.height = 13 * u, .colour = ink});
}

}  // namespace gannet
