// Eight doubles as one vector, for files named *.isa.cpp only. The type lives in the namespace of
// the instruction set it is compiled for (GANNET_ISA_NS), so that the two never mix.
#pragma once

#include <immintrin.h>

#include <cstdint>

#ifndef GANNET_ISA_NS
#error "base/simd.hpp is for files named *.isa.cpp, which the build compiles once per set"
#endif

#define GANNET_INLINE inline __attribute__((always_inline))

namespace gannet::GANNET_ISA_NS {

#ifdef __AVX512F__

/// Eight doubles in one register.
struct Vec8 {
  __m512d v;
  Vec8() = default;
  GANNET_INLINE Vec8(__m512d a) : v(a) {}
  GANNET_INLINE Vec8(double a) : v(_mm512_set1_pd(a)) {}
  static GANNET_INLINE Vec8 load(const double* p) { return _mm512_load_pd(p); }
  static GANNET_INLINE Vec8 load_unaligned(const double* p) { return _mm512_loadu_pd(p); }
  GANNET_INLINE void store(double* p) const { _mm512_store_pd(p, v); }
  GANNET_INLINE void store_unaligned(double* p) const { _mm512_storeu_pd(p, v); }
};

using Mask8 = __mmask8;

GANNET_INLINE Vec8 operator+(Vec8 a, Vec8 b) { return _mm512_add_pd(a.v, b.v); }
GANNET_INLINE Vec8 operator-(Vec8 a, Vec8 b) { return _mm512_sub_pd(a.v, b.v); }
GANNET_INLINE Vec8 operator*(Vec8 a, Vec8 b) { return _mm512_mul_pd(a.v, b.v); }
GANNET_INLINE Vec8 operator/(Vec8 a, Vec8 b) { return _mm512_div_pd(a.v, b.v); }
GANNET_INLINE Vec8 operator-(Vec8 a) { return _mm512_sub_pd(_mm512_setzero_pd(), a.v); }
/// a b + c, rounded once.
GANNET_INLINE Vec8 fma(Vec8 a, Vec8 b, Vec8 c) { return _mm512_fmadd_pd(a.v, b.v, c.v); }
/// c - a b, rounded once.
GANNET_INLINE Vec8 fnma(Vec8 a, Vec8 b, Vec8 c) { return _mm512_fnmadd_pd(a.v, b.v, c.v); }
GANNET_INLINE Vec8 max(Vec8 a, Vec8 b) { return _mm512_max_pd(a.v, b.v); }
GANNET_INLINE Vec8 min(Vec8 a, Vec8 b) { return _mm512_min_pd(a.v, b.v); }
GANNET_INLINE Vec8 sqrt(Vec8 a) { return _mm512_sqrt_pd(a.v); }
GANNET_INLINE Mask8 less(Vec8 a, Vec8 b) { return _mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ); }
/// yes where the mask is set, no elsewhere.
GANNET_INLINE Vec8 select(Mask8 m, Vec8 yes, Vec8 no) {
  return _mm512_mask_blend_pd(m, no.v, yes.v);
}
GANNET_INLINE bool any(Mask8 m) { return m != 0; }

/// 1/sqrt(a), a > 0, from a 14-bit estimate y and one step of fourth order: with e = 1 - a y^2,
/// |e| < 2^-13, y (1 + e/2 + 3/8 e^2 + 5/16 e^3) misses by e^4 (relative error below 1e-15). A
/// chain of five operations; two Newton steps are one of seven.
GANNET_INLINE Vec8 rsqrt(Vec8 a) {
  const Vec8 y = _mm512_rsqrt14_pd(a.v);
  const Vec8 e = fnma(a * y, y, Vec8(1.0));
  const Vec8 p = fma(fma(e, Vec8(0.3125), Vec8(0.375)), e, Vec8(0.5));
  return fma(y * e, p, y);
}

