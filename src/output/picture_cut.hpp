// What a cut leaves to be seen.
#pragma once

#include <optional>

#include "output/picture.hpp"

namespace gannet {

/// True for the points that are shown: those not on the viewer's side of the cut.
struct PointTest {
  std::optional<Cut> cut;
  double side = 1;  ///< 1: the viewer is where the coordinate grows

  [[nodiscard]] bool operator()(const Vec3& x) const {
    return !cut || side * (x[cut->axis] - cut->at) <= 0;
  }
};

inline PointTest test_of(const std::optional<Cut>& cut, const View& view) {
  return {cut, cut && view.toward[cut->axis] < 0 ? -1.0 : 1.0};
}

}  // namespace gannet
