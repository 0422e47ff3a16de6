// The pair loop: eight targets in the lanes, one source broadcast at a time (two, in single
// precision: each half of a vector of sixteen holds the same targets and another source). No masks:
// beyond its support the kernel is 0, and so it is for the particle far away that pads the lists.
// The target itself is among its sources and adds 0, for r_ij = v_ij = 0.
//
// Every pair quantity is either the same to the last bit seen from i and from j, or changes its
// sign: differences are taken first, sums are of two terms, and nothing else tells i from j. So
// the force of j on i is exactly minus that of i on j.
#include "base/simd.hpp"
#include "base/simd_single.hpp"
#include "kernel/smoothing_kernel_vec.hpp"
#include "sph/pair_kernels.hpp"
#include "sph/pair_sums.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// How many sources ahead to ask for; ClusterList::spare entries behind the last list can be read.
constexpr int prefetch_ahead = 32;

/// Particles in double precision: one source a time.
struct DoublePairs {
  using V = Vec8;
  static constexpr int n_sources = 1;
  struct Targets {
    Vec8 c[8];
  };
  struct Source {
    const double* s;
  };
  const double* packed;

  GANNET_INLINE explicit DoublePairs(const PairJob& job) : packed(job.packed) {}
  [[nodiscard]] GANNET_INLINE Targets targets(std::int64_t first) const {
    alignas(64) double t[8][8];
    for (int k = 0; k < 8; ++k) {
      for (int c = 0; c < 8; ++c) t[c][k] = packed[8 * (first + k) + c];
    }
    Targets targets;
    for (int c = 0; c < 8; ++c) targets.c[c] = Vec8::load(t[c]);
    return targets;
  }
  [[nodiscard]] GANNET_INLINE Source source(const std::int32_t* j) const {
    return {packed + 8 * static_cast<std::int64_t>(*j)};
  }
  GANNET_INLINE void prefetch(std::int32_t j) const {
    __builtin_prefetch(packed + 8 * static_cast<std::int64_t>(j));
  }
  /// Component c of r_ij (0 to 2) or v_ij (3 to 5).
  [[nodiscard]] GANNET_INLINE Vec8 difference_of(const Targets& t, const Source& s, int c) const {
    return t.c[c] - Vec8(s.s[c]);
  }
  [[nodiscard]] GANNET_INLINE Vec8 rho(const Targets& t) const { return t.c[6]; }
  [[nodiscard]] GANNET_INLINE Vec8 last(const Targets& t) const { return t.c[7]; }
  [[nodiscard]] GANNET_INLINE Vec8 rho(const Source& s) const { return s.s[6]; }
  [[nodiscard]] GANNET_INLINE Vec8 last(const Source& s) const { return s.s[7]; }
};

/// Particles in single precision: two sources a time.
struct SinglePairs {
  using V = Vec16;
  static constexpr int n_sources = 2;
  struct Targets {
    Int16 c[6];
    Vec16 rho, last;
  };
  struct Source {
    const PackedSingle* a;
    const PackedSingle* b;
  };
  const PackedSingle* packed;
  Vec16 unit[2];  ///< of positions, of velocities

