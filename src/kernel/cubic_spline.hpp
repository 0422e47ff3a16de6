// The cubic spline kernel and its gradient, in one, two and three dimensions.
//
// With q = r/h and the support radius 2 h:
//   W(r) = sigma w(q),  w = 1/4 max(2 - q, 0)^3 - max(1 - q, 0)^3
//        = sigma (1 - 3/2 q^2 + 3/4 q^3)  for q < 1,  sigma/4 (2 - q)^3  for 1 <= q < 2
//   grad_i W_ij = F(r) r_ij,  r_ij = x_i - x_j,  F = (1/r) dW/dr <= 0
// sigma makes the integral of W over the space 1.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace gannet::cubic_spline {

/// Radius of the support in units of h.
inline constexpr double support = 2.0;

/// The factor sigma that makes the integral of W one: 2/(3 h), 10/(7 pi h^2), 1/(pi h^3).
/// From 2, 2 pi or 4 pi times the integral of w q^(d-1) over q from 0 to 2: 3/2, 7 pi/10, pi.
/// dimension: 1, 2 or 3; h: smoothing length [m], positive. Returns [1/m^dimension].
inline double normalisation(int dimension, double h) {
  assert(dimension >= 1 && dimension <= 3 && h > 0);
  if (dimension == 1) return 2.0 / (3.0 * h);
  if (dimension == 2) return 10.0 / (7.0 * std::numbers::pi * h * h);
  return 1.0 / (std::numbers::pi * h * h * h);
}

/// The kernel W(r) [1/m^dimension].
/// r: distance [m], not negative; h: smoothing length [m], positive.
inline double W(int dimension, double r, double h) {
  const double q = r / h;
  const double a = std::max(2.0 - q, 0.0);
  const double b = std::max(1.0 - q, 0.0);
  return normalisation(dimension, h) * (0.25 * a * a * a - b * b * b);
}

/// The slope dW/dr [1/m^(dimension + 1)], zero at r = 0 and beyond 2 h, negative between.
/// r: distance [m], not negative; h: smoothing length [m], positive.
inline double dW_dr(int dimension, double r, double h) {
  const double q = r / h;
  const double a = std::max(2.0 - q, 0.0);
  const double slope = q < 1.0 ? q * (2.25 * q - 3.0) : -0.75 * a * a;
  return normalisation(dimension, h) * slope / h;
}

/// F = (1/r) dW/dr, so that grad_i W_ij = F r_ij [1/m^(dimension + 2)]. Finite at r = 0, where it
/// is -3 sigma/h^2.
/// r: distance [m], not negative; h: smoothing length [m], positive.
inline double F(int dimension, double r, double h) {
  const double q = r / h;
  const double a = std::max(2.0 - q, 0.0);
  const double slope_by_q = q < 1.0 ? 2.25 * q - 3.0 : -0.75 * a * a / q;
  return normalisation(dimension, h) * slope_by_q / (h * h);
}

}  // namespace gannet::cubic_spline
