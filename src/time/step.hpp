// The one step function, and the clock that calls it.
//
//   entry        x, rho, p and ghosts hold n; v holds n-1/2; element stress holds n-1
//   force        elements, pair pass 2, contact, loads add to f(n)
//   choose dt    the smallest vote
//   accelerate   what must see the whole force before the kick (links between models)
//   kick         v(n+1/2) = v(n-1/2) + f/m (dt_old + dt)/2; prescribed, rigid, tied nodes
//   look         level n: v(n) = v(n+1/2) - f/m dt/2; energies, guards, history, VTK
//   half drift   x(n+1/2) = x(n) + v dt/2; when stale: wrap, sort, new lists; ghosts
//   rates        pair pass 1 at x(n+1/2), v(n+1/2); rho(n+1), p(n+1)
//   drift        x(n+1) = x(n+1/2) + v dt/2 + X dt; ghosts
//
// With several models the last three stages of a slower one wait until the faster ones have arrived
// where its step ends: their nodes do not ask where its own are meanwhile, and what of its own
// rides on theirs goes the way that they went. Planes that it moves they see at their own levels
// (plan/model_planes.hpp).
#pragma once

#include <span>

#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Begins a step of the models that stand at one level, stage by stage, slowest first, and moves
/// the last of them to its next level; the others stay before half drift. All of `level` have the
/// same step.t; the first takes the step that its plan allows, each other a whole fraction of the
/// one before. Throws RunError where no step is possible.
void step(std::span<Model* const> level);

/// Advances all models until the slowest has made one step: again and again, the models at the time
/// of the fastest begin a step together, and whoever the faster ones have caught up with moves on.
/// Levels coincide before and after.
void advance(Models& models);

/// Runs the force stage of all models at the start, as the first step will do again: the votes on
/// the time step and the forces at level 0 are then known. Nothing moves, no time passes.
/// Needs dt_old = 0 in all models.
void evaluate_start(Models& models);

/// The smallest vote of a model's plan after its force stage, times its dt_scale.
Vote smallest_vote(const Model& model);

/// Chooses the step of each model of a level: dt = smallest vote for the first; for the others
/// dt = (time left to the next level of the slower one) / n with the smallest whole n that their
/// own votes allow and that never shrinks within a coarse step.
void choose_dt(std::span<Model* const> level);

}  // namespace gannet
