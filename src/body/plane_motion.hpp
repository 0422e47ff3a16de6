// Planes that move: pistons, tanks that sway, heave or roll. A motion is a function of time; planes
// follow it whatever pushes them.
//
//   kick         the mean velocity of the step to come; displacement at n+1
//   half drift   planes at n+1/2, before lists and images are made
//   drift        planes at n+1
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/function.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Motion of the planes of one boundary: turned by theta about `axis` through `centre`, then moved
/// by d:
///   point = centre + R(theta) (point_0 - centre) + d,   normal = R(theta) normal_0
struct PlaneMotion {
  std::string name;
  Location where;
  std::vector<std::size_t> planes;  ///< numbers in scene.planes
  std::vector<Vec3> point;          ///< of them at the start [m]
  std::vector<Vec3> normal;
  bool by_place = false;  ///< `shift` is a displacement, else a velocity
  VectorFunction shift;   ///< [m] or [m/s]
  bool turns = false;
  bool by_angle = false;  ///< `turn` is an angle, else a rate
  Function turn;          ///< [rad] or [rad/s]
  Vec3 axis = Vec3::UnitZ();
  Vec3 centre = Vec3::Zero();
  // State, tracked:
  Vec3 d = Vec3::Zero();  ///< at level n (n+1 after drift) [m]
  double theta = 0;       ///< [rad]
  // Within a step:
  Vec3 d_next = Vec3::Zero();
  double theta_next = 0;
};

/// All moving planes: scene.store.get<PlaneMotions>().
struct PlaneMotions {
  std::deque<PlaneMotion> list;
};

/// Puts the planes where they are for a displacement [m] and an angle [rad].
void place_planes(const PlaneMotion& motion, const Vec3& d, double theta, Scene& scene);

/// Finds d and theta at n+1 and the planes' mean velocities over the step. A displacement or angle
/// given as such is taken at t(n+1) itself, less its value at t = 0; a velocity adds its mean over
/// the step.
void choose_motion(PlaneMotion& motion, Scene& scene, const Step& step);

}  // namespace gannet
