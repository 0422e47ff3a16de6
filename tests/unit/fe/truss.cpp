#include "fe/truss.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/math.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

void chain(Scene& scene, TrussBlock& block, int n, double l) {
  Nodes& nodes = scene.nodes;
  nodes.n_owned = n + 1;
  for (auto* lines : {&nodes.x, &nodes.v, &nodes.f}) {
    lines->assign(static_cast<std::size_t>(n + 1), {});
  }
  block.ends.clear();
  for (int i = 0; i <= n; ++i) {
    nodes.x[static_cast<std::size_t>(i)].x = l * i;
    if (i > 0) block.ends.insert(block.ends.end(), {i - 1, i});
  }
  rest_at_present_length(block, nodes);
  add_truss_masses(block, nodes);
  for (std::size_t i = 0; i < nodes.x.size(); ++i) nodes.v[i].w = 1 / nodes.x[i].w;
}

}  // namespace

TEST_CASE("truss: force, energy and stable step by hand", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "rod", .EA = 2e6, .mu = 0.5};
  chain(scene, block, 1, 0.1);
  CHECK(scene.nodes.x[0].w == Approx(0.025).epsilon(1e-15));
  scene.nodes.x[1] = {0.066, 0.088, 0, scene.nodes.x[1].w};  // length 0.11, direction 3-4-5
  const double energy = truss_pass(block, scene.nodes, 0).internal;
  // F = 2e6 0.01/0.1 = 2e5, W = F 0.01/2 = 1000.
  CHECK(block.value(0, truss_force) == Approx(2e5).epsilon(1e-13));
  CHECK(energy == Approx(1000).epsilon(1e-13));
  CHECK(scene.nodes.f[0].x == Approx(1.2e5).epsilon(1e-13));
  CHECK(scene.nodes.f[1].y == Approx(-1.6e5).epsilon(1e-13));
  // c = sqrt(EA/mu) = 2000 m/s
  CHECK(block.shortest == Approx(0.1 / 2000).epsilon(1e-13));
}

TEST_CASE("truss: a cable does not push", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "line", .EA = 2e6, .mu = 0.5, .tension_only = true};
  chain(scene, block, 2, 0.1);
  scene.nodes.x[1].x = 0.09;
  const double energy = truss_pass(block, scene.nodes, 0).internal;
  CHECK(block.value(0, truss_force) == 0);
  CHECK(block.value(0, truss_energy) == 0);
  CHECK(block.value(1, truss_force) == Approx(2e5).epsilon(1e-12));
  CHECK(energy == Approx(1000).epsilon(1e-12));
  block.tension_only = false;
  truss_pass(block, scene.nodes, 0);
  CHECK(block.value(0, truss_force) == Approx(-2e5).epsilon(1e-12));
}

TEST_CASE("truss: a swinging chain keeps its energy", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "chain", .EA = 1e5, .mu = 1};
  chain(scene, block, 20, 0.1);
  for (std::size_t i = 0; i < scene.nodes.v.size(); ++i) {
    scene.nodes.v[i].y = 3 * std::sin(0.2 * static_cast<double>(i));
  }
  scene.nodes.v[0] = {};  // v.w = 0: held
  Models models;
  models.list.emplace_back();
  Model& model = models.list.front();
  model.ranges = {{0, scene.nodes.n_owned}};
  Part part;  // the ledger's kinetic energy is per part
  part.name = "chain";
  part.nodes = {0, scene.nodes.n_owned};
  part.cell = Cell::line;
  scene.parts.push_back(part);
  scene.particles = {scene.nodes.n_owned, scene.nodes.n_owned};
  add_leapfrog(scene, model, models.ledger);
  add_truss_operations(scene, model, models.ledger, block);
  Model* const level[] = {&model};
  step(level);
  const double start = models.ledger.held();
  double worst = 0;
  for (int k = 0; k < 5000; ++k) {
    step(level);
    worst = std::max(worst, std::abs(models.ledger.held() - start));
  }
  CHECK(start > 1);
  CHECK(models.ledger.entry("internal", "chain").value > 0);
  CHECK(model.vote.limited_by().substr(0, 14) == "chain: element");
  // The leapfrog's energy error at dt = 0.9 of the stable step oscillates, bounded.
  CHECK(worst < 0.02 * start);
}

