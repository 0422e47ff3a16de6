// Points that the tests of this room search among.
#pragma once

#include <random>

#include "base/array.hpp"

namespace gannet {

/// n points, uniform in a box [0, size) at `corner`.
inline Array<Line> random_points(int n, Line corner, Line size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Array<Line> x(static_cast<std::size_t>(n));
  for (Line& line : x) {
    line.x = corner.x + size.x * u(random);
    line.y = corner.y + size.y * u(random);
    line.z = corner.z + size.z * u(random);
  }
  return x;
}

inline bool have_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

}  // namespace gannet
