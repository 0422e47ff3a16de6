// Rubber at one point: stress from the deformation since the start alone. With F = dx/dX, J = det F
// and the isochoric left Cauchy-Green tensor B = J^(-2/3) F F^T, its invariants I1 = tr B and I2 =
// (I1^2 - B : B)/2, the energy per volume at the start is
//   W = C10 (I1 - 3) + C01 (I2 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3 + K/4 (J^2 - 1 - 2 ln J)
// which is neo-Hookean with C10 alone, Mooney-Rivlin (Mooney 1940; Rivlin 1948) with C01, and
// Yeoh's (1993, Rubber Chem. Technol. 66, 754-771) with C20 and C30. Cauchy's stress follows,
//   J dev sigma = 2 dev((W_1 + I1 W_2) B - W_2 B^2),  tr sigma/3 = K/2 (J - 1/J)
// with W_1, W_2 the derivatives of W by I1 and I2: it turns with F to rounding.
//
// For files compiled per instruction set: no Eigen, no standard containers.
#pragma once

#include "material/solid_stress.hpp"

namespace gannet {

/// The constants of the law, ready for use.
struct HyperelasticLaw {
  double C10 = 0, C01 = 0, C20 = 0, C30 = 0;  ///< [Pa]
  double bulk = 0;                            ///< K [Pa], > 0
};

/// What a deformation comes to.
template <class T>
struct HyperelasticStress {
  Symmetric<T> deviator;  ///< of Cauchy's stress [Pa]
  T energy;               ///< isochoric part of W [J/m^3]
  T shear;                ///< no direction is stiffer in shear than this, per volume now [Pa]
};

/// Mean stress of a change of volume [Pa]: K/2 (J - 1/J).
template <class T>
__attribute__((always_inline)) inline T volume_stress(const HyperelasticLaw& law, T J) {
  return T(0.5 * law.bulk) * (J - reciprocal(J));
}

/// Energy of a change of volume per volume at the start [J/m^3]: K/4 (J^2 - 1 - 2 ln J).
template <class T>
__attribute__((always_inline)) inline T volume_energy(const HyperelasticLaw& law, T J) {
  return T(0.25 * law.bulk) * (J * J - T(1.0) - T(2.0) * log_of(J));
}

/// Modulus of a change of volume, dp/d ln J [Pa]: K/2 (J + 1/J).
template <class T>
__attribute__((always_inline)) inline T volume_modulus(const HyperelasticLaw& law, T J) {
  return T(0.5 * law.bulk) * (J + reciprocal(J));
}

/// Largest eigenvalue of a symmetric tensor, at most: mean + sqrt(2/3) |deviator|.
template <class T>
__attribute__((always_inline)) inline T largest_principal_bound(const Symmetric<T>& s) {
  const T trace = s.xx + s.yy + s.zz;
  const T d2 = contraction(s, s) - T(1.0 / 3.0) * trace * trace;
  const T safe = select(less(d2, T(1e-60)), T(1e-60), d2);
  return T(1.0 / 3.0) * trace + T(0.81649658092772603) * safe * rsqrt(safe);
}

/// The isochoric part of the law.
/// b: F F^T of n, J: det F > 0. Throws nothing.
template <class T>
__attribute__((always_inline)) inline HyperelasticStress<T> isochoric(const HyperelasticLaw& law,
                                                                      const Symmetric<T>& b, T J) {
  const T inverse_J = reciprocal(J);
  const T shrink = exp_of(T(-2.0 / 3.0) * log_of(J));
  const Symmetric<T> B{b.xx * shrink, b.yy * shrink, b.zz * shrink,
                       b.xy * shrink, b.yz * shrink, b.zx * shrink};
  const T I1 = B.xx + B.yy + B.zz;
  const T BB = contraction(B, B);
  const T I2 = T(0.5) * (I1 * I1 - BB);
  const T i = I1 - T(3.0);
  const T W_1 = T(law.C10) + i * (T(2.0 * law.C20) + i * T(3.0 * law.C30));
  const T W_2 = T(law.C01);
  const T a = T(2.0) * (W_1 + I1 * W_2) * inverse_J;
  const T c = T(-2.0) * W_2 * inverse_J;
  const T mean = T(1.0 / 3.0) * (a * I1 + c * BB);
  // B^2, component by component.
  const Symmetric<T> B2{
      B.xx * B.xx + B.xy * B.xy + B.zx * B.zx, B.xy * B.xy + B.yy * B.yy + B.yz * B.yz,
      B.zx * B.zx + B.yz * B.yz + B.zz * B.zz, B.xx * B.xy + B.xy * B.yy + B.zx * B.yz,
      B.xy * B.zx + B.yy * B.yz + B.yz * B.zz, B.xx * B.zx + B.xy * B.yz + B.zx * B.zz};
  HyperelasticStress<T> r;
  r.deviator = {a * B.xx + c * B2.xx - mean, a * B.yy + c * B2.yy - mean,
                a * B.zz + c * B2.zz - mean, a * B.xy + c * B2.xy,
                a * B.yz + c * B2.yz,        a * B.zx + c * B2.zx};
  r.energy = i * (T(law.C10) + i * (T(law.C20) + i * T(law.C30))) + W_2 * (I2 - T(3.0));
  // A shear along n seen from m changes by 2 (W_1 + W_2 B_qq) B_nn and 4 W_11 (dev B)^2.
  const T largest = largest_principal_bound(B);
  const Symmetric<T> inverse{B2.xx - I1 * B.xx + I2, B2.yy - I1 * B.yy + I2, B2.zz - I1 * B.zz + I2,
                             B2.xy - I1 * B.xy,      B2.yz - I1 * B.yz,      B2.zx - I1 * B.zx};
  const T over = largest - T(1.0 / 3.0) * I1;
  const T bend = T(2.0 * law.C20) + i * T(6.0 * law.C30);
  const auto rises = less(T(0.0), bend);
  const auto stiff = less(T(0.0), W_1);
  r.shear = inverse_J * (T(2.0) * select(stiff, W_1, T(0.0)) * largest +
                         T(2.0) * W_2 * largest_principal_bound(inverse) +
                         T(4.0) * select(rises, bend, T(0.0)) * over * over);
  return r;
}

}  // namespace gannet
