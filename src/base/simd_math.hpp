// Logarithm and exponential of the doubles of a vector, for files named *.isa.cpp only. No table,
// no library: the same bits on every machine that has the instruction set. The relative error of
// both is 1.7e-16 at most (tests/unit/base/simd_math.cpp).
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

#ifdef __AVX512F__

/// e and m of a = m 2^e, 1 <= m < 2; a > 0, no denormal.
GANNET_INLINE void split(Vec8 a, Vec8& m, Vec8& e) {
  m = _mm512_getmant_pd(a.v, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_zero);
  e = _mm512_getexp_pd(a.v);
}
/// The nearest whole number.
GANNET_INLINE Vec8 rounded(Vec8 a) {
  return _mm512_roundscale_pd(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
/// a 2^n; n a whole number, the result no denormal.
GANNET_INLINE Vec8 times_power_of_two(Vec8 a, Vec8 n) { return _mm512_scalef_pd(a.v, n.v); }

#else

GANNET_INLINE void split(__m256d a, __m256d& m, __m256d& e) {
  const __m256i bits = _mm256_castpd_si256(a);
  const __m256i one = _mm256_castpd_si256(_mm256_set1_pd(1.0));
  const __m256i digits = _mm256_set1_epi64x(0x000fffffffffffffLL);
  m = _mm256_castsi256_pd(_mm256_or_si256(_mm256_and_si256(bits, digits), one));
  // The exponent put behind that of 2^52, whose last digit counts ones.
  const __m256d base = _mm256_set1_pd(4503599627370496.0);
  const __m256i biased = _mm256_or_si256(_mm256_srli_epi64(bits, 52), _mm256_castpd_si256(base));
  e = _mm256_sub_pd(_mm256_castsi256_pd(biased), _mm256_set1_pd(4503599627370496.0 + 1023.0));
}
/// e and m of a = m 2^e, 1 <= m < 2; a > 0, no denormal.
GANNET_INLINE void split(Vec8 a, Vec8& m, Vec8& e) {
  split(a.lo, m.lo, e.lo);
  split(a.hi, m.hi, e.hi);
}
/// The nearest whole number.
GANNET_INLINE Vec8 rounded(Vec8 a) {
  constexpr int nearest = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
  return {_mm256_round_pd(a.lo, nearest), _mm256_round_pd(a.hi, nearest)};
}
GANNET_INLINE __m256d times_power_of_two(__m256d a, __m256d n) {
  const __m256i count = _mm256_castpd_si256(_mm256_add_pd(n, _mm256_set1_pd(6755399441055744.0)));
  return _mm256_castsi256_pd(
      _mm256_add_epi64(_mm256_castpd_si256(a), _mm256_slli_epi64(count, 52)));
}
/// a 2^n; n a whole number, the result no denormal.
GANNET_INLINE Vec8 times_power_of_two(Vec8 a, Vec8 n) {
  return {times_power_of_two(a.lo, n.lo), times_power_of_two(a.hi, n.hi)};
}

#endif

/// c_0 + c_1 x + c_2 x^2 ..., pairs first, then pairs of pairs (Estrin): a chain of log2 of the
/// number of terms, where Horner's is as long as there are terms.
template <class V, int n>
GANNET_INLINE V polynomial(const double (&c)[n], V x) {
  V term[n];
  for (int k = 0; k < n; ++k) term[k] = V(c[k]);
  V power = x;
#pragma GCC unroll 4
  for (int left = n; left > 1; left = (left + 1) / 2) {
    for (int k = 0; k < left / 2; ++k) term[k] = fma(term[2 * k + 1], power, term[2 * k]);
    if (left % 2 == 1) term[left / 2] = term[left - 1];
    power = power * power;
  }
  return term[0];
}

/// Natural logarithm; a > 0, no denormal.
///   a = m 2^e with m in [0.7, 1.4], z = (m - 1)/(m + 1): ln a = e ln 2 + 2 z (1 + z^2/3 + z^4/5
///   ...)
template <class V>
GANNET_INLINE V log_of_lanes(V a) {
  V m;
  V e;
  split(a, m, e);
  const auto large = less(V(1.4142135623730951), m);
  m = select(large, V(0.5) * m, m);
  e = select(large, e + V(1.0), e);
  const V f = m - V(1.0);
  const V z = f / (m + V(1.0));
  const V w = z * z;
  constexpr double odd[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                            1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
  const V p = polynomial(odd, w);
  // 2 z = f - f z, so that the leading term is exact; ln 2 in two parts, the first of 32 bits.
  const V rest = z * fma(V(2.0) * w, p, -f);
  return fma(e, V(0x1.62e42fefp-1), f + fma(e, V(0x1.473de6af278edp-34), rest));
}

/// e^a; a within +-700.
///   a = n ln 2 + r, |r| < 0.35: 2^n (1 + r + r^2/2 + ... + r^13/13!)
template <class V>
GANNET_INLINE V exp_of_lanes(V a) {
  const V n = rounded(a * V(1.4426950408889634));
  const V r = fnma(n, V(0x1.473de6af278edp-34), fnma(n, V(0x1.62e42fefp-1), a));
  constexpr double inverse_factorial[] = {1.0 / 2,        1.0 / 6,         1.0 / 24,
                                          1.0 / 120,      1.0 / 720,       1.0 / 5040,
                                          1.0 / 40320,    1.0 / 362880,    1.0 / 3628800,
                                          1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800.0};
  const V p = polynomial(inverse_factorial, r);
  return times_power_of_two(fma(p * r, r, r) + V(1.0), n);
}

GANNET_INLINE Vec8 log_of(Vec8 a) { return log_of_lanes(a); }
GANNET_INLINE Vec8 exp_of(Vec8 a) { return exp_of_lanes(a); }

}  // namespace gannet::GANNET_ISA_NS
