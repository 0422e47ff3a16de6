#include "mesh/closed_surface.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "mesh/shapes.hpp"
#include "mesh/volume_shapes.hpp"

using namespace gannet;

namespace {

ClosedSurface box(const Vec3& from, const Vec3& to, std::array<int, 3> n) {
  const SurfaceMesh mesh = box_surface(from, to, n);
  ClosedSurface surface;
  add_boundary(mesh.points, mesh.quads, 4, false, surface);
  return surface;
}

/// A sphere of radius 1 about the origin: a cube of n x n cells a side, mapped.
ClosedSurface sphere(int n) {
  SurfaceMesh mesh = box_surface({-1, -1, -1}, {1, 1, 1}, {n, n, n});
  for (Vec3& x : mesh.points) x.normalize();
  ClosedSurface surface;
  add_boundary(mesh.points, mesh.quads, 4, false, surface);
  REQUIRE(close_surface(surface).empty());
  return surface;
}

ClosedSurface circle(int n) {
  ClosedSurface surface{.dimension = 2};
  std::vector<Vec3> points;
  std::vector<Index> lines;
  for (int k = 0; k <= n; ++k) {  // the last point is the first once more, but for rounding
    const double angle = 2 * std::numbers::pi * k / n;
    points.emplace_back(2 + std::cos(angle), std::sin(angle), 0);
    if (k > 0) lines.insert(lines.end(), {k, k - 1});
  }
  add_boundary(points, lines, 2, false, surface);
  REQUIRE(close_surface(surface).empty());
  return surface;
}

}  // namespace

TEST_CASE("closed surface: moments of a box are exact", "[mesh]") {
  ClosedSurface surface = box({1, 2, 3}, {2, 4, 6}, {2, 3, 1});
  REQUIRE(close_surface(surface).empty());
  const VolumeMoments m = volume_moments(surface);
  CHECK(m.volume == Approx(6).epsilon(1e-14));
  CHECK((m.centre - Vec3(1.5, 3, 4.5)).norm() < 1e-14);
  // V L^2/12 along each axis
  const Mat3 expected = Vec3(0.5, 2, 4.5).asDiagonal();
  CHECK((m.second - expected).norm() < 1e-13);
}

TEST_CASE("closed surface: facets are turned outwards whatever way they were given", "[mesh]") {
  ClosedSurface surface = box({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  for (std::size_t k = 0; k < surface.facets.size(); k += 3) {
    std::swap(surface.facets[k][0], surface.facets[k][1]);
  }
  REQUIRE(close_surface(surface).empty());
  CHECK(volume_moments(surface).volume == Approx(1).epsilon(1e-14));
}

TEST_CASE("closed surface: volume and second moments of a sphere at order 2", "[mesh]") {
  double error[2];
  for (const int k : {0, 1}) {
    const VolumeMoments m = volume_moments(sphere(8 << k));
    CHECK(m.centre.norm() < 1e-14);
    error[k] = 1 - m.second(0, 0) / (4 * std::numbers::pi / 15);
  }
  CHECK(error[1] < 0.01);
  CHECK(std::log2(error[0] / error[1]) == Approx(2).margin(0.1));
}

TEST_CASE("closed surface: in the plane, moments of a circle", "[mesh]") {
  const VolumeMoments m = volume_moments(circle(400));
  CHECK(m.volume == Approx(std::numbers::pi).epsilon(1e-4));
  CHECK((m.centre - Vec3(2, 0, 0)).norm() < 1e-14);
  CHECK(m.second(0, 0) == Approx(std::numbers::pi / 4).epsilon(2e-4));
  CHECK(m.second(1, 1) == Approx(std::numbers::pi / 4).epsilon(2e-4));
}

TEST_CASE("closed surface: what is inside, and how far away", "[mesh]") {
  const ClosedSurface ball = sphere(16);
  const ClosedSurface disc = circle(100);
  for (int k = 0; k < 400; ++k) {
    const Vec3 x(1.4 * std::sin(k), 1.4 * std::sin(1.7 * k + 1), 1.4 * std::sin(2.3 * k + 2));
    if (std::abs(x.norm() - 1) < 0.01) continue;
    CHECK(contains(ball, x) == (x.norm() < 1));
    CHECK(distance(ball, x) == Approx(std::abs(x.norm() - 1)).margin(0.01));
    const Vec3 flat(x.x(), x.y(), 0);
    if (std::abs(flat.norm() - 1) < 0.01) continue;
    CHECK(contains(disc, flat + Vec3(2, 0, 0)) == (flat.norm() < 1));
    CHECK(distance(disc, flat + Vec3(2, 0, 0)) == Approx(std::abs(flat.norm() - 1)).margin(0.001));
  }
}

TEST_CASE("closed surface: two parts that meet close each other", "[mesh]") {
  const SurfaceMesh whole = box_surface({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  ClosedSurface surface;
  const auto half = static_cast<std::ptrdiff_t>(whole.quads.size() / 2);
  add_boundary(whole.points, {whole.quads.begin(), whole.quads.begin() + half}, 4, false, surface);
  ClosedSurface open = surface;
  CHECK(close_surface(open).find("is not closed: an edge at (") == 0);
  add_boundary(whole.points, {whole.quads.begin() + half, whole.quads.end()}, 4, false, surface);
  CHECK(close_surface(surface).empty());
  CHECK(volume_moments(surface).volume == Approx(1).epsilon(1e-14));
}

TEST_CASE("closed surface: the boundary of solids", "[mesh]") {
  const VolumeMesh bricks = block_volume({0, 0, 0}, {2, 1, 1}, {3, 2, 2});
  for (const VolumeMesh& mesh : {bricks, tetrahedra_of(bricks)}) {
    ClosedSurface surface;
    add_boundary(mesh.points, mesh.cells, mesh.nodes_per_cell, true, surface);
    REQUIRE(close_surface(surface).empty());
    CHECK(volume_moments(surface).volume == Approx(2).epsilon(1e-14));
  }
  const VolumeMesh area = block_area({0, 0, 0}, {2, 1, 0}, {3, 2});
  ClosedSurface curve{.dimension = 2};
  add_boundary(area.points, area.cells, 4, true, curve);
  REQUIRE(close_surface(curve).empty());
  CHECK(volume_moments(curve).volume == Approx(2).epsilon(1e-14));
}
