// Walls on bodies that advance in a faster model than the water. The body takes what the water does
// to it through a link (plan/link.hpp), as force and moment on its centre:
//
//   accelerate   water at its level n: force and moment of the wall move to the slow slot; the body
//                takes them there, or all along its substeps
//   half drift   of the water, when the body has arrived at n+1: v = (x_c(n+1) - x_c(n))/dT +
//                (R(n+1) - R(n)) arm/dT, the chord of the way that the body really went
//
// So a wall is where its body is at every level of the water, whatever pushed it in between.
#pragma once

#include "sph/wall_state.hpp"

namespace gannet {

/// How a body moved on the mean since the last level of the water.
struct MeanRates {
  Vec3 v;      ///< of the centre [m/s]
  Vec3 omega;  ///< [rad/s]
};

/// Links a wall to its body and adds what moves it. The wall has its carrier; `slow`, the model of
/// the water, comes before `fast`, that of the body; all operations of walls are in the plan.
void link_wall(Walls& walls, Scene& scene, Models& models, Wall& wall, Model& slow, Model& fast);

/// Over the last dt seconds, the time since the last level of the link [s]; what the centre has now
/// where no time has passed. Before the link is collected at a level.
MeanRates mean_rates(const Wall& wall, const Scene& scene, double dt);

}  // namespace gannet
