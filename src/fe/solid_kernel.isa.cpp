#include "fe/solid_kernel.hpp"

#include "fe/lane_extremes.hpp"
#include "fe/solid_element.hpp"
#include "fe/solid_forces.hpp"
#include "fe/vote_lanes.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Blocks between the one at work and the one whose data is called for.
constexpr std::int32_t blocks_ahead = 2;

GANNET_INLINE const std::int32_t* corners_of_block(const SolidPass& pass, std::int32_t block) {
  return pass.corners + 8 * pass.layout.n_corners() * static_cast<std::int64_t>(block);
}

/// Calls for the state and the nodes of a later block: four of the eight corners, which with those
/// of its neighbours are nearly every node.
GANNET_INLINE void call_for(const SolidPass& pass, std::int32_t block) {
  const int n_values = pass.layout.n_values();
  const double* state = pass.state + static_cast<std::int64_t>(block) * n_values * 8;
  for (int k = 0; k < n_values; ++k) __builtin_prefetch(state + 8 * k, 1);
  const std::int32_t* corners = corners_of_block(pass, block);
  constexpr int some[2][4] = {{0, 2, 5, 7}, {0, 1, 2, 3}};
  for (const int a : some[pass.layout.n_corners() == 4 ? 1 : 0]) {
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
  Vec8 internal = Vec8(0.0);
  Vec8 plastic = Vec8(0.0);
  Vec8 hourglass = Vec8(0.0);
  Vec8 viscous = Vec8(0.0);
  Vec8 damping = Vec8(0.0);
  Vec8 eroded = Vec8(0.0);
  Vec8 omega2 = Vec8(0.0);
  Vec8 block = Vec8(-1.0);
  Vec8 volume_ratio = Vec8(1.0);
  Vec8 smallest = Vec8(-1.0);
};

/// Keeps the larger bound and the smaller volume of each lane, and whose they are.
GANNET_INLINE void note_extremes(Vec8 omega2, Vec8 volume_ratio, std::int32_t block,
                                 SolidLaneSums& sums) {
  const Vec8 here(static_cast<double>(block));
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
    select(alive, Vec8::load(p), Vec8(0.0)).store(p);
  }
}

/// Eight elements on their way from n-1 to n: what all formulations start from.
struct SolidMotion {
  SolidModes x;       ///< of the positions at n
  SolidModes x_half;  ///< halfway to them
  SolidModes v;       ///< of the velocities
  SolidGeometry half;
  SolidGeometry now;
  Tensor L;           ///< mean gradient of the displacement of the step
  Symmetric<Vec8> e;  ///< its symmetric part
  GramBound gram;     ///< of the mean gradients at n
  Vec8 inverse_V0;    ///< 0 in empty lanes and eroded elements
  Vec8 shrunk_to;     ///< smaller of V/V0 at n and halfway
  Mask8 alive;        ///< elements that are there and have not collapsed
  Vec8 inverse_volume;
  Vec8 inverse_mass;
  Vec8 length;  ///< shortest distance across the element
  [[nodiscard]] GANNET_INLINE Vec8 of_alive(Vec8 a) const { return select(alive, a, Vec8(0.0)); }
  [[nodiscard]] GANNET_INLINE Vec8x3 of_alive(const Vec8x3& a) const {
    return {of_alive(a.x), of_alive(a.y), of_alive(a.z)};
  }
};

/// across: half the distance of the faces of a plane case, for positions; 0 for other fields.
GANNET_INLINE SolidModes gather_modes(const double* base, const std::int32_t* corners,
                                      const SolidLayout& layout, double across) {
  Vec8x3 at_corner[8];
  for (int a = 0; a < layout.n_corners(); ++a) at_corner[a] = gather_corner(base, corners, a);
  if (layout.tetrahedra()) return tetrahedron_modes_of(at_corner);
  if (layout.plane()) return plane_modes_of(at_corner, {Vec8(0.0), Vec8(0.0), Vec8(across)});
  return modes_of(at_corner);
}

