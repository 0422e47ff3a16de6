#include <catch2/catch.hpp>

#include <cmath>

#include "body/effects.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;
using gannet::test::World;

namespace {

std::unique_ptr<World> probed_world(const std::string& probes) {
  Draft draft;
  draft.parts = {test::plate("panel", 2, 2, 1, 1)};
  return make_world(
      "parts: {panel: {made: yes}}\n"
      "contacts: {slam: {made: yes}}\n"
      "boundaries: {corner: {nodes: {nearest: [0, 0, 0], of: panel}, fix: [z]},\n"
      "             basin: {planes: {z: -5}}}\n"
      "loads: {gravity: [0, 0, -10 m/s^2]}\n"
      "probes: " +
          probes + "\n",
      draft, {gravity_effect(), planes_effect(), prescribed_motion_effect(), probes_effect()});
}

}  // namespace

TEST_CASE("probes: displacement and velocity are means over the set, at level n", "[body]") {
  auto world = probed_world(
      "{tip: {displacement: {node: {nearest: [1, 1, 0], of: panel}}},\n"
      "  mean: {velocity: {node: {part: panel}}}, tip_v: {velocity: {node: {nearest: [1, 1, 0], "
      "of: panel}}}}");
  REQUIRE(test::mistakes_of(*world).empty());
  Vec3 tip;
  Vec3 tip_v;
  Vec3 mean;
  world->model().plan.add(
      {.name = "look of the test", .stage = Stage::look, .run = [&](const Step&) {
         tip = world->measure("probe.tip");
         tip_v = world->measure("probe.tip_v");
         mean = world->measure("probe.mean");
       }});
  world->take_steps(11);  // the last look is at 10 ms
  CHECK((tip - Vec3(0, 0, -5e-4)).norm() < 1e-16);
  CHECK((tip_v - Vec3(0, 0, -0.1)).norm() < 1e-15);
  CHECK((mean - Vec3(0, 0, -0.1 * 8 / 9)).norm() < 1e-15);  // one of nine nodes is held
}

TEST_CASE("probes: forces of contacts and boundaries are passed on", "[body]") {
  auto world = probed_world("{a: {contact_force: slam}, b: {boundary_force: corner}}");
  REQUIRE(test::mistakes_of(*world).empty());
  CHECK(std::isnan(world->measure("probe.a").x()));  // nobody makes it yet
  world->scene.measures.push_back({"contact.slam.force", "N", {"x", "y", "z"}, [](double* to) {
                                     to[0] = 1;
                                     to[1] = 2;
                                     to[2] = 3;
                                   }});
  CHECK(world->measure("probe.a") == Vec3(1, 2, 3));
  world->take_steps(2);
  CHECK((world->measure("probe.b") - Vec3(0, 0, 20)).norm() < 1e-13);
}

TEST_CASE("probes: mistakes name their place", "[body]") {
  const auto mistakes = [](const std::string& p) { return test::mistakes_of(*probed_world(p)); };
  CHECK_THAT(mistakes("{a: {boundary_force: basin}}"),
             Catch::Contains("case.yaml:7:") &&
                 Catch::Contains("probes.a.boundary_force: boundary 'basin' has no nodes"));
  CHECK_THAT(mistakes("{a: {boundary_force: corner, contact_force: slam}}"),
             Catch::Contains("watches one thing"));
  // A contact that the case does not have is found when the case is read.
  CHECK_THROWS_WITH(probed_world("{a: {contact_force: slum}}"),
                    Catch::Contains("probes.a.contact_force") && Catch::Contains("slum"));
}
