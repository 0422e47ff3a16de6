#include "time/guards.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/keys.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

/// Two free nodes under guards with their default limits.
struct Guarded {
  Value empty;
  Mistakes mistakes;
  Scene scene;
  Models models;
  double limit = 1e-3;

  Guarded() {
    empty.is_map = true;
    scene.nodes.n_owned = 2;
    scene.nodes.x = {{0, 0, 0, 1}, {1, 2, 3, 1}};
    scene.nodes.v = {{1, 0, 0, 1}, {1, 0, 0, 1}};
    scene.nodes.f.resize(2);
    scene.nodes.id = {1, 2};
    scene.parts.resize(1);
    scene.parts[0].name = "pair";
    scene.parts[0].cell = Cell::line;
    scene.parts[0].nodes = {0, 2};
    models.list.emplace_back().ranges = {{0, 2}};
    const Keys root(empty, mistakes);
    add_leapfrog(scene, models.list[0], models.ledger);
    models.list[0].plan.add({.name = "step",
                             .stage = Stage::force,
                             .run = [](const Step&) {},
                             .stable_dt = [this] { return limit; },
                             .limited_by = [] { return "a test"; }});
    const Effect guards = guards_effect();
    guards.state(root, scene);
    guards.operations(root, scene, models);
  }

  /// What the guards say at the next step; empty where they are content.
  std::string next() {
    try {
      advance(models);
    } catch (const RunError& e) {
      return e.what();
    }
    return "";
  }
};

}  // namespace

TEST_CASE("guards: a sound scene passes", "[time]") {
  Guarded g;
  for (int k = 0; k < 10; ++k) CHECK(g.next().empty());
}

TEST_CASE("guards: NaN stops the run and names part, node and place", "[time]") {
  Guarded g;
  g.next();
  g.scene.nodes.v[1].y = std::numeric_limits<double>::quiet_NaN();
  const std::string text = g.next();
  CHECK(text.find("NaN") != std::string::npos);
  CHECK(text.find("part pair, node 2 at (1.001") != std::string::npos);
  CHECK(text.find("step 1") != std::string::npos);
}

TEST_CASE("guards: energy from nowhere stops the run", "[time]") {
  Guarded g;
  g.next();
  LedgerEntry& leak = g.models.ledger.entry("internal", "leak");
  leak.value = 0.1;  // 10 % of the kinetic energy of 1 J: allowed
  CHECK(g.next().empty());
  leak.value = 0.3;
  CHECK(g.next().find("energy balance is off by") != std::string::npos);
}

TEST_CASE("guards: the energies of a scene that starts from none may settle for twenty steps",
          "[time]") {
  Guarded g;
  for (Line& v : g.scene.nodes.v) v.x = 0;
  LedgerEntry& leak = g.models.ledger.entry("internal", "leak");
  g.next();
  leak.value = 1e-12;
  int quiet = 1;
  while (g.next().empty() && quiet < 100) ++quiet;
  CHECK(quiet == 20);
}

TEST_CASE("guards: energies of less than a nanometre a second are rounding", "[time]") {
  Guarded g;
  for (Line& v : g.scene.nodes.v) v.x = 0;
  double mass = 0;
  for (const Line& x : g.scene.nodes.x) mass += x.w;
  LedgerEntry& leak = g.models.ledger.entry("internal", "leak");
  g.next();
  leak.value = 0.4e-18 * mass;
  for (int k = 0; k < 100; ++k) CHECK(g.next().empty());
  leak.value = 0.6e-18 * mass;
  CHECK_FALSE(g.next().empty());
}

TEST_CASE("guards: a step that collapses stops the run and says who limits it", "[time]") {
  Guarded g;
  g.next();
  g.limit = 1.1e-7;
  CHECK(g.next().empty());
  g.limit = 0.9e-7;
  const std::string text = g.next();
  CHECK(text.find("collapsed") != std::string::npos);
  CHECK(text.find("a test") != std::string::npos);
}

TEST_CASE("guards: the density of a particle may not leave its range", "[time]") {
  Guarded g;
  g.scene.particles = {0, 2};
  g.scene.particle_part = {0, 0};
  Array<double> rho = {1000, 1000};
  g.scene.fields.push_back(
      plain_field("rho", "kg/m^3", "", Over::particles, rho, 1, GhostRule::none));
  CHECK(g.next().empty());
  rho[1] = 4000;  // the mean is 2500
  CHECK(g.next().find("density is") != std::string::npos);
}
