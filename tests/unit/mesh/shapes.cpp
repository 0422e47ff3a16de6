#include "mesh/shapes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "case_values.hpp"
#include "mesh/line_shapes.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double deg = std::numbers::pi / 180;
// Coordinates are sums of a few products of numbers of order 1: a few roundings of 1e-16.
constexpr double rounding = 1e-15;

// Twice the area of a cell as a vector along its normal.
Vec3 doubled_area(const SurfaceMesh& mesh, std::size_t cell) {
  const auto x = [&](std::size_t k) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(mesh.quads[4 * cell + k])];
  };
  return (x(2) - x(0)).cross(x(3) - x(1));
}

SurfaceMesh made(const Value& part, std::string expected_messages = "") {
  Mistakes mistakes;
  const SurfaceMesh mesh = surface_mesh(Keys(part, mistakes));
  CHECK(messages(mistakes) == expected_messages);
  return mesh;
}

Value shape(const std::string& name, std::vector<Value> keys) {
  return part({map("shape", {map(name, std::move(keys))})});
}

}  // namespace

TEST_CASE("plate: a tilted plate rises to +x from the middle of its lowest edge", "[mesh]") {
  // A 5 m long plate at tan(tilt) = 3/4 spans 4 m in x and 3 m in z.
  const Value asked =
      shape("plate", {numbers("size", {5, 2}), numbers("elements", {2, 1}),
                      numbers("tilt", {std::atan2(3, 4)}), numbers("lowest_point", {1, 0, 0.5})});
  const SurfaceMesh mesh = made(asked);
  const std::vector<Vec3> expected = {{1, -1, 0.5}, {3, -1, 2}, {5, -1, 3.5},
                                      {1, 1, 0.5},  {3, 1, 2},  {5, 1, 3.5}};
  REQUIRE(mesh.points.size() == expected.size());
  for (std::size_t p = 0; p < expected.size(); ++p) {
    CHECK((mesh.points[p] - expected[p]).norm() < 4 * rounding);
  }
  CHECK(mesh.quads == std::vector<Index>{0, 1, 4, 3, 1, 2, 5, 4});
  // Each cell has 2.5 m x 2 m, its normal is (-3, 0, 4)/5.
  CHECK((doubled_area(mesh, 0) - 10 * Vec3(-0.6, 0, 0.8)).norm() < 40 * rounding);
}

TEST_CASE("plate: tilted the other way, the lowest point is on the edge at +x", "[mesh]") {
  const SurfaceMesh mesh =
      made(shape("plate", {numbers("size", {2, 2}), numbers("elements", {1, 1}),
                           numbers("tilt", {-30 * deg}), numbers("lowest_point", {0, 0, 1})}));
  REQUIRE(mesh.points.size() == 4);
  CHECK((mesh.points[1] - Vec3(0, -1, 1)).norm() < rounding);
  CHECK((mesh.points[0] - Vec3(-std::sqrt(3), -1, 2)).norm() < 4 * rounding);
}

TEST_CASE("plate: stands around its centre, at the origin unless said", "[mesh]") {
  const SurfaceMesh origin =
      made(shape("plate", {numbers("size", {4, 2}), numbers("elements", {4, 3})}));
  CHECK(origin.points.size() == 5 * 4);
  CHECK(origin.quads.size() == 4 * 4 * 3);
  CHECK(origin.points.front() == Vec3(-2, -1, 0));
  CHECK(origin.points.back() == Vec3(2, 1, 0));
  const SurfaceMesh moved =
      made(shape("plate", {numbers("size", {4, 2}), numbers("elements", {4, 3}),
                           numbers("centre", {1, 2, 3})}));
  CHECK(moved.points.front() == Vec3(-1, 1, 3));
}

TEST_CASE("plane: corner and two edges, normal along x across", "[mesh]") {
  const SurfaceMesh mesh =
      made(shape("plane", {numbers("corner", {1, 0, 0}), numbers("along", {0, 2, 0}),
                           numbers("across", {0, 1, 4}), numbers("elements", {2, 2})}));
  REQUIRE(mesh.points.size() == 9);
  CHECK(mesh.points[4] == Vec3(1, 1.5, 2));
  CHECK(mesh.points[8] == Vec3(1, 3, 4));
  CHECK(doubled_area(mesh, 3) == Vec3(4, 0, 0));  // 8 m^2 over 4 cells, twice
}

TEST_CASE("wedge: two plates share the keel and point upwards", "[mesh]") {
  const SurfaceMesh mesh =
      made(shape("wedge", {numbers("deadrise", {std::atan2(1, 2)}), numbers("half_breadth", {2}),
                           numbers("length", {3}), numbers("elements", {2, 3}),
                           numbers("lowest_point", {0, 0, -1})}));
  REQUIRE(mesh.points.size() == 5 * 4);  // the keel counts once
  CHECK(mesh.quads.size() == 4 * 4 * 3);
  const std::vector<double> z = {0, -0.5, -1, -0.5, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK((mesh.points[i] - Vec3(double(i) - 2, -1.5, z[i])).norm() < rounding);
  }
  double lowest_normal = 1;
  for (std::size_t c = 0; c < 12; ++c) {
    lowest_normal = std::min(lowest_normal, doubled_area(mesh, c).normalized().z());
  }
  CHECK(lowest_normal == Approx(2 / std::sqrt(5)).epsilon(1e-14));
}