GANNET_INLINE SolidMotion solid_motion(const SolidPass& pass, const std::int32_t* corners,
                                       const double* state) {
  const SolidConstants& c = *pass.constants;
  SolidMotion m;
  m.x = gather_modes(pass.x, corners, pass.layout, 0.5);
  m.v = gather_modes(pass.v, corners, pass.layout, 0);
  const Vec8 half_dt(0.5 * pass.dt);
  for (int k = 0; k < 3; ++k) m.x_half.a[k] = m.x.a[k] - scaled(m.v.a[k], half_dt);
  for (int k = 0; k < 4; ++k) m.x_half.g[k] = m.x.g[k] - scaled(m.v.g[k], half_dt);
  m.half = solid_geometry(m.x_half);
  m.L = mean_gradient(m.half, m.v, Vec8(pass.dt) * reciprocal(m.half.volume));
  m.e = symmetric_part(m.L);
  m.now = solid_geometry(m.x);
  m.gram = gram_bound(m.now, pass.layout.shape);
  m.inverse_V0 = Vec8::load(state + 8 * pass.layout.inverse_volume());
  const auto there = less(Vec8(0.0), m.inverse_V0);
  m.shrunk_to = select(there, min(m.now.volume, m.half.volume) * m.inverse_V0, Vec8(1.0));
  m.alive = less(select(there, Vec8(c.smallest_ratio), Vec8(1.0)), m.shrunk_to);
  m.inverse_volume = reciprocal(m.now.volume);
  m.inverse_mass = m.inverse_V0 * Vec8(1.0 / c.rho0);
  m.length = m.now.volume * rsqrt(Vec8(2.0) * m.gram.largest);
  return m;
}

/// What is left of a number of elements: all of it.
struct KeepAll {
  GANNET_INLINE Vec8 operator()(Vec8 a) const { return a; }
};

/// What is left of a number of elements whose last point may have failed in this step: nothing.
struct KeepCarrying {
  Vec8 damage;  ///< smallest of the element's points
  GANNET_INLINE Vec8 operator()(Vec8 a) const {
    return select(less(damage, Vec8(1.0)), a, Vec8(0.0));
  }
};

/// The bulk viscosity of the step; its pressure is kept in the state, its work added to the sums.
template <class Keep>
GANNET_INLINE BulkViscosity add_bulk_viscosity(const SolidPass& pass, const SolidMotion& m,
                                               Keep keep, double* state, SolidLaneSums& sums) {
  const SolidConstants& c = *pass.constants;
  const Vec8 trace_e = m.e.xx + m.e.yy + m.e.zz;
  const Vec8 ratio = select(m.alive, m.now.volume * m.inverse_V0, Vec8(1.0));
  BulkViscosity bulk =
      bulk_viscosity(c, trace_e, pass.dt, m.length, Vec8(c.rho0) * reciprocal(ratio));
  bulk.q = keep(bulk.q);
  double* kept = state + 8 * pass.layout.viscous_pressure();
  sums.viscous += m.of_alive(Vec8(-0.5) * (Vec8::load(kept) + bulk.q) * trace_e * m.half.volume);
  bulk.q.store(kept);
  return bulk;
}

