// The cubic spline kernel for eight distances at once; for files named *.isa.cpp only.
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

/// Constants of the cubic spline of kernel/cubic_spline.hpp for one h.
struct CubicSpline8 {
  Vec8 inv_h;
  Vec8 f_far;   ///< -3/4 sigma/h, times max(2 - q, 0)^2
  Vec8 f_near;  ///< 3 sigma/h, times max(1 - q, 0)^2
  Vec8 w_far;   ///< sigma/4, times max(2 - q, 0)^3
  Vec8 w_near;  ///< -sigma, times max(1 - q, 0)^3
};

/// h: smoothing length [m]; sigma: cubic_spline::normalisation(dimension, h) [1/m^dimension].
GANNET_INLINE CubicSpline8 cubic_spline_8(double h, double sigma) {
  return {Vec8(1.0 / h), Vec8(-0.75 * sigma / h), Vec8(3.0 * sigma / h), Vec8(0.25 * sigma),
          Vec8(-sigma)};
}

/// F = (1/r) dW/dr and, where W is not null, W itself, of eight pairs. Beyond 2 h both are 0: the
/// two cut-offs of the spline are its only branches.
/// r2: squared distances [m^2], positive (the caller lifts 0, where F r_ij = 0 whatever F is).
GANNET_INLINE Vec8 spline_F(const CubicSpline8& s, Vec8 r2, Vec8* W) {
  const Vec8 inv_r = rsqrt(r2);
  const Vec8 q = r2 * inv_r * s.inv_h;
  const Vec8 a = max(Vec8(2.0) - q, Vec8(0.0));
  const Vec8 b = max(Vec8(1.0) - q, Vec8(0.0));
  const Vec8 a2 = a * a;
  const Vec8 b2 = b * b;
  if (W != nullptr) *W = fma(s.w_far, a2 * a, s.w_near * (b2 * b));
  return fma(s.f_far, a2, s.f_near * b2) * inv_r;
}

}  // namespace gannet::GANNET_ISA_NS
