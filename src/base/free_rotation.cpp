#include "base/free_rotation.hpp"

#include <Eigen/LU>

#include <limits>

namespace gannet {

FreeRotation rotate_freely(const Quaternion& q, const Vec3& L, const Mat3& inverse_inertia,
                           double dt) {
  const Vec3 Pi = q.conjugate() * L;
  Vec3 Pi_m = Pi;
  Vec3 Omega = inverse_inertia * Pi_m;
  double last = std::numeric_limits<double>::infinity();
  for (int round = 1; round <= 30; ++round) {
    const Vec3 residual = Pi_m - Pi - 0.5 * dt * Pi_m.cross(Omega);
    const Mat3 slope =
        Mat3::Identity() - 0.5 * dt * (cross_matrix(Pi_m) * inverse_inertia - cross_matrix(Omega));
    const Vec3 change = slope.inverse() * residual;
    const double size = change.norm();
    Pi_m -= change;
    Omega = inverse_inertia * Pi_m;
    // Done at rounding: below it, or small and no longer shrinking.
    const double scale = Pi.norm();
    if (size <= 1e-15 * scale || (size <= 1e-13 * scale && size >= last)) {
      const Vec3 half = 0.5 * dt * Omega;
      return {(q * Quaternion(1, half.x(), half.y(), half.z())).normalized(), q * Omega, round,
              true};
    }
    last = size;
  }
  return {q, Vec3::Zero(), 30, false};
}

}  // namespace gannet
