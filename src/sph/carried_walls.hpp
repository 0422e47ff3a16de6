// Walls of dummy particles inside of rigid bodies: the water outside has its sums complete, and its
// pressure at the skin is that of the water itself.
//
// The particles have no mass: they move with the body, and what the water does to them is force and
// moment of the body, pair by pair the reaction to what they do to the water.
//
//   accelerate   force and moment about the centre, before the body gathers
//   kick         after the body's own: v = v_c + (R(n+1) - R(n)) arm / dt, the chord of the way
//
// Acceleration of the wall. p_w wants that of the body, a, which the force on the body says; and
// the force contains p_w: a layer of water next to the skin, mass M_a, is accelerated by the wall
// itself. With the value of the step before in its place, a(n) = (F - M_a a(n-1))/M, bodies lighter
// than that layer would shake themselves to pieces. Taken is instead
//   a' = a'(n-1) + theta (a(n-1) - a'(n-1)),  theta = 1/(2 + mu),  mu = sum_w m (1/M + r^2/I_min),
// the sum over wall particles that are wet, which is at least M_a/M: stable, as |1 - theta (1 +
// M_a/M)| < 1, and with the same limit, which it reaches within mu + 2 steps.
#pragma once

#include "sph/wall_state.hpp"

namespace gannet {

/// Adds the walls on bodies to the list. Their parts are there already.
void read_carried_walls(const Keys& root, const Scene& scene, Walls& walls);

/// Adds the operation that hands force and moment of walls to their bodies, where there are any.
/// It votes for the step: the water's stiffness m (c0/dx)^2 per particle of the outermost layer
/// meets the body's ease to be moved, omega^2 = sum_w m (c0/dx)^2 / n_layers (1/M + r^2/I_min), and
/// the step keeps to 4/omega: that counts layers as if all were as near as the first, and bodies of
/// 0.2 and 1 kg/m^3 that rest on water are lost between 8/omega and 12/omega.
void add_gathering(Walls& walls, SphState& sph, Scene& scene, Plan& plan);

/// Takes a share of what the body did from the step before this level to the step after it into the
/// acceleration that pressures follow. v, omega: in the step after it [m/s, rad/s]; dt: from one
/// middle to the other [s].
void follow_acceleration(Wall& wall, const Vec3& v, const Vec3& omega, double dt);

/// Acceleration of a point of a body [m/s^2]: a' + alpha' x r + omega x (omega x r). arm: 3 [m].
Vec3 acceleration_on_body(const Wall& wall, const Scene& scene, const Vec3& arm);

/// Gives the particles of walls on bodies of their own model their velocity, after the kick of the
/// bodies; those of faster models are not there yet (sph/linked_walls.hpp). As with
/// every member of a body, f becomes the acceleration and 1/m one, until half drift, so that
/// work_path() sees the way that they go.
void kick_carried_walls(Walls& walls, Scene& scene, const Step& step);

/// Sums 1/M + r^2/I_min over the particles of each wall that have water near, for the vote and
/// theta. After set_wall_pressure()'s sums.
void note_ease(Walls& walls, const Scene& scene);

}  // namespace gannet
