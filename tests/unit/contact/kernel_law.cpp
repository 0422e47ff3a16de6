#include "contact/kernel_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

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

TEST_CASE("kernel contact: a lattice of nodes pushes as the plane that it stands for",
          "[contact]") {
  const double dp = 0.01;
  for (const int n : {1, 2, 4}) {
    const KernelLaw law = law_of(KernelType::cubic_spline, 3, 1.3 * dp, dp, n);
    const double t = 0.003;
    const double V = dp * dp * dp;
    for (const double spacing : {0.5 * dp, dp}) {
      for (const double z : {0.5 * dp, 1.2 * dp}) {
        double f = 0;
        double sideways = 0;
        for (int i = -10; i <= 10; ++i) {
          for (int j = -10; j <= 10; ++j) {
            const double x = (i + 0.3) * spacing;
            const double y = (j + 0.1) * spacing;
            const double by_r = law.force_by_distance(std::sqrt(x * x + y * y + z * z));
            f += V * spacing * spacing * t * by_r * z;
            sideways += V * spacing * spacing * t * by_r * x;
          }
        }
        // Nodes a spacing of the particles apart are felt as nodes where the potential is steep.
        const double even = spacing < dp ? 1e-3 : (n == 4 ? 0.2 : 0.01);
        CHECK(f == Approx(force_of_plane(law, V, t, z)).epsilon(even));
        if (n < 4) CHECK(std::abs(sideways) < 0.02 * f);
      }
    }
  }
}

TEST_CASE("kernel contact: its standard stiffness holds what a penalty holds", "[contact]") {
  const double dp = 0.02;
  for (const int dimension : {2, 3}) {
    KernelLaw law = law_of(KernelType::quintic_spline, dimension, 1.1 * dp, dp, 2);
    law.K = standard_K(law, dp, 0.004, 1000, 30);
    const double V = std::pow(dp, dimension);
    CHECK(force_of_plane(law, V, 0.004, 0.5 * dp) == Approx(0.5 * 1000 * 30 * 30 * V / dp));
  }
}
