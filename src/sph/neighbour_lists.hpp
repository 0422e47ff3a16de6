// When and how the neighbour lists of the particles are made anew.
#pragma once

#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Sorts the particles in space and builds their lists at the present positions: wrap (periodic
/// directions), sort, x_build = x, images, list. Ghosts are filled. Throws RunError where a
/// position is not a number.
void rebuild_lists(SphState& sph, Scene& scene);

/// The same lists again from x_build, without sorting: for a restart, after the fields were read.
void restore_lists(SphState& sph, Scene& scene);

/// Rebuilds the lists where they may miss a pair at the end of the step, with a skin that follows
/// from how long the last ones were right; counts the step. Once a step, with half of it to go.
void renew_lists(SphState& sph, Scene& scene, double dt_half);

/// True where the lists may miss a pair at the end of the step (see sph/list_age.hpp).
/// dt_half: what is left of the step [s]; particles are expected to move on by v dt_half, and with
/// XSPH by 2 X dt_half with the X of the last step. Depends on x, v, X and x_build alone.
bool lists_are_stale(SphState& sph, const Scene& scene, double dt_half);

}  // namespace gannet
