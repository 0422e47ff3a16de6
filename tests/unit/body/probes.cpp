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

TEST_CASE("probes: the force on a wall or a part, split into pressure and viscosity", "[body]") {
  Draft draft;
  draft.parts = {test::plate("panel", 2, 2, 1, 1), test::particles("pool", {{0, 0, -1}})};
  const auto make = [&](const std::string& of) {
    return make_world(
        "parts: {panel: {made: yes}, pool: {made: yes}}\n"
        "contacts: {slam: {made: yes, between: [pool, panel]}}\n"
        "boundaries: {basin: {planes: {x: [-5, 5], z: -5}}}\n"
        "probes: {wall: {wall_force: " +
            of + "}}\n",
        draft, {planes_effect(), wall_force_effect()});
  };
  const auto add = [](World& world, const std::string& name, const Vec3& force) {
    world.scene.measures.push_back({name, "N", {"x", "y", "z"}, [force](double* to) {
                                      for (int d = 0; d < 3; ++d) to[d] = force[d];
                                    }});
  };
  const auto read = [&](const std::string& of) {
    auto world = make(of);
    REQUIRE(test::mistakes_of(*world).empty());
    add(*world, "plane.basin.x_min.force", {-8, 0, 0});
    add(*world, "plane.basin.x_max.force", {5, 0, 0});
    add(*world, "plane.basin.z_min.force", {0, 1, -30});
    add(*world, "plane.basin.z_min.viscous_force", {0, 1, -2});
    add(*world, "contact.slam.force", {1, 2, 3});
    add(*world, "plane.basin_2.force", {100, 100, 100});
    std::vector<double> values(9);
    for (const Measure& m : world->scene.measures) {
      if (m.name == "probe.wall") m.sample(values.data());
    }
    return values;
  };
  CHECK(read("basin") == std::vector<double>{-3, 0, -28, 0, 1, -2, -3, 1, -30});
  CHECK(read("basin.x_max") == std::vector<double>{5, 0, 0, 0, 0, 0, 5, 0, 0});
  CHECK(read("panel") == std::vector<double>{1, 2, 3, 0, 0, 0, 1, 2, 3});
  CHECK_THAT(test::mistakes_of(*make("bassin")),
             Catch::Contains("there is no wall or part 'bassin'; there are: basin.x_min, "
                             "basin.x_max, basin.z_min, panel"));
  CHECK_THAT(test::mistakes_of(*make("pool")), Catch::Contains("'pool' is made of particles"));
}