  GANNET_INLINE explicit SinglePairs(const PairJob& job)
      : packed(job.single), unit{Vec16(job.x_unit), Vec16(job.v_unit)} {}
  [[nodiscard]] GANNET_INLINE Targets targets(std::int64_t first) const {
    alignas(64) std::int32_t t[6][8];
    alignas(64) float values[2][8];
    for (int k = 0; k < 8; ++k) {
      const PackedSingle& p = packed[first + k];
      for (int c = 0; c < 3; ++c) t[c][k] = p.x[c];
      for (int c = 0; c < 3; ++c) t[3 + c][k] = p.v[c];
      values[0][k] = p.rho;
      values[1][k] = p.last;
    }
    Targets targets;
    for (int c = 0; c < 6; ++c) targets.c[c] = Int16::twice(t[c]);
    targets.rho = Vec16::twice(values[0]);
    targets.last = Vec16::twice(values[1]);
    return targets;
  }
  [[nodiscard]] GANNET_INLINE Source source(const std::int32_t* j) const {
    return {packed + j[0], packed + j[1]};
  }
  GANNET_INLINE void prefetch(std::int32_t j) const { __builtin_prefetch(packed + j); }
  [[nodiscard]] GANNET_INLINE Vec16 difference_of(const Targets& t, const Source& s, int c) const {
    const Int16 there =
        c < 3 ? Int16::pair(s.a->x[c], s.b->x[c]) : Int16::pair(s.a->v[c - 3], s.b->v[c - 3]);
    return difference(t.c[c], there) * unit[c < 3 ? 0 : 1];
  }
  [[nodiscard]] GANNET_INLINE Vec16 rho(const Targets& t) const { return t.rho; }
  [[nodiscard]] GANNET_INLINE Vec16 last(const Targets& t) const { return t.last; }
  [[nodiscard]] GANNET_INLINE Vec16 rho(const Source& s) const {
    return Vec16::pair(s.a->rho, s.b->rho);
  }
  [[nodiscard]] GANNET_INLINE Vec16 last(const Source& s) const {
    return Vec16::pair(s.a->last, s.b->last);
  }
};

template <class V>
struct Constants {
  KernelVec<V> kernel;
  V least_r2;   ///< 1e-20 h^2 (1e-12 in single precision), lifts r = 0 out of 1/r
  V eta2;       ///< 0.01 h^2
  V linear;     ///< 2 alpha c0 h
  V quadratic;  ///< 2 beta h^2
  V inv_W_dx;   ///< 1/W(dx)

  GANNET_INLINE Constants(const PairJob& job, double least)
      : kernel(job.kernel, job.h, job.sigma),
        least_r2(least * job.h * job.h),
        eta2(0.01 * job.h * job.h),
        linear(2.0 * job.alpha * job.c0 * job.h),
        quadratic(2.0 * job.beta * job.h * job.h),
        inv_W_dx(job.inv_W_dx) {}
};

/// r_ij, v_ij and the kernel of eight pairs (sixteen, in single precision).
template <class V>
struct Pair {
  V x, y, z, r2;
  V vx, vy, vz, v_r;
  V F, W;
};

/// Pi_ij = 2/(rho_i + rho_j) (-alpha c0 mu + beta mu^2), mu = h min(v.r, 0)/(r^2 + eta^2), with
/// one division: where s = 1/((r^2 + eta^2)(rho_i + rho_j)), mu/(rho_i + rho_j) = h min(v.r, 0) s.
template <class V>
GANNET_INLINE V viscosity(const Constants<V>& k, const Pair<V>& p, V rho_sum) {
  const V closing = min(p.v_r, V(0.0));
  const V a = closing * reciprocal((p.r2 + k.eta2) * rho_sum);
  return a * (k.quadratic * (a * rho_sum) - k.linear);
}

/// (W/W(dx))^4
template <class V>
GANNET_INLINE V closeness(const Constants<V>& k, const Pair<V>& p) {
  const V f = p.W * k.inv_W_dx;
  const V f2 = f * f;
  return f2 * f2;
}

/// The terms of the rates pass.
template <unsigned allowed, class P, class V = typename P::V>
GANNET_INLINE void add_rates(const P& pairs, const Constants<V>& k, unsigned terms,
                             const typename P::Targets& t, const typename P::Source& s,
                             const Pair<V>& p, Sums<V>& sums) {
  if constexpr ((allowed & rate_term) != 0) sums.rate = fma(p.F, p.v_r, sums.rate);
  if ((allowed & terms & diffusion_term) != 0) {
    sums.diffusion = fma(p.F, pairs.last(t) - pairs.last(s), sums.diffusion);
  }
  if ((allowed & terms & xsph_term) != 0) {
    const V c = p.W * reciprocal(pairs.rho(t) + pairs.rho(s));
    sums.X.subtract(c, p.vx, p.vy, p.vz);
  }
  if ((allowed & terms & concentration_term) != 0) {
    sums.div_r = fma(p.F, p.r2, sums.div_r);
    sums.concentration.add(p.F * fma(V(0.2), closeness(k, p), V(1.0)), p.x, p.y, p.z);
  }
  if ((allowed & terms & shepard_term) != 0) {
    sums.W = sums.W + p.W;
    sums.VW = fma(p.W, reciprocal(pairs.rho(s)), sums.VW);
  }
  if ((allowed & terms & rate_correction_term) != 0) {
    const V x = p.F * p.x;
    const V y = p.F * p.y;
    const V z = p.F * p.z;
    sums.moment.add(x, y, z, p.x, p.y, p.z);
    sums.grad_v[0].add(p.vx, x, y, z);
    sums.grad_v[1].add(p.vy, x, y, z);
    sums.grad_v[2].add(p.vz, x, y, z);
  }
}

