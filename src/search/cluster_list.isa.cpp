// Finds the sources near each cluster of eight targets: columns that reach into the box, by binary
// search the stretch of each, then 16 candidates at a time against the box, the hits compressed.
// Both instruction sets do the same single-precision arithmetic and so find the same lists.
#include <immintrin.h>

#include "base/simd.hpp"
#include "search/cluster_kernel.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

/// Box of a cluster, relative to the origin, in the numbers that candidates are compared with.
struct ClusterBox {
  float low[3];
  float high[3];
  double radius;  ///< of its list [m]
};

GANNET_INLINE ClusterBox box_of(const ListJob& job, std::int32_t cluster) {
  ClusterBox box;
  const std::int32_t begin = 8 * cluster;
  const std::int32_t end = begin + 8 < job.n_targets ? begin + 8 : job.n_targets;
  double further = 0;
  if (job.further != nullptr) {
    for (std::int32_t i = begin; i < end; ++i) {
      further = job.further[i] > further ? job.further[i] : further;
    }
  }
  box.radius = job.radius + further;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = 3.0e38F;
    box.high[d] = -3.0e38F;
    for (std::int32_t i = begin; i < end; ++i) {
      const auto c =
          static_cast<float>(job.target[4 * static_cast<std::int64_t>(i) + d] - job.origin[d]);
      box.low[d] = c < box.low[d] ? c : box.low[d];
      box.high[d] = c > box.high[d] ? c : box.high[d];
    }
  }
  return box;
}

/// Radius with room for the rounding of coordinates to single precision (2^-24 of them each).
GANNET_INLINE double padded_radius(const ClusterBox& box) {
  double largest = box.radius;
  for (int d = 0; d < 3; ++d) {
    largest = -box.low[d] > largest ? -box.low[d] : largest;
    largest = box.high[d] > largest ? box.high[d] : largest;
  }
  return box.radius + 8.0 * 5.97e-8 * (largest + box.radius);
}

GANNET_INLINE std::int32_t clamp_column(double place, std::int32_t n) {
  if (!(place > 0)) return 0;
  return place < n - 1 ? static_cast<std::int32_t>(place) : n - 1;
}

/// Distance along one axis between the box and column i; the outermost columns have no outer side.
GANNET_INLINE double gap_to_column(double low, double high, double column_low, double width,
                                   bool first, bool last) {
  double gap = 0;
  if (!first && column_low - high > gap) gap = column_low - high;
  if (!last && low - (column_low + width) > gap) gap = low - (column_low + width);
  return gap;
}

/// First place in the rising stretch [begin, end) of x that is not below the limit.
GANNET_INLINE std::int32_t lower_bound(const float* x, std::int32_t begin, std::int32_t end,
                                       float limit) {
  std::int32_t n = end - begin;
  while (n > 0) {
    const std::int32_t half = n / 2;
    const bool below = x[begin + half] < limit;
    begin = below ? begin + half + 1 : begin;
    n = below ? n - half - 1 : half;
  }
  return begin;
}

#ifdef __AVX512F__

/// Appends the candidates [begin, end) that lie within the radius of the box.
GANNET_INLINE std::int64_t scan(const ListJob& job, const ClusterBox& box, float r2,
                                std::int32_t begin, std::int32_t end, std::int64_t used) {
  const __m512 zero = _mm512_setzero_ps();
  auto gap = [&](const float* c, std::int32_t q, int d) __attribute__((always_inline)) {
    const __m512 v = _mm512_loadu_ps(c + q);
    const __m512 below = _mm512_sub_ps(_mm512_set1_ps(box.low[d]), v);
    const __m512 above = _mm512_sub_ps(v, _mm512_set1_ps(box.high[d]));
    return _mm512_max_ps(_mm512_max_ps(below, above), zero);
  };
  for (std::int32_t q = begin; q < end; q += 16) {
    const __m512 ex = gap(job.x, q, 0);
    const __m512 ey = gap(job.y, q, 1);
    const __m512 ez = gap(job.z, q, 2);
    const __m512 d2 = _mm512_fmadd_ps(ez, ez, _mm512_fmadd_ps(ey, ey, _mm512_mul_ps(ex, ex)));
    __mmask16 hit = _mm512_cmp_ps_mask(d2, _mm512_set1_ps(r2), _CMP_LE_OQ);
    if (end - q < 16) hit &= static_cast<__mmask16>((1U << (end - q)) - 1U);
    const __m512i id = _mm512_loadu_si512(job.index + q);
    _mm512_storeu_si512(job.out + used, _mm512_maskz_compress_epi32(hit, id));
    used += __builtin_popcount(hit);
  }
  return used;
}

