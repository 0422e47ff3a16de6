// Where to look for particles: bounding boxes of short stretches of the particle table. Particles
// that are near in space stand near in memory, so a gauge looks at few stretches.
//
// Particles of a periodic domain may stand outside of it until lists are made anew, and their
// images with them. Gauges therefore look at the particles themselves and at images behind walls,
// and go to every period that particles stand in.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Boxes of up to 64 particles each: owned ones, then images that no period shifts.
struct ParticleBoxes {
  static constexpr Index per_box = 64;
  struct Box {
    Vec3 low, high;
    Index begin, end;  ///< particles
  };
  std::vector<Box> box;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< of all boxes [m]
  Vec3 period = Vec3::Zero();                    ///< of the domain [m]; 0 where it does not repeat
  bool fresh = false;                            ///< of the positions of this level
};

/// Boxes of the present positions; `boxes.fresh` is set. Parallel. The same for any number of
/// threads.
void find_boxes(Scene& scene, ParticleBoxes& boxes);

/// The boxes of this level, made when first asked for: scene.store.get<ParticleBoxes>(). Whoever
/// moves particles has to unset `fresh`.
const ParticleBoxes& boxes_of(Scene& scene);

/// Calls f(x + shift) for all shifts by whole periods with which particles can be within `reach` of
/// it in the directions of `along` (a coordinate counts where its entry is not 0).
template <class F>
void for_periods(const ParticleBoxes& boxes, const Vec3& x, double reach, const Vec3& along,
                 F&& f) {
  int first[3] = {0, 0, 0};
  int last[3] = {0, 0, 0};
  for (int d = 0; d < 3; ++d) {
    const double period = boxes.period[d];
    if (period == 0 || along[d] == 0) continue;
    first[d] = static_cast<int>(std::ceil((boxes.low[d] - reach - x[d]) / period));
    last[d] = static_cast<int>(std::floor((boxes.high[d] + reach - x[d]) / period));
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        f(Vec3(x + Vec3(i, j, k).cwiseProduct(boxes.period)));
      }
    }
  }
}

/// Calls f(k, x_k) for all particles k of the boxes that `wanted(low, high)` keeps, in order.
/// x_k: their position [m].
template <class Wanted, class F>
void for_particles_in(const ParticleBoxes& boxes, const Scene& scene, Wanted&& wanted, F&& f) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  for (const ParticleBoxes::Box& box : boxes.box) {
    if (!wanted(box.low, box.high)) continue;
    for (Index k = box.begin; k < box.end; ++k) f(k, xyz(x[k]));
  }
}

/// Calls f(k, r_k, x') for all particles within `reach` of a point: r_k = x_k - x', x' the point or
/// one that is whole periods away.
template <class F>
void for_particles_near(const ParticleBoxes& boxes, const Scene& scene, const Vec3& x, double reach,
                        F&& f) {
  for_periods(boxes, x, reach, Vec3::Ones(), [&](const Vec3& at) {
    const auto near = [&](const Vec3& low, const Vec3& high) {
      return (low - at).cwiseMax(at - high).maxCoeff() < reach;
    };
    for_particles_in(boxes, scene, near, [&](Index k, const Vec3& x_k) {
      const Vec3 r = x_k - at;
      if (r.squaredNorm() < reach * reach) f(k, r, at);
    });
  });
}

}  // namespace gannet
