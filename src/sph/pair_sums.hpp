// What a pair pass sums over the sources of eight targets, and how the sums become results; for
// files named *.isa.cpp only.
#pragma once

#include "base/simd.hpp"
#include "base/simd_single.hpp"
#include "sph/pair_kernels.hpp"

namespace gannet::GANNET_ISA_NS {

template <class V>
struct Vector {
  V x = 0.0;
  V y = 0.0;
  V z = 0.0;
  GANNET_INLINE void add(V c, V a, V b, V d) {
    x = fma(c, a, x);
    y = fma(c, b, y);
    z = fma(c, d, z);
  }
  GANNET_INLINE void subtract(V c, V a, V b, V d) {
    x = fnma(c, a, x);
    y = fnma(c, b, y);
    z = fnma(c, d, z);
  }
};

template <class V>
struct Symmetric {
  V xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, xz = 0.0;
  /// Adds a (x) b, which is symmetric.
  GANNET_INLINE void add(V ax, V ay, V az, V bx, V by, V bz) {
    xx = fma(ax, bx, xx);
    yy = fma(ay, by, yy);
    zz = fma(az, bz, zz);
    xy = fma(ax, by, xy);
    yz = fma(ay, bz, yz);
    xz = fma(ax, bz, xz);
  }
};

/// Sums over sources, without the factors that all pairs share. Those of absent terms vanish.
template <class V>
struct Sums {
  V rate = 0.0;             ///< F v.r
  V diffusion = 0.0;        ///< F (s_i - s_j)
  V div_r = 0.0;            ///< F r^2
  V W = 0.0;                ///< W
  V VW = 0.0;               ///< W/rho_j
  Vector<V> X;              ///< -W v/(rho_i + rho_j)
  Vector<V> concentration;  ///< F (1 + 0.2 (W/W(dx))^4) r
  Symmetric<V> moment;      ///< F r (x) r
  Vector<V> grad_v[3];      ///< v_a F r
  Vector<V> f;              ///< -(p_i/rho_i^2 + p_j/rho_j^2) F r
  Vector<V> f_viscous;      ///< -Pi F r
  Vector<V> f_laminar;      ///< F/((r^2 + eta^2) rho_i rho_j) (r^2 v, or v . r r)
  Vector<V> f_tensile;      ///< -R (W/W(dx))^4 F r
  Vector<V> grad_p;         ///< (p_j - p_i) F r
};

/// Sums of doubles as they are; of floats, the two halves added.
GANNET_INLINE Vec8 total(Vec8 v) { return v; }
GANNET_INLINE Vec8 total(Vec16 v) {
  alignas(64) double t[8];
  v.store_sum(t);
  return Vec8::load(t);
}
template <class V>
GANNET_INLINE Vector<Vec8> total(const Vector<V>& v) {
  return {total(v.x), total(v.y), total(v.z)};
}

/// Writes lane k of scale v to place k.
GANNET_INLINE void put_numbers(double* out, int n, Vec8 v, double scale) {
  alignas(64) double t[8];
  (v * Vec8(scale)).store(t);
  for (int k = 0; k < n; ++k) out[k] = t[k];
}

/// Writes lane k of scale v to components x, y, z of line k, and w.
GANNET_INLINE void put_lines(double* lines, int n, const Vector<Vec8>& v, double scale,
                             Vec8 w = 0.0) {
  alignas(64) double t[4][8];
  (v.x * Vec8(scale)).store(t[0]);
  (v.y * Vec8(scale)).store(t[1]);
  (v.z * Vec8(scale)).store(t[2]);
  w.store(t[3]);
  for (int k = 0; k < n; ++k) {
    for (int d = 0; d < 4; ++d) lines[4 * k + d] = t[d][k];
  }
}

/// Adds lane k of scale v to components x, y, z of line k; w stays.
GANNET_INLINE void add_lines(double* lines, int n, const Vector<Vec8>& v, double scale) {
  alignas(64) double t[3][8];
  (v.x * Vec8(scale)).store(t[0]);
  (v.y * Vec8(scale)).store(t[1]);
  (v.z * Vec8(scale)).store(t[2]);
  for (int k = 0; k < n; ++k) {
    for (int d = 0; d < 3; ++d) lines[4 * k + d] += t[d][k];
  }
}

/// The inverse of M = -sum F r (x) r, which is V/V_0 times the unit matrix in a full
/// neighbourhood. `usable` is 1 where det(V_0 M) > 0.75, elsewhere 0: at the free surface the
/// usual sums stand, for they let the pressure be 0 there; differences alone know of no surface.
struct Inverse {
  Symmetric<Vec8> m;
  Vec8 usable;
  [[nodiscard]] GANNET_INLINE Vector<Vec8> times(const Vector<Vec8>& a) const {
    return {fma(m.xx, a.x, fma(m.xy, a.y, m.xz * a.z)), fma(m.xy, a.x, fma(m.yy, a.y, m.yz * a.z)),
            fma(m.xz, a.x, fma(m.yz, a.y, m.zz * a.z))};
  }
};

template <class V>
GANNET_INLINE Inverse inverse_of(const Symmetric<V>& sums, const PairJob& job) {
  const Vec8 s(-job.m / job.rho0);
  const Vec8 xx = total(sums.xx) * s;
  const Vec8 yy = total(sums.yy) * s;
  const Vec8 zz = job.dimension == 2 ? Vec8(1.0) : total(sums.zz) * s;
  const Vec8 xy = total(sums.xy) * s;
  const Vec8 yz = total(sums.yz) * s;
  const Vec8 xz = total(sums.xz) * s;
  Inverse inverse;
  inverse.m.xx = fnma(yz, yz, yy * zz);
  inverse.m.xy = fnma(xy, zz, xz * yz);
  inverse.m.xz = fnma(xz, yy, xy * yz);
  inverse.m.yy = fnma(xz, xz, xx * zz);
  inverse.m.yz = fnma(yz, xx, xy * xz);
  inverse.m.zz = fnma(xy, xy, xx * yy);
  const Vec8 det = fma(xx, inverse.m.xx, fma(xy, inverse.m.xy, xz * inverse.m.xz));
  const Mask8 bad = less(det, Vec8(0.75));
  inverse.usable = select(bad, Vec8(0.0), Vec8(1.0));
  const Vec8 factor = s * (Vec8(1.0) / select(bad, Vec8(1.0), det));
  Symmetric<Vec8>& m = inverse.m;
  m.xx *= factor;
  m.yy *= factor;
  m.zz *= factor;
  m.xy *= factor;
  m.yz *= factor;
  m.xz *= factor;
  return inverse;
}

/// Densities of the targets of a cluster; 1 for lanes without one.
GANNET_INLINE Vec8 densities(const PairJob& job, std::int64_t first, int n) {
  alignas(64) double t[8];
  for (int k = 0; k < 8; ++k) t[k] = k < n ? job.rho[first + k] : 1.0;
  return Vec8::load(t);
}

/// What the corrected divergence adds to the density rate. With v = v_i - v_j, G = sum F v (x) r
/// and S = sum F r (x) r, a linear field has G = (grad v) S, so div v = trace(G S^-1) exactly; the
/// rate is -rho div v in place of m sum F v.r.
template <class V>
GANNET_INLINE Vec8 rate_correction(const PairJob& job, const Sums<V>& sums, Vec8 rho) {
  const Inverse inverse = inverse_of(sums.moment, job);
  const Vec8 div_v = inverse.times(total(sums.grad_v[0])).x +
                     inverse.times(total(sums.grad_v[1])).y +
                     inverse.times(total(sums.grad_v[2])).z;
  return -(inverse.usable * fma(rho, div_v, total(sums.rate) * Vec8(job.m)));
}

/// What the corrected gradient adds to the force. With g = sum (p_j - p_i) F r a linear field has
/// grad p = -S^-1 g exactly; the force is -m/rho grad p in place of the sum of both pressures.
template <class V>
GANNET_INLINE Vector<Vec8> force_correction(const PairJob& job, const Sums<V>& sums, Vec8 rho) {
  const Inverse inverse = inverse_of(sums.moment, job);
  const Vector<Vec8> g = inverse.times(total(sums.grad_p));
  const Vector<Vec8> f = total(sums.f);
  const Vec8 c = Vec8(job.m) / rho;
  const Vec8 m2(job.m * job.m);
  return {inverse.usable * fnma(m2, f.x, c * g.x), inverse.usable * fnma(m2, f.y, c * g.y),
          inverse.usable * fnma(m2, f.z, c * g.z)};
}

template <unsigned allowed, class V>
GANNET_INLINE void put_rates(const PairJob& job, std::int64_t first, int n, const Sums<V>& sums) {
  const unsigned on = allowed & job.terms;
  Vec8 rate = total(sums.rate) * Vec8(job.m);
  if ((on & diffusion_term) != 0) {
    const Vec8 d =
        total(sums.diffusion) * Vec8(2.0 * job.delta * job.h * job.c0 * job.m / job.rho0);
    rate = rate + d;
    put_numbers(job.drho_diffusion + first, n, d, 1.0);
  }
  if ((on & rate_correction_term) != 0) {
    const Vec8 d = rate_correction(job, sums, densities(job, first, n));
    rate = rate + d;
    put_numbers(job.drho_correction + first, n, d, 1.0);
  }
  if ((on & rate_term) != 0) put_numbers(job.drho_dt + first, n, rate, 1.0);
  if ((on & xsph_term) != 0) {
    put_lines(job.X + 4 * first, n, total(sums.X), 2.0 * job.epsilon * job.m);
  }
  if ((on & concentration_term) != 0) {
    const double V0 = job.m / job.rho0;
    put_lines(job.concentration + 4 * first, n, total(sums.concentration), V0,
              total(sums.div_r) * Vec8(-V0));
  }
  if ((on & shepard_term) != 0) {
    put_numbers(job.sum_mW + first, n, total(sums.W), job.m);
    put_numbers(job.sum_VW + first, n, total(sums.VW), job.m);
  }
}

template <unsigned allowed, class V>
GANNET_INLINE void put_forces(const PairJob& job, std::int64_t first, int n, const Sums<V>& sums) {
  const unsigned on = allowed & job.terms;
  const double m2 = job.m * job.m;
  double* f = job.f + 4 * first;
  if ((on & force_term) != 0) add_lines(f, n, total(sums.f), m2);
  const auto put = [&](unsigned term, double* out, const Vector<V>& v, double scale)
      __attribute__((always_inline)) {
    if ((on & term) == 0) return;
    const Vector<Vec8> whole = total(v);
    add_lines(f, n, whole, scale);
    put_lines(out + 4 * first, n, whole, scale);
  };
  put(viscous_term, job.f_viscous, sums.f_viscous, m2);
  put(laminar_term, job.f_laminar, sums.f_laminar, job.mu * m2);
  put(tensile_term, job.f_tensile, sums.f_tensile, job.tensile * m2);
  if ((on & force_correction_term) != 0) {
    const Vector<Vec8> d = force_correction(job, sums, densities(job, first, n));
    add_lines(f, n, d, 1.0);
    put_lines(job.f_correction + 4 * first, n, d, 1.0);
  }
}

/// Writes what a cluster's targets summed up.
template <unsigned allowed, class V>
GANNET_INLINE void put_sums(const PairJob& job, std::int32_t cluster, const Sums<V>& sums) {
  const std::int64_t first = 8 * static_cast<std::int64_t>(cluster);
  const int n = job.n_targets - first < 8 ? static_cast<int>(job.n_targets - first) : 8;
  constexpr unsigned rates = rate_term | shepard_term;
  constexpr unsigned forces = force_term;
  if constexpr ((allowed & rates) != 0) put_rates<allowed>(job, first, n, sums);
  if constexpr ((allowed & forces) != 0) put_forces<allowed>(job, first, n, sums);
}

}  // namespace gannet::GANNET_ISA_NS
