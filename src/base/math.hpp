// Short names for the small Eigen types, and the bridge between them and node lines.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/array.hpp"

namespace gannet {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

inline Vec3 xyz(const Line& line) { return {line.x, line.y, line.z}; }

inline void set_xyz(Line& line, const Vec3& value) {
  line.x = value.x();
  line.y = value.y();
  line.z = value.z();
}

inline void add_xyz(Line& line, const Vec3& value) {
  line.x += value.x();
  line.y += value.y();
  line.z += value.z();
}

}  // namespace gannet
