// The smoothing kernels that a case can choose from, behind one set of functions.
//
//   W(r) = sigma w(r/h),  grad_i W_ij = F(r) r_ij,  r_ij = x_i - x_j,  F = (1/r) dW/dr <= 0
// sigma makes the integral of W over the space 1.
#pragma once

#include <cassert>

#include "kernel/cubic_spline.hpp"
#include "kernel/quintic_spline.hpp"
#include "kernel/wendland.hpp"

namespace gannet {

/// In the order of the words of `parts.*.sph.kernel`.
enum class KernelType : int { cubic_spline, wendland_c2, wendland_c4, quintic_spline };

/// A kernel for one smoothing length. Functions take the distance r [m], not negative.
struct SmoothingKernel {
  KernelType type = KernelType::cubic_spline;
  int dimension = 3;  ///< 1, 2 or 3
  double h = 0;       ///< smoothing length [m], positive

  /// Radius of the support [m].
  [[nodiscard]] double reach() const;
  /// The factor sigma [1/m^dimension].
  [[nodiscard]] double normalisation() const;
  /// W(r) [1/m^dimension].
  [[nodiscard]] double W(double r) const;
  /// F(r) = (1/r) dW/dr [1/m^(dimension + 2)], finite at r = 0.
  [[nodiscard]] double F(double r) const;
};

/// Radius of the support over h [-].
inline double support(KernelType type) {
  return type == KernelType::quintic_spline ? quintic_spline::support : cubic_spline::support;
}

/// What h over the spacing is where a case does not say [-]: sums over a lattice are right to a
/// percent or better, and a lattice under pressure keeps its order, or gives way slowly
/// (`tests/convergence/lattice_stability.cpp`). About 20 neighbours in the plane for the cubic
/// spline.
inline double usual_smoothing_ratio(KernelType type, int dimension) {
  switch (type) {
    case KernelType::cubic_spline:
      return dimension == 2 ? 1.25 : 1.3;
    case KernelType::wendland_c2:
      return 1.5;
    case KernelType::wendland_c4:
      return 1.7;
    case KernelType::quintic_spline:
      return dimension == 2 ? 1.25 : 1.0;
  }
  return 1.3;
}

inline double SmoothingKernel::reach() const { return support(type) * h; }

inline double SmoothingKernel::normalisation() const {
  assert(dimension >= 1 && dimension <= 3 && h > 0);
  switch (type) {
    case KernelType::cubic_spline:
      return cubic_spline::normalisation(dimension, h);
    case KernelType::wendland_c2:
      return wendland_c2::normalisation(dimension, h);
    case KernelType::wendland_c4:
      return wendland_c4::normalisation(dimension, h);
    case KernelType::quintic_spline:
      return quintic_spline::normalisation(dimension, h);
  }
  return 0;
}

inline double SmoothingKernel::W(double r) const {
  switch (type) {
    case KernelType::cubic_spline:
      return cubic_spline::W(dimension, r, h);
    case KernelType::wendland_c2:
      return normalisation() * wendland_c2::w(r / h);
    case KernelType::wendland_c4:
      return normalisation() * wendland_c4::w(r / h);
    case KernelType::quintic_spline:
      return normalisation() * quintic_spline::w(r / h);
  }
  return 0;
}

inline double SmoothingKernel::F(double r) const {
  const double scale = normalisation() / (h * h);
  switch (type) {
    case KernelType::cubic_spline:
      return cubic_spline::F(dimension, r, h);
    case KernelType::wendland_c2:
      return scale * wendland_c2::slope_by_q(r / h);
    case KernelType::wendland_c4:
      return scale * wendland_c4::slope_by_q(r / h);
    case KernelType::quintic_spline:
      return scale * quintic_spline::slope_by_q(r / h);
  }
  return 0;
}

}  // namespace gannet
