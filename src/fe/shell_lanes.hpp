// What passes over blocks of shells have in common: corners in and out, memory called for ahead,
// sums by lane. For *.isa.cpp files only.
#pragma once

#include "fe/lane_extremes.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/vec_x3.hpp"
#include "fe/vote_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

/// The corners of a block: now, halfway through the step that led here, and their motion.
template <int N>
struct CornersOf {
  VecX3 x[N], middle[N];  ///< [m]
  VecX3 v[N], w[N];       ///< [m/s], [rad/s]
};

template <int N>
GANNET_INLINE const std::int32_t* corners_of(const ShellPass& pass, std::int32_t block) {
  return pass.corners + 8 * N * static_cast<std::int64_t>(block);
}

template <int N>
GANNET_INLINE CornersOf<N> gather_all(const ShellPass& pass, std::int32_t block) {
  const std::int32_t* corners = corners_of<N>(pass, block);
  CornersOf<N> c;
  for (int a = 0; a < N; ++a) c.x[a] = gather_corner(pass.x, corners, a);
  for (int a = 0; a < N; ++a) c.v[a] = gather_corner(pass.v, corners, a);
  for (int a = 0; a < N; ++a) c.w[a] = gather_corner(pass.omega, corners, a);
  for (int a = 0; a < N; ++a) c.middle[a] = c.x[a] - scaled(c.v[a], Vec(0.5 * pass.dt));
  return c;
}

template <int N>
GANNET_INLINE void scatter_all(const ShellPass& pass, std::int32_t block, const VecX3 f[N],
                               const VecX3 m[N]) {
  const std::int32_t* corners = corners_of<N>(pass, block);
  for (int a = 0; a < N; ++a) scatter_corner(pass.f, corners, a, f[a]);
  for (int a = 0; a < N; ++a) scatter_corner(pass.torque, corners, a, m[a]);
}

/// Puts the corners of elements that have collapsed where nothing about them is singular, at rest;
/// without thickness they then exert nothing and change nothing.
template <int N>
GANNET_INLINE void make_harmless(CornersOf<N>& c, VecMask goes_on) {
  const Vec zero(0.0);
  for (int a = 0; a < N; ++a) {
    const Vec x(a == 1 || (N == 4 && a == 2) ? 1.0 : 0.0);
    const Vec y(a >= 2 ? 1.0 : 0.0);
    const auto put = [&](VecX3& line, Vec there_x, Vec there_y) {
      line = {select(goes_on, line.x, there_x), select(goes_on, line.y, there_y),
              select(goes_on, line.z, zero)};
    };
    put(c.x[a], x, y);
    put(c.middle[a], x, y);
    put(c.v[a], zero, zero);
    put(c.w[a], zero, zero);
  }
}

/// Sums over elements, kept by lane until the end of a chunk.
struct ShellLaneSums {
  Vec internal = Vec(0.0);
  Vec plastic = Vec(0.0);
  Vec hourglass = Vec(0.0);
  Vec damping = Vec(0.0);
  Vec eroded = Vec(0.0);
  Vec omega2 = Vec(0.0);
  Vec block = Vec(-1.0);
  Vec area_ratio = Vec(1.0);
  Vec smallest = Vec(-1.0);
  /// Takes note of areas over those at the start, of elements with a thickness, and says which have
  /// not collapsed. A ratio that is no number counts as 0.
  GANNET_INLINE VecMask shrunk_to(Vec ratio, double limit, Vec thickness, std::int32_t number) {
    const Vec counts = select(less(Vec(0.0), thickness), max(ratio, Vec(0.0)), Vec(1.0));
    const auto smaller = less(counts, area_ratio);
    area_ratio = select(smaller, counts, area_ratio);
    smallest = select(smaller, Vec(static_cast<double>(number)), smallest);
    return less(Vec(limit), ratio);
  }
  /// Takes note of the bounds of a block, from the own mass of elements [1/s^2].
  GANNET_INLINE void vote(const ShellPass& pass, Vec own, std::int32_t number) {
    const Vec damped = pass.votes.damping_time == nullptr
                           ? own
                           : own * damped_factor(stiffness_ratio(pass.votes, number, own));
    const Vec bound = with_added_mass(pass.votes, number, damped);
    const auto larger = less(omega2, bound);
    omega2 = select(larger, bound, omega2);
    block = select(larger, Vec(static_cast<double>(number)), block);
  }
};

