// What passes over blocks of shells have in common: corners in and out, memory called for ahead,
// sums by lane. For *.isa.cpp files only.
#pragma once

#include "fe/lane_extremes.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/vec8x3.hpp"
#include "fe/vote_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

/// The corners of a block: now, halfway through the step that led here, and their motion.
template <int N>
struct CornersOf {
  Vec8x3 x[N], middle[N];  ///< [m]
  Vec8x3 v[N], w[N];       ///< [m/s], [rad/s]
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
  for (int a = 0; a < N; ++a) c.middle[a] = c.x[a] - scaled(c.v[a], Vec8(0.5 * pass.dt));
  return c;
}

template <int N>
GANNET_INLINE void scatter_all(const ShellPass& pass, std::int32_t block, const Vec8x3 f[N],
                               const Vec8x3 m[N]) {
  const std::int32_t* corners = corners_of<N>(pass, block);
  for (int a = 0; a < N; ++a) scatter_corner(pass.f, corners, a, f[a]);
  for (int a = 0; a < N; ++a) scatter_corner(pass.torque, corners, a, m[a]);
}

/// Puts the corners of elements that have collapsed where nothing about them is singular, at rest;
/// without thickness they then exert nothing and change nothing.
template <int N>
GANNET_INLINE void make_harmless(CornersOf<N>& c, Mask8 goes_on) {
  const Vec8 zero(0.0);
  for (int a = 0; a < N; ++a) {
    const Vec8 x(a == 1 || (N == 4 && a == 2) ? 1.0 : 0.0);
    const Vec8 y(a >= 2 ? 1.0 : 0.0);
    const auto put = [&](Vec8x3& line, Vec8 there_x, Vec8 there_y) {
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
  Vec8 internal = Vec8(0.0);
  Vec8 plastic = Vec8(0.0);
  Vec8 hourglass = Vec8(0.0);
  Vec8 damping = Vec8(0.0);
  Vec8 eroded = Vec8(0.0);
  Vec8 omega2 = Vec8(0.0);
  Vec8 block = Vec8(-1.0);
  Vec8 area_ratio = Vec8(1.0);
  Vec8 smallest = Vec8(-1.0);
  /// Takes note of areas over those at the start, of elements with a thickness, and says which have
  /// not collapsed. A ratio that is no number counts as 0.
  GANNET_INLINE Mask8 shrunk_to(Vec8 ratio, double limit, Vec8 thickness, std::int32_t number) {
    const Vec8 counts = select(less(Vec8(0.0), thickness), max(ratio, Vec8(0.0)), Vec8(1.0));
    const auto smaller = less(counts, area_ratio);
    area_ratio = select(smaller, counts, area_ratio);
    smallest = select(smaller, Vec8(static_cast<double>(number)), smallest);
    return less(Vec8(limit), ratio);
  }
  /// Takes note of the bounds of a block, from the own mass of elements [1/s^2].
  GANNET_INLINE void vote(const ShellPass& pass, Vec8 own, std::int32_t number) {
    const Vec8 damped = pass.votes.damping_time == nullptr
                            ? own
                            : own * damped_factor(stiffness_ratio(pass.votes, number, own));
    const Vec8 bound = with_added_mass(pass.votes, number, damped);
    const auto larger = less(omega2, bound);
    omega2 = select(larger, bound, omega2);
    block = select(larger, Vec8(static_cast<double>(number)), block);
  }
};

/// Whether a mask leaves any lane out.
GANNET_INLINE bool leaves_out(Mask8 goes_on) {
  return any(less(Vec8(0.5), select(goes_on, Vec8(0.0), Vec8(1.0))));
}

/// The thickness follows the strain increment: t (1 + e/2)/(1 - e/2), t exp(e) to second order.
GANNET_INLINE Vec8 grown(Vec8 t, Vec8 strain) {
  return t * (Vec8(1.0) + Vec8(0.5) * strain) / (Vec8(1.0) - Vec8(0.5) * strain);
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

/// Element::block<law>(pass, block, sums) for blocks [begin, end).
template <class Element, PointLaw law>
GANNET_INLINE void over_blocks(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                               ShellSums& out) {
  ShellLaneSums sums;
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + blocks_ahead < end) {
      call_for<Element::n_corners>(pass, block + blocks_ahead);
    }
    Element::template block<law>(pass, block, sums);
  }
  out.internal = sum(sums.internal);
  out.plastic = sum(sums.plastic);
  out.hourglass = sum(sums.hourglass);
  out.damping = sum(sums.damping);
  out.eroded = sum(sums.eroded);
  out.omega2 = 0;
  out.element = -1;
  take_largest(sums.omega2, sums.block, out.omega2, out.element);
  out.area_ratio = 1;
  out.smallest = -1;
  take_smallest(sums.area_ratio, sums.smallest, out.area_ratio, out.smallest);
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
