// Waves of water of constant depth, followed particle by particle: where the water that rests at X
// is, how fast it moves, what pressure it has. With K = k (Z + d), Z below the still level, d the
// depth, S = sinh kd, theta = k e . X - omega t + phase, omega^2 = g k tanh kd (Airy),
//   xi   = -a cosh K/S sin theta,   zeta = a sinh K/S cos theta + m(Z),   m = a^2 k sinh 2K/(4 S^2)
//   p/rho = g (-Z + a (cosh K/cosh kd - sinh K/S) cos theta)
// m is the mean rise that keeps volume; the surface Z = 0 keeps p = 0. Second order (Stokes) adds
//   xi_2   = a^2 k (-3/8 cosh 2K/S^4 + 1/(4 S^2)) sin 2 theta + U_s t
//   zeta_2 = 3/8 a^2 k sinh 2K/S^4 cos 2 theta,   U_s = a^2 omega k cosh 2K/(2 S^2)
// and X + U_s t stands for X in theta: the paths of the velocities of the potential
//   phi = a omega/k cosh K/S sin theta + 3/8 a^2 omega cosh 2K/S^4 sin 2 theta
// up to (ka)^2, with which the Jacobian of X -> x is 1 (Dean and Dalrymple 1991, Water Wave
// Mechanics for Engineers and Scientists, chapters 3, 4 and 11). A current U carries all of it.
#pragma once

#include <vector>

#include "base/math.hpp"

namespace gannet {

struct WaveComponent {
  double a = 0;                ///< half the height [m]
  double k = 0;                ///< [1/m]
  double omega = 0;            ///< in water at rest [rad/s]
  double phase = 0;            ///< [rad]
  Vec3 along = Vec3::UnitX();  ///< where it goes: horizontal, length 1
};

struct WaveField {
  std::vector<WaveComponent> waves;
  bool second_order = false;    ///< Stokes; of one wave
  double depth = 0;             ///< d [m]
  double level = 0;             ///< height of the still water [m]
  double g = 0;                 ///< [m/s^2]
  int up = 2;                   ///< axis that points up
  Vec3 current = Vec3::Zero();  ///< U, horizontal [m/s]
};

/// omega of waves of wave number k [1/m] on the depth d [m]: sqrt(g k tanh kd) [rad/s].
double dispersion(double k, double depth, double g);

/// Way from X to the water that rests at X, at time t [m]. X: 3 [m].
Vec3 displacement_at(const WaveField& field, const Vec3& X, double t);

/// Velocity and acceleration of that water [m/s], [m/s^2].
Vec3 velocity_of(const WaveField& field, const Vec3& X, double t);
Vec3 acceleration_of(const WaveField& field, const Vec3& X, double t);

/// p/rho of that water over that at the surface [m^2/s^2]; hydrostatic below the still level
/// without waves. Second order: Bernoulli's equation at the place of the water, zero at the surface
/// up to (ka)^2.
double pressure_of(const WaveField& field, const Vec3& X, double t);

/// Height of the surface over the still level at the place x [m]:
///   eta = sum a cos theta [+ k a^2/4 cosh kd (2 + cosh 2kd)/S^3 cos 2 theta],
/// theta = k e . (x - U t) - omega t + phase.
double elevation_at(const WaveField& field, const Vec3& x, double t);

/// X of the water that is at x at time t, by X <- x - displacement_at(X); needs ka < 1.
Vec3 rest_place_of(const WaveField& field, const Vec3& x, double t);

}  // namespace gannet
