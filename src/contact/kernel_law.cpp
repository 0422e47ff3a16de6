#include "contact/kernel_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gannet {

namespace {

double power(double u, int n) {
  double product = 1;
  for (int k = 0; k < n; ++k) product *= u;
  return product;
}

double volume_of_cell(const KernelLaw& law, double dp) { return power(dp, law.kernel.dimension); }

/// phi'(r) for K = 1.
double slope(const KernelLaw& law, double r) {
  const double u = law.kernel.W(r) / law.W_dp;
  return law.n * power(u, law.n - 1) * law.kernel.F(r) * r / law.W_dp;
}

/// The largest of |phi''| and |phi'/r| near r, phi'' by central differences.
double stiffness_near(const KernelLaw& law, double r) {
  const double step = 1e-4 * law.kernel.h;
  const double at = std::max(r, step);
  const double second = (slope(law, at + step) - slope(law, at - step)) / (2 * step);
  return std::max(std::abs(second), std::abs(slope(law, at) / at));
}

/// The integral of f(r) over a plane at the height z, r the distance from its points, by the
/// midpoint rule over rings (pairs of lines) of radius s.
template <class F>
double over_plane(const KernelLaw& law, double z, F&& f) {
  constexpr int rings = 2000;
  const double ds = law.kernel.reach() / rings;
  double sum = 0;
  for (int k = 0; k < rings; ++k) {
    const double s = (k + 0.5) * ds;
    const double dA = law.kernel.dimension == 3 ? 2 * std::numbers::pi * s * ds : 2 * ds;
    sum += f(std::hypot(s, z)) * dA;
  }
  return sum;
}

/// The greatest height at which something holds: from the reach down in steps, then by halves; 0
/// where it does not hold at any.
template <class Holds>
double highest(const KernelLaw& law, Holds&& holds) {
  constexpr int steps = 64;
  const double step = law.kernel.reach() / steps;
  for (int k = steps - 1; k >= 0; --k) {
    double low = k * step;
    if (!holds(low)) continue;
    double high = low + step;
    for (int n = 0; n < 30; ++n) {
      const double middle = 0.5 * (low + high);
      (holds(middle) ? low : high) = middle;
    }
    return low;
  }
  return 0;
}

}  // namespace

double KernelLaw::potential(double r) const { return K * power(kernel.W(r) / W_dp, n); }

double KernelLaw::force_by_distance(double r) const {
  const double u = kernel.W(r) / W_dp;
  return -K * n * power(u, n - 1) * kernel.F(r) / W_dp;
}

double KernelLaw::stiffness_at(double r) const {
  const double reach = kernel.reach();
  if (!(r < reach)) return 0;
  const int bin = std::min(static_cast<int>(r / reach * n_bins), n_bins - 1);
  return K * stiffness[static_cast<std::size_t>(bin)];
}

KernelLaw make_kernel_law(const SmoothingKernel& kernel, double dp, int n) {
  KernelLaw law{.kernel = kernel, .n = n, .K = 1, .W_dp = kernel.W(dp)};
  constexpr int samples = 8;
  const double width = kernel.reach() / KernelLaw::n_bins;
  for (int bin = 0; bin < KernelLaw::n_bins; ++bin) {
    double& most = law.stiffness[static_cast<std::size_t>(bin)];
    for (int k = 0; k <= samples; ++k) {
      most = std::max(most, stiffness_near(law, (bin + static_cast<double>(k) / samples) * width));
    }
  }
  return law;
}

double force_of_plane(const KernelLaw& law, double V, double t, double z) {
  // The component along z is s(r) z.
  return V * t * z * over_plane(law, z, [&](double r) { return law.force_by_distance(r); });
}

double energy_of_plane(const KernelLaw& law, double V, double t, double z) {
  return V * t * over_plane(law, z, [&](double r) { return law.potential(r); });
}

double height_of_force(const KernelLaw& law, double V, double t, double force) {
  return highest(law, [&](double z) { return force_of_plane(law, V, t, z) >= force; });
}

double height_of_energy(const KernelLaw& law, double V, double t, double energy) {
  return highest(law, [&](double z) { return energy_of_plane(law, V, t, z) >= energy; });
}

double standard_K(const KernelLaw& law, double dp, double t, double rho0, double c0) {
  const double V = volume_of_cell(law, dp);
  const double wanted = 0.5 * rho0 * c0 * c0 * V / dp;
  return law.K * wanted / force_of_plane(law, V, t, 0.5 * dp);
}

}  // namespace gannet
