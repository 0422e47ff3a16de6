#include "sph/probe_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// What a gauge adds up over the particles near it.
struct GaugeSums {
  double volume = 0;    ///< sum V W [-]
  double fluid = 0;     ///< the part of it that is fluid [-]
  double pressure = 0;  ///< sum V W p [Pa]
  double head = 0;      ///< sum V W rho g . (x - x_j): what still water has more at the gauge [Pa]
  double p0 = std::numeric_limits<double>::infinity();  ///< least of their p0 [Pa]
};

/// Adds source k at r = x_k - x. Images have the pressure of their source, and so its place.
void add_source(const SphState& sph, const Scene& scene, Index k, const Vec3& r, const Vec3& x,
                GaugeSums& sums) {
  const Index n = scene.particles.size();
  const double VW = sph.m / sph.rho[k] * sph.kernel.W(r.norm());
  const Index source = k < n ? k : sph.halo.source[k - n];
  const Vec3 from_source = x - xyz(scene.nodes.x[scene.particles.begin + source]);
  sums.volume += VW;
  sums.pressure += VW * sph.p[k];
  sums.head += VW * sph.rho[k] * scene.gravity.dot(from_source);
  if (!is_fluid(scene, k)) return;
  sums.fluid += VW;
  sums.p0 = std::min(sums.p0, eos_of(sph, scene, k).p0);
}

GaugeSums sums_at(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                  const Vec3& x) {
  GaugeSums sums;
  for_particles_near(
      boxes, scene, x, sph.kernel.reach(),
      [&](Index k, const Vec3& r, const Vec3& at) { add_source(sph, scene, k, r, at, sums); });
  return sums;
}

/// The same with the particles on one side of a surface alone.
GaugeSums sums_beside(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                      const WettedPoint& point, double side) {
  const Vec3 normal = side * point.normal;
  const Vec3 x = point.foot + point.distance * normal;
  GaugeSums sums;
  for_particles_near(boxes, scene, x, sph.kernel.reach(),
                     [&](Index k, const Vec3& r, const Vec3& at) {
                       const double height = point.distance + r.dot(normal);
                       if (height > 0) add_source(sph, scene, k, r, at, sums);
                     });
  return sums;
}

double pressure_of(const GaugeSums& sums) {
  if (!(sums.fluid > 0)) return 0;
  const double mean = sums.pressure / sums.volume;
  return std::max(mean + sums.head / sums.volume, std::min(mean, sums.p0));
}

/// A particle near a column: place along it, squared distance from it, volume.
struct OnColumn {
  double s = 0;
  double off2 = 0;
  double V = 0;
};

std::vector<OnColumn> particles_on_column(const SphState& sph, const Scene& scene,
                                          const ParticleBoxes& boxes, const Vec3& foot,
                                          const Vec3& up) {
  const double reach = sph.kernel.reach();
  const Vec3 across = Vec3::Ones() - up.cwiseAbs();  // `up` is along an axis
  std::vector<OnColumn> found;
  for_periods(boxes, foot, reach, across, [&](const Vec3& at) {
    const auto near = [&](const Vec3& low, const Vec3& high) {
      return (low - at).cwiseMax(at - high).cwiseProduct(across).maxCoeff() < reach;
    };
    for_particles_in(boxes, scene, near, [&](Index k, const Vec3& x) {
      if (!is_fluid(scene, k)) return;
      const Vec3 d = x - at;
      const double s = d.dot(up);
      const double off2 = (d - s * up).squaredNorm();
      if (off2 < reach * reach) found.push_back({s, off2, sph.m / sph.rho[k]});
    });
  });
  // From the top down, so that a sum near one height touches few of them.
  std::stable_sort(found.begin(), found.end(),
                   [](const OnColumn& a, const OnColumn& b) { return a.s > b.s; });
  return found;
}

}  // namespace

double pressure_at(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                   const Vec3& x) {
  return pressure_of(sums_at(sph, scene, boxes, x));
}

double volume_fraction_at(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                          const Vec3& x) {
  return sums_at(sph, scene, boxes, x).fluid;
}

double pressure_beside(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                       const WettedPoint& at) {
  if (at.side != 0) return pressure_of(sums_beside(sph, scene, boxes, at, at.side));
  const GaugeSums front = sums_beside(sph, scene, boxes, at, 1);
  const GaugeSums back = sums_beside(sph, scene, boxes, at, -1);
  return pressure_of(front.fluid >= back.fluid ? front : back);
}

double surface_height_on(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                         const Vec3& foot, const Vec3& up) {
  const std::vector<OnColumn> column = particles_on_column(sph, scene, boxes, foot, up);
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
