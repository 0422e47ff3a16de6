// The directions in which the domain of the particles repeats. Particles are kept inside of it;
// nodes of elements and bodies never are, so whoever relates the two looks for the image that is
// near.
#pragma once

#include <cmath>

#include "base/math.hpp"

namespace gannet {

/// Found by scene.store; absent or zero where nothing repeats.
struct Periods {
  Vec3 length = Vec3::Zero();  ///< of each direction [m]; 0: does not repeat
  [[nodiscard]] bool any() const { return !length.isZero(0); }
};

/// The image x + k L, k whole numbers, that is nearest to a point. x, to: 3 [m].
inline Vec3 image_near(const Periods& periods, const Vec3& x, const Vec3& to) {
  Vec3 image = x;
  for (Eigen::Index d = 0; d < 3; ++d) {
    const double L = periods.length[d];
    if (L > 0) image[d] += L * std::floor((to[d] - x[d]) / L + 0.5);
  }
  return image;
}

/// Calls f(k) for all whole numbers k with which x + k L lies in the box [low, high]; k = 0 in
/// directions that do not repeat, whether or not x lies there. x, low, high: 3 [m].
template <class F>
void for_images_in(const Periods& periods, const Vec3& x, const Vec3& low, const Vec3& high,
                   F&& f) {
  Eigen::Vector3i first = Eigen::Vector3i::Zero();
  Eigen::Vector3i last = Eigen::Vector3i::Zero();
  for (Eigen::Index d = 0; d < 3; ++d) {
    const double L = periods.length[d];
    if (!(L > 0)) continue;
    first[d] = static_cast<int>(std::ceil((low[d] - x[d]) / L));
    last[d] = static_cast<int>(std::floor((high[d] - x[d]) / L));
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) f(Eigen::Vector3i(i, j, k));
    }
  }
}

/// Where the image with the whole numbers k of a point is [m].
inline Vec3 image_of(const Periods& periods, const Vec3& x, const Eigen::Vector3i& k) {
  return x + periods.length.cwiseProduct(k.cast<double>());
}

}  // namespace gannet