/// 1/a, a not 0, from a 14-bit estimate y: with e = 1 - a y, |e| < 2^-14, y (1 + e) (1 + e^2)
/// misses by e^4 (relative error below 1e-15).
GANNET_INLINE Vec8 reciprocal(Vec8 a) {
  const Vec8 y = _mm512_rcp14_pd(a.v);
  const Vec8 e = fnma(a, y, Vec8(1.0));
  const Vec8 z = fma(y, e, y);
  return fma(z, e * e, z);
}

#else

/// Eight doubles in two registers.
struct Vec8 {
  __m256d lo, hi;
  Vec8() = default;
  GANNET_INLINE Vec8(__m256d l, __m256d h) : lo(l), hi(h) {}
  GANNET_INLINE Vec8(double a) : lo(_mm256_set1_pd(a)), hi(lo) {}
  static GANNET_INLINE Vec8 load(const double* p) {
    return {_mm256_load_pd(p), _mm256_load_pd(p + 4)};
  }
  static GANNET_INLINE Vec8 load_unaligned(const double* p) {
    return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)};
  }
  GANNET_INLINE void store(double* p) const {
    _mm256_store_pd(p, lo);
    _mm256_store_pd(p + 4, hi);
  }
  GANNET_INLINE void store_unaligned(double* p) const {
    _mm256_storeu_pd(p, lo);
    _mm256_storeu_pd(p + 4, hi);
  }
};

struct Mask8 {
  __m256d lo, hi;
};

