// What passes over blocks of solids have in common: corners in and out, memory called for ahead,
// the motion of the step, what every formulation adds to its stress, sums by lane. For *.isa.cpp
// files only.
#pragma once

#include "fe/lane_extremes.hpp"
#include "fe/solid_element.hpp"
#include "fe/solid_forces.hpp"
#include "fe/vote_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

/// Blocks between the one at work and the one whose data is called for.
inline constexpr std::int32_t solid_blocks_ahead = 2;

GANNET_INLINE const std::int32_t* corners_of_block(const SolidPass& pass, std::int32_t block) {
  return pass.corners + 8 * pass.layout.n_corners() * static_cast<std::int64_t>(block);
}

/// Calls for the state and the nodes of a later block: four of the eight corners, which with those
/// of its neighbours are nearly every node.
GANNET_INLINE void call_for(const SolidPass& pass, SolidShape shape, std::int32_t block) {
  const int n_values = pass.layout.n_values();
  const double* state = pass.state + static_cast<std::int64_t>(block) * n_values * 8;
  for (int k = 0; k < n_values; ++k) __builtin_prefetch(state + 8 * k, 1);
  const std::int32_t* corners = corners_of_block(pass, block);
  constexpr int some[2][4] = {{0, 2, 5, 7}, {0, 1, 2, 3}};
  for (const int a : some[shape == SolidShape::brick ? 0 : 1]) {
    for (int lane = 0; lane < 8; ++lane) {
      const std::int64_t line = 4 * static_cast<std::int64_t>(corners[8 * a + lane]);
      __builtin_prefetch(pass.x + line);
      __builtin_prefetch(pass.v + line);
      __builtin_prefetch(pass.f + line, 1);
    }
  }
}

/// Sums over elements, kept by lane until the end of a chunk.
struct SolidLaneSums {
  Vec internal = Vec(0.0);
  Vec plastic = Vec(0.0);
  Vec hourglass = Vec(0.0);
  Vec viscous = Vec(0.0);
  Vec damping = Vec(0.0);
  Vec eroded = Vec(0.0);
  Vec omega2 = Vec(0.0);
  Vec block = Vec(-1.0);
  Vec volume_ratio = Vec(1.0);
  Vec smallest = Vec(-1.0);
};

/// Keeps the larger bound and the smaller volume of each lane, and whose they are.
GANNET_INLINE void note_extremes(Vec omega2, Vec volume_ratio, std::int32_t block,
                                 SolidLaneSums& sums) {
  const Vec here(static_cast<double>(block));
  const auto larger = less(sums.omega2, omega2);
  sums.omega2 = select(larger, omega2, sums.omega2);
  sums.block = select(larger, here, sums.block);
  const auto smaller = less(volume_ratio, sums.volume_ratio);
  sums.volume_ratio = select(smaller, volume_ratio, sums.volume_ratio);
  sums.smallest = select(smaller, here, sums.smallest);
}

/// What an element that has collapsed held may not be finite: stress, history and forces are
/// cleared.
template <class Mask>
GANNET_INLINE void forget_collapsed(const SolidLayout& layout, Mask alive, double* state) {
  for (int k = 0; k < layout.start(); ++k) {
    if (k == layout.inverse_volume()) continue;
    double* p = state + 8 * k;
    select(alive, Vec::load(p), Vec(0.0)).store(p);
  }
}

/// The elements of a vector on their way from n-1 to n: what all formulations start from.
struct SolidMotion {
  SolidModes x;       ///< of the positions at n
  SolidModes x_half;  ///< halfway to them
  SolidModes v;       ///< of the velocities
  SolidGeometry half;
  SolidGeometry now;
  Tensor L;          ///< mean gradient of the displacement of the step
  Symmetric<Vec> e;  ///< its symmetric part
  GramBound gram;    ///< of the mean gradients at n
  Vec inverse_V0;    ///< 0 in empty lanes and eroded elements
  Vec shrunk_to;     ///< smaller of V/V0 at n and halfway
  VecMask alive;     ///< elements that are there and have not collapsed
  Vec inverse_volume;
  Vec inverse_volume_192;  ///< 1/(192 V)
  Vec inverse_mass;
  Vec length;  ///< shortest distance across the element
  [[nodiscard]] GANNET_INLINE Vec of_alive(Vec a) const { return select(alive, a, Vec(0.0)); }
  [[nodiscard]] GANNET_INLINE VecX3 of_alive(const VecX3& a) const {
    return {of_alive(a.x), of_alive(a.y), of_alive(a.z)};
  }
};

