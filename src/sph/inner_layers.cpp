#include "sph/inner_layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "base/parallel.hpp"
#include "kernel/smoothing_kernel.hpp"
#include "mesh/surface_grid.hpp"

namespace gannet {

namespace {

constexpr int most_rounds = 300;
constexpr int rounds_a_list = 10;

/// The crowd inside, and what it stands against.
struct Crowd {
  const ClosedSurface* surface = nullptr;
  double dx = 0;
  SmoothingKernel kernel;
  std::vector<Vec3> x;  ///< all points: those that move, then those that stay
  std::vector<double> V;
  std::size_t n_moving = 0;
  std::vector<std::vector<std::size_t>> facets;  ///< that a moving point may come near
  std::vector<std::vector<std::size_t>> near;    ///< points around each of those that move
};

std::int64_t cell_of(const Vec3& x, double size) {
  std::int64_t key = 0;
  for (int d = 0; d < 3; ++d) key = key << 21 | (std::llround(x[d] / size) & 0x1fffff);
  return key;
}

void find_neighbours(Crowd& crowd) {
  const double radius = crowd.kernel.reach() + crowd.dx;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells;
  for (std::size_t k = 0; k < crowd.x.size(); ++k) {
    cells[cell_of(crowd.x[k], radius)].push_back(k);
  }
  crowd.near.resize(crowd.n_moving);
  parallel_for(static_cast<Index>(crowd.n_moving), 64, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      crowd.near[i].clear();
      for (int c = 0; c < 27; ++c) {
        const Vec3 beside(c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1);
        const auto found = cells.find(cell_of(crowd.x[i] + radius * beside, radius));
        if (found == cells.end()) continue;
        for (const std::size_t j : found->second) {
          if (j != i && (crowd.x[i] - crowd.x[j]).norm() < radius) crowd.near[i].push_back(j);
        }
      }
    }
  });
}

/// The nearest point of the surface among the facets that a point may come near; far away, and so
/// no matter, where there are none.
Vec3 foot_of(const Crowd& crowd, std::size_t i, const Vec3& x) {
  Vec3 foot = x + Vec3::Constant(1e3 * crowd.dx);
  for (const std::size_t f : crowd.facets[i]) {
    const Vec3 p = nearest_on_facet(*crowd.surface, f, x);
    if ((p - x).squaredNorm() < (foot - x).squaredNorm()) foot = p;
  }
  return foot;
}

/// Where point i goes next.
Vec3 next_place(const Crowd& crowd, std::size_t i) {
  Vec3 crowding = Vec3::Zero();
  for (const std::size_t j : crowd.near[i]) {
    const Vec3 r = crowd.x[i] - crowd.x[j];
    crowding += crowd.V[j] * crowd.kernel.F(r.norm()) * r;
  }
  Vec3 step = -crowd.dx * crowd.dx * crowding;
  const double most = 0.1 * crowd.dx;
  if (step.norm() > most) step *= most / step.norm();
  const Vec3 x = crowd.x[i] + step;
  const Vec3 foot = foot_of(crowd, i, x);
  const double depth = (x - foot).norm();
  if (depth >= 0.5 * crowd.dx || depth == 0) return x;
  return foot + 0.5 * crowd.dx / depth * (x - foot);
}

void spread_out(Crowd& crowd) {
  std::vector<Vec3> next(crowd.n_moving);
  for (int round = 0; round < most_rounds; ++round) {
    if (round % rounds_a_list == 0) find_neighbours(crowd);
    parallel_for(static_cast<Index>(crowd.n_moving), 64, [&](Index begin, Index end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        next[i] = next_place(crowd, i);
      }
    });
    double furthest = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      furthest = std::max(furthest, (next[i] - crowd.x[i]).norm());
      crowd.x[i] = next[i];
    }
    if (furthest < 1e-3 * crowd.dx) return;
  }
}

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
  Crowd crowd{.surface = &surface,
              .dx = dx,
              .kernel = {KernelType::wendland_c2, surface.dimension, 1.3 * dx}};
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
  crowd.facets.resize(crowd.n_moving);
  parallel_for(static_cast<Index>(crowd.n_moving), 64, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (depths[i] > 3 * dx) continue;
      for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        if (distance_to_facet(surface, f, crowd.x[i]) < depths[i] + 3 * dx) {
          crowd.facets[i].push_back(f);
        }
      }
    }
  });
  crowd.x.insert(crowd.x.end(), core.begin(), core.end());
  crowd.V.assign(crowd.x.size(), V);
  add_outside(surface, crowd);
  spread_out(crowd);
  crowd.x.resize(crowd.n_moving);
  return crowd.x;
}

}  // namespace gannet