TEST_CASE("truss: prestrain, damping and its stable step by hand", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "rod",
                   .EA = 2e6,
                   .mu = 0.5,
                   .prestrain = 0.01,
                   .damping_ratio = 0.2,
                   .damping_time = 1e-5};
  chain(scene, block, 1, 0.101);
  CHECK(block.value(0, truss_l0) == Approx(0.1).epsilon(1e-14));
  truss_pass(block, scene.nodes, 0);
  CHECK(block.value(0, truss_force) == Approx(2e4).epsilon(1e-12));
  // beta + zeta l0/c = 1e-5 + 0.2 0.1/2000 = 2e-5 s; the rod grows by 1 mm in 1 ms.
  scene.nodes.x[1].x += 1e-3;
  const ElementWork work = truss_pass(block, scene.nodes, 1e-3);
  CHECK(block.value(0, truss_force) == Approx(4e4 + 2e7 * 2e-5 * 1).epsilon(1e-12));
  CHECK(work.internal == Approx(0.5 * 2e7 * (4e-6 - 1e-6)).epsilon(1e-9));
  CHECK(work.damping == Approx(0.5 * 400 * 1e-3).epsilon(1e-9));
  // omega = 2 c/l0 = 4e4, xi = 2e-5 4e4/2 = 0.4.
  CHECK(block.shortest == Approx(5e-5 * (std::sqrt(1.16) - 0.4)).epsilon(1e-12));
}

TEST_CASE("truss: an element that breaks carries nothing and hands its energy over", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "line", .EA = 2e6, .mu = 0.5, .tension_only = true, .strength = 1.5e5};
  chain(scene, block, 2, 0.1);
  scene.nodes.x[2].x += 0.005;  // F = 1e5
  ElementWork work = truss_pass(block, scene.nodes, 1e-5);
  CHECK(block.n_broken == 0);
  CHECK(work.internal == Approx(250).epsilon(1e-10));
  scene.nodes.x[2].x += 0.003;  // F would be 1.6e5
  for (Line& f : scene.nodes.f) f = {};
  work = truss_pass(block, scene.nodes, 1e-5);
  CHECK(block.n_broken == 1);
  CHECK(block.value(1, truss_broken) == 1);
  CHECK(work.internal == Approx(-250).epsilon(1e-10));
  CHECK(work.eroded == Approx(250 + 0.5 * 1e5 * 0.003).epsilon(1e-10));
  CHECK(scene.nodes.f[2].x == 0);
  // What is left is the other element's: EA times the rounding of its strain, the root of a square.
  CHECK(std::abs(scene.nodes.f[1].x) <= 2e6 * 2.3e-16);
  work = truss_pass(block, scene.nodes, 1e-5);
  CHECK(block.n_broken == 1);
  CHECK(work.eroded == 0);
}

TEST_CASE("truss: a law of straight pieces by hand", "[fe]") {
  Scene scene;
  TrussBlock block{.name = "rope", .mu = 0.5, .tension_only = true};
  block.law = law_through({{0.01, 1e4}, {0.03, 7e4}});
  REQUIRE(block.law.size() == 2);
  block.EA = 3e6;  // 1e6 N, then 3e6 N
  chain(scene, block, 2, 0.1);
  scene.nodes.x[2].x += 0.0025;  // strain 0.025: 10 kN + 3e6 0.015
  const double energy = truss_pass(block, scene.nodes, 0).internal;
  CHECK(block.value(1, truss_force) == Approx(5.5e4).epsilon(1e-12));
  CHECK(block.value(0, truss_force) == Approx(0).margin(1e-6));
  // 0.1 (1e6 0.025^2/2 + 2e6 0.015^2/2)
  CHECK(energy == Approx(0.1 * (312.5 + 225)).epsilon(1e-12));
  CHECK(block.shortest == Approx(0.1 / std::sqrt(3e6 / 0.5)).epsilon(1e-12));
  scene.nodes.x[2].x -= 0.005;
  truss_pass(block, scene.nodes, 0);
  CHECK(block.value(1, truss_force) == 0);
}
