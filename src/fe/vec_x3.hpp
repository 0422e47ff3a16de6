// Three components of as many nodes or elements as a vector has lanes, and blocks of eight elements
// taken vector by vector. For *.isa.cpp files only.
#pragma once

#include "base/simd_vec.hpp"

namespace gannet::GANNET_ISA_NS {

template <class V>
struct Three {
  V x, y, z;
};
using Vec8x3 = Three<Vec8>;
using VecX3 = Three<Vec>;

template <class V>
GANNET_INLINE Three<V> operator+(const Three<V>& a, const Three<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
GANNET_INLINE Three<V> operator-(const Three<V>& a, const Three<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
GANNET_INLINE Three<V> operator-(const Three<V>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class V>
GANNET_INLINE V dot(const Three<V>& a, const Three<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
GANNET_INLINE Three<V> scaled(const Three<V>& a, V s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class V>
GANNET_INLINE Three<V> cross(const Three<V>& a, const Three<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Gathers corner a of the elements of a vector from lines at base. corners: 8 a corner, as
/// ShellPass::corners.
template <class V = Vec>
GANNET_INLINE Three<V> gather_corner(const double* base, const std::int32_t* corners, int a) {
  V line[4];
  gather_lines(base, corners + 8 * a, 1, line);
  return {line[0], line[1], line[2]};
}

/// Adds to the lines of corner a, lane by lane in order.
template <class V>
GANNET_INLINE void scatter_corner(double* base, const std::int32_t* corners, int a,
                                  const Three<V>& in) {
  const V line[3] = {in.x, in.y, in.z};
  scatter_add_lines(base, corners + 8 * a, 1, line);
}

/// Vectors that a block of eight elements fills.
inline constexpr int vecs_per_block = 8 / vec_lanes;

/// The same pass for those who look at the first lanes of a block only: begun at another lane.
template <class Pass>
GANNET_INLINE Pass from_lane(const Pass& pass, int lane) {
  Pass p = pass;
  p.corners += lane;
  p.state += lane;
  if (p.votes.inverse_mass != nullptr) p.votes.inverse_mass += lane;
  if (p.votes.damping_time != nullptr) p.votes.damping_time += lane;
  if (p.votes.omega2 != nullptr) p.votes.omega2 += lane;
  return p;
}

}  // namespace gannet::GANNET_ISA_NS