/// Positions and velocities of the corners. The faces of a plane case are one unit apart: eight
/// times half of that is a3.
GANNET_INLINE void gather_motion(const SolidPass& pass, SolidShape shape,
                                 const std::int32_t* corners, SolidModes& x, SolidModes& v) {
  if (shape == SolidShape::brick) {
    gather_bricks(pass.x, pass.v, corners, x, v);
  } else {
    VecX3 at[4];
    VecX3 moving[4];
    for (int a = 0; a < 4; ++a) at[a] = gather_corner(pass.x, corners, a);
    for (int a = 0; a < 4; ++a) moving[a] = gather_corner(pass.v, corners, a);
    if (shape == SolidShape::tetrahedron) {
      x = tetrahedron_modes_of(at);
      v = tetrahedron_modes_of(moving);
    } else {
      x = plane_modes_of(at, {Vec(0.0), Vec(0.0), Vec(4.0)});
      v = plane_modes_of(moving, {Vec(0.0), Vec(0.0), Vec(0.0)});
    }
  }
}

/// Adds forces to the corners.
GANNET_INLINE void scatter_modes(double* base, SolidShape shape, const std::int32_t* corners,
                                 const SolidModes& F) {
  if (shape == SolidShape::brick) {
    scatter_brick(base, corners, F);
  } else {
    VecX3 f[4];
    shape == SolidShape::tetrahedron ? tetrahedron_corners_of(F, f) : plane_corners_of(F, f);
    for (int a = 0; a < 4; ++a) scatter_corner(base, corners, a, f[a]);
  }
}

GANNET_INLINE SolidMotion solid_motion(const SolidPass& pass, SolidShape shape,
                                       const std::int32_t* corners, const double* state) {
  const SolidConstants& c = *pass.constants;
  SolidMotion m;
  gather_motion(pass, shape, corners, m.x, m.v);
  const Vec half_dt(0.5 * pass.dt);
  for (int k = 0; k < 3; ++k) m.x_half.a[k] = m.x.a[k] - scaled(m.v.a[k], half_dt);
  for (int k = 0; k < 4; ++k) m.x_half.g[k] = m.x.g[k] - scaled(m.v.g[k], half_dt);
  m.half = solid_geometry(m.x_half);
  m.L = mean_gradient(m.half, m.v, Vec(pass.dt) * reciprocal(m.half.volume_192));
  m.e = symmetric_part(m.L);
  m.now = solid_geometry(m.x);
  m.gram = gram_bound(m.now, shape);
  m.inverse_V0 = Vec::load(state + 8 * pass.layout.inverse_volume());
  const auto there = less(Vec(0.0), m.inverse_V0);
  m.shrunk_to = select(
      there, Vec(1.0 / 192.0) * min(m.now.volume_192, m.half.volume_192) * m.inverse_V0, Vec(1.0));
  m.alive = less(select(there, Vec(c.smallest_ratio), Vec(1.0)), m.shrunk_to);
  m.inverse_volume_192 = reciprocal(m.now.volume_192);
  m.inverse_volume = Vec(192.0) * m.inverse_volume_192;
  m.inverse_mass = m.inverse_V0 * Vec(1.0 / c.rho0);
  m.length = m.now.volume() * rsqrt(Vec(2.0) * m.gram.largest);
  return m;
}

/// What is left of a number of elements: all of it.
struct KeepAll {
  GANNET_INLINE Vec operator()(Vec a) const { return a; }
};

/// What is left of a number of elements whose last point may have failed in this step: nothing.
struct KeepCarrying {
  Vec damage;  ///< smallest of the element's points
  GANNET_INLINE Vec operator()(Vec a) const { return select(less(damage, Vec(1.0)), a, Vec(0.0)); }
};

