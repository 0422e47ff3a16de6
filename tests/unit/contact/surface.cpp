#include "contact/surface.hpp"

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace gannet;

namespace {

Part part_of(Cell cell, std::vector<Index> nodes) {
  Part p;
  p.cell = cell;
  p.connectivity.assign(nodes.begin(), nodes.end());
  return p;
}

}  // namespace

TEST_CASE("surface: neighbours, rim and sheets of a plate", "[contact]") {
  Scene scene;
  test::Builder b;
  b.nx = 3;
  b.ny = 3;
  b.fill(scene);
  const Surface s = make_surface(scene.parts[0]);
  REQUIRE(s.segments.size() == 9);
  const std::array<Index, 4> around{1, 5, 7, 3};  // of the middle one: below, right, above, left
  CHECK(s.segments[4].neighbour == around);
  CHECK(s.segments[0].neighbour == std::array<Index, 4>{-1, 1, 3, -1});
  int rim = 0;
  for (const auto at_rim : s.at_rim) rim += at_rim;
  CHECK(rim == 12);
  for (const Segment& g : s.segments) CHECK(g.sheet == 0);
}

TEST_CASE("surface: segments given upside down are turned", "[contact]") {
  Scene scene;
  test::Builder b;
  b.nx = 4;
  b.ny = 2;
  b.fill(scene);
  auto& c = scene.parts[0].connectivity;
  std::swap(c[4 * 3 + 1], c[4 * 3 + 3]);  // segments 3 and 5 the other way around
  std::swap(c[4 * 5 + 1], c[4 * 5 + 3]);
  Surface s = make_surface(scene.parts[0]);
  update_surface(scene.nodes, s);
  for (const SegmentPlace& p : s.place) CHECK(p.normal.z() == Approx(1));
}

TEST_CASE("surface: a junction of three ends the sheets", "[contact]") {
  // A T of three triangles on the edge 0-1.
  const Surface s = make_surface(part_of(Cell::triangle, {0, 1, 2, 0, 1, 3, 0, 1, 4}));
  CHECK(s.segments[0].sheet != s.segments[1].sheet);
  CHECK(s.segments[1].sheet != s.segments[2].sheet);
  CHECK(s.at_rim[0] == 1);
}

TEST_CASE("surface: a closed ring of lines has no rim and one side", "[contact]") {
  // A square, two of its lines the other way around.
  Part ring = part_of(Cell::line, {0, 1, 2, 1, 2, 3, 0, 3});
  Surface s = make_surface(ring);
  for (const auto rim : s.at_rim) CHECK(rim == 0);
  Nodes nodes;
  nodes.x = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  update_surface(nodes, s);
  const Vec3 centre(0.5, 0.5, 0);
  const bool inward = s.place[0].normal.dot(centre - s.place[0].centre) > 0;
  for (const SegmentPlace& p : s.place) {
    CHECK((p.normal.dot(centre - p.centre) > 0) == inward);
    CHECK(p.normal.norm() == Approx(1));
  }
}

TEST_CASE("surface: a quad with a repeated corner is a triangle", "[contact]") {
  const Surface s = make_surface(part_of(Cell::quad, {0, 1, 2, 2}));
  CHECK(s.segments[0].n_corners == 3);
}
