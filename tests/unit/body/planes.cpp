#include <catch2/catch.hpp>

#include "body/effects.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;

TEST_CASE("planes: walls across the axes point inwards and are named", "[body]") {
  Draft draft;
  auto world = make_world(
      "boundaries:\n"
      "  basin: {planes: {x: [-500 mm, 0.5 m], y: [-0.3, 0.3], z: -0.4 m}}\n"
      "  beach: {plane: {point: [1 m, 0, 0], normal: [-3, 0, 4]}}\n",
      draft, {planes_effect()});
  const auto& planes = world->scene.planes;
  REQUIRE(planes.size() == 6);
  CHECK(planes[0].name == "basin.x_min");
  CHECK(planes[0].point == Vec3(-0.5, 0, 0));
  CHECK(planes[0].normal == Vec3(1, 0, 0));
  CHECK(planes[1].name == "basin.x_max");
  CHECK(planes[1].point == Vec3(0.5, 0, 0));
  CHECK(planes[1].normal == Vec3(-1, 0, 0));
  CHECK(planes[4].name == "basin.z_min");
  CHECK(planes[4].point == Vec3(0, 0, -0.4));
  CHECK(planes[4].normal == Vec3(0, 0, 1));
  CHECK(planes[4].where.text() == "case.yaml:3:60");
  CHECK(planes[5].name == "beach");
  CHECK((planes[5].normal - Vec3(-0.6, 0, 0.8)).norm() < 1e-15);
}

TEST_CASE("planes: mistakes name their place", "[body]") {
  const auto mistakes = [](const std::string& text) {
    return test::mistakes_of(*make_world("boundaries: {b: " + text + "}\n", {}, {planes_effect()}));
  };
  CHECK_THAT(mistakes("{planes: {x: [1, -1]}}"), Catch::Contains("case.yaml:2:") &&
                                                     Catch::Contains("boundaries.b.planes.x") &&
                                                     Catch::Contains("must lie below"));
  CHECK_THAT(mistakes("{planes: {x: [1, 2, 3]}}"), Catch::Contains("3 numbers"));
  CHECK_THAT(mistakes("{plane: {point: [0, 0, 0], normal: [0, 0, 0]}}"),
             Catch::Contains("a normal needs a length above 0"));
}
