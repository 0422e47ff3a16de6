// The pair loop: eight targets in the lanes, one source broadcast at a time. No masks: beyond 2 h
// the kernel is 0, and so it is for the particle far away that pads the lists. The target itself
// is among its sources and adds 0, for r_ij = v_ij = 0.
//
// Every pair quantity is either the same to the last bit seen from i and from j, or changes its
// sign: differences are taken first, sums are of two terms, and nothing else tells i from j. So
// the force of j on i is exactly minus that of i on j.
#include "base/simd.hpp"
#include "kernel/cubic_spline_vec.hpp"
#include "sph/pair_kernels.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Terms of a pass.
enum : unsigned { rate_term = 1, xsph_term = 2, force_term = 4, viscous_term = 8 };

/// How many sources ahead to ask for; ClusterList::spare entries behind the last list can be read.
constexpr int prefetch_ahead = 32;

struct Targets {
  Vec8 x, y, z, vx, vy, vz, rho, p_rho2;
};

/// Sums over sources, without the factors that all pairs share.
struct Sums {
  Vec8 rate = 0.0;
  Vec8 X[3] = {0.0, 0.0, 0.0};
  Vec8 f[3] = {0.0, 0.0, 0.0};
  Vec8 f_viscous[3] = {0.0, 0.0, 0.0};
};

struct Constants {
  CubicSpline8 spline;
  Vec8 least_r2;   ///< 1e-20 h^2, lifts r = 0 out of 1/r
  Vec8 eta2;       ///< 0.01 h^2
  Vec8 linear;     ///< 2 alpha c0 h
  Vec8 quadratic;  ///< 2 beta h^2
};

GANNET_INLINE Targets load_targets(const double* packed) {
  alignas(64) double t[8][8];
  for (int k = 0; k < 8; ++k) {
    for (int c = 0; c < 8; ++c) t[c][k] = packed[8 * k + c];
  }
  return {Vec8::load(t[0]), Vec8::load(t[1]), Vec8::load(t[2]), Vec8::load(t[3]),
          Vec8::load(t[4]), Vec8::load(t[5]), Vec8::load(t[6]), Vec8::load(t[7])};
}

/// Pi_ij = 2/(rho_i + rho_j) (-alpha c0 mu + beta mu^2), mu = h min(v.r, 0)/(r^2 + eta^2), with
/// one division: where s = 1/((r^2 + eta^2)(rho_i + rho_j)), mu/(rho_i + rho_j) = h min(v.r, 0) s.
GANNET_INLINE Vec8 viscosity(const Constants& k, Vec8 r2, Vec8 v_r, Vec8 rho_sum) {
  const Vec8 closing = min(v_r, Vec8(0.0));
  const Vec8 a = closing / ((r2 + k.eta2) * rho_sum);
  return a * (k.quadratic * (a * rho_sum) - k.linear);
}

/// Adds what one source does to eight targets.
template <unsigned terms>
GANNET_INLINE void add_pair(const Constants& k, const Targets& t, const double* source,
                            Sums& sums) {
  const Vec8 x = t.x - Vec8(source[0]);
  const Vec8 y = t.y - Vec8(source[1]);
  const Vec8 z = t.z - Vec8(source[2]);
  const Vec8 r2 = fma(x, x, fma(y, y, fma(z, z, k.least_r2)));
  Vec8 W = 0.0;
  const Vec8 F = spline_F(k.spline, r2, (terms & xsph_term) != 0 ? &W : nullptr);
  Vec8 pressure = 0.0;
  if constexpr ((terms & force_term) != 0) pressure = t.p_rho2 + Vec8(source[7]);
  if constexpr (terms != force_term) {
    const Vec8 vx = t.vx - Vec8(source[3]);
    const Vec8 vy = t.vy - Vec8(source[4]);
    const Vec8 vz = t.vz - Vec8(source[5]);
    const Vec8 v_r = fma(x, vx, fma(y, vy, z * vz));
    if constexpr ((terms & rate_term) != 0) sums.rate = fma(F, v_r, sums.rate);
    if constexpr ((terms & xsph_term) != 0) {
      const Vec8 c = W / (t.rho + Vec8(source[6]));
      sums.X[0] = fnma(c, vx, sums.X[0]);
      sums.X[1] = fnma(c, vy, sums.X[1]);
      sums.X[2] = fnma(c, vz, sums.X[2]);
    }
    if constexpr ((terms & viscous_term) != 0) {
      const Vec8 Pi = viscosity(k, r2, v_r, t.rho + Vec8(source[6]));
      const Vec8 c = Pi * F;
      sums.f_viscous[0] = fnma(c, x, sums.f_viscous[0]);
      sums.f_viscous[1] = fnma(c, y, sums.f_viscous[1]);
      sums.f_viscous[2] = fnma(c, z, sums.f_viscous[2]);
    }
  }
  if constexpr ((terms & force_term) != 0) {
    const Vec8 c = pressure * F;
    sums.f[0] = fnma(c, x, sums.f[0]);
    sums.f[1] = fnma(c, y, sums.f[1]);
    sums.f[2] = fnma(c, z, sums.f[2]);
  }
}

