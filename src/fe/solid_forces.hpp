// What solids answer to the motion of a step: stress, bulk viscosity, hourglass forces, and the
// bound of their frequency. The equations stand in solid_element.hpp. For *.isa.cpp files only.
#pragma once

#include "base/simd_math.hpp"
#include "fe/solid_element.hpp"

namespace gannet::GANNET_ISA_NS {

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

GANNET_INLINE Symmetric<Vec8> scaled(const Symmetric<Vec8>& s, Vec8 a) {
  return {s.xx * a, s.yy * a, s.zz * a, s.xy * a, s.yz * a, s.zx * a};
}

/// Stress of a point from n-1 to n by the law of j2.hpp, as solid_stress(). dt: of the step [s].
/// One function for all formulations: it is long, and called where a step costs more anyway.
__attribute__((noinline)) inline void general_stress(const SolidConstants& c, double dt,
                                                     double* state, const Symmetric<Vec8>& e,
                                                     const Tensor& R, Symmetric<Vec8>& sigma,
                                                     J2Work<Vec8>& work) {
  const J2History& h = c.history;
  double* history = state + 48;
  const auto optional = [&](int k) { return k < 0 ? Vec8(0.0) : Vec8::load(history + 8 * k); };
  J2State<Vec8> point{Vec8::load(history), optional(h.temperature), optional(h.damage)};
  Symmetric<Vec8> alpha{};
  if (h.back_stress >= 0) alpha = rotated(R, load_stress(history + 8 * h.back_stress));
  const Symmetric<Vec8> old = load_stress(state);
  const Symmetric<Vec8> half = scaled(e, Vec8(0.5));
  Symmetric<Vec8> turned = old;
  add_elastic(c.law, half, turned);
  turned = rotated(R, turned);
  add_elastic(c.law, scaled(half, Vec8(-1.0)), turned);
  work = j2_step(c.j2, old, turned, e, Vec8(dt > 0 ? 1 / dt : 0.0), alpha, point, sigma);
  store_stress(sigma, state);
  point.eps_p.store(history);
  if (h.back_stress >= 0) store_stress(alpha, history + 8 * h.back_stress);
  if (h.temperature >= 0) point.rise.store(history + 8 * h.temperature);
  if (h.damage >= 0) point.damage.store(history + 8 * h.damage);
}

/// Stress of a point from n-1 to n: half of the elastic answer to e, turned by R, the other half
/// (order 2, and in elasticity the work below is the change of the elastic energy exactly),
/// returned to the yield surface. state: its six stresses, and its history behind them. Gives the
/// work per volume, (sigma(n-1) + sigma(n))/2 : e [J/m^3].
template <PointLaw law>
GANNET_INLINE Symmetric<Vec8> solid_stress(const SolidConstants& c, double dt, double* state,
                                           const Symmetric<Vec8>& e, const Tensor& R,
                                           J2Work<Vec8>& work) {
  if constexpr (law == PointLaw::general) {
    Symmetric<Vec8> sigma;
    general_stress(c, dt, state, e, R, sigma, work);
    return sigma;
  }
  const Symmetric<Vec8> old = load_stress(state);
  const Symmetric<Vec8> half = scaled(e, Vec8(0.5));
  Symmetric<Vec8> sigma = old;
  add_elastic(c.law, half, sigma);
  sigma = rotated(R, sigma);
  add_elastic(c.law, half, sigma);
  if constexpr (law == PointLaw::linear_hardening) {
    double* strain = state + 48;
    const Vec8 eps_p = Vec8::load(strain);
    const Vec8 Y = Vec8(c.law.yield) + Vec8(c.law.hardening) * eps_p;
    const Vec8 flow = return_to_yield(c.law, Y, sigma);
    work.plastic = flow * (Y + Vec8(0.5 * c.law.hardening) * flow);
    (eps_p + flow).store(strain);
  }
  store_stress(sigma, state);
  work.internal = Vec8(0.5) * (contraction(old, e) + contraction(sigma, e));
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

/// Resists the hourglass patterns by stiffness: Q to n in `state`, returned in Q, through keep(),
/// which is 0 for elements that leave. Returns the work [J].
template <class Keep>
GANNET_INLINE Vec8 hourglass_stiffness(double* state, const Vec8x3 q[4], const Tensor& R, Vec8 k_h,
                                       Keep keep, Vec8x3 Q[4]) {
  Vec8 twice_work(0.0);
  for (int k = 0; k < 4; ++k) {
    double* p = state + 24 * k;
    const Vec8x3 old{Vec8::load(p), Vec8::load(p + 8), Vec8::load(p + 16)};
    Q[k] = times(R, old) + scaled(q[k], k_h);
    Q[k] = {keep(Q[k].x), keep(Q[k].y), keep(Q[k].z)};
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

}  // namespace gannet::GANNET_ISA_NS
