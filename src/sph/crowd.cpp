#include "sph/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr int most_rounds = 300;
constexpr int rounds_a_list = 10;

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

}  // namespace

Crowd crowd_beside(const ClosedSurface& surface, double dx) {
  return {.surface = &surface,
          .dx = dx,
          .kernel = {KernelType::wendland_c2, surface.dimension, 1.3 * dx}};
}

void find_facets(Crowd& crowd, const std::vector<double>& distances) {
  const double dx = crowd.dx;
  crowd.facets.resize(crowd.n_moving);
  parallel_for(static_cast<Index>(crowd.n_moving), 64, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (distances[i] > 3 * dx) continue;
      for (std::size_t f = 0; f < crowd.surface->facets.size(); ++f) {
        if (distance_to_facet(*crowd.surface, f, crowd.x[i]) < distances[i] + 3 * dx) {
          crowd.facets[i].push_back(f);
        }
      }
    }
  });
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

}  // namespace gannet
