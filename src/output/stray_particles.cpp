#include "output/stray_particles.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "contact/node_to_segment.hpp"

namespace gannet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double least_growth = 100;  // spacings: a lone particle may fly too

double depth_behind(const Scene& scene, const Vec3& x) {
  double deepest = -infinity;
  for (const Plane& plane : scene.planes) {
    deepest = std::max(deepest, -(x - plane.point).dot(plane.normal));
  }
  return deepest;
}

Vec3 particle(const Scene& scene, Index i) {
  return xyz(scene.nodes.x[static_cast<std::size_t>(scene.particles.begin + i)]);
}

/// Particles of walls stand behind planes and are pressed together: that is their place.
bool is_of_wall(const Scene& scene, Index i) {
  if (scene.particle_part.empty()) return false;
  return scene.parts[static_cast<std::size_t>(scene.particle_part[static_cast<std::size_t>(i)])]
             .kind == "wall";
}

}  // namespace

double deepest_penetration(Scene& scene) {
  double deepest = parallel_reduce(
      scene.planes.empty() ? 0 : scene.particles.size(), node_chunk, -infinity,
      [&](Index begin, Index end) {
        double worst = -infinity;
        for (Index i = begin; i < end; ++i) {
          if (is_of_wall(scene, i)) continue;
          worst = std::max(worst, depth_behind(scene, particle(scene, i)));
        }
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
  if (!scene.store.has<NodeToSegments>()) return deepest;
  for (const NodeToSegment& contact : scene.store.get<NodeToSegments>().list) {
    for (const Gap& gap : contact.gaps) {
      if (gap.segment < 0) continue;
      deepest = std::max(deepest, gap.penetration - contact.range.contact);
    }
  }
  return deepest;
}

bool sees_penetration(Scene& scene) {
  return !scene.planes.empty() ||
         (scene.store.has<NodeToSegments>() && !scene.store.get<NodeToSegments>().list.empty());
}

LostLimits lost_limits(const Scene& scene, double dx) {
  Vec3 low = Vec3::Constant(infinity);
  Vec3 high = Vec3::Constant(-infinity);
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(i)]);
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  for (const Plane& plane : scene.planes) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(plane.normal[axis]) != 1) continue;
      low[axis] = std::min(low[axis], plane.point[axis]);
      high[axis] = std::max(high[axis], plane.point[axis]);
    }
  }
  const Vec3 growth = Vec3::Constant(std::max((high - low).norm(), least_growth * dx));
  return {low - growth, high + growth, dx};
}

Index count_lost(const Scene& scene, const LostLimits& limits) {
  return parallel_sum(scene.particles.size(), node_chunk, Index{0}, [&](Index begin, Index end) {
    Index lost = 0;
    for (Index i = begin; i < end; ++i) {
      if (is_of_wall(scene, i)) continue;
      const Vec3 x = particle(scene, i);
      const bool inside = (x.array() >= limits.low.array()).all() &&
                          (x.array() <= limits.high.array()).all();  // false for NaN
      if (!inside || depth_behind(scene, x) > limits.depth) ++lost;
    }
    return lost;
  });
}

void look_for_strays(Scene& scene, StrayParticles& strays) {
  if (scene.particles.size() == 0 || !scene.store.has<StrayLimits>()) return;
  strays.deepest = std::max(strays.deepest, deepest_penetration(scene));
  strays.lost = std::max(strays.lost, count_lost(scene, scene.store.get<StrayLimits>().lost));
}

}  // namespace gannet