/// The bulk viscosity of the step; its pressure is kept in the state, its work added to the sums.
template <class Keep>
GANNET_INLINE BulkViscosity add_bulk_viscosity(const SolidPass& pass, const SolidMotion& m,
                                               Keep keep, double* state, SolidLaneSums& sums) {
  const SolidConstants& c = *pass.constants;
  const Vec trace_e = m.e.xx + m.e.yy + m.e.zz;
  const Vec ratio = select(m.alive, m.now.volume() * m.inverse_V0, Vec(1.0));
  BulkViscosity bulk =
      bulk_viscosity(c, trace_e, pass.dt, m.length, Vec(c.rho0) * reciprocal(ratio));
  bulk.q = keep(bulk.q);
  double* kept = state + 8 * pass.layout.viscous_pressure();
  sums.viscous += m.of_alive(Vec(-0.5) * (Vec::load(kept) + bulk.q) * trace_e * m.half.volume());
  bulk.q.store(kept);
  return bulk;
}

/// Hourglass forces of the step, their work added to the sums. k_h: stiffness [N/m].
template <class Keep>
GANNET_INLINE void add_hourglass(const SolidPass& pass, const SolidMotion& m, const Tensor& R,
                                 Vec k_h, Keep keep, double* state, SolidLaneSums& sums,
                                 VecX3 Q[4]) {
  VecX3 q[4];  // eight times
  for (int k = 0; k < 4; ++k) {
    q[k] = scaled(m.v.g[k], Vec(pass.dt)) - times(m.L, m.x_half.g[k]);
  }
  if (pass.layout.remembers) {
    double* kept = state + 8 * pass.layout.hourglass();
    sums.hourglass += m.of_alive(hourglass_stiffness(kept, q, R, k_h, keep, Q));
  } else {
    sums.hourglass +=
        m.of_alive(hourglass_viscosity(*pass.constants, q, keep(k_h), pass.dt, m.length, Q));
  }
}

/// Smallest damage of the points of each element.
GANNET_INLINE Vec least_damage(const SolidPass& pass, const double* state) {
  const J2History& h = pass.constants->history;
  if (h.damage < 0) return Vec(0.0);
  Vec least(1.0);
  for (int point = 0; point < pass.layout.n_points; ++point) {
    const int k = pass.layout.plastic_strain(point) + h.damage;
    least = min(least, Vec::load(state + 8 * k));
  }
  return least;
}

/// Takes elements out whose last point has failed: they exert nothing from now on.
GANNET_INLINE void take_out_failed(const SolidPass& pass, const KeepCarrying& keep, double* state) {
  double* inverse_V0 = state + 8 * pass.layout.inverse_volume();
  keep(Vec::load(inverse_V0)).store(inverse_V0);
}

/// Where the part asks for it: damping at a point, its work added to the sums. e, along: as of
/// damping_stress(); volume: that the point stands for [m^3]; keep: 0 for what carries nothing.
template <class Keep>
GANNET_INLINE void add_damping(const SolidPass& pass, const SolidMotion& m, std::int32_t block,
                               int point, Keep keep, const Symmetric<Vec>& e,
                               const Symmetric<Vec>& along, Vec volume, double* state,
                               SolidLaneSums& sums, Symmetric<Vec>& sigma) {
  if (pass.votes.damping_time == nullptr) [[likely]]
    return;
  // Copies: what a function gets by reference is kept in memory wherever it is used.
  const Symmetric<Vec> strain{e.xx, e.yy, e.zz, e.xy, e.yz, e.zx};
  const Symmetric<Vec> path{along.xx, along.yy, along.zz, along.xy, along.yz, along.zx};
  Symmetric<Vec> with_damping{sigma.xx, sigma.yy, sigma.zz, sigma.xy, sigma.yz, sigma.zx};
  Vec work;
  damping_stress(*pass.constants, keep(damping_per_step(pass.votes, block, pass.dt)),
                 state + 8 * pass.layout.damping(point), strain, path, with_damping, work);
  const Symmetric<Vec>& d = with_damping;
  sigma = {d.xx, d.yy, d.zz, d.xy, d.yz, d.zx};
  sums.damping += m.of_alive(work * volume);
}

