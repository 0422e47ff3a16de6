// A lattice around a closed surface: which of its points are inside, and how far from the surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/closed_surface.hpp"

namespace gannet {

/// Points low + (i + 1/2) cell in each direction, x runs fastest. In the plane one layer at z = 0.
struct SurfaceGrid {
  int dimension = 3;
  Vec3 low = Vec3::Zero();
  Vec3 cell = Vec3::Zero();  ///< [m]
  std::array<std::int64_t, 3> n{1, 1, 1};
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(n[0] * n[1] * n[2]); }
  [[nodiscard]] Vec3 point(std::int64_t i, std::int64_t j, std::int64_t k) const;
  [[nodiscard]] Vec3 point(std::size_t number) const;
};

/// The lattice of whole cells, each about dx, that fills the box around a surface widened by
/// `margin` on each side [m].
SurfaceGrid grid_around(const ClosedSurface& surface, double dx, double margin);

/// 1 for points inside: an odd number of faces lies beyond them along x. Rows are taken a millionth
/// of a cell beside the points, so that they do not run along edges. Needs close_surface().
std::vector<std::uint8_t> inside_of(const ClosedSurface& surface, const SurfaceGrid& grid);

/// Distance of each point from the surface where that is below `reach`, else infinity [m].
std::vector<double> distances_to(const ClosedSurface& surface, const SurfaceGrid& grid,
                                 double reach);

}  // namespace gannet
