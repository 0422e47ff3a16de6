// When and how the neighbour lists of the particles are made anew.
#pragma once

#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Sorts the particles in space and builds their lists at the present positions: wrap (periodic
/// directions), sort, x_build = x, images, list. Ghosts are filled. Throws RunError where a
/// position is not a number.
void rebuild_lists(SphState& sph, Scene& scene);

/// The same lists again from x_build and list_skin as they are, without sorting: for a restart,
/// after the fields were read. Bounds of another case hold from the next build on.
void restore_lists(SphState& sph, Scene& scene);

/// Rebuilds the lists where they may miss a pair at the end of the step, with skins that follow
/// from how much each cell moves a step relative to those near it, on the mean while the last lists
/// were used and now (see sph/list_skin.hpp); counts the step. Once a step, with half of it to go.
void renew_lists(SphState& sph, Scene& scene, double dt_half);

/// True where the lists may miss a pair at the end of the step (see sph/list_age.hpp).
/// dt_half: what is left of the step [s]; particles are expected to move on by v dt_half, and with
/// XSPH and shifting by 2 (X + shift) dt_half with those of the last step. Depends on x, v, X,
/// shift, x_build, list_skin and the motion of walls.
bool lists_are_stale(SphState& sph, const Scene& scene, double dt_half);

}  // namespace gannet
