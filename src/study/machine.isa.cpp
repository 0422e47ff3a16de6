#include "study/machine.hpp"

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

namespace {

constexpr int n_chains = 16;

#ifdef __AVX512F__
using Floats = __m512;
GANNET_INLINE Floats set1(float a) { return _mm512_set1_ps(a); }
GANNET_INLINE Floats fma_ps(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
GANNET_INLINE void store(float* p, Floats a) { _mm512_storeu_ps(p, a); }
using Doubles = __m512d;
GANNET_INLINE Doubles set1d(double a) { return _mm512_set1_pd(a); }
GANNET_INLINE Doubles fma_pd(Doubles a, Doubles b, Doubles c) { return _mm512_fmadd_pd(a, b, c); }
GANNET_INLINE void store(double* p, Doubles a) { _mm512_storeu_pd(p, a); }
#else
using Floats = __m256;
GANNET_INLINE Floats set1(float a) { return _mm256_set1_ps(a); }
GANNET_INLINE Floats fma_ps(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }
GANNET_INLINE void store(float* p, Floats a) { _mm256_storeu_ps(p, a); }
using Doubles = __m256d;
GANNET_INLINE Doubles set1d(double a) { return _mm256_set1_pd(a); }
GANNET_INLINE Doubles fma_pd(Doubles a, Doubles b, Doubles c) { return _mm256_fmadd_pd(a, b, c); }
GANNET_INLINE void store(double* p, Doubles a) { _mm256_storeu_pd(p, a); }
#endif

}  // namespace

__attribute__((flatten)) double burn_fma_f64(long n, double* sink) {
  Doubles r[n_chains];
  for (int k = 0; k < n_chains; ++k) r[k] = set1d(1e-3 * k);
  const Doubles a = set1d(0.999);
  const Doubles b = set1d(1e-3);
  for (long i = 0; i < n; ++i) {
#pragma GCC unroll 16
    for (int k = 0; k < n_chains; ++k) r[k] = fma_pd(r[k], a, b);
  }
  for (int k = 0; k < n_chains; ++k) store(sink + 8 * k, r[k]);
  return 2.0 * static_cast<double>(n) * n_chains * (sizeof(Doubles) / sizeof(double));
}

__attribute__((flatten)) double burn_fma_f32(long n, float* sink) {
  Floats r[n_chains];
  for (int k = 0; k < n_chains; ++k) r[k] = set1(1e-3F * static_cast<float>(k));
  const Floats a = set1(0.999F);
  const Floats b = set1(1e-3F);
  for (long i = 0; i < n; ++i) {
#pragma GCC unroll 16
    for (int k = 0; k < n_chains; ++k) r[k] = fma_ps(r[k], a, b);
  }
  for (int k = 0; k < n_chains; ++k) store(sink + 16 * k, r[k]);
  return 2.0 * static_cast<double>(n) * n_chains * (sizeof(Floats) / sizeof(float));
}

__attribute__((flatten)) double triad(double* a, const double* b, const double* c, double s,
                                      long n) {
  const Vec8 scale(s);
  for (long i = 0; i + 8 <= n; i += 8) {
    fma(scale, Vec8::load(c + i), Vec8::load(b + i)).store(a + i);
  }
  return 24.0 * static_cast<double>(n);
}

}  // namespace gannet::GANNET_ISA_NS
