// A picture in memory, and how it becomes a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gannet {

/// A colour of sRGB; each part 0 ... 255.
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// a + t (b - a) of each part, t in [0, 1].
Rgb mix(Rgb a, Rgb b, double t);

/// Times a brightness; what passes 255 stays there.
Rgb shaded(Rgb colour, float brightness);

/// Rows from the top, pixels from the left. The middle of pixel (column, row) is at
/// (column + 0.5, row + 0.5).
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;

  Raster(int columns, int rows, Rgb background);
  [[nodiscard]] std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// An image with the depth of what each pixel shows: in pixels towards the viewer, far behind
/// everything where nothing was drawn yet.
struct Canvas {
  Raster image;
  std::vector<float> depth;

  static constexpr float nothing = -1e30F;
  Canvas(int columns, int rows, Rgb background);
};

/// Mean of every factor x factor pixels: smooth edges for what was drawn `factor` times too large.
/// Width and height must be multiples of factor.
Raster shrink(const Raster& image, int factor);

/// Rounds each part of each colour to the nearest multiple of 5 (0 and 255 stay): shades that the
/// eye cannot tell apart become one, and a PNG of thousands of spheres shrinks by a third.
void merge_shades(Raster& image);

/// Writes a PNG; the file has its name only when it is complete. Throws std::runtime_error where
/// it cannot be written.
void write_png(const Raster& image, const std::string& path);

}  // namespace gannet
