#include "body/prescribed_motion.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "body/effects.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;
using gannet::test::World;

namespace {

const std::string header = "parts: {panel: {made: yes}, pool: {made: yes}}\n";

std::unique_ptr<World> panel_world(const std::string& text, bool rotations = false) {
  Draft draft;
  draft.parts = {test::plate("panel", 3, 2, 3, 2, rotations), test::particles("pool", {{0, 0, 5}})};
  return make_world(header + text, draft,
                    {gravity_effect(), prescribed_motion_effect(), nodal_force_effect()});
}

std::string mistakes_of_boundaries(const std::string& boundaries, bool rotations = false) {
  try {
    return test::mistakes_of(*panel_world("boundaries:\n" + boundaries, rotations));
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("prescribed motion: the path is the velocity's integral, whatever pushes", "[body]") {
  auto world = panel_world(
      "let: {V: 6 m/s}\n"
      "boundaries:\n"
      "  edges: {nodes: {edge_of: panel}, velocity: [free, free, \"-V\"]}\n"
      "loads: {push: {force: {nodes: {part: panel}, value: [12 N, 0, 5 kN]}}}\n");
  Nodes& nodes = world->scene.nodes;
  const auto& motion = world->scene.store.get<PrescribedMotions>().list.front();
  for (const Index i : motion.nodes) CHECK(nodes.v[i].z == -6);  // from the start
  for (int n = 0; n < 40; ++n) {
    world->dt = n % 3 == 0 ? 1e-3 : 1.7e-3;
    world->take_steps(1);
  }
  const double t = world->time();
  for (const Index i : motion.nodes) {
    CHECK(nodes.x[i].z == Approx(-6 * t).epsilon(1e-13));
    CHECK(nodes.v[i].z == -6);
    CHECK(nodes.v[i].x > 0);  // 1 N on 2 kg: free
  }
}

TEST_CASE("prescribed motion: a factor in time is followed exactly over its corners", "[body]") {
  auto world = panel_world(
      "boundaries:\n"
      "  all: {nodes: {part: panel}, velocity: [0, 0, 2 m/s], factor: [[0 s, 0], [10 ms, 1]]}\n");
  for (int n = 0; n < 12; ++n) {
    world->dt = n % 2 == 0 ? 1.1e-3 : 1.6e-3;
    world->take_steps(1);
  }
  const double t = world->time();
  REQUIRE(t > 0.01);
  // 2 m/s (10 ms / 2 + what is left).
  CHECK(world->scene.nodes.x[3].z == Approx(2 * (0.005 + t - 0.01)).epsilon(1e-13));
}

TEST_CASE("prescribed motion: a formula in time is followed to its integral", "[body]") {
  auto world = panel_world(
      "let: {V: 2 m/s, w: 40 rad/s}\n"
      "boundaries: {all: {nodes: {part: panel}, velocity: [free, 0, \"V*cos(w*t)\"]}}\n");
  CHECK(world->scene.nodes.v[3].z == 2);
  for (int n = 0; n < 30; ++n) {
    world->dt = n % 2 == 0 ? 1.1e-3 : 1.6e-3;
    world->take_steps(1);
  }
  CHECK(world->scene.nodes.x[3].z == Approx(0.05 * std::sin(40 * world->time())).margin(1e-12));
}

TEST_CASE("prescribed motion: fixed edges stay where they are and carry the weight", "[body]") {
  auto world = panel_world(
      "boundaries: {edges: {nodes: {edge_of: panel}, fix: [x, y, z]}}\n"
      "loads: {gravity: [0, 0, -10 m/s^2]}\n");
  const Array<Line> start = world->scene.nodes.x;
  world->take_steps(20);
  const auto& motion = world->scene.store.get<PrescribedMotions>().list.front();
  REQUIRE(motion.nodes.size() == 10);
  for (const Index i : motion.nodes) {
    CHECK(xyz(world->scene.nodes.x[i]) == xyz(start[i]));
    CHECK(velocity_at_level(world->scene.nodes, i, 1e-3).norm() == 0);
  }
  // 10 of the 12 nodes, 2 kg each.
  CHECK((world->measure("boundary.edges.force") - Vec3(0, 0, 200)).norm() < 1e-12);
  // Symmetric about (1.5, 1): moment = centre x force.
  CHECK((world->measure("boundary.edges.moment") - Vec3(200, -300, 0)).norm() < 1e-11);
  CHECK(world->models.ledger.entry("prescribed motion", "edges").value == 0);
}

TEST_CASE("prescribed motion: work put in equals energy held, at order 2", "[body]") {
  // Driven by 2 m/s sin(2 pi t / 0.1 s): work put in = kinetic energy held, at every level.
  const auto worst = [](double dt) {
    std::string table;
    for (int k = 0; k <= 4000; ++k) {
      table += fmt::format("{}[{}, {}]", k == 0 ? "" : ", ", k * 2.5e-5,
                           std::sin(2 * M_PI * k * 2.5e-4));
    }
    auto world = panel_world(
        "boundaries: {all: {nodes: {part: panel}, velocity: [0, 2 m/s, free],"
        " factor: [" +
        table + "]}}\n");
    world->dt = dt;
    double error = 0;
    for (int n = 0; n < static_cast<int>(0.1 / dt) - 1; ++n) {
      world->take_steps(1);
      Ledger& ledger = world->models.ledger;
      const double held = ledger.entry("kinetic", "panel").value;
      const double put_in = ledger.entry("prescribed motion", "all").value;
      error = std::max(error, std::abs(held - put_in));
    }
    return error / (0.5 * 12 * 2 * 4);  // 12 nodes of 2 kg at 2 m/s
  };
  const double coarse = worst(1e-3);
  const double fine = worst(5e-4);
  CAPTURE(coarse, fine);
  // Of the largest energy, (omega dt)^2/4 from v(n) as the mean of both half steps, and as much
  // from work shared between the two steps in proportion to their length.
  CHECK(coarse < 0.51 * std::pow(2 * M_PI / 0.1 * 1e-3, 2));
  CHECK(coarse / fine == Approx(4).epsilon(0.05));
}

TEST_CASE("prescribed motion: rotations, their moment and their work", "[body]") {
  auto world = panel_world(
      "boundaries: {all: {nodes: {part: panel}, fix: [x, y, z, rx],\n"
      "  angular_velocity: [free, 2 rad/s, free], factor: [[0 s, 0], [1 s, 1]]}}\n",
      true);
  world->take_steps(100);
  const Nodes& nodes = world->scene.nodes;
  // Mean over the last step, 99 to 100 ms.
  CHECK(nodes.omega[4].y == Approx(2 * 0.0995).epsilon(1e-13));
  // 12 nodes, I = 0.5, 2 rad/s^2.
  CHECK((world->measure("boundary.all.moment") - Vec3(0, 12, 0)).norm() < 1e-9);
  // Work at the last look, level 99 ms: 12 I omega^2 / 2; the leapfrog is exact here.
  const LedgerEntry& work = world->models.ledger.entry("prescribed motion", "all");
  CHECK(work.external);
  CHECK(work.value == Approx(12 * 0.25 * 0.198 * 0.198).epsilon(1e-4));
}

TEST_CASE("prescribed motion: what two boundaries prescribe alike is counted once", "[body]") {
  auto world = panel_world(
      "boundaries:\n"
      "  edges: {nodes: {edge_of: panel}, fix: [z]}\n"
      "  corner: {nodes: {nearest: [0, 0, 0], of: panel}, fix: [x], velocity: [free, free, 0]}\n"
      "loads: {gravity: [1 m/s^2, 0, -10 m/s^2]}\n");
  CHECK(test::mistakes_of(*world).empty());
  world->take_steps(3);
  CHECK((world->measure("boundary.edges.force") - Vec3(0, 0, 200)).norm() < 1e-12);
  CHECK((world->measure("boundary.corner.force") - Vec3(-2, 0, 0)).norm() < 1e-12);
}

TEST_CASE("prescribed motion: mistakes name their place", "[body]") {
  CHECK_THAT(mistakes_of_boundaries("  edges: {nodes: {edge_of: panel}, fix: [z]}\n"
                                    "  b: {nodes: {part: panel}, velocity: [free, free, 1 m/s]}\n"),
             Catch::Contains("case.yaml:5:") && Catch::Contains("boundaries.b.velocity: z of") &&
                 Catch::Contains("prescribed otherwise by boundary 'edges' (case.yaml:4:"));
  CHECK_THAT(mistakes_of_boundaries(
                 "  b: {nodes: {part: panel}, fix: [z], velocity: [free, 1 m/s, 1 m/s]}\n"),
             Catch::Contains("z is prescribed by 'fix' already"));
  CHECK_THAT(mistakes_of_boundaries("  b: {nodes: {part: panel}, fix: [rx]}\n"),
             Catch::Contains("boundaries.b.fix: the nodes have no rotations"));
  CHECK_THAT(mistakes_of_boundaries("  b: {nodes: {part: panel}}\n"),
             Catch::Contains("say what the nodes do"));
  CHECK_THAT(mistakes_of_boundaries("  b: {fix: [x]}\n"), Catch::Contains("say of which nodes"));
  CHECK_THAT(mistakes_of_boundaries("  b: {nodes: {part: panel}, velocity: [1 m/s, 2 m/s]}\n"),
             Catch::Contains("2 numbers stand here; three are wanted"));
  CHECK_THAT(mistakes_of_boundaries("  b: {nodes: {part: panel}, velocity: [free, loose, 1 s]}\n"),
             Catch::Contains("loose") && Catch::Contains("'1 s' is a time"));
  CHECK_THAT(mistakes_of_boundaries("  b: {nodes: {part: pool}, fix: [x]}\n"),
             Catch::Contains("made of particles"));
}