GANNET_INLINE Vec8 operator+(Vec8 a, Vec8 b) {
  return {_mm256_add_pd(a.lo, b.lo), _mm256_add_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 operator-(Vec8 a, Vec8 b) {
  return {_mm256_sub_pd(a.lo, b.lo), _mm256_sub_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 operator*(Vec8 a, Vec8 b) {
  return {_mm256_mul_pd(a.lo, b.lo), _mm256_mul_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 operator/(Vec8 a, Vec8 b) {
  return {_mm256_div_pd(a.lo, b.lo), _mm256_div_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 operator-(Vec8 a) {
  const __m256d zero = _mm256_setzero_pd();
  return {_mm256_sub_pd(zero, a.lo), _mm256_sub_pd(zero, a.hi)};
}
/// a b + c, rounded once.
GANNET_INLINE Vec8 fma(Vec8 a, Vec8 b, Vec8 c) {
  return {_mm256_fmadd_pd(a.lo, b.lo, c.lo), _mm256_fmadd_pd(a.hi, b.hi, c.hi)};
}
/// c - a b, rounded once.
GANNET_INLINE Vec8 fnma(Vec8 a, Vec8 b, Vec8 c) {
  return {_mm256_fnmadd_pd(a.lo, b.lo, c.lo), _mm256_fnmadd_pd(a.hi, b.hi, c.hi)};
}
GANNET_INLINE Vec8 max(Vec8 a, Vec8 b) {
  return {_mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 min(Vec8 a, Vec8 b) {
  return {_mm256_min_pd(a.lo, b.lo), _mm256_min_pd(a.hi, b.hi)};
}
GANNET_INLINE Vec8 sqrt(Vec8 a) { return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)}; }
GANNET_INLINE Mask8 less(Vec8 a, Vec8 b) {
  return {_mm256_cmp_pd(a.lo, b.lo, _CMP_LT_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_LT_OQ)};
}
/// yes where the mask is set, no elsewhere.
GANNET_INLINE Vec8 select(Mask8 m, Vec8 yes, Vec8 no) {
  return {_mm256_blendv_pd(no.lo, yes.lo, m.lo), _mm256_blendv_pd(no.hi, yes.hi, m.hi)};
}
GANNET_INLINE bool any(Mask8 m) {
  return (_mm256_movemask_pd(m.lo) | _mm256_movemask_pd(m.hi)) != 0;
}

/// 1/sqrt(a); a > 0.
GANNET_INLINE Vec8 rsqrt(Vec8 a) { return Vec8(1.0) / sqrt(a); }

/// 1/a; a not 0.
GANNET_INLINE Vec8 reciprocal(Vec8 a) { return Vec8(1.0) / a; }

#endif

GANNET_INLINE Vec8& operator+=(Vec8& a, Vec8 b) { return a = a + b; }
GANNET_INLINE Vec8& operator-=(Vec8& a, Vec8 b) { return a = a - b; }
GANNET_INLINE Vec8& operator*=(Vec8& a, Vec8 b) { return a = a * b; }

/// Each lane gets the one below it, the first gets `first`.
GANNET_INLINE Vec8 lanes_up(Vec8 a, double first) {
#ifdef __AVX512F__
  const __m512i v = _mm512_castpd_si512(a.v);
  const __m512i f = _mm512_castpd_si512(_mm512_set1_pd(first));
  return _mm512_castsi512_pd(_mm512_alignr_epi64(v, f, 7));
#else
  const __m256d turned_lo = _mm256_permute4x64_pd(a.lo, 0b10'01'00'11);
  const __m256d turned_hi = _mm256_permute4x64_pd(a.hi, 0b10'01'00'11);
  return {_mm256_blend_pd(turned_lo, _mm256_set1_pd(first), 1),
          _mm256_blend_pd(turned_hi, turned_lo, 1)};
#endif
}

/// Each lane gets the one above it, the last gets `last`.
GANNET_INLINE Vec8 lanes_down(Vec8 a, double last) {
#ifdef __AVX512F__
  const __m512i v = _mm512_castpd_si512(a.v);
  const __m512i l = _mm512_castpd_si512(_mm512_set1_pd(last));
  return _mm512_castsi512_pd(_mm512_alignr_epi64(l, v, 1));
#else
  const __m256d turned_lo = _mm256_permute4x64_pd(a.lo, 0b00'11'10'01);
  const __m256d turned_hi = _mm256_permute4x64_pd(a.hi, 0b00'11'10'01);
  return {_mm256_blend_pd(turned_lo, turned_hi, 8),
          _mm256_blend_pd(turned_hi, _mm256_set1_pd(last), 8)};
#endif
}

/// Sum of the eight lanes, always added in the same order.
GANNET_INLINE double sum(Vec8 a) {
  alignas(64) double t[8];
  a.store(t);
  return ((t[0] + t[1]) + (t[2] + t[3])) + ((t[4] + t[5]) + (t[6] + t[7]));
}

/// Smallest of the eight lanes.
GANNET_INLINE double smallest(Vec8 a) {
  alignas(64) double t[8];
  a.store(t);
  double m = t[0];
  for (int k = 1; k < 8; ++k) m = t[k] < m ? t[k] : m;
  return m;
}

/// Four lines of four doubles, transposed: c0..c3 hold component 0..3 of rows r0..r3.
GANNET_INLINE void transpose_4x4(__m256d r0, __m256d r1, __m256d r2, __m256d r3, __m256d& c0,
                                 __m256d& c1, __m256d& c2, __m256d& c3) {
  const __m256d t0 = _mm256_unpacklo_pd(r0, r1);
  const __m256d t1 = _mm256_unpackhi_pd(r0, r1);
  const __m256d t2 = _mm256_unpacklo_pd(r2, r3);
  const __m256d t3 = _mm256_unpackhi_pd(r2, r3);
  c0 = _mm256_permute2f128_pd(t0, t2, 0x20);
  c1 = _mm256_permute2f128_pd(t1, t3, 0x20);
  c2 = _mm256_permute2f128_pd(t0, t2, 0x31);
  c3 = _mm256_permute2f128_pd(t1, t3, 0x31);
}

#ifdef __AVX512F__

/// The lines at base + 4 low and base + 4 high, in the halves of a register.
GANNET_INLINE __m512d two_lines(const double* base, std::int32_t low, std::int32_t high) {
  const __m256d first = _mm256_load_pd(base + 4 * static_cast<std::int64_t>(low));
  const __m256d second = _mm256_load_pd(base + 4 * static_cast<std::int64_t>(high));
  return _mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1);
}

#endif

/// Gathers eight 32-byte lines (four doubles each) at base + 4 index[k]: out[c] holds component c
/// of the eight lines. base: 32-byte aligned.
GANNET_INLINE void gather_lines(const double* base, const std::int32_t* index, int index_stride,
                                Vec8 out[4]) {
#ifdef __AVX512F__
  const auto pair = [&](int low, int high) {
    return two_lines(base, index[low * index_stride], index[high * index_stride]);
  };
  // Lines are paired such that after the first round whole quarters have to be put in order.
  const __m512d l02 = pair(0, 2), l13 = pair(1, 3), l46 = pair(4, 6), l57 = pair(5, 7);
  const __m512d a = _mm512_unpacklo_pd(l02, l13);  // x0 x1 z0 z1 x2 x3 z2 z3
  const __m512d b = _mm512_unpackhi_pd(l02, l13);  // y0 y1 w0 w1 y2 y3 w2 w3
  const __m512d c = _mm512_unpacklo_pd(l46, l57);
  const __m512d d = _mm512_unpackhi_pd(l46, l57);
  out[0] = _mm512_shuffle_f64x2(a, c, 0b10'00'10'00);
  out[1] = _mm512_shuffle_f64x2(b, d, 0b10'00'10'00);
  out[2] = _mm512_shuffle_f64x2(a, c, 0b11'01'11'01);
  out[3] = _mm512_shuffle_f64x2(b, d, 0b11'01'11'01);
#else
  __m256d r[8];
  for (int k = 0; k < 8; ++k) {
    r[k] = _mm256_load_pd(base + 4 * static_cast<std::int64_t>(index[k * index_stride]));
  }
  transpose_4x4(r[0], r[1], r[2], r[3], out[0].lo, out[1].lo, out[2].lo, out[3].lo);
  transpose_4x4(r[4], r[5], r[6], r[7], out[0].hi, out[1].hi, out[2].hi, out[3].hi);
#endif
}

/// Adds lane k of in[0..2] to components 0..2 of the line at base + 4 index[k], k = 0..7 in order;
/// the fourth component is left as it is.
GANNET_INLINE void scatter_add_lines(double* base, const std::int32_t* index, int index_stride,
                                     const Vec8 in[3]) {
  __m256d r[8];
#ifdef __AVX512F__
  const __m512d zero = _mm512_setzero_pd();
  const __m512d a = _mm512_unpacklo_pd(in[0].v, in[1].v);  // x0 y0 x2 y2 x4 y4 x6 y6
  const __m512d b = _mm512_unpackhi_pd(in[0].v, in[1].v);  // x1 y1 x3 y3 x5 y5 x7 y7
  const __m512d c = _mm512_unpacklo_pd(in[2].v, zero);
  const __m512d d = _mm512_unpackhi_pd(in[2].v, zero);
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
  const __m512i last = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
  const auto put = [&r](__m512d two, int low, int high) {
    r[low] = _mm512_castpd512_pd256(two);
    r[high] = _mm512_extractf64x4_pd(two, 1);
  };
  put(_mm512_permutex2var_pd(a, first, c), 0, 2);
  put(_mm512_permutex2var_pd(b, first, d), 1, 3);
  put(_mm512_permutex2var_pd(a, last, c), 4, 6);
  put(_mm512_permutex2var_pd(b, last, d), 5, 7);
#else
  const __m256d zero = _mm256_setzero_pd();
  transpose_4x4(in[0].lo, in[1].lo, in[2].lo, zero, r[0], r[1], r[2], r[3]);
  transpose_4x4(in[0].hi, in[1].hi, in[2].hi, zero, r[4], r[5], r[6], r[7]);
#endif
  for (int k = 0; k < 8; ++k) {
    double* p = base + 4 * static_cast<std::int64_t>(index[k * index_stride]);
    _mm256_store_pd(p, _mm256_add_pd(_mm256_load_pd(p), r[k]));
  }
}

}  // namespace gannet::GANNET_ISA_NS
