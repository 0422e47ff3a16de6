// The loop over the fluid near wall particles: eight targets in the lanes, one source broadcast at
// a time, as in the pair passes. It reads the fields themselves and not packed lines: few clusters
// hold wall particles, and each reads its sources once.
#include "base/simd.hpp"
#include "kernel/cubic_spline_vec.hpp"
#include "sph/wall_kernels.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

struct WallTargets {
  Vec8 x, y, z;
};

/// The last cluster repeats the last particle in its empty lanes.
GANNET_INLINE WallTargets wall_targets(const WallJob& job, std::int32_t cluster) {
  alignas(64) double t[3][8];
  for (int k = 0; k < 8; ++k) {
    const std::int64_t wanted = 8 * static_cast<std::int64_t>(cluster) + k;
    const std::int64_t i = wanted < job.n_targets ? wanted : job.n_targets - 1;
    for (int d = 0; d < 3; ++d) t[d][k] = job.x[4 * i + d];
  }
  return {Vec8::load(t[0]), Vec8::load(t[1]), Vec8::load(t[2])};
}

/// Adds what one source brings: W, p W, rho r W, v W.
GANNET_INLINE void add_source(const WallJob& job, const CubicSpline8& spline, Vec8 least_r2,
                              const WallTargets& t, std::int64_t j, Vec8 sums[8]) {
  const Vec8 x = t.x - Vec8(job.x[4 * j]);
  const Vec8 y = t.y - Vec8(job.x[4 * j + 1]);
  const Vec8 z = t.z - Vec8(job.x[4 * j + 2]);
  const Vec8 r2 = fma(x, x, fma(y, y, fma(z, z, least_r2)));
  Vec8 W = 0.0;
  spline_F(spline, r2, &W);
  const Vec8 rho_W = Vec8(job.rho[j]) * W;
  sums[0] += W;
  sums[1] = fma(Vec8(job.p[j]), W, sums[1]);
  sums[2] = fma(rho_W, x, sums[2]);
  sums[3] = fma(rho_W, y, sums[3]);
  sums[4] = fma(rho_W, z, sums[4]);
  sums[5] = fma(Vec8(job.v[4 * j]), W, sums[5]);
  sums[6] = fma(Vec8(job.v[4 * j + 1]), W, sums[6]);
  sums[7] = fma(Vec8(job.v[4 * j + 2]), W, sums[7]);
}

}  // namespace

__attribute__((flatten)) void wall_sums(const WallJob& job) {
  const CubicSpline8 spline = cubic_spline_8(job.h, job.sigma);
  const Vec8 least_r2(1e-20 * job.h * job.h);
  for (std::int32_t c = job.first; c < job.last; ++c) {
    const std::int32_t cluster = job.cluster[c];
    const WallTargets t = wall_targets(job, cluster);
    Vec8 sums[8];
    for (int s = 0; s < 8; ++s) sums[s] = Vec8(0.0);
    const std::int32_t* end = job.source + job.offset[cluster + 1];
    for (const std::int32_t* j = job.source + job.offset[cluster]; j < end; ++j) {
      if (*j < job.n_sources) add_source(job, spline, least_r2, t, *j, sums);
    }
    alignas(64) double lanes[8];
    for (int s = 0; s < 8; ++s) {
      sums[s].store(lanes);
      for (int k = 0; k < 8; ++k)
        job.sums[64 * static_cast<std::int64_t>(c) + 8 * k + s] = lanes[k];
    }
  }
}

}  // namespace gannet::GANNET_ISA_NS
