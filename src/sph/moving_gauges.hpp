// Gauges that move with a wall: a part of dummy particles, or a plane.
#pragma once

#include <deque>
#include <string>

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sph/wall_state.hpp"

namespace gannet {

/// A point of a wall.
struct MovingGauge {
  std::string name;
  Wall wall;              ///< what it goes with; its part, or its plane
  Vec3 x = Vec3::Zero();  ///< place at level n, tracked [m]
  Vec3 v = Vec3::Zero();  ///< mean velocity of the step to come [m/s]
};

/// All of them: scene.store.get<MovingGauges>().
struct MovingGauges {
  std::deque<MovingGauge> list;
};

/// A gauge at x (3 [m]) that goes with what `on` names: a part that is a wall, a plane, or a
/// boundary whose planes move as one. nullptr where it names none of these. Its address stays.
MovingGauge* gauge_on_wall(const std::string& name, const std::string& on, const Vec3& x,
                           Scene& scene);

/// Moves the gauges: v in the kick, x in the drift. After the motion of planes is chosen.
void add_gauge_motion(Scene& scene, Models& models);

}  // namespace gannet