/// Hourglass forces of the step, their work added to the sums. k_h: stiffness [N/m].
template <class Keep>
GANNET_INLINE void add_hourglass(const SolidPass& pass, const SolidMotion& m, const Tensor& R,
                                 Vec8 k_h, Keep keep, double* state, SolidLaneSums& sums,
                                 Vec8x3 Q[4]) {
  Vec8x3 q[4];
  for (int k = 0; k < 4; ++k) {
    q[k] = scaled(m.v.g[k], Vec8(pass.dt)) - times(m.L, m.x_half.g[k]);
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
GANNET_INLINE Vec8 least_damage(const SolidPass& pass, const double* state) {
  const J2History& h = pass.constants->history;
  if (h.damage < 0) return Vec8(0.0);
  Vec8 least(1.0);
  for (int point = 0; point < pass.layout.n_points; ++point) {
    const int k = pass.layout.plastic_strain(point) + h.damage;
    least = min(least, Vec8::load(state + 8 * k));
  }
  return least;
}

/// Takes elements out whose last point has failed: they exert nothing from now on.
GANNET_INLINE void take_out_failed(const SolidPass& pass, const KeepCarrying& keep, double* state) {
  double* inverse_V0 = state + 8 * pass.layout.inverse_volume();
  keep(Vec8::load(inverse_V0)).store(inverse_V0);
}

/// Where the part asks for it: damping at a point, its work added to the sums. e, along: as of
/// damping_stress(); volume: that the point stands for [m^3]; keep: 0 for what carries nothing.
template <class Keep>
GANNET_INLINE void add_damping(const SolidPass& pass, const SolidMotion& m, std::int32_t block,
                               int point, Keep keep, const Symmetric<Vec8>& e,
                               const Symmetric<Vec8>& along, Vec8 volume, double* state,
                               SolidLaneSums& sums, Symmetric<Vec8>& sigma) {
  if (pass.votes.damping_time == nullptr) [[likely]]
    return;
  Vec8 work;
  damping_stress(*pass.constants, keep(damping_per_step(pass.votes, block, pass.dt)),
                 state + 8 * pass.layout.damping(point), e, along, sigma, work);
  sums.damping += m.of_alive(work * volume);
}

/// Adds the forces to the corners and notes the extremes. F: forces on the coefficients; omega2
/// [1/s^2], damped.
GANNET_INLINE void finish_block(const SolidPass& pass, const SolidMotion& m,
                                const std::int32_t* corners, std::int32_t block, SolidModes& F,
                                Vec8 omega2, double* state, SolidLaneSums& sums) {
  for (Vec8x3& a : F.a) a = m.of_alive(a);
  for (Vec8x3& g : F.g) g = m.of_alive(g);
  const auto there = less(Vec8(0.0), m.inverse_V0);
  if (any(less(m.shrunk_to, select(there, Vec8(pass.constants->smallest_ratio), Vec8(0.0))))) {
    forget_collapsed(pass.layout, m.alive, state);
  }
  Vec8x3 at_corner[8];
  if (pass.layout.tetrahedra()) {
    tetrahedron_corners_of(F, at_corner);
  } else {
    pass.layout.plane() ? plane_corners_of(F, at_corner) : corners_of(F, at_corner);
  }
  for (int a = 0; a < pass.layout.n_corners(); ++a) {
    scatter_corner(pass.f, corners, a, at_corner[a]);
  }
  note_extremes(with_added_mass(pass.votes, block, m.of_alive(omega2)), m.shrunk_to, block, sums);
}

/// omega2 [1/s^2] with what bulk viscosity, zeta, and damping in proportion to stiffness make of
/// the step.
GANNET_INLINE Vec8 damped(const SolidPass& pass, std::int32_t block, Vec8 omega2, Vec8 zeta) {
  return omega2 * damped_factor(zeta + stiffness_ratio(pass.votes, block, omega2));
}

/// Lame's constants that bound the frequency.
struct Lame {
  Vec8 lambda;
  Vec8 two_mu;
};

/// Adds the work of a point or an element to the sums. volume: of what it is per [m^3].
template <PointLaw law>
GANNET_INLINE void add_work(const SolidMotion& m, const J2Work<Vec8>& work, Vec8 volume,
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

/// The same of one of several points.
template <PointLaw law>
GANNET_INLINE auto keeper_of_point(const SolidPass& pass, int point, const double* state) {
  if constexpr (law == PointLaw::general) {
    const int damage = pass.constants->history.damage;
    const int k = pass.layout.plastic_strain(point) + damage;
    return KeepCarrying{damage < 0 ? Vec8(0.0) : Vec8::load(state + 8 * k)};
  } else {
    return KeepAll{};
  }
}

/// The mean of the logarithms of volume changes around the corners of tetrahedra; what it has
/// become since n-1 is the dilatation of the step. Kept in the state.
GANNET_INLINE Vec8 nodal_dilatation(const SolidPass& pass, const std::int32_t* corners,
                                    double* state) {
  Vec8 mean(0.0);
  for (int a = 0; a < 4; ++a) mean += gather_corner(pass.nodal, corners, a).z;
  mean = Vec8(0.25) * mean;
  double* kept = state + 8 * pass.layout.dilatation();
  const Vec8 change = mean - Vec8::load(kept);
  mean.store(kept);
  return change;
}

/// solid_stress() of tetrahedra: their dilatation is that of their nodes, and the work that of
/// their own motion. e: strain of their own motion, which gets that dilatation.
template <PointLaw law>
GANNET_INLINE Symmetric<Vec8> tetrahedron_stress(const SolidPass& pass, const SolidMotion& m,
                                                 const std::int32_t* corners, const Tensor& R,
                                                 double* state, Symmetric<Vec8>& e,
                                                 J2Work<Vec8>& work) {
  const Vec8 trace = m.e.xx + m.e.yy + m.e.zz;
  const Vec8 dilatation = m.of_alive(nodal_dilatation(pass, corners, state));
  const Vec8 change = Vec8(1.0 / 3.0) * (dilatation - trace);
  e.xx += change;
  e.yy += change;
  e.zz += change;
  const Symmetric<Vec8> old = load_stress(state);
  const Symmetric<Vec8> sigma = solid_stress<law>(*pass.constants, pass.dt, state, e, R, work);
  const Vec8 twice_traces = old.xx + old.yy + old.zz + sigma.xx + sigma.yy + sigma.zz;
  work.internal -= Vec8(0.5) * twice_traces * change;
  return sigma;
}

/// One block of eight elements with one point.
template <PointLaw law>
GANNET_INLINE void one_point_block(const SolidPass& pass, std::int32_t block, SolidLaneSums& sums) {
  const SolidConstants& c = *pass.constants;
  const std::int32_t* corners = corners_of_block(pass, block);
  double* state = pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
  const SolidMotion m = solid_motion(pass, corners, state);
  const Tensor R = rotation_of(m.L);
  Symmetric<Vec8> sigma{};
  Symmetric<Vec8> e = m.e;
  RubberPoint rubber;
  Lame now{Vec8(c.law.bulk - 2.0 / 3.0 * c.law.shear), Vec8(2.0 * c.law.shear)};
  if constexpr (law == PointLaw::hyperelastic) {
    rubber = rubber_point(c, pass.layout, pass.dt, m.x, m.v, state);
    sums.internal += m.of_alive(rubber.work);
    now = {rubber.now.bulk - Vec8(2.0 / 3.0) * rubber.now.shear, Vec8(2.0) * rubber.now.shear};
  } else {
    J2Work<Vec8> work;
    sigma = pass.layout.tetrahedra() ? tetrahedron_stress<law>(pass, m, corners, R, state, e, work)
                                     : solid_stress<law>(c, pass.dt, state, m.e, R, work);
    add_work<law>(m, work, m.half.volume, sums);
  }
  const auto keep = keeper<law>(pass, state);
  add_damping(pass, m, block, 0, keep, e, m.e, m.half.volume, state, sums, sigma);
  const BulkViscosity bulk = add_bulk_viscosity(pass, m, keep, state, sums);
  sigma.xx -= bulk.q;
  sigma.yy -= bulk.q;
  sigma.zz -= bulk.q;
  const Vec8 k_h = Vec8(8.0 * c.hourglass * c.hourglass_modulus) * m.gram.trace * m.inverse_volume;
  Vec8x3 Q[4];
  add_hourglass(pass, m, R, k_h, keep, state, sums, Q);
  SolidModes F = solid_forces(m.now, m.x, sigma, Q, m.inverse_volume);
  if constexpr (law == PointLaw::hyperelastic) add_forces(rubber, F);
  const Vec8 omega2 = solid_omega2(pass.layout.shape, now.lambda, now.two_mu, m.gram, m.x,
                                   m.inverse_volume, m.inverse_mass, k_h);
  if constexpr (law == PointLaw::general) take_out_failed(pass, keep, state);
  finish_block(pass, m, corners, block, F, keep(damped(pass, block, omega2, bulk.zeta)), state,
               sums);
}

/// One block of eight elements with eight points and a mean dilatation, see solid_element.hpp.
template <PointLaw law>
GANNET_INLINE void eight_point_block(const SolidPass& pass, std::int32_t block,
                                     SolidLaneSums& sums) {
  const SolidConstants& c = *pass.constants;
  const std::int32_t* corners = corners_of_block(pass, block);
  double* state = pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
  const SolidMotion m = solid_motion(pass, corners, state);
  const Vec8 mean_e = Vec8(1.0 / 3.0) * (m.e.xx + m.e.yy + m.e.zz);
  SolidModes F{};
  Vec8 mean_stress(0.0);  // times the volume
  Vec8 largest(0.0);      // of the Gram matrices, times the volume
  // Of rubber: its mean stress follows from the volume of the element.
  Vec8 pressure(0.0);
  Moduli moduli{Vec8(c.law.bulk), Vec8(c.law.shear)};
  SolidModes X{};
  if constexpr (law == PointLaw::hyperelastic) {
    X = load_start(pass.layout, state);
    const Vec8 ratio = max(m.now.volume * m.inverse_V0, Vec8(1e-3));
    pressure = volume_stress(c.rubber, ratio);
    moduli.bulk = volume_modulus(c.rubber, ratio);
  }
  for (int point = 0; point < 8; ++point) {
    const SolidPlace at = gauss_place(point);
    const PointGradient half = point_gradient(m.x_half, at);
    const Tensor L = gradient_at(half, m.v, at, Vec8(pass.dt));
    Symmetric<Vec8> e = symmetric_part(L);
    const Vec8 change = mean_e - Vec8(1.0 / 3.0) * (e.xx + e.yy + e.zz);
    e.xx += change;
    e.yy += change;
    e.zz += change;
    J2Work<Vec8> work;
    double* kept = state + 8 * pass.layout.stress(point);
    Symmetric<Vec8> sigma;
    if constexpr (law == PointLaw::hyperelastic) {
      HyperelasticStress<Vec8> stress;
      Vec8 J;
      rubber_stress(c, gradient_at(point_gradient(X, at), m.x, at, Vec8(1.0)), stress, J);
      sigma = stress.deviator;
      sigma.xx += pressure;
      sigma.yy += pressure;
      sigma.zz += pressure;
      work.internal = Vec8(0.5) * (contraction(load_stress(kept), e) + contraction(sigma, e));
      store_stress(sigma, kept);
      moduli.shear = max(moduli.shear, taut_shear(stress, pressure));
    } else {
      sigma = solid_stress<law>(c, pass.dt, kept, e, rotation_of(L), work);
    }
    add_work<law>(m, work, half.det, sums);
    add_damping(pass, m, block, point, keeper_of_point<law>(pass, point, state), e, e, half.det,
                state, sums, sigma);
    const PointGradient now = point_gradient(m.x, at);
    const Vec8 p = Vec8(1.0 / 3.0) * (sigma.xx + sigma.yy + sigma.zz);
    mean_stress += p * now.det;
    largest += largest_gram(now, at, pass.layout.plane()) * now.det;
    add_point_forces(now, at, sigma, p, F);
  }
  const auto keep = keeper<law>(pass, state);
  const BulkViscosity bulk = add_bulk_viscosity(pass, m, keep, state, sums);
  add_mean_stress(m.now, mean_stress * m.inverse_volume - bulk.q, F);
  // tr of the mean gradient and the deviator at each point are bounded apart.
  const Vec8 omega2 =
      Vec8(8.0) * m.inverse_mass *
      (moduli.bulk * m.gram.trace * m.inverse_volume + Vec8(2.0) * moduli.shear * largest);
  if constexpr (law == PointLaw::general) take_out_failed(pass, keep, state);
  finish_block(pass, m, corners, block, F, keep(damped(pass, block, omega2, bulk.zeta)), state,
               sums);
}

template <PointLaw law, int points>
GANNET_INLINE void solid_blocks(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                                SolidLaneSums& sums) {
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + blocks_ahead < end) call_for(pass, block + blocks_ahead);
    if constexpr (points == 1) {
      one_point_block<law>(pass, block, sums);
    } else {
      eight_point_block<law>(pass, block, sums);
    }
  }
}

}  // namespace

