// Where the dummy particles behind planes stand.
#pragma once

#include <array>
#include <vector>

#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What the walls are built around.
struct WallRegion {
  Vec3 low = Vec3::Zero();   ///< where walls end that no plane ends, and where the period begins
  Vec3 high = Vec3::Zero();  ///< [m]
  std::array<bool, 3> periodic{};
  double dx = 0;     ///< spacing [m], > 0
  int n_layers = 0;  ///< behind each plane
  int dimension = 3;
};

/// The dummy particles of each plane, in the order of the planes: n_layers layers, the first half a
/// spacing behind the plane.
/// Planes across an axis share one lattice, which holds a whole number of cells between two planes
/// and of cells dx elsewhere, and fills edges and corners: a point behind several planes belongs
/// to the one that it is deepest behind. A plane that leans has a lattice of its own, along the
/// plane; of that stand the points that are no nearer than 3/4 dx to one that stands already.
/// No point is deeper than n_layers dx behind any of the planes: what the planes enclose is taken
/// to be convex.
std::vector<std::vector<Vec3>> points_behind(const std::vector<Plane>& planes,
                                             const WallRegion& region);

}  // namespace gannet
