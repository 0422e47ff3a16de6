#include "time/leapfrog.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "time/energy_balance.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

/// A mass on a nonlinear spring, f = -x - x^3, and the energy of the spring in the ledger.
struct Oscillator {
  Scene scene;
  Models models;
  double limit = 0.1;

  explicit Oscillator(double x0) {
    scene.nodes.n_owned = 1;
    scene.nodes.x = {{x0, 0, 0, 1}};
    scene.nodes.v = {{0, 0, 0, 1}};
    scene.nodes.f = {{}};
    scene.nodes.id = {1};
    scene.parts.resize(1);
    scene.parts[0].name = "mass";
    scene.parts[0].nodes = {0, 1};
    Model& model = models.list.emplace_back();
    model.ranges = {{0, 1}};
    add_leapfrog(scene, model, models.ledger);
    LedgerEntry& spring = models.ledger.entry("internal", "spring");
    model.plan.add({.name = "spring",
                    .stage = Stage::force,
                    .run =
                        [this, &spring](const Step&) {
                          const double x = scene.nodes.x[0].x;
                          scene.nodes.f[0].x += -x - x * x * x;
                          spring.value = 0.5 * x * x + 0.25 * x * x * x * x;
                        },
                    .stable_dt = [this] { return limit; }});
  }

  /// State at a level: position and the velocity there.
  [[nodiscard]] Vec3 at_level(double dt_before_kick) const {
    return {scene.nodes.x[0].x, velocity_at_level(scene.nodes, 0, dt_before_kick).x(), 0};
  }
};

/// Position at time 2 with n steps whose sizes swing by 30 %, three times over the run.
double position_with(int n) {
  Oscillator o(1.0);
  const auto share = [n](int k) { return 1 + 0.3 * std::sin(6 * M_PI * (k + 0.5) / n); };
  for (int k = 0; k < n; ++k) {
    o.limit = 2.0 / n * share(k);  // the swings cancel in the sum
    advance(o.models);
  }
  return o.scene.nodes.x[0].x;
}

}  // namespace

TEST_CASE("leapfrog: the first two steps of a spring by hand", "[time]") {
  Oscillator o(1.0);
  o.limit = 0.1;
  advance(o.models);
  // f = -2; first kick is half a step: v = -2 * 0.05 = -0.1; x = 1 - 0.01.
  CHECK(o.scene.nodes.v[0].x == Approx(-0.1).epsilon(1e-15));
  CHECK(o.scene.nodes.x[0].x == Approx(0.99).epsilon(1e-15));
  o.limit = 0.2;
  advance(o.models);
  // f = -0.99 - 0.970299; v -= 1.960299 * 0.15; x += 0.2 v.
  CHECK(o.scene.nodes.v[0].x == Approx(-0.1 - 1.960299 * 0.15).epsilon(1e-15));
  CHECK(o.scene.nodes.x[0].x == Approx(0.99 + 0.2 * (-0.1 - 1.960299 * 0.15)).epsilon(1e-14));
  CHECK(o.models.list[0].step.t == Approx(0.3).epsilon(1e-15));
}

TEST_CASE("leapfrog: order 2 on a nonlinear spring with a changing step", "[time][convergence]") {
  const double fine = position_with(5120);
  double previous = 0;
  for (const int n : {40, 80, 160, 320}) {
    const double error = std::abs(position_with(n) - fine);
    if (previous > 0) {
      const double order = std::log2(previous / error);
      INFO("steps " << n << ", error " << error << ", order " << order);
      CHECK(order > 1.9);  // 2 in the limit
      CHECK(order < 2.1);
    }
    previous = error;
  }
}

TEST_CASE("leapfrog: energy stays bounded over 10^5 steps at 0.9 of the limit", "[time]") {
  Oscillator o(0.01);  // nearly linear: omega = 1, limit 2
  o.limit = 1.8;
  EnergyBalance balance;
  double largest = 0;
  o.models.list[0].plan.add({.name = "balance", .stage = Stage::look, .run = [&](const Step&) {
                               balance.update(o.models.ledger);
                               largest = std::max(largest, o.models.ledger.held());
                             }});
  for (int k = 0; k < 100000; ++k) advance(o.models);
  // The conserved quantity of the scheme is 1/2 v^2 + 1/2 x^2 (1 - (omega dt)^2/4) with v(n):
  // the energy swings within 1/(1 - 0.81), it does not drift.
  CHECK(largest < 0.5e-4 / (1 - 0.81) * 1.01);
  CHECK(std::isfinite(balance.error()));
}

TEST_CASE("ledger: a constant force gives its work as kinetic energy at every level", "[time]") {
  Scene scene;
  scene.nodes.n_owned = 1;
  scene.nodes.x = {{0, 0, 0, 2}};
  scene.nodes.v = {{0.3, 0, 0, 0.5}};
  scene.nodes.f = {{}};
  scene.parts.resize(1);
  scene.parts[0].cell = Cell::line;
  scene.parts[0].nodes = {0, 1};
  Models models;
  Model& model = models.list.emplace_back();
  model.ranges = {{0, 1}};
  add_leapfrog(scene, model, models.ledger);
  LedgerEntry& entry = models.ledger.entry("push", "");
  entry.external = true;
  double dt = 0.1;
  const Vec3 push(7, 0, 0);
  model.plan.add({.name = "push",
                  .stage = Stage::force,
                  .run = [&](const Step&) { add_xyz(scene.nodes.f[0], push); },
                  .stable_dt = [&] { return dt; }});
  EnergyBalance balance;
  model.plan.add({.name = "work", .stage = Stage::look, .run = [&](const Step& s) {
                    entry.add_work(work_along(work_path(scene.nodes, 0, s), push));
                    balance.update(models.ledger);
                    CHECK(std::abs(balance.error()) < 1e-14);
                  }});
  for (int k = 0; k < 20; ++k) {
    advance(models);
    dt = 0.1 * (1 + 0.5 * std::sin(k));
  }
}

TEST_CASE("ledger: work measured at a level is shared by the steps on both sides", "[plan]") {
  LedgerEntry e;
  e.add_work({2, 6});
  CHECK(e.value == 2);
  CHECK(e.pending == 6);
  e.add_work({3, 1});
  CHECK(e.value == 2 + 6 + 3);
  CHECK(e.pending == 1);
}
