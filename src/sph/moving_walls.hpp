// Mirror walls that move. Images are made where a wall stands when lists are built; from then on
// they go with it:
//   x_image = x - 2 ((x - x_wall(t)) . n) n,   v_image = v - 2 ((v - v_wall) . n) n
// In the frame of the wall nothing flows through it, so what it does to the water is the force of
// its images times its velocity, and that is what its motion takes.
#pragma once

#include "sph/sph_state.hpp"

namespace gannet {

/// Whether images of this kind are mirrored by the wall.
bool is_behind(const Halo& halo, const MirrorWall& wall, const Image& image);

/// Takes over where the planes are, before images are made.
void follow_walls(Halo& halo, const Scene& scene);

/// How far walls are from where they were at the last build [m]; 0 for those that do not move.
struct WallsGone {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
  /// How far images of one kind went with them.
  [[nodiscard]] Vec3 of_image(const Halo& halo, const Image& image) const;
};

/// The same, up to dt on from now [s].
WallsGone walls_gone(const Halo& halo, const Scene& scene, double dt);

/// Places the ghosts behind moving walls and gives them their velocities, whatever they held.
void move_images(const Halo& halo, Scene& scene);

/// Pressure of the images behind a moving wall on the water, along the axis of the wall [N]: the
/// pressure terms of the particle pair pass, over the neighbour lists.
double force_of_images(const SphState& sph, const Scene& scene, const MirrorWall& wall);

}  // namespace gannet
