// Planes that move: pistons, tanks that sway, heave or roll. A motion is a function of time; planes
// follow it whatever pushes them.
//
//   kick         the mean velocity of the step to come; displacement at n+1
//   half drift   planes at n+1/2, before lists and images are made
//   drift        planes at n+1
//
// Planes of the scene go at the step of the water. Where parts of another model meet planes, that
// model has its own (plan/model_planes.hpp), put at each of its levels where they are by then:
//
//   force        place at n and mean velocity of the step before, from where the scene's stand
//   kick         the mean velocity of the step to come
//
// They have no state of their own.
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

/// A motion as another model sees it.
struct SeenMotion {
  PlaneMotion its;                  ///< d and theta at the model's levels; not tracked
  const PlaneMotion* of = nullptr;  ///< of the scene's planes
  const Step* time = nullptr;       ///< of the model that moves them
  std::vector<Plane>* planes = nullptr;
};

/// All moving planes: scene.store.get<PlaneMotions>().
struct PlaneMotions {
  std::deque<PlaneMotion> list;
  std::deque<SeenMotion> seen;
};

/// Puts planes, numbered as scene.planes, where they are for a displacement [m] and an angle [rad].
void place_planes(const PlaneMotion& motion, const Vec3& d, double theta,
                  std::vector<Plane>& planes);

/// Finds d and theta at n+1 and the planes' mean velocities over the step. A displacement or angle
/// given as such is taken at t(n+1) itself, less its value at t = 0; a velocity adds its mean over
/// the step.
void choose_motion(PlaneMotion& motion, std::vector<Plane>& planes, const Step& step);

/// Puts planes of a model where they are at its level, with the mean velocities of its step before:
/// d and theta from those of `of`, which hold at time T [s]. Depends on nothing else but step.t and
/// step.dt_old, unless dt_old = 0: velocities stay as they are then.
void follow_motion(const PlaneMotion& of, double T, PlaneMotion& its, std::vector<Plane>& planes,
                   const Step& step);

}  // namespace gannet
