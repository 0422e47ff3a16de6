// J2 plasticity with linear isotropic hardening in plane stress (sigma_zz = 0), at one point.
//
// The elastic predictor leaves the plane-stress subspace only through sigma_zz, which is held at
// zero, so the backward-Euler step can be written in the three components of the plane. With
// sigma = C (eps - eps_p) and d eps_p = s P sigma (P maps sigma to its deviator), C and P have the
// same eigenvectors, and each part of the trial stress only shrinks by its own factor:
//
//   a = sigma_xx + sigma_yy             a(s) = a_trial / (1 + s E / (3 (1 - nu)))
//   d = sigma_xx - sigma_yy, sigma_xy   d(s) = d_trial / (1 + 2 G s), sigma_xy alike
//   sigma_vm^2(s) = a^2/4 + 3 d^2/4 + 3 sigma_xy^2,   eps_p grows by (2/3) s sigma_vm(s)
//
// s solves sigma_vm(s) = Y + H (2/3) s sigma_vm(s), Y the yield stress before the step. Written as
//   F(s) = 1/sigma_vm(s) + (2 H / (3 Y)) s - 1/Y = 0
// F is increasing and concave (1/sigma_vm is a power mean, with exponent -2, of functions linear in
// s) and nearly straight, for a pure deviator exactly so. Halley's method from s = 0 triples the
// correct digits each time; two iterations leave an error of the ninth power of the overstress,
// which tests/unit/material measures. Far from the root (an overstress of 100 % and more, which no
// sound step makes) an iteration is Newton's instead, which a concave function keeps on the near
// side of the root: the answer stays finite and plastic there, if less exact.
//
// For files compiled per instruction set: no Eigen, no standard containers.
#pragma once

#include "material/scalar.hpp"

