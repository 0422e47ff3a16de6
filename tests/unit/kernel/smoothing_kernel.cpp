#include "kernel/smoothing_kernel.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gannet;

namespace {

constexpr KernelType all[] = {KernelType::cubic_spline, KernelType::wendland_c2,
                              KernelType::wendland_c4, KernelType::quintic_spline};

/// Measure of the sphere of radius r: 2, 2 pi r, 4 pi r^2.
double shell(int dimension, double r) {
  if (dimension == 1) return 2;
  return dimension == 2 ? 2 * M_PI * r : 4 * M_PI * r * r;
}

}  // namespace

TEST_CASE("smoothing kernels: the integral over the space is 1", "[kernel]") {
  for (const KernelType type : all) {
    for (const int dimension : {1, 2, 3}) {
      const SmoothingKernel kernel{type, dimension, 0.37};
      const int n = 3000;  // a multiple of the pieces of every spline; Simpson's rule
      const double dr = kernel.reach() / n;
      double sum = 0;
      for (int k = 0; k <= n; ++k) {
        const double weight = k == 0 || k == n ? 1 : (k % 2 == 1 ? 4 : 2);
        sum += weight * kernel.W(k * dr) * shell(dimension, k * dr) * dr / 3;
      }
      CHECK(sum == Approx(1).epsilon(1e-9));
    }
  }
}

TEST_CASE("smoothing kernels: F is the slope of W over r", "[kernel]") {
  for (const KernelType type : all) {
    const SmoothingKernel kernel{type, 3, 0.8};
    for (const double q : {0.1, 0.6, 0.95, 1.3, 1.99, 2.4}) {
      const double r = 0.8 * q;
      const double e = 1e-6;
      const double slope = (kernel.W(r + e) - kernel.W(r - e)) / (2 * e);
      CHECK(kernel.F(r) * r == Approx(slope).epsilon(1e-6).margin(1e-9));
      CHECK(kernel.F(r) <= 0);
    }
    CHECK(kernel.W(kernel.reach()) == 0);
    CHECK(kernel.F(kernel.reach() * 1.01) == 0);
    CHECK(std::isfinite(kernel.F(0)));
  }
}

TEST_CASE("smoothing kernels: values by hand at q = 1", "[kernel]") {
  const double pi = M_PI;
  CHECK(SmoothingKernel{KernelType::cubic_spline, 3, 1}.W(1) == Approx(0.25 / pi));
  // (1/2)^4 3 = 3/16 and -5/8
  CHECK(SmoothingKernel{KernelType::wendland_c2, 3, 1}.W(1) == Approx(3.0 / 16 * 21 / (16 * pi)));
  CHECK(SmoothingKernel{KernelType::wendland_c2, 2, 1}.F(1) == Approx(-5.0 / 8 * 7 / (4 * pi)));
  // (1/2)^6 (35/12 + 4) = 83/768, -7/3 7/32 = -49/96
  CHECK(SmoothingKernel{KernelType::wendland_c4, 2, 1}.W(1) == Approx(83.0 / 768 * 9 / (4 * pi)));
  CHECK(SmoothingKernel{KernelType::wendland_c4, 2, 1}.F(1) == Approx(-49.0 / 96 * 9 / (4 * pi)));
  // 32 - 6 = 26, -5 (16 - 6) = -50
  CHECK(SmoothingKernel{KernelType::quintic_spline, 2, 1}.W(1) == Approx(26 * 7 / (478 * pi)));
  CHECK(SmoothingKernel{KernelType::quintic_spline, 2, 1}.F(1) == Approx(-50 * 7 / (478 * pi)));
}
