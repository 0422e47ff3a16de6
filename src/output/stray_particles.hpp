// Particles where none should be: how deep behind walls and shells, and how many are lost.
#pragma once

#include <limits>

#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// How far the worst particle's centre is behind a plane of the scene, or behind the mid-surface of
/// a shell that its contact holds it off, [m]; negative or -infinity where none is behind.
double deepest_penetration(Scene& scene);

/// Whether there is anything that a particle can be behind: a plane, or a contact with segments
/// (type node_to_segment). Nodes of kernel contact have no sides.
bool sees_penetration(Scene& scene);

/// What counts as lost.
struct LostLimits {
  Vec3 low = Vec3::Zero();  ///< box outside of which a particle is lost [m]
  Vec3 high = Vec3::Zero();
  double depth = 0;  ///< behind a plane by more than this [m]
};

/// The box of all nodes as they are now and of all planes across an axis, grown on every side by
/// its own diagonal (at least by 100 spacings); the depth is one spacing dx [m].
LostLimits lost_limits(const Scene& scene, double dx);

/// Particles that are lost: their position is not finite, outside of the box, or too deep behind a
/// plane.
Index count_lost(const Scene& scene, const LostLimits& limits);

/// The worst of a run so far; a checkpoint holds it.
struct StrayParticles {
  double deepest = -std::numeric_limits<double>::infinity();  ///< deepest_penetration() [m]
  Index lost = 0;                                             ///< largest count_lost()
};

/// The limits as the scene was at the start; scene.store.get<StrayLimits>().
struct StrayLimits {
  LostLimits lost;
};

/// Takes another look at the scene.
void look_for_strays(Scene& scene, StrayParticles& strays);

}  // namespace gannet