TEST_CASE("box: six faces are closed, joined and look outwards", "[mesh]") {
  const SurfaceMesh mesh = made(shape("box", {numbers("from", {0, 0, 0}), numbers("to", {1, 2, 3}),
                                              numbers("elements", {1, 2, 3})}));
  CHECK(mesh.points.size() == 24);     // 2 x 3 x 4 places of which all are on the surface
  CHECK(mesh.quads.size() == 4 * 22);  // 2 (1x2 + 2x3 + 3x1)
  Vec3 closed = Vec3::Zero();
  double volume = 0;
  std::map<std::pair<Index, Index>, int> edges;
  for (std::size_t c = 0; c < 22; ++c) {
    const Vec3 area = 0.5 * doubled_area(mesh, c);
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Index a = mesh.quads[4 * c + k];
      const Index b = mesh.quads[4 * c + (k + 1) % 4];
      middle += 0.25 * mesh.points[static_cast<std::size_t>(a)];
      edges[{a, b}] += 1;
    }
    closed += area;
    volume += area.dot(middle) / 3;  // Gauss; positive where the normals look outwards
  }
  CHECK(closed.norm() < 10 * rounding);
  CHECK(volume == Approx(6).epsilon(1e-14));
  // Every edge is used once in each sense: no gap, one orientation.
  for (const auto& [edge, n] : edges) {
    CHECK(n == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("shapes: what makes no surface is a located mistake", "[mesh][errors]") {
  const Value size = numbers("size", {1, 1});
  const Value elements = numbers("elements", {2, 2});
  const auto answer = [](const Value& asked) {
    Mistakes mistakes;
    CHECK(surface_mesh(Keys(asked, mistakes)).empty());
    return messages(mistakes);
  };
  const auto plate = [&](std::vector<Value> keys) { return answer(shape("plate", keys)); };

  CHECK(answer(part({})) ==
        "case.yaml:10:5: parts.skin: its surface is missing; a 'shape' or a 'mesh' is wanted");
  CHECK(answer(part({map("shape", {})})) ==
        "case.yaml:11:5: parts.skin.shape: no shape is named; one of plate, plane, wedge, box is "
        "wanted");
  CHECK(answer(part({map("shape", {map("plate", {}), map("box", {})})})) ==
        "case.yaml:11:5: parts.skin.shape: 2 shapes are named; a part has one");
  CHECK(answer(part({map("shape", {}), map("mesh", {})})) ==
        "case.yaml:12:5: parts.skin.mesh: stands beside 'shape'; a part has one of them");
  CHECK(plate({numbers("size", {1, -2}), elements}) ==
        "case.yaml:13:5: parts.skin.shape.plate.size: -2 m is not a length; it must be > 0");
  CHECK(plate({numbers("size", {1}), elements}) ==
        "case.yaml:13:5: parts.skin.shape.plate.size: 1 lengths are given; 2 are wanted");
  CHECK(plate({size, numbers("elements", {2, 0.5})}) ==
        "case.yaml:14:5: parts.skin.shape.plate.elements: 0.5 is not a number of elements; whole "
        "numbers from 1 on are wanted");
  CHECK(plate({size, numbers("elements", {2, 2, 2})}) ==
        "case.yaml:14:5: parts.skin.shape.plate.elements: 3 numbers are given; 2 are wanted, one a "
        "direction");
  CHECK(plate({size, numbers("elements", {1e5, 1e5})}) ==
        "case.yaml:14:5: parts.skin.shape.plate.elements: 1e+10 elements are more than the largest "
        "mesh (1e+08)");
  CHECK(plate({size, elements, numbers("centre", {0, 0, 0}), numbers("lowest_point", {0, 0, 0})}) ==
        "case.yaml:16:5: parts.skin.shape.plate.lowest_point: stands beside 'centre'; one of them "
        "places the plate");
  CHECK(answer(shape("plane", {numbers("corner", {0, 0, 0}), numbers("along", {1, 0, 0}),
                               numbers("across", {2, 0, 0}), elements})) ==
        "case.yaml:15:5: parts.skin.shape.plane.across: has the direction of 'along' (or one of "
        "them is zero), so that they span no area");
  CHECK(answer(shape("box", {numbers("from", {0, 0, 1}), numbers("to", {1, 1, 1}),
                             numbers("elements", {1, 1, 1})})) ==
        "case.yaml:14:5: parts.skin.shape.box.to: z = 1 m must be greater than that of 'from', 1 "
        "m");
}

TEST_CASE("shapes: a line in legs of equal elements", "[mesh]") {
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 3}};
  const int n[] = {2, 3};
  const LineMesh mesh = polyline_mesh(corners, n);
  REQUIRE(mesh.points.size() == 6);
  CHECK(mesh.cells == std::vector<Index>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5});
  CHECK((mesh.points[1] - Vec3(0.5, 0, 0)).norm() < rounding);
  CHECK((mesh.points[4] - Vec3(1, 0, 2)).norm() < rounding);
  CHECK(mesh.points[2] == corners[1]);
  CHECK(mesh.points[5] == corners[2]);
}
