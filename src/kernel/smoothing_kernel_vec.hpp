// The smoothing kernels for several distances at once; for files named *.isa.cpp only. V is Vec8
// (double precision) or Vec16 (single precision).
#pragma once

#include "base/simd.hpp"

namespace gannet::GANNET_ISA_NS {

/// Constants of one kernel of kernel/smoothing_kernel.hpp.
template <class V>
struct KernelVec {
  int type = 0;  ///< KernelType
  V inv_h;
  V f;  ///< in front of F: with sigma/h^2 where F is a polynomial of q, sigma/h where it is over q
  V w;  ///< in front of W

  /// h: smoothing length [m]; sigma: its normalisation [1/m^dimension].
  GANNET_INLINE KernelVec(int kernel_type, double h, double sigma) : type(kernel_type) {
    const double slope[4] = {-0.75 * h, -5.0, -7.0 / 3.0, -5.0 * h};
    const double value[4] = {0.25, 1.0, 1.0, 1.0};
    inv_h = V(1.0 / h);
    f = V(slope[type] * sigma / (h * h));
    w = V(value[type] * sigma);
  }
};

template <class V>
GANNET_INLINE V positive_part(V a) {
  return max(a, V(0.0));
}

/// w = 1/4 [(2-q)_+^3 - 4 (1-q)_+^3], dw/dq = -3/4 [(2-q)_+^2 - 4 (1-q)_+^2]
template <class V>
GANNET_INLINE V cubic_F(const KernelVec<V>& k, V r2, V* W) {
  const V inv_r = rsqrt(r2);
  const V q = r2 * inv_r * k.inv_h;
  const V a = positive_part(V(2.0) - q);
  const V b = positive_part(V(1.0) - q);
  const V a2 = a * a;
  const V b2 = b * b;
  if (W != nullptr) *W = k.w * fnma(V(4.0), b2 * b, a2 * a);
  return k.f * fnma(V(4.0), b2, a2) * inv_r;
}

/// w = a^4 (2 q + 1), (1/q) dw/dq = -5 a^3,  a = (1 - q/2)_+
template <class V>
GANNET_INLINE V wendland_c2_F(const KernelVec<V>& k, V r2, V* W) {
  const V q = r2 * rsqrt(r2) * k.inv_h;
  const V a = positive_part(fnma(V(0.5), q, V(1.0)));
  const V a2 = a * a;
  if (W != nullptr) *W = k.w * (a2 * a2) * fma(V(2.0), q, V(1.0));
  return k.f * (a2 * a);
}

/// w = a^6 (35/12 q^2 + 3 q + 1), (1/q) dw/dq = -7/3 (5 q + 2) a^5,  a = (1 - q/2)_+
template <class V>
GANNET_INLINE V wendland_c4_F(const KernelVec<V>& k, V r2, V* W) {
  const V q = r2 * rsqrt(r2) * k.inv_h;
  const V a = positive_part(fnma(V(0.5), q, V(1.0)));
  const V a2 = a * a;
  const V a4 = a2 * a2;
  if (W != nullptr) *W = k.w * (a4 * a2) * fma(fma(V(35.0 / 12.0), q, V(3.0)), q, V(1.0));
  return k.f * (a4 * a) * fma(V(5.0), q, V(2.0));
}

/// w = (3-q)_+^5 - 6 (2-q)_+^5 + 15 (1-q)_+^5, dw/dq = -5 [(3-q)_+^4 - 6 (2-q)_+^4 + 15 (1-q)_+^4]
template <class V>
GANNET_INLINE V quintic_F(const KernelVec<V>& k, V r2, V* W) {
  const V inv_r = rsqrt(r2);
  const V q = r2 * inv_r * k.inv_h;
  const V a = positive_part(V(3.0) - q);
  const V b = positive_part(V(2.0) - q);
  const V c = positive_part(V(1.0) - q);
  const V a4 = (a * a) * (a * a);
  const V b4 = (b * b) * (b * b);
  const V c4 = (c * c) * (c * c);
  if (W != nullptr) *W = k.w * fma(V(15.0), c4 * c, fnma(V(6.0), b4 * b, a4 * a));
  return k.f * fma(V(15.0), c4, fnma(V(6.0), b4, a4)) * inv_r;
}

/// F = (1/r) dW/dr and, where W is not null, W itself. Beyond the support both are 0: truncated
/// powers are the only branches. The type is the same for a whole pass.
/// r2: squared distances [m^2], positive (the caller lifts 0, where F r_ij = 0 whatever F is).
template <class V>
GANNET_INLINE V kernel_F(const KernelVec<V>& k, V r2, V* W) {
  if (k.type == 0) return cubic_F(k, r2, W);
  if (k.type == 1) return wendland_c2_F(k, r2, W);
  if (k.type == 2) return wendland_c4_F(k, r2, W);
  return quintic_F(k, r2, W);
}

}  // namespace gannet::GANNET_ISA_NS
