// As many doubles as one register of the instruction set holds, for files named *.isa.cpp only:
// eight with AVX-512, four with AVX2. Kernels that keep more numbers at hand than there are
// registers use it in place of Vec8 (base/simd.hpp), which takes two registers each with AVX2.
#pragma once

#include "base/simd_math.hpp"

namespace gannet::GANNET_ISA_NS {

#ifdef __AVX512F__

using Vec = Vec8;
using VecMask = Mask8;
inline constexpr int vec_lanes = 8;
GANNET_INLINE bool leaves_out(VecMask m) { return m != 0xff; }

#else

struct Vec {
  __m256d v;
  Vec() = default;
  GANNET_INLINE Vec(__m256d a) : v(a) {}
  GANNET_INLINE Vec(double a) : v(_mm256_set1_pd(a)) {}
  static GANNET_INLINE Vec load(const double* p) { return _mm256_load_pd(p); }
  GANNET_INLINE void store(double* p) const { _mm256_store_pd(p, v); }
};

struct VecMask {
  __m256d v;
};
inline constexpr int vec_lanes = 4;

GANNET_INLINE Vec operator+(Vec a, Vec b) { return _mm256_add_pd(a.v, b.v); }
GANNET_INLINE Vec operator-(Vec a, Vec b) { return _mm256_sub_pd(a.v, b.v); }
GANNET_INLINE Vec operator*(Vec a, Vec b) { return _mm256_mul_pd(a.v, b.v); }
GANNET_INLINE Vec operator/(Vec a, Vec b) { return _mm256_div_pd(a.v, b.v); }
GANNET_INLINE Vec operator-(Vec a) { return _mm256_sub_pd(_mm256_setzero_pd(), a.v); }
GANNET_INLINE Vec& operator+=(Vec& a, Vec b) { return a = a + b; }
GANNET_INLINE Vec& operator-=(Vec& a, Vec b) { return a = a - b; }
GANNET_INLINE Vec& operator*=(Vec& a, Vec b) { return a = a * b; }
GANNET_INLINE Vec fma(Vec a, Vec b, Vec c) { return _mm256_fmadd_pd(a.v, b.v, c.v); }
GANNET_INLINE Vec fnma(Vec a, Vec b, Vec c) { return _mm256_fnmadd_pd(a.v, b.v, c.v); }
GANNET_INLINE Vec max(Vec a, Vec b) { return _mm256_max_pd(a.v, b.v); }
GANNET_INLINE Vec min(Vec a, Vec b) { return _mm256_min_pd(a.v, b.v); }
GANNET_INLINE Vec sqrt(Vec a) { return _mm256_sqrt_pd(a.v); }
GANNET_INLINE VecMask less(Vec a, Vec b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)}; }
GANNET_INLINE Vec select(VecMask m, Vec yes, Vec no) { return _mm256_blendv_pd(no.v, yes.v, m.v); }
GANNET_INLINE bool any(VecMask m) { return _mm256_movemask_pd(m.v) != 0; }
/// Whether the mask leaves any lane out.
GANNET_INLINE bool leaves_out(VecMask m) { return _mm256_movemask_pd(m.v) != 15; }
GANNET_INLINE Vec rsqrt(Vec a) { return Vec(1.0) / sqrt(a); }
GANNET_INLINE Vec reciprocal(Vec a) { return Vec(1.0) / a; }
GANNET_INLINE void split(Vec a, Vec& m, Vec& e) { split(a.v, m.v, e.v); }
GANNET_INLINE Vec rounded(Vec a) {
  return _mm256_round_pd(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
GANNET_INLINE Vec times_power_of_two(Vec a, Vec n) { return times_power_of_two(a.v, n.v); }

#endif

#ifndef __AVX512F__
/// Sum of the lanes, always added in the same order.
GANNET_INLINE double sum(Vec a) {
  alignas(32) double t[4];
  a.store(t);
  return (t[0] + t[1]) + (t[2] + t[3]);
}

GANNET_INLINE Vec log_of(Vec a) { return log_of_lanes(a); }
GANNET_INLINE Vec exp_of(Vec a) { return exp_of_lanes(a); }

GANNET_INLINE void gather_lines(const double* base, const std::int32_t* index, int index_stride,
                                Vec out[4]) {
  __m256d r[4];
  for (int k = 0; k < 4; ++k) {
    r[k] = _mm256_load_pd(base + 4 * static_cast<std::int64_t>(index[k * index_stride]));
  }
  transpose_4x4(r[0], r[1], r[2], r[3], out[0].v, out[1].v, out[2].v, out[3].v);
}

GANNET_INLINE void scatter_add_lines(double* base, const std::int32_t* index, int index_stride,
                                     const Vec in[3]) {
  __m256d r[4];
  transpose_4x4(in[0].v, in[1].v, in[2].v, _mm256_setzero_pd(), r[0], r[1], r[2], r[3]);
  for (int k = 0; k < 4; ++k) {
    double* p = base + 4 * static_cast<std::int64_t>(index[k * index_stride]);
    _mm256_store_pd(p, _mm256_add_pd(_mm256_load_pd(p), r[k]));
  }
}
#endif

// Lines as they lie in memory: a vector holds the line of one index (AVX2) or of two (AVX-512: of
// index[0] in its lower half and of index[4] in its upper one), so that what combines the lines of
// one element is done before they are transposed, in few registers.

#ifdef __AVX512F__

/// Where the lines of index[0] and index[4] begin, in doubles.
struct LinePlace {
  std::int64_t low, high;
};

GANNET_INLINE LinePlace place_of_lines(const std::int32_t* index) {
  return {4 * static_cast<std::int64_t>(index[0]), 4 * static_cast<std::int64_t>(index[4])};
}

/// The lines of four doubles there.
GANNET_INLINE Vec load_lines(const double* base, LinePlace at) {
  const __m512d low = _mm512_castpd256_pd512(_mm256_load_pd(base + at.low));
  return _mm512_insertf64x4(low, _mm256_load_pd(base + at.high), 1);
}

/// Adds to them, to that of index[0] first.
GANNET_INLINE void add_lines(double* base, LinePlace at, Vec in) {
  double* low = base + at.low;
  double* high = base + at.high;
  _mm256_store_pd(low, _mm256_add_pd(_mm256_load_pd(low), _mm512_castpd512_pd256(in.v)));
  _mm256_store_pd(high, _mm256_add_pd(_mm256_load_pd(high), _mm512_extractf64x4_pd(in.v, 1)));
}

/// The first three components of four vectors of lines.
GANNET_INLINE void components_of(const Vec line[4], Vec c[3]) {
  const __m512d t0 = _mm512_unpacklo_pd(line[0].v, line[1].v);
  const __m512d t1 = _mm512_unpackhi_pd(line[0].v, line[1].v);
  const __m512d t2 = _mm512_unpacklo_pd(line[2].v, line[3].v);
  const __m512d t3 = _mm512_unpackhi_pd(line[2].v, line[3].v);
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  c[0] = _mm512_permutex2var_pd(t0, first, t2);
  c[1] = _mm512_permutex2var_pd(t1, first, t3);
  c[2] = _mm512_permutex2var_pd(t0, second, t2);
}

/// Four vectors of lines of three components; their fourth is 0.
GANNET_INLINE void lines_of(const Vec c[3], Vec line[4]) {
  const __m512d zero = _mm512_setzero_pd();
  const __m512d t0 = _mm512_unpacklo_pd(c[0].v, c[1].v);
  const __m512d t1 = _mm512_unpackhi_pd(c[0].v, c[1].v);
  const __m512d t2 = _mm512_unpacklo_pd(c[2].v, zero);
  const __m512d t3 = _mm512_unpackhi_pd(c[2].v, zero);
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  line[0] = _mm512_permutex2var_pd(t0, first, t2);
  line[1] = _mm512_permutex2var_pd(t1, first, t3);
  line[2] = _mm512_permutex2var_pd(t0, second, t2);
  line[3] = _mm512_permutex2var_pd(t1, second, t3);
}

#else

struct LinePlace {
  std::int64_t only;
};

GANNET_INLINE LinePlace place_of_lines(const std::int32_t* index) {
  return {4 * static_cast<std::int64_t>(index[0])};
}

GANNET_INLINE Vec load_lines(const double* base, LinePlace at) {
  return _mm256_load_pd(base + at.only);
}

GANNET_INLINE void add_lines(double* base, LinePlace at, Vec in) {
  double* p = base + at.only;
  _mm256_store_pd(p, _mm256_add_pd(_mm256_load_pd(p), in.v));
}

GANNET_INLINE void components_of(const Vec line[4], Vec c[3]) {
  __m256d fourth;
  transpose_4x4(line[0].v, line[1].v, line[2].v, line[3].v, c[0].v, c[1].v, c[2].v, fourth);
}

GANNET_INLINE void lines_of(const Vec c[3], Vec line[4]) {
  transpose_4x4(c[0].v, c[1].v, c[2].v, _mm256_setzero_pd(), line[0].v, line[1].v, line[2].v,
                line[3].v);
}

#endif

/// Vectors of lines that a vector of elements takes.
inline constexpr int line_vecs = 4;

}  // namespace gannet::GANNET_ISA_NS
