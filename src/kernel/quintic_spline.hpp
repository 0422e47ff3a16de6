// The quintic spline: smoother than the cubic one, and with a support of 3 h dearer.
//
//   w = (3 - q)_+^5 - 6 (2 - q)_+^5 + 15 (1 - q)_+^5,  q = r/h
//   W = sigma w(q), F = (1/r) dW/dr
// Morris, Fox and Zhu 1997, J. Comput. Phys. 136, 214.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gannet::quintic_spline {

inline constexpr double support = 3.0;

/// 1/(120 h), 7/(478 pi h^2), 1/(120 pi h^3) [1/m^dimension].
inline double normalisation(int dimension, double h) {
  if (dimension == 1) return 1.0 / (120.0 * h);
  if (dimension == 2) return 7.0 / (478.0 * std::numbers::pi * h * h);
  return 1.0 / (120.0 * std::numbers::pi * h * h * h);
}

/// w(q) [-]; q >= 0.
inline double w(double q) {
  const auto fifth = [](double a) { return a > 0 ? a * a * a * a * a : 0.0; };
  return fifth(3.0 - q) - 6.0 * fifth(2.0 - q) + 15.0 * fifth(1.0 - q);
}

/// (1/q) dw/dq [-]; q >= 0. At q = 0, where the slope is -120 q, it is -120.
inline double slope_by_q(double q) {
  if (q < 1e-8) return -120.0;
  const auto fourth = [](double a) { return a > 0 ? a * a * a * a : 0.0; };
  return -5.0 * (fourth(3.0 - q) - 6.0 * fourth(2.0 - q) + 15.0 * fourth(1.0 - q)) / q;
}

}  // namespace gannet::quintic_spline
