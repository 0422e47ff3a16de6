// How far the density of a fluid that cavitates may fall.
#pragma once

#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Holds the densities of a part at the largest void of its fluid, and returns the internal energy
/// [J] that this took: the work of p_min over the volumes forgotten,
///   rho >= rho_void = (1 - void) rho_min,   sum m (e(rho) - e(rho_void))
/// Pressures stay: below rho_min they are p_min. The fluid of the part must have a p_min. Throws
/// nothing.
double forget_voids(SphState& sph, const Scene& scene, int part);

}  // namespace gannet
