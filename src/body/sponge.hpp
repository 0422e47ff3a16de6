// A box in which velocity is damped.
#pragma once

#include "base/math.hpp"

namespace gannet {

struct SpongeZone {
  int dimension = 3;
  Vec3 low = Vec3::Zero();  ///< corners of the box [m]; z counts in space alone
  Vec3 high = Vec3::Zero();
  double ramp = 0;  ///< > 0: depth inside a face at which the rate is full [m]
  double rate = 0;  ///< [1/s]
};

/// Rate of damping at x [1/s]: rate prod_d s(min(x_d - low_d, high_d - x_d)/ramp), s(q) = q^2 (3 -
/// 2 q) between 0 and 1; zero outside of the box. x: 3 [m].
double rate_at(const SpongeZone& zone, const Vec3& x);

}  // namespace gannet
