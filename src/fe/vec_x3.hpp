// Three components of eight nodes or elements. For *.isa.cpp files only.
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

struct Vec8x3 {
  Vec8 x, y, z;
};

GANNET_INLINE Vec8x3 operator+(const Vec8x3& a, const Vec8x3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
GANNET_INLINE Vec8x3 operator-(const Vec8x3& a, const Vec8x3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
GANNET_INLINE Vec8x3 operator-(const Vec8x3& a) { return {-a.x, -a.y, -a.z}; }
GANNET_INLINE Vec8 dot(const Vec8x3& a, const Vec8x3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
GANNET_INLINE Vec8x3 scaled(const Vec8x3& a, Vec8 s) { return {a.x * s, a.y * s, a.z * s}; }
GANNET_INLINE Vec8x3 cross(const Vec8x3& a, const Vec8x3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Gathers corner a of the eight elements of a block from lines at base. corners: 8 a block and
/// corner, as ShellPass::corners.
GANNET_INLINE Vec8x3 gather_corner(const double* base, const std::int32_t* corners, int a) {
  Vec8 line[4];
  gather_lines(base, corners + 8 * a, 1, line);
  return {line[0], line[1], line[2]};
}

/// Adds to the lines of corner a, lane by lane in order.
GANNET_INLINE void scatter_corner(double* base, const std::int32_t* corners, int a,
                                  const Vec8x3& in) {
  const Vec8 line[3] = {in.x, in.y, in.z};
  scatter_add_lines(base, corners + 8 * a, 1, line);
}

}  // namespace gannet::GANNET_ISA_NS
