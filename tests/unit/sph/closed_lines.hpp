// Closed lines in the plane, as surfaces that water stands inside or outside of.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/shapes.hpp"

namespace gannet::test {

inline ClosedSurface polygon(const std::vector<Vec3>& points) {
  ClosedSurface surface{.dimension = 2};
  std::vector<Index> lines;
  const auto n = static_cast<Index>(points.size());
  for (Index k = 0; k < n; ++k) lines.insert(lines.end(), {k, (k + 1) % n});
  add_boundary(points, lines, 2, false, surface);
  REQUIRE(close_surface(surface).empty());
  return surface;
}

/// A polygon of 200 corners on a circle of radius R [m].
inline ClosedSurface circle(const Vec3& centre, double R) {
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) {
    const double angle = 2 * std::numbers::pi * k / 200;
    points.push_back(centre + R * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  return polygon(points);
}

}  // namespace gannet::test
