#include "sph/inner_layers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "closed_lines.hpp"

using namespace gannet;

namespace {

double least_distance(const std::vector<Vec3>& x) {
  double least = 1e9;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, (x[i] - x[j]).norm());
  }
  return least;
}

}  // namespace

TEST_CASE("inner layers: a box that fits the spacing gets its own lattice", "[sph]") {
  const auto x = inner_layers(test::polygon({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}), 0.1, 3);
  CHECK(x.size() == 10 * 20 - 4 * 14);  // three layers of cells around what stays empty
  for (const Vec3& p : x) {
    CHECK(std::abs(std::remainder(p.x() - 0.05, 0.1)) < 1e-12);
    CHECK(std::abs(std::remainder(p.y() - 0.05, 0.1)) < 1e-12);
  }
}

TEST_CASE("inner layers: below a circle they stand half a spacing deep, evenly", "[sph]") {
  for (const double R : {0.4, 1.0}) {
    const double dx = 0.1;
    const ClosedSurface surface = test::circle(Vec3::Zero(), R);
    const auto x = inner_layers(surface, dx, 3);
    // The ring of three layers, a particle for each dx^2 of it.
    const double area = std::numbers::pi * (R * R - std::pow(R - 3 * dx, 2));
    CHECK(static_cast<double>(x.size()) * dx * dx == Approx(area).epsilon(0.06));
    std::size_t first = 0;
    for (const Vec3& p : x) {
      const double depth = distance(surface, p);
      CHECK(depth > 0.498 * dx);
      first += depth < 0.7 * dx ? 1 : 0;
    }
    // One layer right below the skin, a particle for each dx of its length.
    const double length = 2 * std::numbers::pi * (R - 0.5 * dx);
    CHECK(static_cast<double>(first) * dx == Approx(length).epsilon(0.1));
    CHECK(least_distance(x) > 0.75 * dx);
  }
}

TEST_CASE("inner layers: in space, below a ball", "[sph]") {
  SurfaceMesh mesh = box_surface({-1, -1, -1}, {1, 1, 1}, {12, 12, 12});
  for (Vec3& p : mesh.points) p = 0.5 * p.normalized();
  ClosedSurface surface;
  add_boundary(mesh.points, mesh.quads, 4, false, surface);
  REQUIRE(close_surface(surface).empty());
  const double dx = 0.1;
  const auto x = inner_layers(surface, dx, 3);
  const double volume = 4 * std::numbers::pi / 3 * (std::pow(0.5, 3) - std::pow(0.2, 3));
  // That many points of a lattice fall into a shell of three spacings, give or take.
  CHECK(static_cast<double>(x.size()) * dx * dx * dx == Approx(volume).epsilon(0.07));
  CHECK(least_distance(x) > 0.7 * dx);
  for (const Vec3& p : x) CHECK(distance(surface, p) > 0.498 * dx);
}
