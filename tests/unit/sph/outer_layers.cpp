#include "sph/outer_layers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "closed_lines.hpp"
#include "kernel/smoothing_kernel.hpp"
#include "sph/inner_layers.hpp"

using namespace gannet;

namespace {

/// A lattice from -2 to 2 in x and from -2 to 0 in y.
std::vector<Vec3> lattice(double dx) {
  std::vector<Vec3> x;
  const int n = static_cast<int>(std::lround(2 / dx));
  for (int j = -n; j < 0; ++j) {
    for (int i = -n; i < n; ++i) x.emplace_back((i + 0.5) * dx, (j + 0.5) * dx, 0);
  }
  return x;
}

std::vector<Vec3> kept(const std::vector<Vec3>& x, const std::vector<std::uint8_t>& stays) {
  std::vector<Vec3> left;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (stays[k] != 0) left.push_back(x[k]);
  }
  return left;
}

}  // namespace

TEST_CASE("outer layers: a lattice that fits a box is left as it is", "[sph]") {
  const double dx = 0.1;
  const std::vector<Vec3> before = lattice(dx);
  std::vector<Vec3> x = before;
  const auto stays =
      stand_outside(test::polygon({{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}), dx, x);
  CHECK((x == before));
  CHECK(std::ranges::count(stays, 0) == 20 * 5);
}

TEST_CASE("outer layers: a lattice that nearly fits keeps nothing inside and gets no holes",
          "[sph]") {
  const double dx = 0.1;
  for (const double misfit : {-0.04, 0.04}) {
    const double depth = 0.5 + misfit * dx;
    const ClosedSurface surface =
        test::polygon({{-4, -depth, 0}, {4, -depth, 0}, {4, 0.5, 0}, {-4, 0.5, 0}});
    std::vector<Vec3> x;
    for (int j = -20; j < 0; ++j) {
      for (int i = -60; i < 60; ++i) x.emplace_back((i + 0.5) * dx, (j + 0.5) * dx, 0);
    }
    const auto stays = stand_outside(surface, dx, x);
    CHECK(std::ranges::count(stays, 0) == 80 * 5);
    for (const Vec3& p : kept(x, stays)) CHECK_FALSE(contains(surface, p));
  }
}

TEST_CASE("outer layers: points on a face stand outside of it", "[sph]") {
  const double dx = 0.1;
  const ClosedSurface surface =
      test::polygon({{-1, -0.55, 0}, {1, -0.55, 0}, {1, 0.5, 0}, {-1, 0.5, 0}});
  std::vector<Vec3> x = lattice(dx);
  const auto stays = stand_outside(surface, dx, x);
  for (const Vec3& p : kept(x, stays)) {
    CHECK_FALSE(contains(surface, p));
    CHECK(distance(surface, p) > 0.499 * dx);
  }
}

TEST_CASE("outer layers: of a row that a face cuts goes what the face cuts off", "[sph]") {
  const double dx = 0.1;
  for (const double depth : {0.52, 0.57, 0.63}) {
    std::vector<Vec3> x = lattice(dx);
    const auto stays = stand_outside(
        test::polygon({{-1, -depth, 0}, {1, -depth, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}), dx, x);
    const auto gone = static_cast<double>(std::ranges::count(stays, 0));
    // The sum over cells is exact for a plane face; a row goes by pairs, half a pair is left over.
    CHECK(gone == Approx(2 * depth / (dx * dx)).margin(1 + 1e-6));
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : kept(x, stays)) sum += p;
    CHECK(std::abs(sum.x()) < 1e-3 * dx);  // the same on both sides, as it was
  }
}

TEST_CASE("outer layers: around a circle at the surface stands as much water as there is room for",
          "[sph]") {
  const double dx = 0.1;
  for (const double y : {-0.25, 0.03, 0.25}) {
    const ClosedSurface surface = test::circle({0, y, 0}, 1);
    std::vector<Vec3> x = lattice(dx);
    const auto stays = stand_outside(surface, dx, x);
    // The segment below y = 0.
    const double area = std::acos(y) - y * std::sqrt(1 - y * y);
    // Points go by pairs: half a pair is left over.
    CHECK(static_cast<double>(std::ranges::count(stays, 0)) * dx * dx ==
          Approx(area).margin(dx * dx));
    const std::vector<Vec3> water = kept(x, stays);
    double nearest = 1e9;
    double highest = -1e9;
    for (const Vec3& p : water) {
      CHECK_FALSE(contains(surface, p));
      nearest = std::min(nearest, distance(surface, p));
      highest = std::max(highest, p.y());
    }
    CHECK(nearest > 0.49 * dx);
    // The water rises by less than a tenth of a spacing from where it was, half a spacing below.
    CHECK(highest < -0.4 * dx);
    // With the layers inside, the crowd is even below the surface.
    const std::vector<Vec3> wall = inner_layers(surface, dx, 3);
    const SmoothingKernel kernel(KernelType::quintic_spline, 2, 1.25 * dx);
    double most = 0;
    for (const Vec3& p : water) {
      if (p.y() > -kernel.reach() || distance(surface, p) > 4 * dx || p.y() < -1.6) continue;
      double sum = 0;
      for (const auto* all : {&water, &wall}) {
        for (const Vec3& q : *all) sum += dx * dx * kernel.W((p - q).norm());
      }
      most = std::max(most, std::abs(sum - 1));
    }
    CHECK(most < 0.07);
  }
}
