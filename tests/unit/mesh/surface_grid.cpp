#include "mesh/surface_grid.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/shapes.hpp"

using namespace gannet;

namespace {

ClosedSurface ball(int n) {
  SurfaceMesh mesh = box_surface({-1, -1, -1}, {1, 1, 1}, {n, n, n});
  for (Vec3& x : mesh.points) x = Vec3(0.3, 0, 0) + x.normalized();
  ClosedSurface surface;
  add_boundary(mesh.points, mesh.quads, 4, false, surface);
  REQUIRE(close_surface(surface).empty());
  return surface;
}

ClosedSurface triangle() {
  ClosedSurface surface{.dimension = 2};
  add_boundary({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, {0, 1, 1, 2, 2, 0}, 2, false, surface);
  REQUIRE(close_surface(surface).empty());
  return surface;
}

}  // namespace

TEST_CASE("surface grid: fills the box around a surface with whole cells", "[mesh]") {
  const SurfaceGrid grid = grid_around(triangle(), 0.9, 0);
  CHECK(grid.n[0] == 4);
  CHECK(grid.n[1] == 3);
  CHECK(grid.n[2] == 1);
  CHECK((grid.point(std::size_t{5}) - Vec3(1.5, 1.5, 0)).norm() < 1e-15);
  CHECK(grid_around(triangle(), 1, 2).n[0] == 8);
}

TEST_CASE("surface grid: in the plane, what is inside of a triangle and how far from it",
          "[mesh]") {
  const ClosedSurface surface = triangle();
  const SurfaceGrid grid = grid_around(surface, 1, 1);  // middles at -0.5, 0.5, ...
  const auto inside = inside_of(surface, grid);
  const auto away = distances_to(surface, grid, 1.1);
  double most = 0;
  int n = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const Vec3 x = grid.point(k);
    const bool expected = x.x() > 0 && x.y() > 0 && 3 * x.x() + 4 * x.y() < 12;
    CHECK((inside[k] != 0) == expected);
    n += inside[k];
    const double d = distance(surface, x);
    if (d >= 1.1) {
      CHECK(away[k] == std::numeric_limits<double>::infinity());
    } else {
      most = std::max(most, std::abs(away[k] - d));
    }
  }
  CHECK(n == 6);
  CHECK(most < 1e-15);
}

TEST_CASE("surface grid: in space, cells inside of a ball fill it", "[mesh]") {
  const ClosedSurface surface = ball(12);
  const SurfaceGrid grid = grid_around(surface, 0.1, 0.25);
  const auto inside = inside_of(surface, grid);
  int n = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    n += inside[k];
    const double r = (grid.point(k) - Vec3(0.3, 0, 0)).norm();
    if (r < 0.98) CHECK(inside[k] == 1);
    if (r > 1) CHECK(inside[k] == 0);
  }
  CHECK(n * grid.cell.prod() == Approx(4 * std::numbers::pi / 3).epsilon(0.02));
}