#else

/// Moves the lanes whose bit is set to the front, in order.
GANNET_INLINE __m256i compress(__m256i v, unsigned hit) {
  const std::uint64_t bytes = _pdep_u64(hit, 0x0101010101010101U) * 0xffU;
  const std::uint64_t lanes = _pext_u64(0x0706050403020100U, bytes);
  const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(lanes)));
  return _mm256_permutevar8x32_epi32(v, order);
}

/// Appends the candidates [begin, end) that lie within the radius of the box.
GANNET_INLINE std::int64_t scan(const ListJob& job, const ClusterBox& box, float r2,
                                std::int32_t begin, std::int32_t end, std::int64_t used) {
  const __m256 zero = _mm256_setzero_ps();
  auto gap = [&](const float* c, std::int32_t q, int d) __attribute__((always_inline)) {
    const __m256 v = _mm256_loadu_ps(c + q);
    const __m256 below = _mm256_sub_ps(_mm256_set1_ps(box.low[d]), v);
    const __m256 above = _mm256_sub_ps(v, _mm256_set1_ps(box.high[d]));
    return _mm256_max_ps(_mm256_max_ps(below, above), zero);
  };
  for (std::int32_t q = begin; q < end; q += 8) {
    const __m256 ex = gap(job.x, q, 0);
    const __m256 ey = gap(job.y, q, 1);
    const __m256 ez = gap(job.z, q, 2);
    const __m256 d2 = _mm256_fmadd_ps(ez, ez, _mm256_fmadd_ps(ey, ey, _mm256_mul_ps(ex, ex)));
    const __m256 near = _mm256_cmp_ps(d2, _mm256_set1_ps(r2), _CMP_LE_OQ);
    auto hit = static_cast<unsigned>(_mm256_movemask_ps(near));
    if (end - q < 8) hit &= (1U << (end - q)) - 1U;
    const __m256i id = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(job.index + q));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(job.out + used), compress(id, hit));
    used += __builtin_popcount(hit);
  }
  return used;
}

#endif

/// Appends the list of one cluster; returns the new length of out, or -1 where it might not fit.
GANNET_INLINE std::int64_t list_one(const ListJob& job, std::int32_t cluster, std::int64_t used) {
  const ClusterBox box = box_of(job, cluster);
  const double r = padded_radius(box);
  const auto r2 = static_cast<float>(r * r);
  const double w = job.width;
  const std::int32_t y0 = clamp_column((box.low[1] - r - job.y_min) / w, job.n_y);
  const std::int32_t y1 = clamp_column((box.high[1] + r - job.y_min) / w, job.n_y);
  const std::int32_t z0 = clamp_column((box.low[2] - r - job.z_min) / w, job.n_z);
  const std::int32_t z1 = clamp_column((box.high[2] + r - job.z_min) / w, job.n_z);
  for (std::int32_t iz = z0; iz <= z1; ++iz) {
    const double ez =
        gap_to_column(box.low[2], box.high[2], job.z_min + iz * w, w, iz == 0, iz == job.n_z - 1);
    for (std::int32_t iy = y0; iy <= y1; ++iy) {
      const double ey =
          gap_to_column(box.low[1], box.high[1], job.y_min + iy * w, w, iy == 0, iy == job.n_y - 1);
      const double left = r * r - ey * ey - ez * ez;
      if (left < 0) continue;
      const auto reach = static_cast<float>(__builtin_sqrt(left) + (r - box.radius));
      const std::int32_t* s = job.start + (iz * job.n_y + iy);
      const std::int32_t begin = lower_bound(job.x, s[0], s[1], box.low[0] - reach);
      const std::int32_t end = lower_bound(job.x, begin, s[1], box.high[0] + reach);
      if (used + (end - begin) + 32 > job.capacity) return -1;
      used = scan(job, box, r2, begin, end, used);
    }
  }
  return used;
}

}  // namespace

__attribute__((flatten)) ListProgress list_clusters(const ListJob& job) {
  ListProgress progress{job.first, 0};
  for (; progress.next < job.last; ++progress.next) {
    std::int64_t used = list_one(job, progress.next, progress.used);
    if (used < 0) return progress;
    if ((used - progress.used) % 2 != 0) job.out[used++] = job.filler;
    job.count[progress.next - job.first] = used - progress.used;
    progress.used = used;
  }
  return progress;
}

}  // namespace gannet::GANNET_ISA_NS
