// Mirror walls that water sticks to (slip: none). Viscous forces see an image that goes the other
// way as a whole, so that water and image stand still at the wall between them:
//   v_image = 2 v_wall - v,   at a wall to slide along:  v_image = v - 2 ((v - v_wall) . n) n
// (Morris, Fox and Zhu 1997, J. Comput. Phys. 136, 214, section 3.5, with the image in place of the
// extrapolation.) In a corner one follows the other. The density rate sees images that slide, at
// every wall: there nothing flows through, and shear along a wall compresses nothing.
#pragma once

#include "sph/sph_state.hpp"

namespace gannet {

/// Velocity of an image of a particle with velocity v [m/s], as viscous forces see it.
Vec3 stuck_velocity(const Halo& halo, const Scene& scene, const Image& image, const Vec3& v);

/// Gives ghosts behind walls that water sticks to the velocity that viscous forces see. What is
/// copied to ghosts after the kick undoes it.
void stick_images(const Halo& halo, Scene& scene);

}  // namespace gannet
