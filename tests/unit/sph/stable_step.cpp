#include "sph/stable_step.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

using namespace gannet;

TEST_CASE("stable step: the largest root of the damped leapfrog reaches the unit circle there",
          "[sph]") {
  const LatticeLimits limits{1.1, 0.6};
  const double h = 0.013;
  const double c = 60;
  for (const double a : {0.0, 3.0, 30.0, 300.0}) {
    const double omega = limits.sound * c / h;
    const double lambda = largest_damping(limits, h, {.slope = a});
    const auto largest_root = [&](double dt) {
      const std::complex<double> b = 2 - lambda * dt - omega * omega * dt * dt;
      const std::complex<double> root = std::sqrt(b * b - 4.0 * (1 - lambda * dt));
      return std::max(std::abs((b + root) / 2.0), std::abs((b - root) / 2.0));
    };
    const double limit = stable_step(limits, 2 / limits.sound, h, c, lambda);
    CHECK(largest_root(limit * 0.999) <= 1 + 1e-12);
    CHECK(largest_root(limit * 1.001) > 1 + 1e-6);
  }
}

TEST_CASE("stable step: without viscosity it is cfl h/c", "[sph]") {
  CHECK(stable_step({1.1, 0.6}, 0.7, 0.013, 60, 0) == Approx(0.7 * 0.013 / 60).epsilon(1e-15));
}

TEST_CASE("lattice limits: two neighbours each side in the plane, by hand", "[sph]") {
  // h/dx = 0.5: only the four nearest neighbours at r = 1 = 2 h are there, where F = 0.
  CHECK(lattice_limits(KernelType::cubic_spline, 2, 0.5).sound == 0);
  // h/dx = 0.6: the four at distance 1 (the diagonals at 1.414 > 1.2 are not reached), with
  // q = 5/3: F = -0.75 sigma (1/3)^2 / (q h^2), sigma = 10/(7 pi 0.36)
  const double q = 5.0 / 3;
  const double F = 0.75 * 10 / (7 * M_PI * 0.36) / 9 / (q * 0.36);
  // Along the edge the sum is 2 F sin k, at most 2 F; along the diagonal sqrt(2) times that.
  CHECK(lattice_limits(KernelType::cubic_spline, 2, 0.6).sound ==
        Approx(0.6 * 2 * std::sqrt(2.0) * F).epsilon(1e-12));
  // Damping is strongest along the edge: 2 F (1 - cos pi)/(1 + 0.01 h^2).
  CHECK(lattice_limits(KernelType::cubic_spline, 2, 0.6).viscous ==
        Approx(0.36 * 4 * F / (1 + 0.01 * 0.36)).epsilon(1e-12));
}

TEST_CASE("lattice limits: a dense lattice is the kernel's transform", "[sph]") {
  // For h >> dx the sum is |k W^(k)| with the transform W^ of the 3D cubic spline; the search
  // takes its largest value, which depends no more on h/dx.
  const double at_2 = lattice_limits(KernelType::cubic_spline, 3, 2.0).sound;
  const double at_3 = lattice_limits(KernelType::cubic_spline, 3, 2.9).sound;
  CHECK(at_2 == Approx(at_3).epsilon(0.02));
}

TEST_CASE("damping: along the line of a pair laminar viscosity is 2 (d + 2) artificial ones",
          "[sph]") {
  const LatticeLimits limits{.sound = 1, .viscous = 0.6, .dimension = 2, .laminar = 7};
  CHECK(largest_damping(limits, 0.5, {.nu = 3}) == Approx(7 * 3 / 0.25));
  CHECK(largest_damping(limits, 0.5, {.central_nu = 3}) == Approx(0.6 * 2 * 4 * 3 / 0.25));
  // The same as alpha c h = 2 (d + 2) nu.
  CHECK(largest_damping(limits, 0.5, {.slope = 2 * 4 * 3 / 0.5}) ==
        Approx(largest_damping(limits, 0.5, {.central_nu = 3})));
}
