#include "kernel/cubic_spline.hpp"

#include <catch2/catch.hpp>

namespace {
constexpr double pi = 3.14159265358979323846;
}

TEST_CASE("cubic spline: hand-computed values in 1D, 2D and 3D", "[kernel]") {
  using namespace gannet::cubic_spline;
  // h = 1: w(0) = 1, w(1/2) = 1 - 3/8 + 3/32 = 23/32, w(1) = 1/4, w(3/2) = 1/32, w(2) = 0.
  CHECK(W(3, 0.0, 1.0) == Approx(1 / pi).epsilon(1e-15));
  CHECK(W(3, 0.5, 1.0) == Approx(23.0 / 32 / pi).epsilon(1e-15));
  CHECK(W(3, 1.0, 1.0) == Approx(0.25 / pi).epsilon(1e-15));
  CHECK(W(3, 1.5, 1.0) == Approx(1.0 / 32 / pi).epsilon(1e-15));
  CHECK(W(3, 2.0, 1.0) == 0.0);
  CHECK(W(3, 7.0, 1.0) == 0.0);
  // h = 2: 1D sigma = 1/3, 2D sigma = 10/(28 pi), 3D sigma = 1/(8 pi).
  CHECK(W(1, 1.0, 2.0) == Approx(23.0 / 96).epsilon(1e-15));
  CHECK(W(2, 2.0, 2.0) == Approx(10.0 / (112 * pi)).epsilon(1e-15));
  CHECK(W(3, 3.0, 2.0) == Approx(1.0 / (256 * pi)).epsilon(1e-15));
}

TEST_CASE("cubic spline: hand-computed slopes", "[kernel]") {
  using namespace gannet::cubic_spline;
  // dw/dq = -3 q + 9/4 q^2 for q < 1, -3/4 (2 - q)^2 for q < 2.
  CHECK(dW_dr(3, 0.0, 1.0) == 0.0);
  CHECK(dW_dr(3, 0.5, 1.0) == Approx(-15.0 / 16 / pi).epsilon(1e-15));
  CHECK(dW_dr(3, 1.0, 1.0) == Approx(-0.75 / pi).epsilon(1e-15));
  CHECK(dW_dr(3, 1.5, 1.0) == Approx(-3.0 / 16 / pi).epsilon(1e-15));
  CHECK(dW_dr(3, 2.5, 1.0) == 0.0);
  CHECK(F(3, 0.0, 1.0) == Approx(-3 / pi).epsilon(1e-15));
  CHECK(F(3, 1.5, 1.0) == Approx(-0.125 / pi).epsilon(1e-15));
  // h = 2, r = 1 in 2D: sigma/h (-15/16) / r with sigma = 10/(28 pi).
  CHECK(F(2, 1.0, 2.0) == Approx(-150.0 / (2 * 16 * 28 * pi)).epsilon(1e-15));
}

TEST_CASE("cubic spline: the integral over space is one", "[kernel]") {
  using namespace gannet::cubic_spline;
  const double h = 0.7;
  const int dimension = GENERATE(1, 2, 3);
  const double sphere = dimension == 1 ? 2.0 : (dimension == 2 ? 2 * pi : 4 * pi);
  // Simpson's rule on 2 x 200 intervals; r^(d-1) W is a polynomial of degree at most 5 on each
  // side of r = h, so what is left is of order (1/200)^4.
  const int n = 400;
  const double step = 2 * h / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double r = k * step;
    const double weight = k == 0 || k == n ? 1 : (k % 2 == 1 ? 4 : 2);
    sum += weight * W(dimension, r, h) * sphere * std::pow(r, dimension - 1);
  }
  CHECK(sum * step / 3 == Approx(1.0).epsilon(1e-8));
}

TEST_CASE("cubic spline: the slope is the derivative of W, and F is the slope over r", "[kernel]") {
  using namespace gannet::cubic_spline;
  const int dimension = GENERATE(1, 2, 3);
  const double h = 1.3;
  const double d = 1e-5;
  for (double r = 0.05; r < 2.8; r += 0.05) {
    const double difference = (W(dimension, r + d, h) - W(dimension, r - d, h)) / (2 * d);
    const double scale = normalisation(dimension, h) / h;
    // Central difference: d^2/6 |W'''| <= 1e-10 and rounding 1e-16/d = 1e-11, of the scale.
    CHECK(std::abs(dW_dr(dimension, r, h) - difference) < 1e-9 * scale);
    CHECK(F(dimension, r, h) * r == Approx(dW_dr(dimension, r, h)).epsilon(1e-14));
  }
}