/// The terms of the force pass.
template <unsigned allowed, class P, class V = typename P::V>
GANNET_INLINE void add_forces(const P& pairs, const Constants<V>& k, unsigned terms,
                              const typename P::Targets& t, const typename P::Source& s,
                              const Pair<V>& p, Sums<V>& sums) {
  if constexpr ((allowed & force_term) != 0) {
    sums.f.subtract((pairs.last(t) + pairs.last(s)) * p.F, p.x, p.y, p.z);
  }
  if ((allowed & terms & viscous_term) != 0) {
    const V Pi = viscosity(k, p, pairs.rho(t) + pairs.rho(s));
    sums.f_viscous.subtract(Pi * p.F, p.x, p.y, p.z);
  }
  if ((allowed & terms & laminar_term) != 0) {
    const V below = (p.r2 + k.eta2) * (pairs.rho(t) * pairs.rho(s));
    const V c = p.F * reciprocal(below);
    if ((terms & central_term) != 0) {
      sums.f_laminar.add(c * p.v_r, p.x, p.y, p.z);
    } else {
      sums.f_laminar.add(c * p.r2, p.vx, p.vy, p.vz);
    }
  }
  if ((allowed & terms & tensile_term) != 0) {
    const V tension = positive_part(V(0.0) - pairs.last(t)) + positive_part(V(0.0) - pairs.last(s));
    sums.f_tensile.subtract(tension * closeness(k, p) * p.F, p.x, p.y, p.z);
  }
  if ((allowed & terms & force_correction_term) != 0) {
    const V x = p.F * p.x;
    const V y = p.F * p.y;
    const V z = p.F * p.z;
    const V rho_i = pairs.rho(t);
    const V rho_j = pairs.rho(s);
    sums.moment.add(x, y, z, p.x, p.y, p.z);
    sums.grad_p.add(pairs.last(s) * (rho_j * rho_j) - pairs.last(t) * (rho_i * rho_i), x, y, z);
  }
}

/// Terms that read velocities, and terms that read W.
constexpr unsigned with_velocity =
    rate_term | xsph_term | rate_correction_term | viscous_term | laminar_term;
constexpr unsigned with_W = xsph_term | concentration_term | shepard_term | tensile_term;

/// Adds what one source (two, in single precision) does to eight targets.
template <unsigned allowed, bool cubic, class P, class V = typename P::V>
GANNET_INLINE void add_pair(const P& pairs, const Constants<V>& k, unsigned terms,
                            const typename P::Targets& t, const typename P::Source& s,
                            Sums<V>& sums) {
  Pair<V> p;
  p.x = pairs.difference_of(t, s, 0);
  p.y = pairs.difference_of(t, s, 1);
  p.z = pairs.difference_of(t, s, 2);
  p.r2 = fma(p.x, p.x, fma(p.y, p.y, fma(p.z, p.z, k.least_r2)));
  V* W = (allowed & terms & with_W) != 0 ? &p.W : nullptr;
  p.F = cubic ? cubic_F(k.kernel, p.r2, W) : kernel_F(k.kernel, p.r2, W);
  if ((allowed & terms & with_velocity) != 0) {
    p.vx = pairs.difference_of(t, s, 3);
    p.vy = pairs.difference_of(t, s, 4);
    p.vz = pairs.difference_of(t, s, 5);
    p.v_r = fma(p.x, p.vx, fma(p.y, p.vy, p.z * p.vz));
  }
  add_rates<allowed>(pairs, k, terms, t, s, p, sums);
  add_forces<allowed>(pairs, k, terms, t, s, p, sums);
}

