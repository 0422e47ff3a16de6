#include "body/damping.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include <fmt/format.h>

#include "body/effects.hpp"
#include "body/relaxation.hpp"
#include "body/sponge.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;

namespace {

double entry(const test::World& world, const std::string& name) {
  double sum = 0;
  for (const LedgerEntry& e : world.models.ledger.entries()) sum += e.name == name ? e.value : 0;
  return sum;
}

Draft two_particles(const Vec3& velocity) {
  Draft draft;
  draft.parts = {test::particles("pool", {{0.5, 0.5, 0.5}, {3, 0.5, 0.5}})};
  draft.parts[0].velocity = velocity;
  return draft;
}

}  // namespace

TEST_CASE("damping: a centred kick, by hand", "[body]") {
  // v_mid = (1 + 3)/2 = 2; dv = -2 x 0.5/(1 + 0.5) (2 - 0.5) = -1
  const Vec3 dv = damping_kick({1, 0, 0}, {3, 0, 0}, {0.5, 0, 0}, 2, 0.5);
  CHECK(dv.x() == Approx(-1).epsilon(1e-15));
  CHECK(dv.y() == 0);
  // Centred: dv = -gamma dt ((v_old + v_free + dv)/2 - u) = -1 (1.5 - 0.5)
  CHECK(dv.x() == Approx(-2 * 0.5 * (0.5 * (1 + 3 - 1) - 0.5)).epsilon(1e-15));
}

TEST_CASE("sponge: the rate rises smoothly inside the faces", "[body]") {
  const SpongeZone zone{2, {1, -1, 0}, {5, 3, 0}, 0.5, 8};
  CHECK(rate_at(zone, {0.9, 1, 0}) == 0);
  CHECK(rate_at(zone, {1, 1, 0}) == 0);
  CHECK(rate_at(zone, {1.25, 1, 0}) == Approx(4));      // s(1/2) = 1/2
  CHECK(rate_at(zone, {1.125, 1, 7}) == Approx(1.25));  // s(1/4) = 5/32; z does not count
  CHECK(rate_at(zone, {4.75, 2.75, 0}) == Approx(2));   // two faces
  CHECK(rate_at(zone, {3, 1, 0}) == 8);
  CHECK(rate_at({3, {1, -1, 0}, {5, 3, 1}, 0.5, 8}, {3, 1, 7}) == 0);
}

TEST_CASE("sponge: velocity inside decays as exp(-gamma t), order 2", "[body]") {
  double error[2];
  for (const int r : {0, 1}) {
    auto world = make_world(
        "boundaries: {b: {sponge: {box: {from: [-9, -9, -9], to: [2 m, 9, 9]}, ramp: 0.5 m, rate: "
        "10 1/s}}}",
        two_particles({0.1, 0, 0}), {sponge_effect()});
    world->dt = r == 0 ? 1e-2 : 5e-3;
    world->take_steps(r == 0 ? 20 : 40);
    const Nodes& nodes = world->scene.nodes;
    // v at half a step before t
    const double exact = 0.1 * std::exp(-10 * (world->time() - 0.5 * world->dt));
    error[r] = std::abs(nodes.v[0].x - exact);
    CHECK(nodes.v[1].x == 0.1);  // outside
  }
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.1));
}

TEST_CASE("sponge: what it takes stands in the ledger, to rounding", "[body]") {
  auto world = make_world(
      "boundaries: {b: {sponge: {box: {from: [-9, -9, -9], to: [2.9 m, 9, 9]}, ramp: 0.5 m, "
      "length: "
      "1 m, speed: 5 m/s, velocity: [3 m/s, 0, 0]}}}",
      two_particles({0, 0.4, 0}), {sponge_effect()});
  // Two particles of 2 kg; one is taken along at 10/s.
  for (int n = 0; n < 300; ++n) {
    world->dt = n % 2 == 0 ? 2e-3 : 2.5e-3;
    world->take_steps(1);
  }
  const Nodes& nodes = world->scene.nodes;
  // Of v - u exp(-6.75) is left.
  CHECK(nodes.v[0].x == Approx(3).epsilon(2e-3));
  CHECK(nodes.v[0].y == Approx(0).margin(1e-3));
  CHECK(entry(*world, "kinetic") == Approx(9 + 0.16).epsilon(4e-3));
  // Driven by m u dv = 2 x 3 x 3 J; lost is 1/2 m |v_0 - u|^2 = 9.16 J.
  CHECK(entry(*world, "sponge drive") == Approx(18).epsilon(2e-3));
  CHECK(entry(*world, "sponge") == Approx(9.16).epsilon(1e-3));
  // A last pair of steps is slow: no swing of kinetic energy is left.
  const double imbalance =
      entry(*world, "kinetic") + entry(*world, "sponge") - 0.32 - entry(*world, "sponge drive");
  CHECK(std::abs(imbalance) < 2e-3 * 9);
}

TEST_CASE("sponge: two that overlap add up, and each keeps its account", "[body]") {
  const char* zone =
      "{sponge: {box: {from: [-9, -9, -9], to: [9 m, 9, 9]}, ramp: 0.5 m, rate: 5 1/s}}";
  auto world = make_world(fmt::format("boundaries: {{a: {0}, b: {0}}}", zone),
                          two_particles({0.1, 0, 0}), {sponge_effect()});
  world->dt = 1e-3;
  world->take_steps(100);
  // One acts after the other, which is off by gamma_1 gamma_2 dt t/2 = 1.2e-3.
  const double together = 0.1 * std::exp(-10 * 0.0995);
  CHECK(world->scene.nodes.v[0].x == Approx(together * (1 - 1.25e-3)).epsilon(1e-4));
  const double kinetic = entry(*world, "kinetic");
  CHECK(kinetic + entry(*world, "sponge") == Approx(0.02).epsilon(1e-3));
}

