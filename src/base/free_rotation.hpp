// Rotation of a rigid body over one step by the implicit midpoint rule.
//
// Free rotation. In the frame of the body, Pi = R(q)^T L and Pi' = Pi x (I^-1 Pi). The midpoint
// rule reads
//   Pi(n+1) - Pi(n) = dt Pi_m x Omega,   Pi_m = (Pi(n) + Pi(n+1))/2,   Omega = I^-1 Pi_m.
// The increment is normal to Pi_m and to I^-1 Pi_m, and (a - b).(a + b) = |a|^2 - |b|^2: so |Pi|^2
// and Pi . I^-1 Pi, the kinetic energy, are both kept exactly. The same equation, written
//   (1 + dt/2 [Omega]) Pi(n+1) = (1 - dt/2 [Omega]) Pi(n),
// says Pi(n+1) = C^T Pi(n) with the Cayley rotation C of dt Omega, whose quaternion is
// (1, dt Omega/2) normalised. With q(n+1) = q(n) (1, dt Omega/2)/|.| therefore
// R(n+1) Pi(n+1) = R(n) Pi(n) = L: the spatial angular momentum does not change at all.
#pragma once

#include "base/math.hpp"

namespace gannet {

/// The matrix of a x ( ).
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Result of a free rotation over dt.
struct FreeRotation {
  Quaternion q;  ///< at the end of the step
  Vec3 omega;    ///< mean angular velocity in space: the step turns by the Cayley map of it
  int iterations = 0;
  bool settled = false;  ///< false: not solved, q and omega mean nothing
};

/// Free rotation over dt [s] with fixed spatial angular momentum L [kg m^2/s] by the implicit
/// midpoint rule (see above), solved by Newton's method to rounding within 30 rounds.
/// inverse_inertia: in the frame of the body [1/(kg m^2)]. Wants dt |omega| below about 1. Throws
/// nothing.
FreeRotation rotate_freely(const Quaternion& q, const Vec3& L, const Mat3& inverse_inertia,
                           double dt);

}  // namespace gannet
