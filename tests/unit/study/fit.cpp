#include "study/study_fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace gannet;

namespace {

const std::vector<double> sizes = {0.04, 0.02, 0.01, 0.005};

std::vector<double> power_law(double c, double p, double constant = 0) {
  std::vector<double> y;
  for (const double h : sizes) y.push_back(constant + c * std::pow(h, p));
  return y;
}

}  // namespace

TEST_CASE("fit: an exact power law gives its order with an interval of no width", "[study]") {
  const OrderFit fit = fit_order(sizes, power_law(3, 1.7));
  REQUIRE(fit.valid);
  // The search for the order ends at 1e-10; squares near their minimum are flat to 1e-8.
  CHECK(fit.order == Approx(1.7).margin(1e-6));
  CHECK(fit.coefficient == Approx(3).epsilon(1e-5));
  CHECK(fit.high - fit.low < 1e-5);
  CHECK(fit.error_at(0.01) == Approx(3 * std::pow(0.01, 1.7)).epsilon(1e-6));
  CHECK(fit.size_for(fit.error_at(0.003)) == Approx(0.003).epsilon(1e-6));
}

TEST_CASE("fit: the interval of scattered errors is that of the straight line", "[study]") {
  // log2 e = 0, -1.1, -1.9, -3 at log2 h = 0, -1, -2, -3: slope sum(xy)/sum(xx) = 4.9/5 = 0.98,
  // residuals +-: 0.03, -0.09, 0.09, -0.03 (sum of squares 0.018), s = sqrt(0.018/2),
  // half width t(2) s / sqrt(5) = 4.303 * 0.0948683 / 2.236068 = 0.182561.
  const std::vector<double> h = {1, 0.5, 0.25, 0.125};
  const std::vector<double> e = {1, std::exp2(-1.1), std::exp2(-1.9), std::exp2(-3.0)};
  const OrderFit fit = fit_order(h, e);
  REQUIRE(fit.valid);
  CHECK(fit.order == Approx(0.98).margin(1e-6));
  CHECK((fit.high - fit.low) / 2 == Approx(0.182561).epsilon(1e-4));
}

TEST_CASE("fit: errors against a finest run give the order of the limit", "[study]") {
  // Values 2 + 5 h^2; errors are taken against the finest of them, which is wrong itself.
  const std::vector<double> phi = power_law(5, 2, 2);
  std::vector<double> error;
  for (const double value : phi) error.push_back(std::abs(value - phi.back()));
  const OrderFit fit = fit_order(sizes, error, sizes.back());
  REQUIRE(fit.valid);
  CHECK(fit.order == Approx(2).margin(1e-6));
  CHECK(fit.coefficient == Approx(5).epsilon(1e-5));
  // A straight line through the same errors shows more than there is.
  const std::vector<double> coarse(sizes.begin(), sizes.end() - 1);
  CHECK(fit_order(coarse, error).order > 2.05);
}

TEST_CASE("fit: no order from one level or from errors that grow", "[study]") {
  const std::vector<double> one_h = {0.1};
  const std::vector<double> one_e = {0.1};
  CHECK(fit_order(one_h, one_e).reason == "an order needs two levels with an error, there is one");
  const std::vector<double> growing = {1, 2, 3, 4};
  CHECK(fit_order(sizes, growing).reason == "errors do not shrink like a power of the size");
}

TEST_CASE("grid convergence index: a worked example of three grids", "[study]") {
  // Reattachment length on grids of 18000, 8000, 4500 cells (r = 1.5, 4/3), as in the procedure of
  // the ASME Journal of Fluids Engineering (2008): order 1.53, limit 6.1685, index 2.2 %. By hand,
  // with p = 1.534: 1.5^p = 1.8626, 6.063 + 0.091 / 0.8626 = 6.1685, 1.25 * 0.1055 / 6.063 = 2.175
  // %.
  const std::vector<double> h = {2, 1.5, 1};
  const std::vector<double> phi = {5.863, 5.972, 6.063};
  const LimitFit fit = fit_limit(h, phi);
  REQUIRE(fit.valid);
  CHECK(fit.order == Approx(1.53).margin(0.005));     // printed digits
  CHECK(fit.limit == Approx(6.1685).margin(0.0005));  // printed digits
  CHECK(fit.gci == Approx(0.02175).margin(0.00001));
}

TEST_CASE("grid convergence index: refused with its reason", "[study]") {
  const std::vector<double> h = {4, 2, 1};
  const std::vector<double> wavy = {1.0, 1.2, 1.1};
  const LimitFit not_monotone = fit_limit(h, wavy);
  CHECK_FALSE(not_monotone.valid);
  CHECK(not_monotone.reason == "results are not monotone: 1, 1.2, 1.1");
  const std::vector<double> two_h = {2, 1};
  const std::vector<double> two = {1.0, 1.2};
  CHECK(fit_limit(two_h, two).reason == "three levels are needed, there are 2");
  const std::vector<double> diverging = {1.0, 1.1, 1.4};
  CHECK(fit_limit(h, diverging).reason == "changes do not shrink like a power of the size");
}

TEST_CASE("grid convergence index: exact data of five levels have no scatter", "[study]") {
  const std::vector<double> h = {5, 4, 3, 2, 1};
  std::vector<double> phi;
  for (const double size : h) phi.push_back(10 - 0.2 * size * size);
  const LimitFit fit = fit_limit(h, phi);
  REQUIRE(fit.valid);
  CHECK(fit.order == Approx(2).margin(1e-5));
  CHECK(fit.limit == Approx(10).epsilon(1e-6));
  CHECK(fit.scatter < 1e-6);
  CHECK(fit.gci == Approx(1.25 * 0.2 / 9.8).epsilon(1e-4));
}

TEST_CASE("fit: a power through costs", "[study]") {
  const std::vector<double> h = {4, 2, 1};
  const std::vector<double> wall = {1, 8, 64};
  CHECK(fit_power(h, wall).exponent == Approx(-3));
  CHECK(fit_power(h, wall, 2).at(0.5) == Approx(512));
  CHECK(std::isnan(fit_power(std::vector<double>{1}, std::vector<double>{1}).exponent));
}