/// Adds the forces to the corners and notes the extremes. F: forces on the coefficients; omega2
/// [1/s^2], damped.
GANNET_INLINE void finish_block(const SolidPass& pass, SolidShape shape, const SolidMotion& m,
                                const std::int32_t* corners, std::int32_t block, SolidModes& F,
                                Vec omega2, double* state, SolidLaneSums& sums) {
  if (leaves_out(m.alive)) {
    for (VecX3& a : F.a) a = m.of_alive(a);
    for (VecX3& g : F.g) g = m.of_alive(g);
  }
  const auto there = less(Vec(0.0), m.inverse_V0);
  if (any(less(m.shrunk_to, select(there, Vec(pass.constants->smallest_ratio), Vec(0.0))))) {
    forget_collapsed(pass.layout, m.alive, state);
  }
  scatter_modes(pass.f, shape, corners, F);
  note_extremes(with_added_mass(pass.votes, block, m.of_alive(omega2)), m.shrunk_to, block, sums);
}

/// omega2 [1/s^2] with what bulk viscosity, zeta, and damping in proportion to stiffness make of
/// the step.
GANNET_INLINE Vec damped(const SolidPass& pass, std::int32_t block, Vec omega2, Vec zeta) {
  return omega2 * damped_factor(zeta + stiffness_ratio(pass.votes, block, omega2));
}

/// Lame's constants that bound the frequency.
struct Lame {
  Vec lambda;
  Vec two_mu;
};

/// Adds the work of a point or an element to the sums. volume: of what it is per [m^3].
template <PointLaw law>
GANNET_INLINE void add_work(const SolidMotion& m, const J2Work<Vec>& work, Vec volume,
                            SolidLaneSums& sums) {
  sums.internal += m.of_alive(work.internal * volume);
  constexpr bool yields = law == PointLaw::linear_hardening || law == PointLaw::general;
  if constexpr (yields) sums.plastic += m.of_alive(work.plastic * volume);
  if constexpr (law == PointLaw::general) sums.eroded += m.of_alive(work.eroded * volume);
}

/// Which elements still carry something after the stress of the step.
template <PointLaw law>
GANNET_INLINE auto keeper(const SolidPass& pass, const double* state) {
  if constexpr (law == PointLaw::general) {
    return KeepCarrying{least_damage(pass, state)};
  } else {
    return KeepAll{};
  }
}

/// Element::block<law>(pass, block, sums) for blocks [begin, end), vector by vector.
template <class Element, PointLaw law>
GANNET_INLINE void over_solids(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                               SolidSums& out) {
  SolidPass from[vecs_per_block];
  SolidLaneSums sums[vecs_per_block];
  for (int k = 0; k < vecs_per_block; ++k) from[k] = from_lane(pass, k * vec_lanes);
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + solid_blocks_ahead < end) {
      call_for(pass, Element::shape_of(pass.layout), block + solid_blocks_ahead);
    }
#pragma GCC unroll 1
    for (int k = 0; k < vecs_per_block; ++k) Element::template block<law>(from[k], block, sums[k]);
  }
  out = {};
  for (int k = 0; k < vecs_per_block; ++k) {
    const SolidLaneSums& s = sums[k];
    out.internal += sum(s.internal);
    out.plastic += sum(s.plastic);
    out.hourglass += sum(s.hourglass);
    out.viscous += sum(s.viscous);
    out.damping += sum(s.damping);
    out.eroded += sum(s.eroded);
    take_largest(s.omega2, s.block, k * vec_lanes, out.omega2, out.element);
    take_smallest(s.volume_ratio, s.smallest, k * vec_lanes, out.volume_ratio, out.smallest);
  }
}

/// The same with the law that the block has.
template <class Element>
GANNET_INLINE void solids_of_law(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                                 SolidSums& sums) {
  switch (pass.constants->point_law) {
    case PointLaw::elastic:
      over_solids<Element, PointLaw::elastic>(pass, begin, end, sums);
      return;
    case PointLaw::linear_hardening:
      over_solids<Element, PointLaw::linear_hardening>(pass, begin, end, sums);
      return;
    case PointLaw::general:
      over_solids<Element, PointLaw::general>(pass, begin, end, sums);
      return;
    case PointLaw::hyperelastic:
      over_solids<Element, PointLaw::hyperelastic>(pass, begin, end, sums);
      return;
  }
}

}  // namespace gannet::GANNET_ISA_NS
