#include "fe/solid_kernel.hpp"

#include "fe/solid_element.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Blocks between the one at work and the one whose data is called for.
constexpr std::int32_t blocks_ahead = 2;

/// Calls for the state and the nodes of a later block: four of the eight corners, which with those
/// of its neighbours are nearly every node.
GANNET_INLINE void call_for(const SolidPass& pass, std::int32_t block) {
  const int n_values = pass.layout.n_values();
  const double* state = pass.state + static_cast<std::int64_t>(block) * n_values * 8;
  for (int k = 0; k < n_values; ++k) __builtin_prefetch(state + 8 * k, 1);
  const std::int32_t* corners = pass.corners + 64 * static_cast<std::int64_t>(block);
  constexpr int some[4] = {0, 2, 5, 7};
  for (const int a : some) {
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
  Vec8 omega2 = Vec8(0.0);
  Vec8 block = Vec8(-1.0);
  Vec8 volume_ratio = Vec8(1.0);
  Vec8 smallest = Vec8(-1.0);
};

GANNET_INLINE Symmetric<Vec8> load_stress(const double* p) {
  return {Vec8::load(p),      Vec8::load(p + 8),  Vec8::load(p + 16),
          Vec8::load(p + 24), Vec8::load(p + 32), Vec8::load(p + 40)};
}

GANNET_INLINE void store_stress(const Symmetric<Vec8>& s, double* p) {
  s.xx.store(p);
  s.yy.store(p + 8);
  s.zz.store(p + 16);
  s.xy.store(p + 24);
  s.yz.store(p + 32);
  s.zx.store(p + 40);
}

/// Stress from n-1 to n: turned by R, elastic answer to e, returned to the yield surface. Adds the
/// work per volume: (sigma(n-1) + sigma(n))/2 : e [J/m^3].
template <bool plastic>
GANNET_INLINE Symmetric<Vec8> solid_stress(const SolidConstants& c, double* state,
                                           const Symmetric<Vec8>& e, const Tensor& R, Vec8& work,
                                           Vec8& plastic_work) {
  const Symmetric<Vec8> old = load_stress(state);
  Symmetric<Vec8> sigma = rotated(R, old);
  add_elastic(c.law, e, sigma);
  plastic_work = Vec8(0.0);
  if constexpr (plastic) {
    double* strain = state + 8 * SolidLayout::plastic_strain();
    const Vec8 eps_p = Vec8::load(strain);
    const Vec8 Y = Vec8(c.law.yield) + Vec8(c.law.hardening) * eps_p;
    const Vec8 flow = return_to_yield(c.law, Y, sigma);
    plastic_work = flow * (Y + Vec8(0.5 * c.law.hardening) * flow);
    (eps_p + flow).store(strain);
  }
  store_stress(sigma, state);
  work = Vec8(0.5) * (contraction(old, e) + contraction(sigma, e));
  return sigma;
}

/// What the bulk viscosity adds [Pa], and to the damping of the highest mode.
struct BulkViscosity {
  Vec8 q;
  Vec8 zeta;
};

/// Bulk viscosity of elements that shrink at the rate d = tr D < 0 (von Neumann & Richtmyer 1950;
/// Landshoff 1955), l the shortest distance across the element:
///   q = rho l |d| (C1 l |d| + C2 c),   zeta = C2 + C1 l |d|/c
GANNET_INLINE BulkViscosity bulk_viscosity(const SolidConstants& c, Vec8 trace_e, double dt,
                                           Vec8 length, Vec8 rho) {
  const Vec8 rate = max(-trace_e, Vec8(0.0)) * Vec8(dt > 0 ? 1 / dt : 0.0);
  const Vec8 speed = Vec8(c.quadratic_viscosity) * length * rate;
  const Vec8 linear(c.linear_viscosity / c.inverse_wave_speed);
  const Vec8 zeta = Vec8(c.linear_viscosity) + speed * Vec8(c.inverse_wave_speed);
  return {rho * length * rate * (speed + linear), zeta};
}

/// Resists the hourglass patterns by stiffness: Q to n in `state`, returned in Q. Returns the work
/// [J].
GANNET_INLINE Vec8 hourglass_stiffness(double* state, const Vec8x3 q[4], const Tensor& R, Vec8 k_h,
                                       Vec8x3 Q[4]) {
  Vec8 twice_work(0.0);
  for (int k = 0; k < 4; ++k) {
    double* p = state + 24 * k;
    const Vec8x3 old{Vec8::load(p), Vec8::load(p + 8), Vec8::load(p + 16)};
    Q[k] = times(R, old) + scaled(q[k], k_h);
    Q[k].x.store(p);
    Q[k].y.store(p + 8);
    Q[k].z.store(p + 16);
    twice_work += dot(old, q[k]) + dot(Q[k], q[k]);
  }
  return Vec8(0.5) * twice_work;
}

/// Resists them by viscosity: the force that the stiffness k_h would build up while a wave crosses
/// `length`, Q = k_h (l/c) q/dt. Nothing is remembered, so the work is Q . q of the step that led
/// here: more than the trapezoid by a term of second order in the change of q. Returns it [J].
GANNET_INLINE Vec8 hourglass_viscosity(const SolidConstants& c, const Vec8x3 q[4], Vec8 k_h,
                                       double dt, Vec8 length, Vec8x3 Q[4]) {
  const Vec8 viscous = k_h * length * Vec8(dt > 0 ? c.inverse_wave_speed / dt : 0.0);
  Vec8 work(0.0);
  for (int k = 0; k < 4; ++k) {
    Q[k] = scaled(q[k], viscous);
    work += dot(Q[k], q[k]);
  }
  return work;
}

/// Forces on the coefficients: -(sigma - sum Q_k g_k^T / V) D_mode, and -Q_k on each hourglass one.
GANNET_INLINE SolidModes solid_forces(const SolidGeometry& G, const SolidModes& x,
                                      const Symmetric<Vec8>& s, const Vec8x3 Q[4],
                                      Vec8 inverse_volume) {
  Tensor T{{{-s.xx, -s.xy, -s.zx}, {-s.xy, -s.yy, -s.yz}, {-s.zx, -s.yz, -s.zz}}};
  for (int k = 0; k < 4; ++k) {
    const Vec8x3 g = scaled(x.g[k], inverse_volume);
    T.row[0] = T.row[0] + scaled(g, Q[k].x);
    T.row[1] = T.row[1] + scaled(g, Q[k].y);
    T.row[2] = T.row[2] + scaled(g, Q[k].z);
  }
  SolidModes F;
  for (int k = 0; k < 3; ++k) F.a[k] = times(T, G.a[k]);
  for (int k = 0; k < 3; ++k) F.g[k] = times(T, G.g[k]) - Q[k];
  F.g[3] = -Q[3];
  return F;
}

/// Bound of the largest squared frequency of each element [1/s^2], from its own lumped mass M/8 a
/// corner. With G the Gram matrix, (tr d)^2 <= tr G |v|^2 and d : d <= largest(G) |v|^2, so
///   omega^2 <= 8/(M V) (lambda tr G + 2 mu largest(G)) + k_h/M (1 + 8 largest(G) sum |g|^2/V^2),
/// exact for a cube (3 K) and for a flat element (lambda + 2 mu).
GANNET_INLINE Vec8 solid_omega2(const SolidConstants& c, const GramBound& gram, const SolidModes& x,
                                Vec8 inverse_volume, Vec8 inverse_mass, Vec8 k_h) {
  const Vec8 lambda(c.law.bulk - 2.0 / 3.0 * c.law.shear);
  const Vec8 two_mu(2.0 * c.law.shear);
  Vec8 g2(0.0);
  for (const Vec8x3& g : x.g) g2 += dot(g, g);
  const Vec8 eight(8.0);
  const Vec8 hourglass =
      k_h * (Vec8(1.0) + eight * gram.largest * g2 * inverse_volume * inverse_volume);
  return inverse_mass *
         (eight * inverse_volume * (lambda * gram.trace + two_mu * gram.largest) + hourglass);
}

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

/// What an element that has collapsed held may not be finite: it is cleared.
template <class Mask>
GANNET_INLINE void forget_collapsed(const SolidLayout& layout, Mask alive, double* state) {
  for (int k = 0; k < layout.n_values(); ++k) {
    if (k == SolidLayout::inverse_volume()) continue;
    double* p = state + 8 * k;
    select(alive, Vec8::load(p), Vec8(0.0)).store(p);
  }
}

/// One block of eight elements.
template <bool plastic>
GANNET_INLINE void solid_block(const SolidPass& pass, std::int32_t block, SolidLaneSums& sums) {
  const SolidConstants& c = *pass.constants;
  const std::int32_t* corners = pass.corners + 64 * static_cast<std::int64_t>(block);
  double* state = pass.state + static_cast<std::int64_t>(block) * pass.layout.n_values() * 8;
  Vec8x3 at_corner[8];
  for (int a = 0; a < 8; ++a) at_corner[a] = gather_corner(pass.x, corners, a);
  const SolidModes x = modes_of(at_corner);
  for (int a = 0; a < 8; ++a) at_corner[a] = gather_corner(pass.v, corners, a);
  const SolidModes v = modes_of(at_corner);
  SolidModes x_half;
  const Vec8 half_dt(0.5 * pass.dt);
  for (int k = 0; k < 3; ++k) x_half.a[k] = x.a[k] - scaled(v.a[k], half_dt);
  for (int k = 0; k < 4; ++k) x_half.g[k] = x.g[k] - scaled(v.g[k], half_dt);

  const SolidGeometry half = solid_geometry(x_half);
  const Tensor L = mean_gradient(half, v, Vec8(pass.dt) * reciprocal(half.volume));
  const Symmetric<Vec8> e = symmetric_part(L);
  const Tensor R = rotation_of(L);

  const SolidGeometry now = solid_geometry(x);
  const GramBound gram = gram_bound(now);
  const Vec8 inverse_V0 = Vec8::load(state + 8 * SolidLayout::inverse_volume());
  const auto there = less(Vec8(0.0), inverse_V0);
  const Vec8 shrunk_to = select(there, min(now.volume, half.volume) * inverse_V0, Vec8(1.0));
  const auto alive = less(select(there, Vec8(c.smallest_ratio), Vec8(1.0)), shrunk_to);
  const auto of_alive = [&](Vec8 a) { return select(alive, a, Vec8(0.0)); };
  const Vec8 inverse_volume = reciprocal(now.volume);
  const Vec8 inverse_mass = inverse_V0 * Vec8(1.0 / c.rho0);
  const Vec8 length = now.volume * rsqrt(Vec8(2.0) * gram.largest);

  Vec8 work;
  Vec8 plastic_work;
  Symmetric<Vec8> sigma = solid_stress<plastic>(c, state, e, R, work, plastic_work);
  sums.internal += of_alive(work * half.volume);
  if constexpr (plastic) sums.plastic += of_alive(plastic_work * half.volume);

  const Vec8 trace_e = e.xx + e.yy + e.zz;
  const Vec8 rho = Vec8(c.rho0) * reciprocal(select(alive, now.volume * inverse_V0, Vec8(1.0)));
  const BulkViscosity bulk = bulk_viscosity(c, trace_e, pass.dt, length, rho);
  double* q_state = state + 8 * SolidLayout::viscous_pressure();
  sums.viscous += of_alive(Vec8(-0.5) * (Vec8::load(q_state) + bulk.q) * trace_e * half.volume);
  bulk.q.store(q_state);
  sigma.xx -= bulk.q;
  sigma.yy -= bulk.q;
  sigma.zz -= bulk.q;

  const Vec8 k_h = Vec8(8.0 * c.hourglass * (c.law.bulk + 4.0 / 3.0 * c.law.shear)) * gram.trace *
                   inverse_volume;
  Vec8x3 q[4];
  Vec8x3 Q[4];
  for (int k = 0; k < 4; ++k) q[k] = scaled(v.g[k], Vec8(pass.dt)) - times(L, x_half.g[k]);
  if (pass.layout.remembers) {
    double* kept = state + 8 * pass.layout.hourglass();
    sums.hourglass += of_alive(hourglass_stiffness(kept, q, R, k_h, Q));
  } else {
    sums.hourglass += of_alive(hourglass_viscosity(c, q, k_h, pass.dt, length, Q));
  }
  SolidModes F = solid_forces(now, x, sigma, Q, inverse_volume);
  const auto of_alive3 = [&](const Vec8x3& a) {
    return Vec8x3{of_alive(a.x), of_alive(a.y), of_alive(a.z)};
  };
  for (Vec8x3& a : F.a) a = of_alive3(a);
  for (Vec8x3& g : F.g) g = of_alive3(g);
  if (any(less(shrunk_to, select(there, Vec8(c.smallest_ratio), Vec8(0.0))))) {
    forget_collapsed(pass.layout, alive, state);
  }
  corners_of(F, at_corner);
  for (int a = 0; a < 8; ++a) scatter_corner(pass.f, corners, a, at_corner[a]);

  const Vec8 omega2 = solid_omega2(c, gram, x, inverse_volume, inverse_mass, k_h);
  const Vec8 damped = sqrt(Vec8(1.0) + bulk.zeta * bulk.zeta) + bulk.zeta;
  note_extremes(of_alive(omega2 * damped * damped), shrunk_to, block, sums);
}

template <bool plastic>
GANNET_INLINE void solid_blocks(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                                SolidLaneSums& sums) {
  for (std::int32_t block = begin; block < end; ++block) {
    if (block + blocks_ahead < end) call_for(pass, block + blocks_ahead);
    solid_block<plastic>(pass, block, sums);
  }
}

}  // namespace

