#include "contact/closest_point.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace gannet;

namespace {

double sum(const Closest& c) { return c.N[0] + c.N[1] + c.N[2] + c.N[3]; }

/// A few ulps of numbers of size 1.
constexpr double rounding = 1e-14;

const Vec3 square[4] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
const Vec3 triangle[3] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("closest point: line, by hand", "[contact]") {
  const Vec3 a(0, 0, 0);
  const Vec3 b(4, 0, 0);
  Closest c = closest_on_line({1, 2, 0}, a, b);
  CHECK(c.N[0] == 0.75);
  CHECK(c.N[1] == 0.25);
  CHECK(c.distance2 == 4);
  CHECK(c.feature == Feature::inside);
  c = closest_on_line({7, 4, 0}, a, b);
  CHECK(c.point == b);
  CHECK(c.distance2 == 25);
  CHECK(c.feature == Feature::corner);
  CHECK(c.number == 1);
  c = closest_on_line({-1, 0, 0}, a, b);
  CHECK(c.point == a);
  CHECK(c.number == 0);
  CHECK(closest_on_line({1, 1, 1}, a, a).point == a);
}

TEST_CASE("closest point: triangle, inside, edges and corners by hand", "[contact]") {
  Closest c = closest_on_triangle({1, 1, 5}, triangle);
  CHECK(c.N[0] == Approx(1.0 / 3).margin(rounding));
  CHECK(c.distance2 == Approx(25));
  CHECK(c.feature == Feature::inside);
  c = closest_on_triangle({1, -2, 0}, triangle);
  CHECK((c.point - Vec3(1, 0, 0)).norm() < rounding);
  CHECK(c.feature == Feature::edge);
  CHECK(c.number == 0);
  c = closest_on_triangle({3, 3, 1}, triangle);  // beyond the hypotenuse
  CHECK((c.point - Vec3(1.5, 1.5, 0)).norm() < rounding);
  CHECK(c.number == 1);
  c = closest_on_triangle({-1, 1, 0}, triangle);
  CHECK(c.number == 2);
  c = closest_on_triangle({-1, -1, 0}, triangle);
  CHECK(c.feature == Feature::corner);
  CHECK(c.number == 0);
  c = closest_on_triangle({5, -1, 0}, triangle);
  CHECK(c.feature == Feature::corner);
  CHECK(c.number == 1);
}

TEST_CASE("closest point: square patch, inside, diagonal, edges and corners", "[contact]") {
  Closest c = closest_on_quad({0.5, 1.5, -3}, square);
  // xi = -1/2, eta = 1/2
  CHECK(c.N[0] == Approx(3.0 / 16).margin(rounding));
  CHECK(c.N[1] == Approx(1.0 / 16).margin(rounding));
  CHECK(c.N[2] == Approx(3.0 / 16).margin(rounding));
  CHECK(c.N[3] == Approx(9.0 / 16).margin(rounding));
  CHECK(c.distance2 == Approx(9));
  for (const double s : {0.25, 0.75, 1.0, 1.6}) {  // on the diagonal, on the patch
    c = closest_on_quad({s, s, 0}, square);
    CHECK((c.point - Vec3(s, s, 0)).norm() < rounding);
    CHECK(c.feature == Feature::inside);
  }
  c = closest_on_quad({3, 1, 1}, square);
  CHECK((c.point - Vec3(2, 1, 0)).norm() < rounding);
  CHECK(c.feature == Feature::edge);
  CHECK(c.number == 1);
  c = closest_on_quad({1, 5, 0}, square);
  CHECK(c.number == 2);
  c = closest_on_quad({-4, -3, 0}, square);
  CHECK(c.distance2 == Approx(25));
  CHECK(c.feature == Feature::corner);
  CHECK(c.number == 0);
  c = closest_on_quad({2, 2, 7}, square);  // exactly above a corner
  CHECK(c.distance2 == Approx(49));
  CHECK(c.N[2] == Approx(1).margin(rounding));
  c = closest_on_quad({2, 1, 0}, square);  // exactly on an edge
  CHECK(c.distance2 < rounding);
}

TEST_CASE("closest point: warped and distorted patches agree with a fine sampling", "[contact]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Vec3 p[4];
    for (int k = 0; k < 4; ++k) p[k] = square[k] + 0.25 * Vec3(u(random), u(random), u(random));
    const Vec3 x = Vec3(1, 1, 0) + Vec3(1.6 * u(random), 1.6 * u(random), 0.8 * u(random));
    const Closest c = closest_on_quad(x, p);
    double best = 1e300;
    constexpr int n = 100;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const double s = static_cast<double>(i) / n;
        const double t = static_cast<double>(j) / n;
        const Vec3 q =
            (1 - s) * (1 - t) * p[0] + s * (1 - t) * p[1] + s * t * p[2] + (1 - s) * t * p[3];
        best = std::min(best, (x - q).norm());
      }
    }
    const double D = std::sqrt(c.distance2);
    CHECK(D <= best + 1e-12);  // never further than any sample
    CHECK(D >= best - 0.03);   // samples lie within half a sampling width (2.5/100) of it
    CHECK(sum(c) == Approx(1).margin(1e-15));
    Vec3 foot = Vec3::Zero();
    for (int k = 0; k < 4; ++k) foot += c.N[static_cast<std::size_t>(k)] * p[k];
    CHECK((foot - c.point).norm() < 2e-15);  // an ulp or two of numbers of size 2
    if (c.feature == Feature::inside) {      // x - x_cp is perpendicular to both edges' directions
      const double s = c.N[1] + c.N[2];
      const double t = c.N[2] + c.N[3];
      const Vec3 X_s = (1 - t) * (p[1] - p[0]) + t * (p[2] - p[3]);
      const Vec3 X_t = (1 - s) * (p[3] - p[0]) + s * (p[2] - p[1]);
      CHECK(std::abs((x - c.point).dot(X_s)) < 1e-12);
      CHECK(std::abs((x - c.point).dot(X_t)) < 1e-12);
    }
  }
}
