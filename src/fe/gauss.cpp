#include "fe/gauss.hpp"

#include <cmath>
#include <numbers>

namespace gannet {

GaussRule gauss_rule(int n) {
  GaussRule rule;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      // k P_k = (2k - 1) x P_(k-1) - (k - 1) P_(k-2)
      double p = 1;
      double before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.point.push_back(x);
    rule.weight.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace gannet
