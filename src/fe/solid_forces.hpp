// What solids answer to the motion of a step: stress, bulk viscosity, hourglass forces, and the
// bound of their frequency. The equations stand in solid_element.hpp. For *.isa.cpp files only.
#pragma once

#include "base/simd_vec.hpp"
#include "fe/solid_element.hpp"

namespace gannet::GANNET_ISA_NS {

GANNET_INLINE Symmetric<Vec> load_stress(const double* p) {
  return {Vec::load(p),      Vec::load(p + 8),  Vec::load(p + 16),
          Vec::load(p + 24), Vec::load(p + 32), Vec::load(p + 40)};
}

GANNET_INLINE void store_stress(const Symmetric<Vec>& s, double* p) {
  s.xx.store(p);
  s.yy.store(p + 8);
  s.zz.store(p + 16);
  s.xy.store(p + 24);
  s.yz.store(p + 32);
  s.zx.store(p + 40);
}

GANNET_INLINE Symmetric<Vec> scaled(const Symmetric<Vec>& s, Vec a) {
  return {s.xx * a, s.yy * a, s.zz * a, s.xy * a, s.yz * a, s.zx * a};
}

/// Stress of a point from n-1 to n by the law of j2.hpp, as solid_stress(). dt: of the step [s].
/// One function for all formulations: it is long, and called where a step costs more anyway.
__attribute__((noinline)) inline void general_stress(const SolidConstants& c, double dt,
                                                     double* state, const Symmetric<Vec>& e,
                                                     const Tensor& R, Symmetric<Vec>& sigma,
                                                     J2Work<Vec>& work) {
  const J2History& h = c.history;
  double* history = state + 48;
  const auto optional = [&](int k) { return k < 0 ? Vec(0.0) : Vec::load(history + 8 * k); };
  J2State<Vec> point{Vec::load(history), optional(h.temperature), optional(h.damage)};
  Symmetric<Vec> alpha{};
  if (h.back_stress >= 0) alpha = rotated(R, load_stress(history + 8 * h.back_stress));
  const Symmetric<Vec> old = load_stress(state);
  const Symmetric<Vec> half = scaled(e, Vec(0.5));
  Symmetric<Vec> turned = old;
  add_elastic(c.law, half, turned);
  turned = rotated(R, turned);
  add_elastic(c.law, scaled(half, Vec(-1.0)), turned);
  work = j2_step(c.j2, old, turned, e, Vec(dt > 0 ? 1 / dt : 0.0), alpha, point, sigma);
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
GANNET_INLINE Symmetric<Vec> solid_stress(const SolidConstants& c, double dt, double* state,
                                          const Symmetric<Vec>& e, const Tensor& R,
                                          J2Work<Vec>& work) {
  if constexpr (law == PointLaw::general) {
    Symmetric<Vec> sigma;
    general_stress(c, dt, state, e, R, sigma, work);
    return sigma;
  }
  const Symmetric<Vec> old = load_stress(state);
  const Symmetric<Vec> half = scaled(e, Vec(0.5));
  Symmetric<Vec> sigma = old;
  add_elastic(c.law, half, sigma);
  sigma = rotated(R, sigma);
  add_elastic(c.law, half, sigma);
  if constexpr (law == PointLaw::linear_hardening) {
    double* strain = state + 48;
    const Vec eps_p = Vec::load(strain);
    const Vec Y = Vec(c.law.yield) + Vec(c.law.hardening) * eps_p;
    const Vec flow = return_to_yield(c.law, Y, sigma);
    work.plastic = flow * (Y + Vec(0.5 * c.law.hardening) * flow);
    (eps_p + flow).store(strain);
  }
  store_stress(sigma, state);
  work.internal = Vec(0.5) * (contraction(old, e) + contraction(sigma, e));
  return sigma;
}

/// Damping stress of a point, (beta/dt) C : e of the elastic moduli at the start, added to sigma.
/// factor: beta/dt [-]; kept: that of the step before, which this replaces; e: strain that the
/// stress follows from; along: strain that it does work on. work: by trapezoids [J/m^3]. Not
/// inlined: parts without damping do not carry it along.
__attribute__((noinline)) inline void damping_stress(const SolidConstants& c, const Vec& factor,
                                                     double* kept, const Symmetric<Vec>& e,
                                                     const Symmetric<Vec>& along,
                                                     Symmetric<Vec>& sigma, Vec& work) {
  Symmetric<Vec> d{};
  add_elastic(c.law, e, d);
  d = scaled(d, factor);
  work = Vec(0.5) * (contraction(load_stress(kept), along) + contraction(d, along));
  store_stress(d, kept);
  sigma = {sigma.xx + d.xx, sigma.yy + d.yy, sigma.zz + d.zz,
           sigma.xy + d.xy, sigma.yz + d.yz, sigma.zx + d.zx};
}

/// Isochoric stress of rubber from F = dx/dX. An element may be inside out for a step before it
/// leaves or stops the run, so J, its determinant, is kept above 0. Not inlined, as
/// general_stress().
__attribute__((noinline)) inline void rubber_stress(const SolidConstants& c, const Tensor& F,
                                                    HyperelasticStress<Vec>& out, Vec& J) {
  J = max(dot(F.row[0], cross(F.row[1], F.row[2])), Vec(1e-3));
  const Symmetric<Vec> b{dot(F.row[0], F.row[0]), dot(F.row[1], F.row[1]), dot(F.row[2], F.row[2]),
                         dot(F.row[0], F.row[1]), dot(F.row[1], F.row[2]), dot(F.row[2], F.row[0])};
  out = isochoric(c.rubber, b, J);
}

/// First Piola-Kirchhoff stress, sigma cof(F): forces per area at the start.
GANNET_INLINE Tensor piola(const Symmetric<Vec>& s, const Tensor& F) {
  const VecX3 c0 = cross(F.row[1], F.row[2]);
  const VecX3 c1 = cross(F.row[2], F.row[0]);
  const VecX3 c2 = cross(F.row[0], F.row[1]);
  const auto row = [&](Vec a, Vec b, Vec d) {
    return scaled(c0, a) + scaled(c1, b) + scaled(c2, d);
  };
  return {{row(s.xx, s.xy, s.zx), row(s.xy, s.yy, s.yz), row(s.zx, s.yz, s.zz)}};
}

/// The shape at the start. Kept are the coefficients themselves.
GANNET_INLINE SolidModes load_start(const SolidLayout& layout, const double* state) {
  SolidModes X;
  const double* p = state + 8 * layout.start();
  const auto next = [&p] {
    const VecX3 a{Vec::load(p), Vec::load(p + 8), Vec::load(p + 16)};
    p += 24;
    return scaled(a, Vec(8.0));
  };
  for (VecX3& a : X.a) a = next();
  for (VecX3& g : X.g) g = next();
  return X;
}

/// Moduli that bound the frequencies of an element now [Pa].
struct Moduli {
  Vec bulk;
  Vec shear;
};

/// Shear modulus of a point of rubber with what its tension adds, as that of a string does.
GANNET_INLINE Vec taut_shear(const HyperelasticStress<Vec>& stress, Vec mean) {
  return stress.shear + Vec(0.5) * max(largest_principal_bound(stress.deviator) + mean, Vec(0.0));
}

/// One point of rubber over the whole element: its forces are the gradient of its energy by the
/// corners, F_mode = -P D_mode of the start, so that they do P : dF V0 along a step exactly.
struct RubberPoint {
  SolidGeometry start;
  Tensor P;  ///< of n [Pa]
  Moduli now;
  Vec work;  ///< (P(n-1) + P(n))/2 : dF V0 [J]
};

GANNET_INLINE RubberPoint rubber_point(const SolidConstants& c, const SolidLayout& layout,
                                       double dt, const SolidModes& x, const SolidModes& v,
                                       double* state) {
  RubberPoint r;
  r.start = solid_geometry(load_start(layout, state));
  const Vec inverse_V0 = reciprocal(r.start.volume_192);
  const Tensor F = mean_gradient(r.start, x, inverse_V0);
  const Tensor dF = mean_gradient(r.start, v, inverse_V0 * Vec(dt));
  Tensor before;
  for (int i = 0; i < 3; ++i) before.row[i] = F.row[i] - dF.row[i];
  const Tensor P_old = piola(load_stress(state), before);
  HyperelasticStress<Vec> stress;
  Vec J;
  rubber_stress(c, F, stress, J);
  const Vec p = volume_stress(c.rubber, J);
  Symmetric<Vec> sigma = stress.deviator;
  sigma.xx += p;
  sigma.yy += p;
  sigma.zz += p;
  store_stress(sigma, state);
  r.P = piola(sigma, F);
  r.work = Vec(0.0);
  for (int i = 0; i < 3; ++i) r.work += dot(P_old.row[i] + r.P.row[i], dF.row[i]);
  r.work = Vec(0.5) * r.work * r.start.volume();
  r.now = {volume_modulus(c.rubber, J), taut_shear(stress, p)};
  return r;
}

/// Adds -P D_mode of the start.
GANNET_INLINE void add_forces(const RubberPoint& r, SolidModes& F) {
  Tensor P = r.P;
  for (VecX3& row : P.row) row = scaled(row, Vec(1.0 / 192.0));
  for (int k = 0; k < 3; ++k) F.a[k] = F.a[k] - times(P, r.start.a[k]);
  for (int k = 0; k < 3; ++k) F.g[k] = F.g[k] - times(P, r.start.g[k]);
}

/// What the bulk viscosity adds [Pa], and to the damping of the highest mode.
struct BulkViscosity {
  Vec q;
  Vec zeta;
};

/// Bulk viscosity of elements that shrink at the rate d = tr D < 0 (von Neumann & Richtmyer 1950;
/// Landshoff 1955), l the shortest distance across the element:
///   q = rho l |d| (C1 l |d| + C2 c),   zeta = C2 + C1 l |d|/c
GANNET_INLINE BulkViscosity bulk_viscosity(const SolidConstants& c, Vec trace_e, double dt,
                                           Vec length, Vec rho) {
  const Vec rate = max(-trace_e, Vec(0.0)) * Vec(dt > 0 ? 1 / dt : 0.0);
  const Vec speed = Vec(c.quadratic_viscosity) * length * rate;
  const Vec linear(c.linear_viscosity / c.inverse_wave_speed);
  const Vec zeta = Vec(c.linear_viscosity) + speed * Vec(c.inverse_wave_speed);
  return {rho * length * rate * (speed + linear), zeta};
}

/// Resists the hourglass patterns by stiffness: Q to n in `state`, an eighth of it returned in F,
/// through keep(), which is 0 for elements that leave. q: eight times the change of the patterns.
/// Returns the work [J].
template <class Keep>
GANNET_INLINE Vec hourglass_stiffness(double* state, const VecX3 q[4], const Tensor& R, Vec k_h,
                                      Keep keep, VecX3 F[4]) {
  const Vec eighth(0.125);
  const Vec k = eighth * k_h;
  Vec sum(0.0);
  for (int i = 0; i < 4; ++i) {
    double* p = state + 24 * i;
    const VecX3 old{Vec::load(p), Vec::load(p + 8), Vec::load(p + 16)};
    VecX3 Q = times(R, old) + scaled(q[i], k);
    Q = {keep(Q.x), keep(Q.y), keep(Q.z)};
    Q.x.store(p);
    Q.y.store(p + 8);
    Q.z.store(p + 16);
    sum += dot(old + Q, q[i]);
    F[i] = scaled(Q, eighth);
  }
  return Vec(0.0625) * sum;
}

/// Resists them by viscosity: the force that the stiffness k_h would build up while a wave crosses
/// `length`, Q = k_h (l/c) q/dt. Nothing is remembered, so the work is Q . q of the step that led
/// here: more than the trapezoid by a term of second order in the change of q. q, F: as above.
/// Returns the work [J].
GANNET_INLINE Vec hourglass_viscosity(const SolidConstants& c, const VecX3 q[4], Vec k_h, double dt,
                                      Vec length, VecX3 F[4]) {
  const Vec viscous = k_h * length * Vec(dt > 0 ? c.inverse_wave_speed / (64 * dt) : 0.0);
  Vec work(0.0);
  for (int k = 0; k < 4; ++k) {
    F[k] = scaled(q[k], viscous);
    work += dot(F[k], q[k]);
  }
  return work;
}

/// Forces, an eighth of those on the coefficients: of -(sigma - sum Q_k g_k^T / V) D_mode, and -Q_k
/// on each hourglass one. Q: an eighth of Q_k.
GANNET_INLINE SolidModes solid_forces(const SolidGeometry& G, const SolidModes& x,
                                      const Symmetric<Vec>& s, const VecX3 Q[4],
                                      Vec inverse_volume_192) {
  const Vec scale(-1.0 / 192.0);
  const Vec xy = scale * s.xy;
  const Vec yz = scale * s.yz;
  const Vec zx = scale * s.zx;
  Tensor T{{{scale * s.xx, xy, zx}, {xy, scale * s.yy, yz}, {zx, yz, scale * s.zz}}};
  for (int k = 0; k < 4; ++k) {
    const VecX3 g = scaled(x.g[k], inverse_volume_192);
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

/// Bound of the largest squared frequency of each element [1/s^2], from its own lumped mass M/n a
/// corner (n = 8; a tetrahedron's 4). With G the Gram matrix, (tr d)^2 <= tr G |v|^2 and d : d <=
/// largest(G) |v|^2, so
///   omega^2 <= n/(M V) (lambda tr G + 2 mu largest(G)) + k_h/M (1 + n largest(G) sum |g|^2/V^2),
/// exact for a cube (3 K) and for a flat element (lambda + 2 mu). Where lambda is below 0 a motion
/// without dilatation is the stiffest: it counts as 0.
GANNET_INLINE Vec solid_omega2(SolidShape shape, Vec lambda, Vec two_mu, const GramBound& gram,
                               const SolidModes& x, Vec inverse_volume, Vec inverse_mass, Vec k_h) {
  Vec g2(0.0);
  for (const VecX3& g : x.g) g2 += dot(g, g);
  g2 = Vec(1.0 / 64.0) * g2;
  const Vec n(shape == SolidShape::tetrahedron ? 4.0 : 8.0);
  const Vec hourglass = k_h * (Vec(1.0) + n * gram.largest * g2 * inverse_volume * inverse_volume);
  return inverse_mass *
         (n * inverse_volume * (max(lambda, Vec(0.0)) * gram.trace + two_mu * gram.largest) +
          hourglass);
}

}  // namespace gannet::GANNET_ISA_NS