TEST_CASE("sponge: mistakes", "[body]") {
  auto world = make_world(
      "boundaries: {b: {sponge: {box: {from: [0, 0, 0], to: [1 m, 1 m, 0]}, ramp: 0.5 m, rate: 1, "
      "length: 1 m}}, c: {sponge: {box: {from: [0, 0, 0], to: [1, 1, 1]}, ramp: 1 m}}}",
      two_particles({0, 0, 0}), {sponge_effect()});
  const std::string mistakes = test::mistakes_of(*world);
  CHECK(mistakes.find("boundaries.b.sponge.length: say either rate, or length and speed") !=
        std::string::npos);
  CHECK(mistakes.find("boundaries.b.sponge.box.to: each coordinate must be greater") !=
        std::string::npos);
  CHECK(mistakes.find("boundaries.c.sponge.rate: missing") != std::string::npos);
}

TEST_CASE("relaxation: ends with time, or with the motion", "[body]") {
  SettlingPhase phase{.rate = 10, .until = 2, .share = 0.01};
  look_at(phase, 0, 0);  // at rest before anything has begun
  look_at(phase, 5, 0.05);
  CHECK(phase.over == 0);
  look_at(phase, 0.04, 0.1);  // a moment of a swing
  look_at(phase, 3, 0.2);
  CHECK(phase.still_since == 0.2);
  look_at(phase, 0.04, 0.25);
  CHECK(phase.over == 0);
  look_at(phase, 0.03, 0.31);  // still for more than 1/rate
  CHECK(phase.over == 1);

  SettlingPhase by_time{.rate = 10, .until = 2};
  for (const double t : {0.0, 0.5, 1.9}) look_at(by_time, 0, t);
  CHECK(by_time.over == 0);
  look_at(by_time, 4, 2);
  CHECK(by_time.over == 1);
}

TEST_CASE("relaxation: what it takes stands in the ledger; later it takes nothing", "[body]") {
  auto world = make_world("effects: {relaxation: {rate: 10 1/s, until: 0.1 s}}",
                          two_particles({0.3, 0.4, 0}), {relaxation_effect()});
  world->dt = 1e-3;
  world->take_steps(100);
  // Two of 2 kg at 0.5 m/s; the last damped kick is that of level 100.
  CHECK(entry(*world, "relaxation") == Approx(0.5 * (1 - std::exp(-2.0))).epsilon(0.02));
  world->take_steps(2);
  const double v = world->scene.nodes.v[0].x;
  const double taken = entry(*world, "relaxation");
  CHECK(v == Approx(0.3 * std::exp(-1.0)).epsilon(0.01));
  CHECK(entry(*world, "kinetic") + taken == Approx(0.5).epsilon(1e-4));
  world->take_steps(50);
  CHECK(world->scene.nodes.v[0].x == v);
  CHECK(entry(*world, "relaxation") == taken);
}

TEST_CASE("damping of a part: velocities decay as exp(-gamma t), order 2, and stand in the ledger",
          "[body]") {
  double error[2];
  for (const int r : {0, 1}) {
    Draft draft;
    draft.parts = {test::plate("panel", 2, 1, 1, 1, true), test::plate("other", 1, 1, 1, 1)};
    for (PartDraft& part : draft.parts) part.velocity = Vec3(0.1, 0, 0.2);
    auto world = make_world("parts: {panel: {made: yes, damping: 10 1/s}, other: {made: yes}}",
                            draft, {part_damping_effect()});
    Nodes& nodes = world->scene.nodes;
    for (Index i = nodes.rotating.begin; i < nodes.rotating.end; ++i) nodes.omega[i].y = 3;
    world->dt = r == 0 ? 1e-2 : 5e-3;
    world->take_steps(r == 0 ? 20 : 40);
    const double left = std::exp(-10 * (world->time() - 0.5 * world->dt));
    error[r] = std::abs(nodes.v[0].z - 0.2 * left);
    CHECK(nodes.v[6].z == 0.2);  // of the other part
    CHECK(nodes.omega[0].y / 3 == Approx(nodes.v[0].z / 0.2).epsilon(1e-12));
    // Six nodes of 2 kg and 0.5 kg m^2; the half step between kinetic energy and work is left.
    const double start = 6 * (0.5 * 2 * 0.05 + 0.5 * 0.5 * 9);
    CHECK(entry(*world, "damping") ==
          Approx(start * (1 - left * left)).epsilon(r == 0 ? 2e-2 : 1e-2));
    CHECK(entry(*world, "damping") + entry(*world, "kinetic") - 4 * 0.05 ==
          Approx(start).epsilon(1e-2));
  }
  CHECK(error[0] / error[1] == Approx(4).epsilon(0.1));
}

TEST_CASE("damping of a part: not of particles", "[body]") {
  const auto world = make_world("parts: {pool: {made: yes, damping: 10 1/s}}",
                                two_particles({1, 0, 0}), {part_damping_effect()});
  CHECK(test::mistakes_of(*world).find("is for parts of elements") != std::string::npos);
}