/// All clusters of a job.
template <unsigned allowed, bool cubic, class P>
GANNET_INLINE void run(const PairJob& job, double least_r2) {
  using V = typename P::V;
  const P pairs(job);
  const Constants<V> k(job, least_r2);
  const unsigned terms = job.terms;
  for (std::int32_t c = job.first; c < job.last; ++c) {
    const std::int32_t cluster = job.cluster == nullptr ? c : job.cluster[c];
    const typename P::Targets t = pairs.targets(8 * static_cast<std::int64_t>(cluster));
    Sums<V> sums;
    const std::int32_t* end = job.source + job.offset[cluster + 1];
    for (const std::int32_t* j = job.source + job.offset[cluster]; j < end; j += P::n_sources) {
      // Sources lie in a few dozen short stretches, too many for the processor to guess ahead.
      for (int q = 0; q < P::n_sources; ++q) pairs.prefetch(j[prefetch_ahead + q]);
      add_pair<allowed, cubic>(pairs, k, terms, t, pairs.source(j), sums);
    }
    put_sums<allowed>(job, cluster, sums);
  }
}

constexpr unsigned usual_rates = rate_term | xsph_term | diffusion_term;
constexpr unsigned all_rates =
    usual_rates | concentration_term | shepard_term | rate_correction_term;
constexpr unsigned usual_force = force_term | viscous_term;
constexpr unsigned all_force =
    usual_force | laminar_term | central_term | tensile_term | force_correction_term;
constexpr unsigned fused_terms = rate_term | force_term | viscous_term;
constexpr double least_double = 1e-20;
constexpr double least_single = 1e-12;

__attribute__((flatten, noinline)) void rates_cubic(const PairJob& job) {
  run<usual_rates, true, DoublePairs>(job, least_double);
}
__attribute__((flatten, noinline)) void rates_cubic_single(const PairJob& job) {
  run<usual_rates, true, SinglePairs>(job, least_single);
}
__attribute__((flatten, noinline)) void rates_any(const PairJob& job) {
  run<all_rates, false, DoublePairs>(job, least_double);
}
__attribute__((flatten, noinline)) void rates_any_single(const PairJob& job) {
  run<all_rates, false, SinglePairs>(job, least_single);
}
__attribute__((flatten, noinline)) void force_cubic(const PairJob& job) {
  run<usual_force, true, DoublePairs>(job, least_double);
}
__attribute__((flatten, noinline)) void force_cubic_single(const PairJob& job) {
  run<usual_force, true, SinglePairs>(job, least_single);
}
__attribute__((flatten, noinline)) void force_any(const PairJob& job) {
  run<all_force, false, DoublePairs>(job, least_double);
}
__attribute__((flatten, noinline)) void force_any_single(const PairJob& job) {
  run<all_force, false, SinglePairs>(job, least_single);
}
__attribute__((flatten, noinline)) void fused(const PairJob& job) {
  run<fused_terms, true, DoublePairs>(job, least_double);
}
__attribute__((flatten, noinline)) void fused_single(const PairJob& job) {
  run<fused_terms, true, SinglePairs>(job, least_single);
}

}  // namespace

void pair_pass(PairKernel kernel, const PairJob& job) {
  switch (kernel) {
    case PairKernel::rates_cubic:
      return rates_cubic(job);
    case PairKernel::rates_cubic_single:
      return rates_cubic_single(job);
    case PairKernel::rates_any:
      return rates_any(job);
    case PairKernel::rates_any_single:
      return rates_any_single(job);
    case PairKernel::force_cubic:
      return force_cubic(job);
    case PairKernel::force_cubic_single:
      return force_cubic_single(job);
    case PairKernel::force_any:
      return force_any(job);
    case PairKernel::force_any_single:
      return force_any_single(job);
    case PairKernel::fused:
      return fused(job);
    case PairKernel::fused_single:
      return fused_single(job);
  }
}

}  // namespace gannet::GANNET_ISA_NS
