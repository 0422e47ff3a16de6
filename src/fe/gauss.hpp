// Gauss points on [-1, 1].
#pragma once

#include <vector>

namespace gannet {

struct GaussRule {
  std::vector<double> point;   ///< rising, in (-1, 1)
  std::vector<double> weight;  ///< adding up to 2
};

/// The rule of n points: the roots of the Legendre polynomial P_n with weights
/// 2 / ((1 - x^2) P_n'(x)^2); exact for polynomials up to degree 2 n - 1. Needs n >= 1.
/// Throws nothing.
GaussRule gauss_rule(int n);

}  // namespace gannet
