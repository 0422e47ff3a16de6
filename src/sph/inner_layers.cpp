#include "sph/inner_layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mesh/surface_grid.hpp"
#include "sph/crowd.hpp"

namespace gannet {

namespace {

/// Whether the first layer of a lattice stands half a spacing below the surface everywhere.
bool fits(const std::vector<double>& depths, double dx) {
  return std::ranges::all_of(
      depths, [&](double d) { return d > 0.99 * dx || std::abs(d - 0.5 * dx) < 0.05 * dx; });
}

/// The points of a lattice that stand for the space outside.
void add_outside(const ClosedSurface& surface, Crowd& crowd) {
  const double reach = crowd.kernel.reach() + 0.5 * crowd.dx;
  const SurfaceGrid grid = grid_around(surface, 0.5 * crowd.dx, reach);
  const std::vector<std::uint8_t> inside = inside_of(surface, grid);
  const std::vector<double> away = distances_to(surface, grid, reach);
  double V = 1;
  for (int d = 0; d < surface.dimension; ++d) V *= grid.cell[d];
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (inside[k] != 0 || !(away[k] < reach)) continue;
    crowd.x.push_back(grid.point(k));
    crowd.V.push_back(V);
  }
}

}  // namespace

std::vector<Vec3> inner_layers(const ClosedSurface& surface, double dx, int n_layers) {
  const double deepest = n_layers * dx;
  Crowd crowd = crowd_beside(surface, dx);
  const SurfaceGrid grid = grid_around(surface, dx, 0);
  for (int d = 0; d < surface.dimension; ++d) {
    if (grid.cell[d] < 0.5 * dx) return {};  // thinner than half a spacing
  }
  const std::vector<std::uint8_t> inside = inside_of(surface, grid);
  const double reach = deepest + crowd.kernel.reach();
  const std::vector<double> away = distances_to(surface, grid, reach);
  double V = 1;
  for (int d = 0; d < surface.dimension; ++d) V *= grid.cell[d];
  std::vector<double> depths;
  std::vector<Vec3> core;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (inside[k] == 0 || !(away[k] < reach)) continue;
    if (away[k] >= deepest) {
      core.push_back(grid.point(k));
      continue;
    }
    crowd.x.push_back(grid.point(k));
    depths.push_back(away[k]);
  }
  if (fits(depths, dx)) return crowd.x;
  crowd.n_moving = crowd.x.size();
  find_facets(crowd, depths);
  crowd.x.insert(crowd.x.end(), core.begin(), core.end());
  crowd.V.assign(crowd.x.size(), V);
  add_outside(surface, crowd);
  spread_out(crowd);
  crowd.x.resize(crowd.n_moving);
  return crowd.x;
}

}  // namespace gannet
