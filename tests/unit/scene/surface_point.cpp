#include "scene/surface_point.hpp"

#include <catch2/catch.hpp>

#include "scene/draft.hpp"

using namespace gannet;

namespace {

Scene scene_of(Cell cell, std::vector<Vec3> points, std::vector<int> connectivity) {
  PartDraft part;
  part.name = "panel";
  part.cell = cell;
  part.points = std::move(points);
  for (const int c : connectivity) part.connectivity.push_back(c);
  Draft draft;
  draft.parts = {part};
  Scene scene;
  assemble(draft, scene);
  return scene;
}

}  // namespace

TEST_CASE("surface point: the foot on a quad, and it moves with the corners", "[scene]") {
  Scene scene = scene_of(Cell::quad, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 3});
  const SurfacePoint point = nearest_on_part(scene, 0, {0.3, 0.8, -0.2});
  REQUIRE(point.n == 3);
  CHECK((place_of(point, scene.nodes) - Vec3(0.3, 0.8, 0)).norm() < 1e-15);
  CHECK(point.height == Approx(-0.2));
  CHECK((normal_of(point, scene.nodes) - Vec3::UnitZ()).norm() < 1e-15);
  // The plate is turned about the x axis by a quarter and moved on.
  for (Line& x : scene.nodes.x) x = {x.x + 5, 0, x.y, x.w};
  CHECK((place_of(point, scene.nodes) - Vec3(5.3, 0, 0.8)).norm() < 1e-15);
  CHECK((normal_of(point, scene.nodes) + Vec3::UnitY()).norm() < 1e-15);
}

TEST_CASE("surface point: beyond an edge or a corner it is the nearest point of it", "[scene]") {
  const Scene scene = scene_of(Cell::triangle, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {0, 1, 2});
  const auto at = [&](const Vec3& x) {
    return place_of(nearest_on_part(scene, 0, x), scene.nodes);
  };
  CHECK((at({0.5, -1, 3}) - Vec3(0.5, 0, 0)).norm() < 1e-15);
  CHECK((at({-4, -1, 0}) - Vec3(0, 0, 0)).norm() < 1e-15);
  CHECK((at({2, 2, 1}) - Vec3(1, 1, 0)).norm() < 1e-15);
}

TEST_CASE("surface point: on a segment of a plane case; none on hexahedra", "[scene]") {
  const Scene line = scene_of(Cell::line, {{0, 0, 0}, {2, 0, 0}}, {0, 1});
  const SurfacePoint point = nearest_on_part(line, 0, {0.5, 3, 0});
  CHECK((place_of(point, line.nodes) - Vec3(0.5, 0, 0)).norm() < 1e-15);
  CHECK(std::abs(point.height) == Approx(3));
  const Scene solid = scene_of(
      Cell::hexahedron,
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(nearest_on_part(solid, 0, {0, 0, 0}).n == 0);
}
