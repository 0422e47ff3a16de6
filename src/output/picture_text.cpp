#include "output/picture_text.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "output/picture_letters.hpp"

namespace gannet {

namespace {

constexpr double capital = 6;      ///< grid steps of a capital's height
constexpr double narrowing = 0.9;  ///< a column of the grid is narrower than a row is high
constexpr double gap = 1.7;        ///< columns between letters
constexpr int space_columns = 2;
constexpr int baseline_row = 2;

/// The shape that stands for a byte of the text; bytes that go on with a UTF-8 character have none.
const std::string_view* shape_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if ((byte & 0xC0U) == 0x80U) return nullptr;
  const bool printable = byte >= ' ' && byte <= '~';
  return &letter_shapes[static_cast<std::size_t>(printable ? byte - ' ' : '?' - ' ')];
}

int columns_of(std::string_view shape) {
  int columns = shape.empty() ? space_columns : 0;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (shape[k] == ' ') continue;
    columns = std::max(columns, shape[k] - '0');
    ++k;
  }
  return columns;
}

double step_of(double height) { return height / capital; }

/// Calls f(column, row, column, row) for each stroke of a shape.
template <class F>
void for_each_stroke(std::string_view shape, F&& f) {
  for (std::size_t k = 0; k + 3 < shape.size(); k += 2) {
    if (shape[k + 2] == ' ') {
      ++k;  // with the step of two: the first point of the next line
      continue;
    }
    f(shape[k] - '0', shape[k + 1] - '0', shape[k + 2] - '0', shape[k + 3] - '0');
  }
}

}  // namespace

void draw_stroke(Raster& image, const Stroke& s, double pen, Rgb colour) {
  const double half = pen / 2;
  const double dx = s.x1 - s.x0;
  const double dy = s.y1 - s.y0;
  const double length2 = std::max(dx * dx + dy * dy, 1e-12);
  const int left = std::max(0, static_cast<int>(std::floor(std::min(s.x0, s.x1) - half - 1)));
  const int right =
      std::min(image.width - 1, static_cast<int>(std::ceil(std::max(s.x0, s.x1) + half)));
  const int top = std::max(0, static_cast<int>(std::floor(std::min(s.y0, s.y1) - half - 1)));
  const int bottom =
      std::min(image.height - 1, static_cast<int>(std::ceil(std::max(s.y0, s.y1) + half)));
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const double x = column + 0.5 - s.x0;
      const double y = row + 0.5 - s.y0;
      const double t = std::clamp((x * dx + y * dy) / length2, 0.0, 1.0);
      const double covered = std::clamp(half + 0.5 - std::hypot(x - t * dx, y - t * dy), 0.0, 1.0);
      Rgb& pixel = image.pixels[image.at(column, row)];
      if (covered > 0) pixel = mix(pixel, colour, covered);
    }
  }
}

double text_width(std::string_view text, double height) {
  double columns = 0;
  for (const char c : text) {
    if (const auto* shape = shape_of(c)) columns += columns_of(*shape) + gap;
  }
  return text.empty() ? 0 : (columns - gap) * narrowing * step_of(height);
}

void draw_text(Raster& image, double left, double baseline, std::string_view text,
               const Lettering& lettering) {
  const double down = step_of(lettering.height);
  const double across = narrowing * down;
  const double pen = std::max(1.2, 0.13 * lettering.height);
  for (const char c : text) {
    const auto* shape = shape_of(c);
    if (shape == nullptr) continue;
    for_each_stroke(*shape, [&](int c0, int r0, int c1, int r1) {
      draw_stroke(image,
                  {left + c0 * across, baseline - (r0 - baseline_row) * down, left + c1 * across,
                   baseline - (r1 - baseline_row) * down},
                  pen, lettering.colour);
    });
    left += (columns_of(*shape) + gap) * across;
  }
}

}  // namespace gannet
