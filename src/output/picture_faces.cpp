#include "output/picture_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"

namespace gannet {

namespace {

void paint_pixel(Canvas& canvas, std::size_t at, float depth, const Paint& paint) {
  if (!(depth > canvas.depth[at])) return;
  Rgb& pixel = canvas.image.pixels[at];
  if (paint.opacity >= 1) {
    pixel = paint.colour;
    canvas.depth[at] = depth;
  } else {
    pixel = mix(pixel, paint.colour, paint.opacity);
  }
}

/// First and last pixel whose middle lies in [low, high], cut to [0, n).
std::pair<int, int> pixels_between(double low, double high, int n) {
  return {static_cast<int>(std::ceil(std::clamp(low - 0.5, 0.0, 1.0 * n))),
          static_cast<int>(std::floor(std::clamp(high - 0.5, -1.0, n - 1.0)))};
}

/// Twice the area of a, b, p on the picture; its sign says on which side of a-b p lies.
double side(const Vec3& a, const Vec3& b, double column, double row) {
  return (b.x() - a.x()) * (row - a.y()) - (b.y() - a.y()) * (column - a.x());
}

/// A point on the edge a-b belongs to the triangle for which the edge goes down, or to the right.
bool owns_edge(const Vec3& a, const Vec3& b) {
  return b.y() > a.y() || (b.y() == a.y() && b.x() > a.x());
}

}  // namespace

void draw_triangle(Canvas& canvas, const std::array<Vec3, 3>& corners, const Paint& paint) {
  std::array<Vec3, 3> c = corners;
  double area = side(c[0], c[1], c[2].x(), c[2].y());
  if (area < 0) {
    std::swap(c[1], c[2]);
    area = -area;
  }
  if (!(area > 0)) return;
  const auto [left, right] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
  const auto [top, bottom] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
  const auto [first_column, last_column] = pixels_between(left, right, canvas.image.width);
  const auto [first_row, last_row] = pixels_between(top, bottom, canvas.image.height);
  const std::array<bool, 3> owned{owns_edge(c[1], c[2]), owns_edge(c[2], c[0]),
                                  owns_edge(c[0], c[1])};
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double x = column + 0.5;
      const double y = row + 0.5;
      const std::array<double, 3> w{side(c[1], c[2], x, y), side(c[2], c[0], x, y),
                                    side(c[0], c[1], x, y)};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) inside &= w[k] > 0 || (w[k] == 0 && owned[k]);
      if (!inside) continue;
      const double depth = (w[0] * c[0].z() + w[1] * c[1].z() + w[2] * c[2].z()) / area;
      paint_pixel(canvas, canvas.image.at(column, row), static_cast<float>(depth), paint);
    }
  }
}

void draw_edge(Canvas& canvas, const Vec3& a, const Vec3& b, double width, const Paint& paint) {
  const double half = width / 2;
  const double dx = b.x() - a.x();
  const double dy = b.y() - a.y();
  const double length2 = std::max(dx * dx + dy * dy, 1e-12);
  const auto [left, right] = pixels_between(std::min(a.x(), b.x()) - half,
                                            std::max(a.x(), b.x()) + half, canvas.image.width);
  const auto [top, bottom] = pixels_between(std::min(a.y(), b.y()) - half,
                                            std::max(a.y(), b.y()) + half, canvas.image.height);
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const double x = column + 0.5 - a.x();
      const double y = row + 0.5 - a.y();
      const double t = std::clamp((x * dx + y * dy) / length2, 0.0, 1.0);
      const double off2 = (x - t * dx) * (x - t * dx) + (y - t * dy) * (y - t * dy);
      if (off2 > half * half) continue;
      const double depth = a.z() + t * (b.z() - a.z());
      paint_pixel(canvas, canvas.image.at(column, row), static_cast<float>(depth), paint);
    }
  }
}

void darken_gaps(Canvas& canvas, int reach, double strength) {
  const int width = canvas.image.width;
  const int height = canvas.image.height;
  parallel_for(height, 16, [&](Index begin, Index end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < width; ++column) {
        const std::size_t at = canvas.image.at(column, row);
        if (canvas.depth[at] == Canvas::nothing) continue;
        float covered = 0;
        for (int k = 0; k < 9; ++k) {
          const int c = std::clamp(column + (k % 3 - 1) * reach, 0, width - 1);
          const int r = std::clamp(row + (k / 3 - 1) * reach, 0, height - 1);
          const float above = canvas.depth[canvas.image.at(c, r)] - canvas.depth[at];
          covered += std::clamp(above / static_cast<float>(reach) - 0.5F, 0.0F, 1.0F);
        }
        canvas.image.pixels[at] =
            shaded(canvas.image.pixels[at], std::exp(static_cast<float>(-strength) * covered / 8));
      }
    }
  });
}

}  // namespace gannet
