// Pressure, nodal forces, accelerations by place.
#include <catch2/catch.hpp>

#include <cmath>

#include "base/parallel.hpp"
#include "body/effects.hpp"
#include "body/pressure.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;
using gannet::test::World;

namespace {

std::unique_ptr<World> plate_world(const std::string& load, int nx = 2, int ny = 2) {
  Draft draft;
  draft.parts = {test::plate("panel", nx, ny, 1, 1), test::particles("pool", {{0, 0, 5}})};
  return make_world("parts: {panel: {made: yes}, pool: {made: yes}}\nloads: {load: " + load + "}\n",
                    draft, {pressure_effect(), nodal_force_effect(), acceleration_effect()});
}

Vec3 total_force(const Scene& scene) {
  Vec3 sum = Vec3::Zero();
  for (const Line& f : scene.nodes.f) sum += xyz(f);
  return sum;
}

}  // namespace

TEST_CASE("pressure: corner forces of a trapezium, by hand", "[body]") {
  // b = (0.75, 0), c = (-0.25, 0.5), d = (-0.25, 0): b x c = 0.375, b x d = 0, d x c = -0.125.
  const auto f = pressure_on_quad(12, {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  CHECK((f[0] - Vec3(0, 0, 5)).norm() < 1e-14);
  CHECK((f[1] - Vec3(0, 0, 5)).norm() < 1e-14);
  CHECK((f[2] - Vec3(0, 0, 4)).norm() < 1e-14);
  CHECK((f[3] - Vec3(0, 0, 4)).norm() < 1e-14);
  const auto triangle = pressure_on_triangle(12, {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)});
  for (const Vec3& force : triangle) CHECK((force - Vec3(0, 0, 4)).norm() < 1e-14);
}

TEST_CASE("pressure: neither force nor moment on a closed box of warped faces", "[body]") {
  // Exact for bilinear faces: a uniform pressure on a closed surface does nothing.
  std::vector<Vec3> x;
  for (int k = 0; k < 8; ++k) {
    x.emplace_back((k & 1) + 0.1 * std::sin(5.0 * k), (k >> 1 & 1) + 0.1 * std::cos(7.0 * k),
                   (k >> 2 & 1) + 0.1 * std::sin(11.0 * k));
  }
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  for (const auto& face : faces) {
    const std::array<Vec3, 4> corners{x[face[0]], x[face[1]], x[face[2]], x[face[3]]};
    const auto f = pressure_on_quad(1, corners);
    for (std::size_t a = 0; a < 4; ++a) {
      force += f[a];
      moment += corners[a].cross(f[a]);
    }
  }
  CHECK(force.norm() < 1e-15);
  CHECK(moment.norm() < 1e-15);
}

TEST_CASE("pressure: p A on a distorted unit plate, against the normals", "[body]") {
  auto world = plate_world("{pressure: {on: panel, value: 1 kPa}}");
  for (Line& x : world->scene.nodes.x) {
    if (x.x == 0.5 && x.y == 0.5) x = {0.57, 0.41, 0, x.w};
  }
  world->take_steps(1);
  CHECK((total_force(world->scene) - Vec3(0, 0, -1000)).norm() < 1e-11);
  auto back = plate_world("{pressure: {on: panel, value: 1 kPa, side: back}}");
  back->take_steps(1);
  CHECK((total_force(back->scene) - Vec3(0, 0, 1000)).norm() < 1e-11);
}

TEST_CASE("pressure: pushes on no cell that has left", "[body]") {
  auto world = plate_world("{pressure: {on: panel, value: 1 kPa}}", 3, 1);
  PressureLoad load;
  load.part = 0;
  load.pressure = Function(1000);
  std::vector<std::uint8_t> gone{0, 1, 0};
  load.gone = &gone;
  prepare(load, world->scene);
  add_pressure(load, world->scene, 0);
  Vec3 sum = Vec3::Zero();
  for (const Line& f : load.force) sum += xyz(f);
  CHECK(sum.norm() == Approx(1000 * 2.0 / 3));  // of a plate of one square metre
}

TEST_CASE("pressure: one that changes with place is that at the middle of a triangle", "[body]") {
  Draft draft;
  PartDraft& panel = draft.parts.emplace_back();
  panel.name = "panel";
  panel.kind = "shell";
  panel.cell = Cell::quad;
  panel.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  panel.connectivity = {0, 1, 2, 2};
  auto world = make_world(
      "parts: {panel: {made: yes}}\nloads: {load: {pressure: {on: panel, value: "
      "\"900*y\", side: back}}}\n",
      draft, {pressure_effect()});
  world->take_steps(1);
  CHECK((total_force(world->scene) - Vec3(0, 0, 150)).norm() < 1e-11);
}

TEST_CASE("pressure: follows the surface as it turns", "[body]") {
  auto world = plate_world("{pressure: {on: panel, value: 2 Pa, side: back}}");
  for (Line& x : world->scene.nodes.x) x = {0, x.x, x.y, x.w};  // z along x now
  world->take_steps(1);
  CHECK((total_force(world->scene) - Vec3(2, 0, 0)).norm() < 1e-14);
}

TEST_CASE("pressure: starts, ramps, and follows a table", "[body]") {
  const auto force_at = [](const std::string& keys, double t) {
    auto world = plate_world("{pressure: {on: panel, side: back, " + keys + "}}");
    world->model().step.t = t;
    world->take_steps(1);
    return total_force(world->scene).z();
  };
  CHECK(force_at("value: 8 Pa, from: 1 s", 0.999) == 0);
  CHECK(force_at("value: 8 Pa, from: 1 s", 1) == Approx(8).epsilon(1e-14));
  CHECK(force_at("value: 8 Pa, ramp: 2 s", 0.5) == Approx(2).epsilon(1e-14));
  CHECK(force_at("value: [[0 s, 1 Pa], [1 s, 5 Pa]]", 0.25) == Approx(2).epsilon(1e-14));
}

TEST_CASE("pressure: its work is what its nodes gain, at order 2", "[body]") {
  // A plate of free nodes: it grows and bends under its pressure as it flies.
  const auto error = [](double dt) {
    auto world =
        plate_world("{pressure: {on: panel, value: [[0 s, 400 Pa], [1 s, 100 Pa]]}}", 4, 4);
    for (Line& x : world->scene.nodes.x) x.z = x.z == 0 ? 0.2 * x.x * x.y : x.z;
    world->dt = dt;
    world->take_steps(static_cast<int>(std::lround(0.2 / dt)) + 1);
    Ledger& ledger = world->models.ledger;
    const double held = ledger.entry("kinetic", "panel").value;
    CHECK(held > 0.1);
    return std::abs(held - ledger.entry("pressure load", "load").value) / held;
  };
  const double coarse = error(4e-3);
  const double fine = error(2e-3);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-2);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("pressure: the same bits for 1 and 3 threads", "[body]") {
  const auto run = [](int n_threads) {
    set_threads(n_threads);
    auto world = plate_world("{pressure: {on: panel, value: 1 kPa}}", 60, 50);
    for (Line& x : world->scene.nodes.x) x.z += 0.1 * std::sin(9 * x.x) * x.y;
    world->take_steps(5);
    double sum = world->models.ledger.external();
    for (const Line& x : world->scene.nodes.x) sum = 1.1 * sum + x.z;
    return sum;
  };
  const double one = run(1);
  CHECK(run(3) == one);
  set_threads(0);
}

TEST_CASE("pressure: by place and time, at the middles of the cells", "[body]") {
  // Four cells of 1/4 m^2, p = 8 x t at their middles, 0.25 and 0.75 m: 4 x 1/4 x 8 x 0.5 x 2.
  auto world = plate_world("{pressure: {on: panel, value: \"8*x*t\", side: back}}");
  world->model().step.t = 2;
  world->take_steps(1);
  CHECK(total_force(world->scene).z() == Approx(8).epsilon(1e-14));
  auto ramp = plate_world("{pressure: {on: panel, value: \"8*t\", side: back, ramp: 4 s}}");
  ramp->model().step.t = 2;
  ramp->take_steps(1);
  CHECK(total_force(ramp->scene).z() == Approx(8).epsilon(1e-14));
}

TEST_CASE("nodal force: a formula in time", "[body]") {
  auto world = plate_world("{force: {nodes: {part: panel}, value: [\"2*t^2\", 0, 1 N]}}");
  world->model().step.t = 3;
  world->take_steps(1);
  CHECK((total_force(world->scene) - Vec3(18, 0, 1)).norm() < 1e-13);
}

TEST_CASE("nodal force: shared evenly, in time, with its work", "[body]") {
  auto world = plate_world(
      "{force: {nodes: {edge_of: panel}, value: [0, 0, 16 N], from: 10 ms, ramp: 20 ms}}");
  world->take_steps(1);
  CHECK(total_force(world->scene).norm() == 0);
  world->model().step.t = 0.015;
  world->take_steps(1);
  CHECK(total_force(world->scene).z() == Approx(4).epsilon(1e-14));
  world->model().step.t = 1;
  world->take_steps(400);
  const Nodes& nodes = world->scene.nodes;
  CHECK(total_force(world->scene).z() == Approx(16).epsilon(1e-14));
  for (std::size_t i = 0; i < nodes.f.size(); ++i) {
    CHECK((nodes.f[i].z == 0 || nodes.f[i].z == 2));  // 8 nodes on the edge, 1 in the middle
  }
  Ledger& ledger = world->models.ledger;
  const double held = ledger.entry("kinetic", "panel").value;
  // Constant but for the jump from 0 to 4 and to 16 N, which the trapezium sees as 1 step of 400.
  CHECK(ledger.entry("force", "load").value == Approx(held).epsilon(1e-2));
}

TEST_CASE("acceleration: mass times the formulas at each node, by hand", "[body]") {
  auto world = plate_world("{acceleration: [\"-4*x\", \"t*y + z\", 3 m/s^2]}");
  world->model().step.t = 2;
  world->take_steps(1);
  const Nodes& nodes = world->scene.nodes;
  for (std::size_t i = 0; i < nodes.f.size(); ++i) {
    const Vec3 x = xyz(nodes.x[i]) - 1e-3 * xyz(nodes.v[i]);  // where it was at the level
    const Vec3 f = 2 * Vec3(-4 * x.x(), 2 * x.y() + x.z(), 3);
    CHECK((xyz(nodes.f[i]) - f).norm() < 1e-14);
  }
  // The particle at [0, 0, 5]: 2 kg times [0, 5, 3] m/s^2.
  CHECK(std::any_of(nodes.f.begin(), nodes.f.end(),
                    [](const Line& f) { return xyz(f) == Vec3(0, 10, 6); }));
}

TEST_CASE("acceleration: a central field turns height into speed, at order 2", "[body]") {
  // x = cos(3 t): the work is half the square of the speed, to the swing of the leapfrog.
  const auto error = [](double dt) {
    auto world = plate_world("{acceleration: [\"-9*x\", \"-9*y\", \"-9*z\"]}");
    world->dt = dt;
    world->take_steps(static_cast<int>(std::lround(0.4 / dt)) + 1);
    Ledger& ledger = world->models.ledger;
    CHECK(ledger.entry("acceleration load", "load").external);
    const double held =
        ledger.entry("kinetic", "panel").value + ledger.entry("kinetic", "pool").value;
    const double exact = 0.5 * 2 * 25 * 9 * std::pow(std::sin(1.2), 2);
    CHECK(ledger.entry("kinetic", "pool").value == Approx(exact).epsilon(10 * dt * dt));
    return std::abs(held - ledger.entry("acceleration load", "load").value) / held;
  };
  const double coarse = error(4e-3);
  const double fine = error(2e-3);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("acceleration: the same bits for 1 and 3 threads", "[body]") {
  const auto run = [](int n_threads) {
    set_threads(n_threads);
    auto world = plate_world("{acceleration: [\"sin(9*x + t)\", \"-y\", \"exp(x*y)\"]}", 60, 50);
    world->take_steps(5);
    double sum = world->models.ledger.external();
    for (const Line& x : world->scene.nodes.x) sum = 1.1 * sum + x.x + x.z;
    return sum;
  };
  const double one = run(1);
  CHECK(run(3) == one);
  set_threads(0);
}

TEST_CASE("loads: mistakes name their place", "[body]") {
  const auto mistakes = [](const std::string& load) {
    try {
      return test::mistakes_of(*plate_world(load));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  CHECK_THAT(mistakes("{pressure: {on: pool, value: 1 Pa}}"),
             Catch::Contains("case.yaml:3:") &&
                 Catch::Contains("loads.load.pressure.on: part 'pool' has no surface"));
  CHECK_THAT(mistakes("{pressure: {on: panel}}"), Catch::Contains("pressure.value: missing"));
  CHECK_THAT(mistakes("{force: {nodes: {part: pool}, value: [1, 0, 0]}}"),
             Catch::Contains("loads.load.force.nodes.part"));
  CHECK_THAT(mistakes("{acceleration: [0, 0, \"1/z\"]}"),
             Catch::Contains("case.yaml:3:") &&
                 Catch::Contains("loads.load.acceleration: gives [0, 0, inf] at t = 0"));
}
