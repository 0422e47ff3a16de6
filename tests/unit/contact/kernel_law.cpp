#include "contact/kernel_law.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace gannet;

namespace {

constexpr double pi = 3.14159265358979323846;

KernelLaw law_of(KernelType type, int dimension, double h, double dp, int n) {
  return make_kernel_law({type, dimension, h}, dp, n);
}

}  // namespace

TEST_CASE("kernel contact: the force of a pair by hand", "[contact]") {
  // Cubic spline, h = dp = 1: W = (2 - q)^3/(4 pi) and W' = -3 (2 - q)^2/(4 pi) for 1 <= q <= 2.
  KernelLaw law = law_of(KernelType::cubic_spline, 3, 1, 1, 2);
  CHECK(law.W_dp == Approx(0.25 / pi));
  law.K = 7;
  // r = 1: W/W_dp = 1, W'/W_dp = -3; f = K n 1 3.
  CHECK(law.potential(1) == Approx(7));
  CHECK(law.force_by_distance(1) * 1 == Approx(7 * 2 * 3));
  // r = 1.5, n = 3: W/W_dp = 1/8, W'/W_dp = -3/4; phi = K/512, f = K 3 (1/64) (3/4).
  law = law_of(KernelType::cubic_spline, 3, 1, 1, 3);
  law.K = 7;
  CHECK(law.potential(1.5) == Approx(7.0 / 512));
  CHECK(law.force_by_distance(1.5) * 1.5 == Approx(7 * 3 / 64.0 * 0.75));
  CHECK(law.potential(2) == 0);
  CHECK(law.force_by_distance(2) == 0);
}

TEST_CASE("kernel contact: the force is the gradient of the potential, its stiffness bounded",
          "[contact]") {
  std::mt19937 random(5);
  for (const KernelType type : {KernelType::cubic_spline, KernelType::wendland_c2,
                                KernelType::wendland_c4, KernelType::quintic_spline}) {
    for (const int dimension : {2, 3}) {
      for (const int n : {1, 2, 5}) {
        const double h = 0.013;
        const KernelLaw law = law_of(type, dimension, h, 0.01, n);
        std::uniform_real_distribution<double> u(1e-3 * h, 0.999 * law.kernel.reach());
        double idle = 0;
        double most = 0;
        for (int k = 0; k < 2000; ++k) {
          const double r = u(random);
          const double d = 1e-5 * h;
          const double f = law.force_by_distance(r) * r;
          const double by_difference = -(law.potential(r + d) - law.potential(r - d)) / (2 * d);
          REQUIRE(f == Approx(by_difference).epsilon(1e-5).margin(1e-6 * law.potential(0) / h));
          const double second =
              (law.force_by_distance(r + d) * (r + d) - law.force_by_distance(r - d) * (r - d)) /
              (2 * d);
          const double stiffness = std::max(std::abs(second), std::abs(f / r));
          REQUIRE(law.stiffness_at(r) >= stiffness * (1 - 1e-3));
          idle = std::max(idle, law.stiffness_at(r) - stiffness);
          most = std::max(most, stiffness);
        }
        CHECK(idle < 0.1 * most);  // and not much above
      }
    }
  }
}

namespace {

constexpr double dp = 0.01;

/// Force of a lattice of nodes on a particle at the height z, by that of the plane that the nodes
/// stand for, and the force along the lattice by the same. at: place over a cell, in spacings.
std::array<double, 2> by_plane(const KernelLaw& law, double spacing, std::array<double, 2> at,
                               double z) {
  double f = 0;
  double fx = 0;
  double fy = 0;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      const double x = (i + at[0]) * spacing;
      const double y = (j + at[1]) * spacing;
      const double s = law.force_by_distance(std::sqrt(x * x + y * y + z * z)) * spacing * spacing;
      f += s * z;
      fx += s * x;
      fy += s * y;
    }
  }
  const double of_plane = force_of_plane(law, 1, 1, z);
  return {f / of_plane, std::hypot(fx, fy) / of_plane};
}

