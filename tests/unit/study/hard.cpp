// Limits of hard cases, on scenes small enough to count by hand, and stability maps of a made-up
// subject whose edge of stability is known.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.hpp"
#include "output/stray_particles.hpp"
#include "study/hard_run.hpp"
#include "study/hard_watch.hpp"
#include "study/stability_map.hpp"
#include "time/guards.hpp"

using namespace gannet;

namespace {

/// Nodes that are all particles, of mass 2, with the given places.
void place(Scene& scene, const std::vector<Vec3>& at) {
  const auto n = at.size();
  scene.nodes.n_owned = static_cast<Index>(n);
  scene.particles = {0, static_cast<Index>(n)};
  scene.nodes.x.resize(n);
  scene.nodes.v.resize(n);
  for (std::size_t k = 0; k < n; ++k) scene.nodes.x[k] = {at[k].x(), at[k].y(), at[k].z(), 2};
}

}  // namespace

TEST_CASE("hard: the least spacing is found across the cells of its grid", "[study]") {
  Scene scene;
  place(scene, {{-0.95, 0, 0}, {1, 1, 1}, {-1.05, 0, 0}, {5, 5, 5}});
  CHECK(smallest_particle_spacing(scene, 1) == Approx(0.1));
  CHECK(smallest_particle_spacing(scene, 0.05) == 0.05);  // nothing within reach
}

TEST_CASE("hard: momentum adds up with signs and without", "[study]") {
  Scene scene;
  place(scene, {{0, 0, 0}, {1, 0, 0}});
  scene.nodes.v[0].x = 3;
  scene.nodes.v[1].x = -1;
  const TotalMomentum p = total_momentum(scene.nodes);
  CHECK(p.sum.x() == 4);  // 2 (3 - 1)
  CHECK(p.scale == 8);    // 2 (3 + 1)
}

TEST_CASE("hard: a particle behind a plane is that deep in it", "[study]") {
  Scene scene;
  place(scene, {{0, 0, -0.3}, {0, 0, 2}});
  CHECK(std::isinf(deepest_penetration(scene)));
  CHECK_FALSE(sees_penetration(scene));
  scene.planes.push_back({.name = "floor"});
  CHECK(deepest_penetration(scene) == Approx(0.3));
  CHECK(sees_penetration(scene));
}

TEST_CASE("hard: NaN keeps no limit, and is not finite", "[study]") {
  const LimitState upper{.name = "a", .worst = std::nan(""), .limit = 1};
  const LimitState lower{.name = "b", .worst = std::nan(""), .limit = 1, .at_least = true};
  CHECK_FALSE(upper.kept());
  CHECK_FALSE(lower.kept());
  Scene scene;
  place(scene, {{0, 0, 0}});
  CHECK(all_finite(scene.nodes));
  scene.nodes.v[0].y = std::nan("");
  CHECK_FALSE(all_finite(scene.nodes));
}

TEST_CASE("hard: margins say how many times better than needed", "[study]") {
  CHECK(LimitState{.worst = 0.5, .limit = 2}.margin() == 4);
  CHECK(LimitState{.worst = 6, .limit = 2, .at_least = true}.margin() == 3);
  CHECK(std::isinf(LimitState{.worst = -1, .limit = 2}.margin()));
}

TEST_CASE("hard: a variant that must fail passes only by the limit it names", "[study]") {
  const HardVariant variant{.name = "off", .must_fail = true, .by = {"momentum"}};
  HardResult stable{.stable = true, .passed = true};
  judge(variant, stable);
  CHECK_FALSE(stable.passed);
  HardResult wrong{.broken = "penetration"};
  judge(variant, wrong);
  CHECK_FALSE(wrong.passed);
  HardResult right{.broken = "momentum"};
  judge(variant, right);
  CHECK(right.passed);
}

TEST_CASE("hard: held energy beyond start and work put in breaks the growth limit", "[study]") {
  Scene scene;
  place(scene, {{0, 0, 0}});
  Models models;
  models.list.emplace_back();
  LedgerEntry& held = models.ledger.entry("kinetic", "a");
  held.value = 10;
  EnergyBalance& balance = scene.store.get<GuardState>().balance;
  balance.update(models.ledger);
  HardWatch watch({}, scene, models);
  models.list.front().step.dt_old = 1;
  held.value = 10.19;  // 1.9 % above: kept
  balance.update(models.ledger);
  watch.look();
  CHECK(watch.broken() == nullptr);
  held.value = 10.21;
  balance.update(models.ledger);
  watch.look();
  REQUIRE(watch.broken() != nullptr);
  CHECK(watch.broken()->name == "energy_growth");
}

TEST_CASE("hard map: ranges with units, and values by steps or by factors", "[study]") {
  const MapAxis even = read_map_axis("let.dx=5 mm..15 mm");
  CHECK(even.lowest == Approx(0.005));
  CHECK(even.values(3)[1] == Approx(0.01));
  const MapAxis factors = read_map_axis("a.b=0.1..10");
  CHECK(factors.logarithmic());
  CHECK(factors.values(3)[1] == Approx(1));
  CHECK(factors.middle(1, 4) == Approx(2));
  CHECK_THROWS_AS(read_map_axis("a.b=1..0"), InputError);
  CHECK_THROWS_AS(read_map_axis("a.b=1"), InputError);
  CHECK_THROWS_AS(read_map_axis("1..2"), InputError);
  CHECK_THROWS_AS(read_map_axis("a=1 m..2 s"), InputError);
}

TEST_CASE("hard map: the sentence gives the margin from the standard to the edge", "[study]") {
  StabilityMap map;
  map.x = {.key = "scale", .unit = "-", .lowest = 0.5, .highest = 2, .standard = 1};
  map.x_values = map.x.values(4);
  map.y_values = {0};
  map.results.resize(4);
  for (HardResult& r : map.results) r.stable = true;
  map.results[3].stable = false;
  map.edges = {{.key = "scale", .upward = true, .found = true, .stable = 1.5, .broken = 1.6}};
  REQUIRE(margins_of(map).size() == 1);
  CHECK(margins_of(map)[0] ==
        "the standard scale 1 has a margin of 1.5 upward: stable at 1.5, not at 1.6");
  const std::string svg = svg_of(map);
  // One cell a run, the broken one crossed, the standard ringed: at 0.5 + 1 cells of 44 from 120.
  CHECK(svg.find("cx=\"186.0\"") != std::string::npos);
  CHECK(svg.find("#cc6677") != std::string::npos);
  CHECK(svg.find("#cc6677") == svg.rfind("#cc6677"));
}
