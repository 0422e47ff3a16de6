// The Wendland kernels C2 and C4: polynomials of compact support whose Fourier transform is
// positive, so that particles do not pair up however many neighbours they have.
//
// With q = r/h and the support radius 2 h, in two and three dimensions:
//   C2: w = (1 - q/2)^4 (2 q + 1),               (1/q) dw/dq = -5 (1 - q/2)^3
//   C4: w = (1 - q/2)^6 (35/12 q^2 + 3 q + 1),   (1/q) dw/dq = -7/3 (5 q + 2) (1 - q/2)^5
// W = sigma w(q), F = (1/r) dW/dr. Wendland 1995, Adv. Comput. Math. 4, 389; in this form Dehnen
// and Aly 2012, Mon. Not. R. Astron. Soc. 425, 1068, table 1. In one dimension these are the same
// polynomials with the normalisation of the line.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gannet {

namespace wendland_c2 {

inline constexpr double support = 2.0;

/// 3/(4 h), 7/(4 pi h^2), 21/(16 pi h^3) [1/m^dimension].
inline double normalisation(int dimension, double h) {
  if (dimension == 1) return 3.0 / (4.0 * h);
  if (dimension == 2) return 7.0 / (4.0 * std::numbers::pi * h * h);
  return 21.0 / (16.0 * std::numbers::pi * h * h * h);
}

/// w(q) [-]; q >= 0.
inline double w(double q) {
  const double a = std::max(1.0 - 0.5 * q, 0.0);
  return a * a * a * a * (2.0 * q + 1.0);
}

/// (1/q) dw/dq [-]; q >= 0.
inline double slope_by_q(double q) {
  const double a = std::max(1.0 - 0.5 * q, 0.0);
  return -5.0 * a * a * a;
}

}  // namespace wendland_c2

namespace wendland_c4 {

inline constexpr double support = 2.0;

/// 27/(32 h), 9/(4 pi h^2), 495/(256 pi h^3) [1/m^dimension].
inline double normalisation(int dimension, double h) {
  if (dimension == 1) return 27.0 / (32.0 * h);
  if (dimension == 2) return 9.0 / (4.0 * std::numbers::pi * h * h);
  return 495.0 / (256.0 * std::numbers::pi * h * h * h);
}

/// w(q) [-]; q >= 0.
inline double w(double q) {
  const double a = std::max(1.0 - 0.5 * q, 0.0);
  const double a2 = a * a;
  return a2 * a2 * a2 * (35.0 / 12.0 * q * q + 3.0 * q + 1.0);
}

/// (1/q) dw/dq [-]; q >= 0.
inline double slope_by_q(double q) {
  const double a = std::max(1.0 - 0.5 * q, 0.0);
  const double a2 = a * a;
  return -7.0 / 3.0 * (5.0 * q + 2.0) * a2 * a2 * a;
}

}  // namespace wendland_c4

}  // namespace gannet