__attribute__((flatten)) void solid_volumes(const SolidPass& pass, std::int32_t begin,
                                            std::int32_t end) {
  const Vec8 quarter(0.25);
  for (std::int32_t block = begin; block < end; ++block) {
    const std::int32_t* corners = corners_of_block(pass, block);
    const double* state =
        pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
    const SolidModes x = gather_modes(pass.x, corners, pass.layout, 0);
    const Vec8 volume = Vec8(8.0) * dot(x.a[0], cross(x.a[1], x.a[2]));
    const Vec8 inverse_V0 = Vec8::load(state + 8 * pass.layout.inverse_volume());
    const auto there = less(Vec8(0.0), inverse_V0);
    const Vec8 V0 = select(there, reciprocal(select(there, inverse_V0, Vec8(1.0))), Vec8(0.0));
    // An element that has collapsed is seen later; until then its nodes have a volume.
    const Vec8 least = Vec8(pass.constants->smallest_ratio) * V0;
    const Vec8x3 share{quarter * select(there, max(volume, least), Vec8(0.0)), quarter * V0,
                       Vec8(0.0)};
    for (int a = 0; a < 4; ++a) scatter_corner(pass.nodal, corners, a, share);
  }
}

__attribute__((flatten)) void solid_force(const SolidPass& pass, std::int32_t begin,
                                          std::int32_t end, SolidSums& out) {
  SolidLaneSums sums;
  const PointLaw law = pass.constants->point_law;
  const bool one = pass.layout.n_points == 1;
  if (law == PointLaw::linear_hardening) {
    if (one) solid_blocks<PointLaw::linear_hardening, 1>(pass, begin, end, sums);
    if (!one) solid_blocks<PointLaw::linear_hardening, 8>(pass, begin, end, sums);
  } else if (law == PointLaw::general) {
    if (one) solid_blocks<PointLaw::general, 1>(pass, begin, end, sums);
    if (!one) solid_blocks<PointLaw::general, 8>(pass, begin, end, sums);
  } else if (law == PointLaw::hyperelastic) {
    if (one) solid_blocks<PointLaw::hyperelastic, 1>(pass, begin, end, sums);
    if (!one) solid_blocks<PointLaw::hyperelastic, 8>(pass, begin, end, sums);
  } else {
    if (one) solid_blocks<PointLaw::elastic, 1>(pass, begin, end, sums);
    if (!one) solid_blocks<PointLaw::elastic, 8>(pass, begin, end, sums);
  }
  out = {};
  out.internal = sum(sums.internal);
  out.plastic = sum(sums.plastic);
  out.hourglass = sum(sums.hourglass);
  out.viscous = sum(sums.viscous);
  out.damping = sum(sums.damping);
  out.eroded = sum(sums.eroded);
  take_largest(sums.omega2, sums.block, out.omega2, out.element);
  take_smallest(sums.volume_ratio, sums.smallest, out.volume_ratio, out.smallest);
}

}  // namespace gannet::GANNET_ISA_NS
