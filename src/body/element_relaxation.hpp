// Dynamic relaxation of parts of elements: motion is damped until a static state is left.
#pragma once

#include "body/relaxation.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Damping of the nodes of elements and what it remembers. Found by scene.store.
struct ElementRelaxation {
  bool asked_for = false;
  bool automatic = true;  ///< the rate follows from the motion
  Range nodes;            ///< that are damped
  Range turning;          ///< those of them with rotations
  SettlingPhase phase;    ///< phase.rate: what damps now [1/s]
  Array<Line> f;          ///< force of the damping, in the kick [N]
  Array<Line> torque;     ///< moment of the damping [N m]
  // State, tracked:
  Array<Line> f_old;       ///< force of the level before, without damping [N]
  Array<Line> torque_old;  ///< moment likewise [N m]
};

/// Square of the frequency that the motion has now [1/s^2]: Rayleigh's quotient of the velocities,
///   omega^2 = -sum v(n-1/2).(f(n) - f(n-1)) / (dt sum m v(n-1/2)^2),
/// over translations and rotations, since -(f(n) - f(n-1)) = K v dt; 0 where forces drive motion
/// that grows. To be called after the free kick of level n, dt_old > 0. Underwood 1983, "Dynamic
/// relaxation", in Computational Methods for Transient Analysis (Belytschko and Hughes), 245-265.
double frequency_squared(const ElementRelaxation& relaxation, const Nodes& nodes, const Step& step);

/// Damps the nodes after the free kick of level n at the rate of the phase, centred in time as
/// damping_kick(), velocities and angular velocities alike.
void damp_elements(ElementRelaxation& relaxation, Nodes& nodes, const Step& step);

/// What the damping takes out of the motion at level n [J].
Work work_of(const ElementRelaxation& relaxation, const Nodes& nodes, const Step& step);

}  // namespace gannet