/// Writes lane k of scale v[0..2] to components x, y, z of line k; adds to what is there where
/// `adds`, else sets w to 0.
template <bool adds>
GANNET_INLINE void put_lines(double* lines, int n, const Vec8 v[3], double scale) {
  alignas(64) double t[3][8];
  for (int d = 0; d < 3; ++d) (v[d] * Vec8(scale)).store(t[d]);
  for (int k = 0; k < n; ++k) {
    for (int d = 0; d < 3; ++d) {
      if constexpr (adds) {
        lines[4 * k + d] += t[d][k];
      } else {
        lines[4 * k + d] = t[d][k];
      }
    }
    if constexpr (!adds) lines[4 * k + 3] = 0;
  }
}

template <unsigned terms>
GANNET_INLINE void put_sums(const PairJob& job, std::int32_t cluster, const Sums& sums) {
  const std::int64_t first = 8 * static_cast<std::int64_t>(cluster);
  const int n = job.n_targets - first < 8 ? static_cast<int>(job.n_targets - first) : 8;
  if constexpr ((terms & rate_term) != 0) {
    alignas(64) double t[8];
    (sums.rate * Vec8(job.m)).store(t);
    for (int k = 0; k < n; ++k) job.drho_dt[first + k] = t[k];
  }
  if constexpr ((terms & xsph_term) != 0) {
    put_lines<false>(job.X + 4 * first, n, sums.X, 2.0 * job.epsilon * job.m);
  }
  if constexpr ((terms & force_term) != 0) {
    put_lines<true>(job.f + 4 * first, n, sums.f, job.m * job.m);
  }
  if constexpr ((terms & viscous_term) != 0) {
    put_lines<true>(job.f + 4 * first, n, sums.f_viscous, job.m * job.m);
    put_lines<false>(job.f_viscous + 4 * first, n, sums.f_viscous, job.m * job.m);
  }
}

template <unsigned terms>
GANNET_INLINE void run(const PairJob& job) {
  const Constants k{cubic_spline_8(job.h, job.sigma), Vec8(1e-20 * job.h * job.h),
                    Vec8(0.01 * job.h * job.h), Vec8(2.0 * job.alpha * job.c0 * job.h),
                    Vec8(2.0 * job.beta * job.h * job.h)};
  for (std::int32_t cluster = job.first; cluster < job.last; ++cluster) {
    const Targets t = load_targets(job.packed + 64 * static_cast<std::int64_t>(cluster));
    Sums sums;
    const std::int32_t* end = job.source + job.offset[cluster + 1];
    for (const std::int32_t* j = job.source + job.offset[cluster]; j < end; ++j) {
      // Sources lie in a few dozen short stretches, too many for the processor to guess ahead.
      __builtin_prefetch(job.packed + 8 * static_cast<std::int64_t>(j[prefetch_ahead]));
      add_pair<terms>(k, t, job.packed + 8 * static_cast<std::int64_t>(*j), sums);
    }
    put_sums<terms>(job, cluster, sums);
  }
}

}  // namespace

__attribute__((flatten)) void pair_rates(const PairJob& job) { run<rate_term>(job); }

__attribute__((flatten)) void pair_rates_xsph(const PairJob& job) {
  run<rate_term | xsph_term>(job);
}

__attribute__((flatten)) void pair_force(const PairJob& job) { run<force_term>(job); }

__attribute__((flatten)) void pair_force_viscous(const PairJob& job) {
  run<force_term | viscous_term>(job);
}

__attribute__((flatten)) void pair_fused(const PairJob& job) {
  run<rate_term | force_term | viscous_term>(job);
}

}  // namespace gannet::GANNET_ISA_NS
