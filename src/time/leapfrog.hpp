// The operations that every model has: clear forces, kick, drift, kinetic energy.
#pragma once

#include "plan/effect.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Adds, as the first of their stages:
///   force       f = 0, torque = 0
///   kick        v += f/m (dt_old + dt)/2, omega += torque/I (dt_old + dt)/2
///   look        kinetic energy at level n, 1/2 sum m |v(n)|^2 + 1/2 sum I |omega(n)|^2, per part
///   half drift  x += v dt/2
///   drift       x += v dt/2
/// over the nodes of the model's ranges. Source: the leapfrog with a changing step, e.g. Verlet
/// 1967 in its velocity form; derived in docs/theory.md, "Time".
void add_leapfrog(Scene& scene, Model& model, Ledger& ledger);

/// The effect "leapfrog": always on, first in the table. Key effects.time_step.scale takes a share
/// of the smallest vote as the step.
Effect leapfrog_effect();

}  // namespace gannet
