// Sixteen floats as one vector, for files named *.isa.cpp only; see base/simd.hpp. Pair kernels use
// it as eight lanes twice: the same eight targets in both halves, another source in each.
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

#ifdef __AVX512F__

struct Vec16 {
  __m512 v;
  Vec16() = default;
  GANNET_INLINE Vec16(__m512 a) : v(a) {}
  GANNET_INLINE Vec16(double a) : v(_mm512_set1_ps(static_cast<float>(a))) {}
  /// Eight floats, the same in both halves.
  static GANNET_INLINE Vec16 twice(const float* p) {
    const __m512 a = _mm512_castps256_ps512(_mm256_loadu_ps(p));
    return _mm512_shuffle_f32x4(a, a, 0x44);
  }
  /// a in the lanes of the first half, b in those of the second.
  static GANNET_INLINE Vec16 pair(float a, float b) {
    return _mm512_mask_blend_ps(0xff00, _mm512_set1_ps(a), _mm512_set1_ps(b));
  }
  /// The sum of both halves, as doubles.
  GANNET_INLINE void store_sum(double* p) const {
    const __m256 low = _mm512_castps512_ps256(v);
    const __m256 high = _mm512_extractf32x8_ps(v, 1);
    _mm512_store_pd(p, _mm512_add_pd(_mm512_cvtps_pd(low), _mm512_cvtps_pd(high)));
  }
};

/// Sixteen whole numbers, for differences without rounding.
struct Int16 {
  __m512i v;
  static GANNET_INLINE Int16 twice(const std::int32_t* p) {
    const __m512i a =
        _mm512_castsi256_si512(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)));
    return {_mm512_shuffle_i32x4(a, a, 0x44)};
  }
  static GANNET_INLINE Int16 pair(std::int32_t a, std::int32_t b) {
    return {_mm512_mask_blend_epi32(0xff00, _mm512_set1_epi32(a), _mm512_set1_epi32(b))};
  }
};

/// a - b as floats.
GANNET_INLINE Vec16 difference(Int16 a, Int16 b) {
  return _mm512_cvtepi32_ps(_mm512_sub_epi32(a.v, b.v));
}

GANNET_INLINE Vec16 operator+(Vec16 a, Vec16 b) { return _mm512_add_ps(a.v, b.v); }
GANNET_INLINE Vec16 operator-(Vec16 a, Vec16 b) { return _mm512_sub_ps(a.v, b.v); }
GANNET_INLINE Vec16 operator*(Vec16 a, Vec16 b) { return _mm512_mul_ps(a.v, b.v); }
GANNET_INLINE Vec16 fma(Vec16 a, Vec16 b, Vec16 c) { return _mm512_fmadd_ps(a.v, b.v, c.v); }
GANNET_INLINE Vec16 fnma(Vec16 a, Vec16 b, Vec16 c) { return _mm512_fnmadd_ps(a.v, b.v, c.v); }
GANNET_INLINE Vec16 max(Vec16 a, Vec16 b) { return _mm512_max_ps(a.v, b.v); }
GANNET_INLINE Vec16 min(Vec16 a, Vec16 b) { return _mm512_min_ps(a.v, b.v); }

/// 1/sqrt(a), a > 0: a 14-bit estimate and one Newton step (relative error below 2e-7).
GANNET_INLINE Vec16 rsqrt(Vec16 a) {
  const Vec16 y = _mm512_rsqrt14_ps(a.v);
  const Vec16 e = fnma(a * y, y, Vec16(1.0));
  return fma(y * e, Vec16(0.5), y);
}

/// 1/a, a not 0: a 14-bit estimate and one Newton step.
GANNET_INLINE Vec16 reciprocal(Vec16 a) {
  const Vec16 y = _mm512_rcp14_ps(a.v);
  return fma(y, fnma(a, y, Vec16(1.0)), y);
}

#else

