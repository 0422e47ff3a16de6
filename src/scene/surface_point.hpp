// A point that sits on a surface part and moves with it.
#pragma once

#include <array>

#include "scene/scene.hpp"

namespace gannet {

/// A place on a cell of shells (or of line segments, in a plane case): a weighted mean of two or
/// three of its nodes. Quads are cut along their first diagonal.
struct SurfacePoint {
  std::array<Index, 3> node{};
  std::array<double, 3> weight{};  ///< sum to 1, none below 0
  int n = 0;                       ///< 3, or 2 on a segment; 0: no point was found
  double height = 0;  ///< of the point that was asked for, along the normal at the start [m]
};

/// The place on a part that is nearest to x, in the present configuration; the first one of equals.
/// n = 0 where the part has neither triangles, quads nor lines. x: 3 [m].
SurfacePoint nearest_on_part(const Scene& scene, int part, const Vec3& x);

/// Where the point is now [m].
Vec3 place_of(const SurfacePoint& point, const Nodes& nodes);

/// Normal of the surface there, by the order of its nodes, of length 1; in a plane case to the left
/// of the way from the first node to the second. Zero for a cell without area.
Vec3 normal_of(const SurfacePoint& point, const Nodes& nodes);

}  // namespace gannet
