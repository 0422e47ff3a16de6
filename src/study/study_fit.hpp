// How results converge: orders, limits, and the grid convergence index.
#pragma once

#include <span>
#include <string>

#include "study/study.hpp"

namespace gannet {

/// error = C (h^p - h_ref^p), fitted in logarithms.
struct OrderFit {
  bool valid = false;
  std::string reason;  ///< why there is none
  double order = unknown;
  double coefficient = unknown;  ///< C
  double h_ref = 0;
  double low = unknown;  ///< 95 % interval of the order; unknown with two levels
  double high = unknown;
  [[nodiscard]] double error_at(double h) const;
  /// The size at which the error is e; 0 < e.
  [[nodiscard]] double size_for(double e) const;
};

/// Least squares of log e = log C + log(h^p - h_ref^p) over p and C. h_ref is the size of the run
/// that errors are measured against, 0 where it is exact: errors against a finest run are too small
/// by its own error, and a straight line through them would show too high an order.
/// The interval of p is that of the linearised fit: p -+ t(0.975, n - 2) s / |g - mean g|, with
/// g = d log(h^p - h_ref^p) / dp and s^2 = sum r^2 / (n - 2).
/// Errors that are 0, unknown, or at h <= h_ref are left out. Refused with fewer than two left, and
/// where errors do not shrink like a power within 0.1 < p < 8.
OrderFit fit_order(std::span<const double> h, std::span<const double> error, double h_ref = 0);

/// phi = limit + C h^p, fitted by least squares.
struct LimitFit {
  bool valid = false;
  std::string reason;  ///< why it is refused
  double limit = unknown;
  double order = unknown;
  double coefficient = unknown;
  double scatter = 0;    ///< sqrt(sum r^2 / (n - 3)); 0 with three levels
  double gci = unknown;  ///< grid convergence index of the finest level, relative to its value
};

/// The limit at h = 0 of a result, from at least three levels that change one way only, and its
/// grid convergence index
///   GCI = (1.25 |limit - phi_finest| + scatter) / |phi_finest|,
/// for three levels with a constant ratio the same as Roache's 1.25 e / (r^p - 1). Refused, with
/// its reason, with fewer than three levels, where results are not monotone, and where their
/// changes do not shrink like a power within 0.1 < p < 8.
LimitFit fit_limit(std::span<const double> h, std::span<const double> phi);

/// q and a of y = a x^q by least squares in logarithms over the last `last` points (all with 0).
/// Both unknown with fewer than two points. Needs x, y > 0.
struct PowerLaw {
  double exponent = unknown;
  double coefficient = unknown;
  [[nodiscard]] double at(double x) const;
};
PowerLaw fit_power(std::span<const double> x, std::span<const double> y, std::size_t last = 0);

/// Two-sided 95 % quantile of Student's t.
double student_95(int degrees_of_freedom);

}  // namespace gannet