struct Vec16 {
  __m256 lo, hi;
  Vec16() = default;
  GANNET_INLINE Vec16(__m256 l, __m256 h) : lo(l), hi(h) {}
  GANNET_INLINE Vec16(double a) : lo(_mm256_set1_ps(static_cast<float>(a))), hi(lo) {}
  static GANNET_INLINE Vec16 twice(const float* p) {
    const __m256 a = _mm256_loadu_ps(p);
    return {a, a};
  }
  static GANNET_INLINE Vec16 pair(float a, float b) {
    return {_mm256_set1_ps(a), _mm256_set1_ps(b)};
  }
  GANNET_INLINE void store_sum(double* p) const {
    for (int half = 0; half < 2; ++half) {
      const __m128 low = half == 0 ? _mm256_castps256_ps128(lo) : _mm256_extractf128_ps(lo, 1);
      const __m128 high = half == 0 ? _mm256_castps256_ps128(hi) : _mm256_extractf128_ps(hi, 1);
      _mm256_store_pd(p + 4 * half, _mm256_add_pd(_mm256_cvtps_pd(low), _mm256_cvtps_pd(high)));
    }
  }
};

struct Int16 {
  __m256i lo, hi;
  static GANNET_INLINE Int16 twice(const std::int32_t* p) {
    const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    return {a, a};
  }
  static GANNET_INLINE Int16 pair(std::int32_t a, std::int32_t b) {
    return {_mm256_set1_epi32(a), _mm256_set1_epi32(b)};
  }
};

GANNET_INLINE Vec16 difference(Int16 a, Int16 b) {
  return {_mm256_cvtepi32_ps(_mm256_sub_epi32(a.lo, b.lo)),
          _mm256_cvtepi32_ps(_mm256_sub_epi32(a.hi, b.hi))};
}

GANNET_INLINE Vec16 operator+(Vec16 a, Vec16 b) {
  return {_mm256_add_ps(a.lo, b.lo), _mm256_add_ps(a.hi, b.hi)};
}
GANNET_INLINE Vec16 operator-(Vec16 a, Vec16 b) {
  return {_mm256_sub_ps(a.lo, b.lo), _mm256_sub_ps(a.hi, b.hi)};
}
GANNET_INLINE Vec16 operator*(Vec16 a, Vec16 b) {
  return {_mm256_mul_ps(a.lo, b.lo), _mm256_mul_ps(a.hi, b.hi)};
}
GANNET_INLINE Vec16 fma(Vec16 a, Vec16 b, Vec16 c) {
  return {_mm256_fmadd_ps(a.lo, b.lo, c.lo), _mm256_fmadd_ps(a.hi, b.hi, c.hi)};
}
GANNET_INLINE Vec16 fnma(Vec16 a, Vec16 b, Vec16 c) {
  return {_mm256_fnmadd_ps(a.lo, b.lo, c.lo), _mm256_fnmadd_ps(a.hi, b.hi, c.hi)};
}
GANNET_INLINE Vec16 max(Vec16 a, Vec16 b) {
  return {_mm256_max_ps(a.lo, b.lo), _mm256_max_ps(a.hi, b.hi)};
}
GANNET_INLINE Vec16 min(Vec16 a, Vec16 b) {
  return {_mm256_min_ps(a.lo, b.lo), _mm256_min_ps(a.hi, b.hi)};
}

/// 1/sqrt(a), a > 0: a 12-bit estimate and one Newton step (relative error below 5e-7).
GANNET_INLINE Vec16 rsqrt(Vec16 a) {
  const Vec16 y{_mm256_rsqrt_ps(a.lo), _mm256_rsqrt_ps(a.hi)};
  const Vec16 e = fnma(a * y, y, Vec16(1.0));
  return fma(y * e, Vec16(0.5), y);
}

/// 1/a, a not 0: a 12-bit estimate and one Newton step.
GANNET_INLINE Vec16 reciprocal(Vec16 a) {
  const Vec16 y{_mm256_rcp_ps(a.lo), _mm256_rcp_ps(a.hi)};
  return fma(y, fnma(a, y, Vec16(1.0)), y);
}

#endif

}  // namespace gannet::GANNET_ISA_NS
