// Particles as shaded spheres.
#pragma once

#include <span>

#include "output/picture_image.hpp"

namespace gannet {

/// A sphere's middle on the canvas, in pixels; depth is that of the middle.
struct Sphere {
  float column = 0;
  float row = 0;
  float depth = 0;
  Rgb colour;
};

/// Brightness of a surface whose unit normal is (right, up, toward the viewer) in the directions
/// of the picture: light comes from the upper left, from behind the viewer.
///   0.55 + 0.5 max(0, n . l)
float brightness(float right, float up, float toward);

/// Draws spheres of one radius [pixels, at least 0.5], hidden where the canvas already shows
/// something nearer; of two at the same depth the first stays. Middles are moved to the middle of
/// their pixel, so that one disc of depths and brightnesses, made once, serves all of them.
/// The canvas is cut into bands of rows that are drawn at the same time; the result does not
/// depend on the number of threads.
void draw_spheres(Canvas& canvas, std::span<const Sphere> spheres, double radius);

}  // namespace gannet