/// The largest deviations of by_plane() over all places of a cell and heights z/dp.
std::array<double, 2> unevenness(const KernelLaw& law, double spacing,
                                 const std::vector<double>& heights) {
  constexpr int places = 10;
  std::array<double, 2> worst{};
  for (const double z : heights) {
    for (int i = 0; i <= places; ++i) {
      for (int j = 0; j <= places; ++j) {
        const auto f = by_plane(law, spacing, {0.5 * i / places, 0.5 * j / places}, z * dp);
        worst[0] = std::max(worst[0], std::abs(f[0] - 1));
        worst[1] = std::max(worst[1], f[1]);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("kernel contact: a lattice of nodes pushes as the plane that it stands for",
          "[contact]") {
  const std::array<double, 4> most{0.012, 0.02, 0.12, 0.32};       // across, nodes dp apart
  const std::array<double, 4> most_along{0.025, 0.02, 0.1, 0.25};  // along
  for (int n = 1; n <= 4; ++n) {
    const KernelLaw law = law_of(KernelType::cubic_spline, 3, 1.3 * dp, dp, n);
    const auto fine = unevenness(law, 0.5 * dp, {0.5, 0.8, 1.2, 1.6});
    const auto even = unevenness(law, dp, {0.5, 0.8, 1.2, 1.6});
    fmt::print("lattice, n = {}: across {:.4f}, along {:.4f}; nodes dp/2 apart {:.5f}, {:.5f}\n", n,
               even[0], even[1], fine[0], fine[1]);
    const auto k = static_cast<std::size_t>(n - 1);
    CHECK(even[0] < most[k]);
    CHECK(even[1] < most_along[k]);
    CHECK(fine[0] < 2e-3);
    CHECK(fine[1] < 2e-3);
  }
}

TEST_CASE("kernel contact: energy and heights over a plane", "[contact]") {
  for (const int dimension : {2, 3}) {
    for (const int n : {1, 2, 4}) {
      KernelLaw law = law_of(KernelType::cubic_spline, dimension, 1.3 * dp, dp, n);
      const double V = std::pow(dp, dimension);
      const double c0 = 30;
      const double unit = 1000 * c0 * c0 * V / dp;
      law.K = standard_K(law, dp, dp, 1000, c0);
      for (const double z : {0.3 * dp, dp, 1.7 * dp}) {
        const double d = 1e-4 * dp;
        const double slope =
            (energy_of_plane(law, V, dp, z + d) - energy_of_plane(law, V, dp, z - d)) / (2 * d);
        CHECK(force_of_plane(law, V, dp, z) == Approx(-slope).epsilon(1e-4));
        CHECK(height_of_energy(law, V, dp, energy_of_plane(law, V, dp, z)) == Approx(z));
      }
      const double z = height_of_force(law, V, dp, 0.01 * unit);
      CHECK(force_of_plane(law, V, dp, z) == Approx(0.01 * unit));
      const double v = std::sqrt(2 * energy_of_plane(law, V, dp, 0.5 * dp) / (1000 * V)) / c0;
      const double v0 = std::sqrt(2 * energy_of_plane(law, V, dp, 0) / (1000 * V)) / c0;
      fmt::print(
          "{}D, n = {}: 1 % of rho0 c0^2 at {:.3f} dp; stops {:.3f} c0 before dp/2, {:.3f} "
          "c0 before the nodes\n",
          dimension, n, z / dp, v, v0);
      if (n == 2) CHECK(z == Approx(1.8 * dp).epsilon(0.02));
      CHECK(height_of_energy(law, V, dp, 2 * energy_of_plane(law, V, dp, 0)) == 0);
    }
  }
}

TEST_CASE("kernel contact: its standard stiffness holds what a penalty holds", "[contact]") {
  for (const int dimension : {2, 3}) {
    KernelLaw law = law_of(KernelType::quintic_spline, dimension, 1.1 * dp, dp, 2);
    law.K = standard_K(law, dp, 0.004, 1000, 30);
    const double V = std::pow(dp, dimension);
    CHECK(force_of_plane(law, V, 0.004, 0.5 * dp) == Approx(0.5 * 1000 * 30 * 30 * V / dp));
  }
}
