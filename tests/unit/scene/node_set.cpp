#include "scene/node_set.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "input/case.hpp"
#include "scene/draft.hpp"

using namespace gannet;

namespace {

// A plate of 3 x 2 unit squares, a closed cube and two particles.
Scene make_scene() {
  Draft draft;
  PartDraft plate;
  plate.name = "plate";
  plate.cell = Cell::quad;
  for (int j = 0; j <= 2; ++j) {
    for (int i = 0; i <= 3; ++i) plate.points.emplace_back(i, j, 0);
  }
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int a = 4 * j + i;
      for (const int k : {a, a + 1, a + 5, a + 4}) plate.connectivity.push_back(k);
    }
  }
  PartDraft cube;
  cube.name = "cube";
  cube.cell = Cell::quad;
  for (int k = 0; k < 8; ++k) cube.points.emplace_back(10 + (k & 1), k >> 1 & 1, k >> 2 & 1);
  cube.connectivity = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  PartDraft fan;  // a square of two triangles, written with a repeated node
  fan.name = "fan";
  fan.cell = Cell::quad;
  fan.points = {{20, 0, 0}, {21, 0, 0}, {21, 1, 0}, {20, 1, 0}, {20.5, 0.5, 0}};
  fan.connectivity = {0, 1, 4, 4, 1, 2, 4, 4, 2, 3, 4, 4, 3, 0, 4, 4};
  PartDraft pool;
  pool.name = "pool";
  pool.points = {{0, 0, -1}, {1, 0, -1}};
  draft.parts = {pool, plate, cube, fan};
  Scene scene;
  assemble(draft, scene);
  return scene;
}

struct Asked {
  std::vector<Vec3> points;
  std::vector<Index> set;
  std::string mistakes;
};

Asked ask(const std::string& nodes) {
  const Scene scene = make_scene();
  const Schema schema{{"parts.*", {.name = "made", .kind = Kind::flag}},
                      {"probes.*", node_set_key("nodes", true)}};
  const auto the_case = read_case_text(
      "gannet: 1\n"
      "parts: {plate: {made: yes}, cube: {made: yes}, fan: {made: yes}, "
      "pool: {made: yes}, ghost: {made: yes}}\n"
      "probes:\n  p: {nodes: " +
          nodes + "}\n",
      "case.yaml", schema);
  Asked asked;
  asked.set = select_nodes(the_case->keys().map("probes").map("p").map("nodes"), scene);
  for (const Index i : asked.set) {
    asked.points.push_back(xyz(scene.nodes.x[static_cast<std::size_t>(i)]));
  }
  for (const std::string& m : the_case->mistakes.messages()) asked.mistakes += m;
  return asked;
}

}  // namespace

TEST_CASE("node sets: all nodes of a part, in rising order", "[scene]") {
  const Asked asked = ask("{part: plate}");
  CHECK(asked.set.size() == 12);
  CHECK(std::is_sorted(asked.set.begin(), asked.set.end()));
  CHECK(asked.mistakes.empty());
}

TEST_CASE("node sets: the edge of a surface is what one cell alone uses", "[scene]") {
  const Asked asked = ask("{edge_of: plate}");
  CHECK(asked.points.size() == 10);
  for (const Vec3& x : asked.points) {
    CHECK((x.x() == 0 || x.x() == 3 || x.y() == 0 || x.y() == 2));
  }
  // Triangles that repeat a node have no edge of length zero: the middle is not on the edge.
  const Asked fan = ask("{edge_of: fan}");
  CHECK(fan.points.size() == 4);
  for (const Vec3& x : fan.points) CHECK(x.x() != 20.5);
  CHECK_THAT(ask("{edge_of: cube}").mistakes,
             Catch::Contains("case.yaml:4:") &&
                 Catch::Contains("part 'cube' is closed: it has no free edge"));
}

TEST_CASE("node sets: nearest node, box and plane", "[scene]") {
  const Asked one = ask("{nearest: [2.2, 0.9, 5], of: plate}");
  REQUIRE(one.points.size() == 1);
  CHECK(one.points[0] == Vec3(2, 1, 0));
  // Faces of the box belong to it, also when they miss a node by rounding.
  const Asked box = ask("{box: {from: [3, 2, 0], to: [1.0000000001, 1, 0]}, of: plate}");
  CHECK(box.points.size() == 6);
  const Asked plane = ask("{plane: {point: [9, 1, 9], normal: [0, 7, 0]}, of: plate}");
  CHECK(plane.points.size() == 4);
  const Asked thick =
      ask("{plane: {point: [0.4, 0, 0], normal: [1, 0, 0], within: 600 mm}, of: plate}");
  CHECK(thick.points.size() == 6);
  for (const Vec3& x : thick.points) CHECK(x.x() <= 1);
}

TEST_CASE("node sets: mistakes name their place", "[scene]") {
  CHECK_THAT(ask("{box: {from: [5, 5, 5], to: [6, 6, 6]}, of: plate}").mistakes,
             Catch::Contains("case.yaml:4:") &&
                 Catch::Contains("probes.p.nodes.box: no node of 'plate' lies there"));
  CHECK_THAT(ask("{part: pool}").mistakes,
             Catch::Contains("probes.p.nodes.part") && Catch::Contains("made of particles"));
  CHECK_THAT(ask("{part: ghost}").mistakes,
             Catch::Contains("there is no part 'ghost'; parts with elements: plate, cube, fan"));
  CHECK_THAT(ask("{part: plate, edge_of: plate}").mistakes,
             Catch::Contains("one of part, edge_of, nearest, box, plane"));
  CHECK_THAT(ask("{of: plate}").mistakes,
             Catch::Contains("one of part, edge_of, nearest, box, plane"));
  CHECK_THAT(ask("{nearest: [0, 0, 0]}").mistakes, Catch::Contains("say of which part"));
  CHECK_THAT(ask("{part: plate, of: plate}").mistakes, Catch::Contains("names its part already"));
  CHECK_THAT(ask("{plane: {point: [0, 0, 0], normal: [0, 0, 0]}, of: plate}").mistakes,
             Catch::Contains("a normal needs a length above 0"));
  CHECK(ask("{part: pool}").set.empty());
}
