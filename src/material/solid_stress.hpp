// Isotropic elasticity and J2 plasticity with linear isotropic hardening in three dimensions, at
// one point.
//
//   d sigma = K tr(d eps) I + 2 G dev(d eps),  yields where sigma_vm > Y = sigma_y + H eps_p
//
// The backward-Euler step in three dimensions is a radial return in closed form (Wilkins 1964; Simo
// & Hughes 1998, Computational Inelasticity, box 3.1): with sigma_vm of the trial stress
//   d eps_p = (sigma_vm - Y) / (3 G + H),  dev sigma = (1 - 3 G d eps_p / sigma_vm) dev sigma_trial
//
// For files compiled per instruction set: no Eigen, no standard containers.
#pragma once

#include "material/scalar.hpp"

namespace gannet {

/// The constants of the law, ready for use.
struct SolidLaw {
  double bulk = 0;       ///< K = E / (3 (1 - 2 nu)) [Pa]
  double shear = 0;      ///< G [Pa]
  double yield = 0;      ///< initial yield stress sigma_y [Pa]
  double hardening = 0;  ///< d sigma_y / d eps_p [Pa], >= 0
};

/// Six components of a symmetric tensor: stress [Pa], or strain [-] with xy ... as tensor
/// components (half the engineering shear). T is double or a vector of them.
template <class T>
struct Symmetric {
  T xx, yy, zz, xy, yz, zx;
};

/// a : b of two symmetric tensors.
template <class T>
__attribute__((always_inline)) inline T contraction(const Symmetric<T>& a, const Symmetric<T>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz +
         T(2.0) * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

/// Adds the elastic answer to a strain increment.
///   d sigma = (K - 2 G/3) tr(e) I + 2 G e
/// e: strain increment [-]. Throws nothing.
template <class T>
__attribute__((always_inline)) inline void add_elastic(const SolidLaw& law, const Symmetric<T>& e,
                                                       Symmetric<T>& sigma) {
  const T two_G = T(2.0 * law.shear);
  const T pressure = T(law.bulk - 2.0 / 3.0 * law.shear) * (e.xx + e.yy + e.zz);
  sigma.xx = sigma.xx + two_G * e.xx + pressure;
  sigma.yy = sigma.yy + two_G * e.yy + pressure;
  sigma.zz = sigma.zz + two_G * e.zz + pressure;
  sigma.xy = sigma.xy + two_G * e.xy;
  sigma.yz = sigma.yz + two_G * e.yz;
  sigma.zx = sigma.zx + two_G * e.zx;
}

/// Square of von Mises' equivalent stress [Pa^2].
///   sigma_vm^2 = 3/2 dev sigma : dev sigma
template <class T>
__attribute__((always_inline)) inline T von_mises_squared(const Symmetric<T>& s) {
  const T xy = s.xx - s.yy;
  const T yz = s.yy - s.zz;
  const T zx = s.zz - s.xx;
  return T(0.5) * (xy * xy + yz * yz + zx * zx) +
         T(3.0) * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
}

/// Returns a trial stress to the yield surface, where it lies outside, and gives the increment of
/// the equivalent plastic strain [-] (0 where it lies inside). The equations stand at the top.
/// sigma: trial stress in, stress out [Pa]; Y: yield stress before the step [Pa], > 0.
/// Throws nothing.
template <class T>
__attribute__((always_inline)) inline T return_to_yield(const SolidLaw& law, T Y,
                                                        Symmetric<T>& sigma) {
  const T vm2 = von_mises_squared(sigma);
  const auto yields = less(Y * Y, vm2);
  const T inverse_vm = rsqrt(select(yields, vm2, Y * Y));
  const T vm = vm2 * inverse_vm;
  const T d_eps = select(yields, (vm - Y) * T(1.0 / (3.0 * law.shear + law.hardening)), T(0.0));
  const T keep = T(1.0) - T(3.0 * law.shear) * d_eps * inverse_vm;
  const T mean = T(1.0 / 3.0) * (sigma.xx + sigma.yy + sigma.zz);
  const T lost = (T(1.0) - keep) * mean;
  sigma.xx = keep * sigma.xx + lost;
  sigma.yy = keep * sigma.yy + lost;
  sigma.zz = keep * sigma.zz + lost;
  sigma.xy = keep * sigma.xy;
  sigma.yz = keep * sigma.yz;
  sigma.zx = keep * sigma.zx;
  return d_eps;
}

}  // namespace gannet
