#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.hpp"
#include "body/effects.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;

TEST_CASE("gravity: a weight on each node, and a parabola whatever the steps", "[body]") {
  Draft draft;
  draft.parts = {test::plate("panel", 1, 1, 1, 1), test::particles("pool", {{0, 0, 5}, {1, 0, 5}})};
  draft.parts[0].velocity = {3, 0, 1};
  auto world = make_world("loads: {gravity: [0, 0, -10 m/s^2]}", draft, {gravity_effect()});
  Nodes& nodes = world->scene.nodes;
  CHECK(world->scene.gravity == Vec3(0, 0, -10));
  const double z0 = nodes.x[0].z;
  for (int n = 0; n < 50; ++n) {
    world->dt = n % 2 == 0 ? 1e-3 : 2.5e-3;
    world->take_steps(1);
  }
  CHECK(xyz(nodes.f[0]) == Vec3(0, 0, -20));  // 2 kg
  const double t = world->time();
  CHECK(t == Approx(0.0875));
  // The leapfrog follows a constant acceleration exactly.
  CHECK(nodes.x[0].z - z0 == Approx(t - 5 * t * t).epsilon(1e-13));
}

TEST_CASE("gravity: its work is m g times the fall, part by part", "[body]") {
  Draft draft;
  draft.parts = {test::plate("panel", 1, 1, 1, 1), test::particles("pool", {{0, 0, 5}, {1, 0, 5}}),
                 test::particles("drop", {{0, 0, 6}, {1, 0, 6}, {2, 0, 6}})};
  draft.parts[2].velocity = {0, 0, -4};
  auto world = make_world("loads: {gravity: [0, 0, -10 m/s^2]}", draft, {gravity_effect()});
  for (int n = 0; n < 50; ++n) {
    world->dt = n % 2 == 0 ? 1e-3 : 2.5e-3;
    world->take_steps(1);
  }
  const double t = world->time();
  const double dt = world->model().step.dt_old;
  Ledger& ledger = world->models.ledger;
  // The paths of all levels so far reach to the middle of the last step (all exact, see above).
  const auto fall = [&](double v) {
    return v * t + 5 * t * t - 0.5 * dt * (v + 10 * (t - 0.5 * dt));
  };
  const auto work = [&](const char* part) {
    const LedgerEntry& e = ledger.entry("gravity", part);
    CHECK(e.external);
    return e.value + e.pending;
  };
  CHECK(work("panel") == Approx(4 * 2 * 10 * fall(0)).epsilon(1e-12));
  CHECK(work("pool") == Approx(2 * 2 * 10 * fall(0)).epsilon(1e-12));
  CHECK(work("drop") == Approx(3 * 2 * 10 * fall(4)).epsilon(1e-12));
}

TEST_CASE("gravity: absent from the case, absent from the plan", "[body]") {
  Draft draft;
  draft.parts = {test::plate("panel", 1, 1, 1, 1)};
  auto world = make_world("title: none", draft, {gravity_effect()});
  world->take_steps(2);
  CHECK(world->models.ledger.external() == 0);
  CHECK(world->model().plan.at(Stage::look).size() == 1);
}

TEST_CASE("gravity: the same bits for 1 and 3 threads", "[body]") {
  const auto run = [](int n_threads) {
    set_threads(n_threads);
    Draft draft;
    draft.parts = {test::plate("panel", 120, 110, 1, 1)};
    auto world =
        make_world("loads: {gravity: [1 m/s^2, 0, -9.81 m/s^2]}", draft, {gravity_effect()}, 0.1);
    world->take_steps(5);
    return world->models.ledger.entry("gravity", "panel").value;
  };
  const double one = run(1);
  CHECK(run(3) == one);
  set_threads(0);
}

TEST_CASE("gravity: in time, as a frame that sways feels it", "[body]") {
  Draft draft;
  draft.parts = {test::particles("pool", {{0, 0, 5}})};
  auto world =
      make_world("let: {A: 3 m/s^2, w: 20 rad/s}\nloads: {gravity: [\"A*cos(w*t)\", 0, -10 m/s^2]}",
                 draft, {gravity_effect()});
  CHECK(world->scene.gravity == Vec3(3, 0, -10));
  world->take_steps(100);
  // The last force stage was at 99 ms.
  CHECK(world->scene.nodes.f[0].x == Approx(2 * 3 * std::cos(20 * 0.099)).epsilon(1e-12));
  CHECK(world->scene.nodes.f[0].z == -20);
  const double v = 3 / 20.0 * std::sin(20 * 0.0995);
  CHECK(world->scene.nodes.v[0].x == Approx(v).epsilon(1e-3));
}