__attribute__((flatten)) void solid_force(const SolidPass& pass, std::int32_t begin,
                                          std::int32_t end, SolidSums& out) {
  SolidLaneSums sums;
  if (pass.constants->plastic) {
    solid_blocks<true>(pass, begin, end, sums);
  } else {
    solid_blocks<false>(pass, begin, end, sums);
  }
  out = {};
  out.internal = sum(sums.internal);
  out.plastic = sum(sums.plastic);
  out.hourglass = sum(sums.hourglass);
  out.viscous = sum(sums.viscous);
  alignas(64) double omega2[8];
  alignas(64) double index[8];
  alignas(64) double ratio[8];
  alignas(64) double smallest[8];
  sums.omega2.store(omega2);
  sums.block.store(index);
  sums.volume_ratio.store(ratio);
  sums.smallest.store(smallest);
  for (int lane = 0; lane < 8; ++lane) {
    if (omega2[lane] > out.omega2) {
      out.omega2 = omega2[lane];
      out.element = 8 * static_cast<std::int32_t>(index[lane]) + lane;
    }
    if (ratio[lane] < out.volume_ratio) {
      out.volume_ratio = ratio[lane];
      out.smallest = 8 * static_cast<std::int32_t>(smallest[lane]) + lane;
    }
  }
}

}  // namespace gannet::GANNET_ISA_NS
