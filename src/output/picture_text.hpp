// Letters, drawn with a round pen.
#pragma once

#include <string_view>

#include "output/picture_image.hpp"

namespace gannet {

/// A line from (x0, y0) to (x1, y1) in pixels, with round ends.
struct Stroke {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

/// Draws a stroke with a pen of the given width [pixels]; the outermost pixel is mixed with what
/// was there, by how much of it the pen covers.
void draw_stroke(Raster& image, const Stroke& stroke, double pen, Rgb colour);

/// How text looks; height of a capital letter [pixels].
struct Lettering {
  double height = 14;
  Rgb colour;
};

/// Width of a text [pixels]; every letter is as wide as its shape. Characters that are not
/// printable ASCII are shown as '?', one for each character of UTF-8.
double text_width(std::string_view text, double height);

/// Writes text whose baseline begins at (left, baseline).
void draw_text(Raster& image, double left, double baseline, std::string_view text,
               const Lettering& lettering);

}  // namespace gannet
