#include "sph/probe_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// Two sums that a gauge needs at once.
struct GaugeSums {
  double volume = 0;    ///< sum V W [-]
  double pressure = 0;  ///< sum V p W [Pa]
};

GaugeSums sums_at(const SphState& sph, const Scene& scene, const Vec3& x) {
  const Line* nodes = scene.nodes.x.data() + scene.particles.begin;
  const double reach = sph.kernel.reach();
  return parallel_reduce(
      scene.particles.size() + scene.nodes.n_ghosts, node_chunk, GaugeSums{},
      [&](Index begin, Index end) {
        GaugeSums sums;
        for (Index k = begin; k < end; ++k) {
          const double r = (xyz(nodes[k]) - x).norm();
          if (r >= reach) continue;
          const double VW = sph.m / sph.rho[k] * sph.kernel.W(r);
          sums.volume += VW;
          sums.pressure += VW * sph.p[k];
        }
        return sums;
      },
      [](const GaugeSums& a, const GaugeSums& b) {
        return GaugeSums{a.volume + b.volume, a.pressure + b.pressure};
      });
}

/// A particle near a column: place along it, squared distance from it, volume.
struct OnColumn {
  double s = 0;
  double off2 = 0;
  double V = 0;
};

std::vector<OnColumn> particles_on_column(const SphState& sph, const Scene& scene, const Vec3& foot,
                                          const Vec3& up) {
  const Line* nodes = scene.nodes.x.data() + scene.particles.begin;
  const double reach = sph.kernel.reach();
  std::vector<OnColumn> found;
  for (Index k = 0; k < scene.particles.size() + scene.nodes.n_ghosts; ++k) {
    const Vec3 d = xyz(nodes[k]) - foot;
    const double s = d.dot(up);
    const double off2 = (d - s * up).squaredNorm();
    if (off2 < reach * reach) found.push_back({s, off2, sph.m / sph.rho[k]});
  }
  // From the top down, so that a sum near one height touches few of them.
  std::stable_sort(found.begin(), found.end(),
                   [](const OnColumn& a, const OnColumn& b) { return a.s > b.s; });
  return found;
}

}  // namespace

double pressure_at(const SphState& sph, const Scene& scene, const Vec3& x) {
  const GaugeSums sums = sums_at(sph, scene, x);
  return sums.volume > 0 ? sums.pressure / sums.volume : 0;
}

double volume_fraction_at(const SphState& sph, const Scene& scene, const Vec3& x) {
  return sums_at(sph, scene, x).volume;
}

double surface_height_on(const SphState& sph, const Scene& scene, const Vec3& foot,
                         const Vec3& up) {
  const std::vector<OnColumn> column = particles_on_column(sph, scene, foot, up);
  if (column.empty()) return nowhere;
  const double reach = sph.kernel.reach();
  const auto fraction = [&](double s) {
    double sum = 0;
    for (const OnColumn& q : column) {
      if (q.s > s + reach) continue;
      if (q.s < s - reach) break;
      const double r = std::sqrt((q.s - s) * (q.s - s) + q.off2);
      sum += q.V * sph.kernel.W(r);
    }
    return sum;
  };
  const double step = 0.25 * sph.h;
  double above = column.front().s + reach;
  const double bottom = column.back().s;
  while (above > bottom && fraction(above - step) <= 0.5) above -= step;
  if (above <= bottom) return nowhere;
  double below = above - step;
  while (above - below > 1e-6 * sph.h) {
    const double middle = 0.5 * (above + below);
    (fraction(middle) > 0.5 ? below : above) = middle;
  }
  return 0.5 * (above + below);
}

double front_of_part(const Scene& scene, int part, int axis) {
  const double none = -std::numeric_limits<double>::infinity();
  const Line* nodes = scene.nodes.x.data() + scene.particles.begin;
  const double most = parallel_reduce(
      scene.particles.size(), node_chunk, none,
      [&](Index begin, Index end) {
        double largest = none;
        for (Index k = begin; k < end; ++k) {
          if (scene.particle_part[k] == part) largest = std::max(largest, xyz(nodes[k])[axis]);
        }
        return largest;
      },
      [](double a, double b) { return std::max(a, b); });
  return most == none ? nowhere : most;
}

}  // namespace gannet