/// The thickness follows the strain increment: t (1 + e/2)/(1 - e/2), t exp(e) to second order.
GANNET_INLINE Vec grown(Vec t, Vec strain) {
  return t * (Vec(1.0) + Vec(0.5) * strain) / (Vec(1.0) - Vec(0.5) * strain);
}

/// Blocks between the one at work and the one whose data is called for: long enough for memory to
/// answer (50 to 70 % more elements a second out of cache).
inline constexpr std::int32_t blocks_ahead = 2;

/// Calls for the state and the nodes of a later block. Two opposite corners are enough: with its
/// neighbours they name nearly every node.
template <int N>
GANNET_INLINE void call_for(const ShellPass& pass, std::int32_t block) {
  const int n_values = pass.layout.n_values();
  const double* state = pass.state + static_cast<std::int64_t>(block) * n_values * 8;
  for (int k = 0; k < n_values; ++k) __builtin_prefetch(state + 8 * k, 1);
  const std::int32_t* corners = corners_of<N>(pass, block);
  for (int k = 0; k < 16; ++k) {
    const std::int64_t line = 4 * static_cast<std::int64_t>(corners[k < 8 ? k : k + 8]);
    __builtin_prefetch(pass.x + line);
    __builtin_prefetch(pass.v + line);
    __builtin_prefetch(pass.omega + line);
    __builtin_prefetch(pass.f + line, 1);
    __builtin_prefetch(pass.torque + line, 1);
  }
}

/// Element::block<law>(pass, block, sums) for blocks [begin, end), vector by vector.
template <class Element, PointLaw law>
GANNET_INLINE void over_blocks(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                               ShellSums& out) {
  ShellPass from[vecs_per_block];
  ShellLaneSums sums[vecs_per_block];
  for (int k = 0; k < vecs_per_block; ++k) from[k] = from_lane(pass, k * vec_lanes);
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + blocks_ahead < end) {
      call_for<Element::n_corners>(pass, block + blocks_ahead);
    }
#pragma GCC unroll 1
    for (int k = 0; k < vecs_per_block; ++k) Element::template block<law>(from[k], block, sums[k]);
  }
  out = {};
  for (int k = 0; k < vecs_per_block; ++k) {
    const ShellLaneSums& s = sums[k];
    out.internal += sum(s.internal);
    out.plastic += sum(s.plastic);
    out.hourglass += sum(s.hourglass);
    out.damping += sum(s.damping);
    out.eroded += sum(s.eroded);
    take_largest(s.omega2, s.block, k * vec_lanes, out.omega2, out.element);
    take_smallest(s.area_ratio, s.smallest, k * vec_lanes, out.area_ratio, out.smallest);
  }
}

/// The same with the law that the block has.
template <class Element>
GANNET_INLINE void with_law(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                            ShellSums& sums) {
  switch (pass.constants->point_law) {
    case PointLaw::elastic:
      over_blocks<Element, PointLaw::elastic>(pass, begin, end, sums);
      return;
    case PointLaw::linear_hardening:
      over_blocks<Element, PointLaw::linear_hardening>(pass, begin, end, sums);
      return;
    case PointLaw::general:
      over_blocks<Element, PointLaw::general>(pass, begin, end, sums);
      return;
    case PointLaw::hyperelastic:  // refused as the case is read
      return;
  }
}

}  // namespace gannet::GANNET_ISA_NS
