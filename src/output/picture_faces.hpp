// Faces and edges of elements.
#pragma once

#include <array>

#include "base/math.hpp"
#include "output/picture_image.hpp"

namespace gannet {

/// How a face or edge looks: its colour already shaded, and how much of what is behind it is
/// covered (1: all of it; below 1 the depth of the canvas stays as it is).
struct Paint {
  Rgb colour;
  double opacity = 1;
};

/// Fills a triangle of corners (column, row, depth) where it is the nearest. Pixels count whose
/// middle is inside; those on a shared edge belong to one of two neighbours only, so that a
/// see-through surface has no seams.
void draw_triangle(Canvas& canvas, const std::array<Vec3, 3>& corners, const Paint& paint);

/// A straight edge of `width` pixels from a to b (column, row, depth) with round
/// ends, hidden by what is nearer.
void draw_edge(Canvas& canvas, const Vec3& a, const Vec3& b, double width, const Paint& paint);

/// Darkens what lies behind its neighbours on the picture, so that outlines and gaps can be seen:
/// brightness exp(-strength mean(min(1, max(0, (depth of neighbour - depth) / reach - 0.5)))) over
/// the eight neighbours `reach` pixels away. What was not drawn stays as it is.
void darken_gaps(Canvas& canvas, int reach, double strength);

}  // namespace gannet