namespace gannet {

/// The constants of the law, ready for use.
struct PlaneStressLaw {
  double c11 = 0;         ///< E / (1 - nu^2) [Pa]
  double c12 = 0;         ///< nu E / (1 - nu^2) [Pa]
  double shear = 0;       ///< G [Pa]
  double mean_rate = 0;   ///< E / (3 (1 - nu)) [Pa]
  double yield = 0;       ///< initial yield stress sigma_y [Pa]
  double hardening = 0;   ///< d sigma_y / d eps_p [Pa], >= 0
  double compliance = 0;  ///< (1 - 2 nu) / E [1/Pa]: see through_thickness_strain()
};

/// Stress in the plane [Pa]; T is double or a vector of them.
template <class T>
struct PlaneStress {
  T xx, yy, xy;
};

/// Iterations of the return; the overstress of an explicit step is small, see above.
inline constexpr int n_return_iterations = 2;

/// Adds the elastic answer to a strain increment.
///   d sigma = C d eps, plane stress; gxy is the engineering shear strain 2 eps_xy
/// exx, eyy, gxy: strain increments [-]. Throws nothing.
template <class T>
__attribute__((always_inline)) inline void add_elastic(const PlaneStressLaw& law, T exx, T eyy,
                                                       T gxy, PlaneStress<T>& sigma) {
  sigma.xx = sigma.xx + T(law.c11) * exx + T(law.c12) * eyy;
  sigma.yy = sigma.yy + T(law.c12) * exx + T(law.c11) * eyy;
  sigma.xy = sigma.xy + T(law.shear) * gxy;
}

/// Square of von Mises' equivalent stress in plane stress [Pa^2].
///   sigma_vm^2 = sigma_xx^2 - sigma_xx sigma_yy + sigma_yy^2 + 3 sigma_xy^2
template <class T>
__attribute__((always_inline)) inline T von_mises_squared(const PlaneStress<T>& sigma) {
  return sigma.xx * sigma.xx - sigma.xx * sigma.yy + sigma.yy * sigma.yy +
         T(3.0) * sigma.xy * sigma.xy;
}

/// Returns a trial stress to the yield surface, where it lies outside, and gives the increment of
/// the equivalent plastic strain [-] (0 where it lies inside). The equations stand at the top.
/// sigma: trial stress in, stress out [Pa]; Y: yield stress before the step [Pa], > 0.
/// Throws nothing.
template <class T>
__attribute__((always_inline)) inline T return_to_yield(const PlaneStressLaw& law, T Y,
                                                        PlaneStress<T>& sigma) {
  const T a = sigma.xx + sigma.yy;
  const T d = sigma.xx - sigma.yy;
  const T c_a = T(0.25) * a * a;
  const T c_d = T(0.75) * d * d + T(3.0) * sigma.xy * sigma.xy;
  const auto yields = less(Y * Y, c_a + c_d);
  // Points that do not yield solve a harmless problem whose answer is thrown away.
  const T mean = select(yields, c_a, T(0.0));
  const T dev = select(yields, c_d, Y * Y);
  const T k_a = T(law.mean_rate);
  const T k_d = T(2.0 * law.shear);
  const T hard = T(law.hardening * (2.0 / 3.0));
  const T inverse_Y = reciprocal(Y);

  T s = T(0.0);
  T shrink_a = T(1.0);
  T shrink_d = T(1.0);
  for (int i = 0; i < n_return_iterations; ++i) {
    // vm2 = sigma_vm^2; its first and second derivative by s are -2 fall and 6 bend.
    const T part_a = mean * shrink_a * shrink_a;
    const T part_d = dev * shrink_d * shrink_d;
    const T rate_a = k_a * shrink_a;
    const T rate_d = k_d * shrink_d;
    const T vm2 = part_a + part_d;
    const T inverse_vm = rsqrt(vm2);
    const T vm_over_Y = vm2 * inverse_vm * inverse_Y;
    const T inverse_vm2 = inverse_vm * inverse_vm;
    const T fall = (rate_a * part_a + rate_d * part_d) * inverse_vm2;
    const T bend = (rate_a * rate_a * part_a + rate_d * rate_d * part_d) * inverse_vm2;
    // F, F' and F'', all times sigma_vm.
    const T F = T(1.0) + vm_over_Y * (hard * s - T(1.0));
    const T F_s = fall + hard * vm_over_Y;
    const T F_ss = select(less(F, T(-0.5)), T(0.0), T(3.0) * (fall * fall - bend));
    s = s - T(2.0) * F * F_s * reciprocal(T(2.0) * F_s * F_s - F * F_ss);
    const T grown_a = T(1.0) + k_a * s;
    const T grown_d = T(1.0) + k_d * s;
    const T both = reciprocal(grown_a * grown_d);
    shrink_a = grown_d * both;
    shrink_d = grown_a * both;
  }
  // At the root sigma_vm = Y / (1 - (2/3) H s).
  const T vm = Y * reciprocal(T(1.0) - hard * s);
  const T new_a = a * shrink_a;
  const T new_d = d * shrink_d;
  sigma.xx = select(yields, T(0.5) * (new_a + new_d), sigma.xx);
  sigma.yy = select(yields, T(0.5) * (new_a - new_d), sigma.yy);
  sigma.xy = select(yields, sigma.xy * shrink_d, sigma.xy);
  return select(yields, T(2.0 / 3.0) * s * vm, T(0.0));
}

/// Strain increment through the thickness that keeps sigma_zz = 0 [-].
///   d eps_zz = -(d eps_xx + d eps_yy) + (1 - 2 nu)/E (d sigma_xx + d sigma_yy)
/// because plastic flow keeps the volume and the elastic change of volume is (1 - 2 nu)/E
/// tr(sigma). exx, eyy: total strain increments [-]; dsxx, dsyy: stress increments [Pa]. Throws
/// nothing.
template <class T>
__attribute__((always_inline)) inline T through_thickness_strain(const PlaneStressLaw& law, T exx,
                                                                 T eyy, T dsxx, T dsyy) {
  return T(law.compliance) * (dsxx + dsyy) - (exx + eyy);
}

}  // namespace gannet
