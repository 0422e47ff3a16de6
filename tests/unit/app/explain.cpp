// What `gannet explain`, `gannet check` and effects.csv say of a case.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/effect_lines.hpp"
#include "app/effect_prices.hpp"
#include "app/effects.hpp"
#include "app/effects_csv.hpp"
#include "app/first_steps.hpp"
#include "app/penetrations.hpp"
#include "app/run_time.hpp"
#include "output/run_record.hpp"
#include "sph/sph_state.hpp"
#include "time/step.hpp"

using namespace gannet;
using State = Presence::State;

namespace {

const std::string drop = R"(gannet: 1
materials: {water: {card: water, c0: 20 m/s}}
parts: {drop: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [40 mm, 40 mm, 40 mm]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

const std::string slam = R"(gannet: 1
materials: {water: {card: water, c0: auto, expected_speed: 3 m/s}, skin: {card: al_6061_t6}, steel: {card: steel}}
parts:
  pool: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [100 mm, 100 mm, 40 mm]}}}
  panel: {shell: {material: skin, thickness: 2 mm}, shape: {plate: {size: [80 mm, 80 mm], elements: [4, 4], lowest_point: [10 mm, 10 mm, 37 mm]}}}
boundaries: {basin: {planes: {z: 2 mm, x: [0, 100 mm]}}}
contacts: {touch: {between: [pool, panel]}}
output: {until: 10 ms, checkpoint: never}
)";

Presence presence(Simulation& simulation, const std::string& name) {
  for (const EffectLine& l : effect_lines(simulation)) {
    if (l.name == name) return l.presence;
  }
  FAIL("no line for " + name);
  return {};
}

}  // namespace

TEST_CASE("explain: every effect of the table has a line with a reason, in its order", "[app]") {
  const auto simulation = make_simulation_of_text(drop);
  const auto lines = effect_lines(*simulation);
  REQUIRE(lines.size() == effects().size() + 1);
  CHECK(lines[0].name == "nodes");
  for (std::size_t k = 1; k < lines.size(); ++k) {
    CHECK(lines[k].name == effects()[k - 1].name);
    INFO(lines[k].name);
    CHECK(!lines[k].presence.why.empty());
    if (lines[k].presence.state == State::off) CHECK(lines[k].bytes == 0);
  }
}

TEST_CASE("explain: on with key and place, automatic with the rule, off with the key to write",
          "[app]") {
  const auto plain = make_simulation_of_text(drop);
  CHECK(presence(*plain, "xsph").state == State::off);
  CHECK(presence(*plain, "xsph").why == "the case has no effects.xsph");
  CHECK(presence(*plain, "shell").why == "the case has no parts.*.shell");
  CHECK(presence(*plain, "sph").state == State::on);
  CHECK(presence(*plain, "sph").why == "asked for at case.yaml:3:16");
  CHECK(presence(*plain, "guards").state == State::automatic);

  const auto with =
      make_simulation_of_text(drop + "effects: {viscosity: {alpha: 0}, xsph: {epsilon: 0.5}}\n");
  CHECK(presence(*with, "xsph").why == "asked for at case.yaml:5:34");
  CHECK(presence(*with, "viscosity").state == State::off);
  CHECK(presence(*with, "viscosity").why ==
        "effects.viscosity at case.yaml:5:11 leaves it without effect");

  const auto tank = make_simulation_of_text(slam);
  CHECK(presence(*tank, "planes").why == "boundaries.basin.planes at case.yaml:6:22");
  CHECK(presence(*tank, "planes").state == State::on);
  CHECK(presence(*tank, "contacts").state == State::on);
}

TEST_CASE("explain: an effect may say itself whether it is on", "[app]") {
  const auto simulation = make_simulation_of_text(drop);
  const Effect effect{.name = "xsph", .presence = [](const Keys&, Scene&) -> Presence {
                        return {State::automatic, "rule: 7 of 8"};
                      }};
  CHECK(presence_of(effect, *simulation).state == State::automatic);
  CHECK(presence_of(effect, *simulation).why == "rule: 7 of 8");
}

TEST_CASE("explain: what the case leaves open is named with its value, rule and key", "[app]") {
  const auto value = [](const std::string& text, const std::string& key) -> std::string {
    const auto simulation = make_simulation_of_text(text);
    for (const Choice& c : all_choices(*simulation)) {
      CHECK(!c.rule.empty());
      if (c.key == key) return c.chosen;
    }
    return "";
  };
  CHECK(value(slam, "materials.water.c0") == "30 m/s");  // 10 times 3 m/s
  CHECK(value(slam, "parts.panel.shell.points") == "5");
  CHECK(value(slam, "contacts.touch.thickness") == "0.006 m");  // (2 mm + 10 mm) / 2
  CHECK(value(slam, "output.vtk") == "every 200 us");
  CHECK(value(slam, "--threads") != "");
  CHECK(value(drop, "materials.water.c0") == "");  // given
  CHECK(value(drop, "output.vtk") == "");
}

namespace {

const std::string tank = R"(gannet: 1
let: {dx: 10 mm}
materials: {water: {card: water, c0: 20 m/s}}
parts: {pool: {sph: {material: water, spacing: dx}, fill: {box: {from: [0, 0, 0], to: [40 mm, 40 mm, 40 mm]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

std::string with_basin(const std::string& more) {
  return tank + "boundaries: {basin: {planes: {z: 0, x: [0, 40 mm]}" + more + "}}\n";
}

bool has_operation(const Simulation& simulation, const std::string& name) {
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : simulation.models.list.front().plan.at(static_cast<Stage>(s))) {
      if (op.name == name) return true;
    }
  }
  return false;
}

bool has_choice(Simulation& simulation, const std::string& key) {
  const std::vector<Choice> all = all_choices(simulation);
  return std::any_of(all.begin(), all.end(), [&](const Choice& c) { return c.key == key; });
}

}  // namespace

TEST_CASE("automatic: mirrors and penalty of planes name their keys, and follow them", "[app]") {
  const auto plain = make_simulation_of_text(with_basin(""));
  CHECK(presence(*plain, "mirror_walls").state == State::automatic);
  CHECK(presence(*plain, "contact with planes").state == State::automatic);
  CHECK(has_choice(*plain, "boundaries.basin.walls"));
  CHECK(has_choice(*plain, "boundaries.basin.penalty"));
  CHECK(plain->scene.warnings.empty());

  const auto asked = make_simulation_of_text(with_basin(", walls: mirror, penalty: on"));
  CHECK(presence(*asked, "mirror_walls").state == State::on);
  CHECK(presence(*asked, "mirror_walls").why == "boundaries.basin.walls: mirror at case.yaml:6:60");
  CHECK(presence(*asked, "contact with planes").state == State::on);
  CHECK(!has_choice(*asked, "boundaries.basin.walls"));
  CHECK(!has_choice(*asked, "boundaries.basin.penalty"));

  const auto off = make_simulation_of_text(with_basin(", walls: contact, penalty: off"));
  CHECK(presence(*off, "mirror_walls").state == State::off);
  CHECK(presence(*off, "mirror_walls").why == "boundaries.basin.walls: contact at case.yaml:6:60");
  CHECK(presence(*off, "contact with planes").state == State::off);
  CHECK(presence(*off, "contact with planes").why ==
        "boundaries.basin.penalty: off at case.yaml:6:78");
  CHECK(has_operation(*plain, "contact: particles and planes"));
  CHECK(!has_operation(*off, "contact: particles and planes"));
  CHECK(!has_operation(*off, "contact: work at planes"));
  REQUIRE(off->scene.warnings.size() == 1);
  CHECK(off->scene.warnings[0] ==
        "case.yaml:6:78: boundaries.basin.penalty: off: nothing is left that stops particles at "
        "its planes");
}

TEST_CASE("automatic: a plane without penalty lets water through, its neighbour does not",
          "[app]") {
  // Water falls through the floor at 1 m/s and is held by the other boundary's wall.
  const std::string more =
      "loads: {gravity: [0, 0, -100 m/s^2]}\n"
      "boundaries: {floor: {planes: {z: 0}, walls: contact";
  const auto lowest = [&](const std::string& penalty) {
    const auto s = make_simulation_of_text(tank + more + penalty +
                                           "}, side: {planes: {x: 0}, walls: contact}}\n");
    Model& model = s->models.list.front();
    evaluate_start(s->models);
    while (model.step.t < 0.02) advance(s->models);
    Vec3 low = Vec3::Constant(1);
    for (Index i = s->scene.particles.begin; i < s->scene.particles.end; ++i) {
      low = low.cwiseMin(xyz(s->scene.nodes.x[static_cast<std::size_t>(i)]));
    }
    return low;
  };
  CHECK(lowest("").z() > 0);
  const Vec3 through = lowest(", penalty: off");
  CHECK(through.z() == Approx(0.005 - 0.5 * 100 * 0.02 * 0.02).margin(0.003));
  CHECK(through.x() > 0);
}

TEST_CASE("automatic: guards and the check of the speed of sound can be switched off", "[app]") {
  const auto plain = make_simulation_of_text(tank);
  CHECK(has_choice(*plain, "effects.guards.active"));
  CHECK(has_operation(*plain, "guards"));
  CHECK(has_operation(*plain, "check of the speed of sound"));
  const auto off = make_simulation_of_text(tank + "effects: {guards: off}\n");
  CHECK(presence(*off, "guards").state == State::off);
  CHECK(presence(*off, "guards").why == "effects.guards.active: off at case.yaml:6:19");
  CHECK(!has_operation(*off, "guards"));
  CHECK(has_operation(*off, "energy balance"));
  REQUIRE(off->scene.warnings.size() == 1);
  CHECK(off->scene.warnings[0].starts_with("case.yaml:6:19: effects.guards.active: off: nothing"));
  const auto set =
      make_simulation_of_text(tank, {"effects.guards=off", "parts.pool.sph.sound_speed_check=off"});
  CHECK(presence(*set, "guards").state == State::off);
  CHECK(!has_operation(*set, "check of the speed of sound"));
  const auto limits = make_simulation_of_text(tank + "effects: {guards: {density_range: 1}}\n");
  CHECK(presence(*limits, "guards").state == State::on);
}

TEST_CASE("automatic: smoothing length and free surface are named with their values", "[app]") {
  const auto s = make_simulation_of_text(tank + "loads: {gravity: [0, 0, -9.81 m/s^2]}\n",
                                         {"parts.pool.start=hydrostatic"});
  const auto value = [&](const std::string& key) -> std::string {
    for (const Choice& c : all_choices(*s)) {
      if (c.key == key) return c.chosen;
    }
    return "";
  };
  CHECK(value("parts.pool.sph.smoothing_ratio") == "1.3");
  CHECK(value("parts.pool.surface") == "0.04 m");
}

TEST_CASE("overrides: the end of a path stands for the whole where one key has it", "[app]") {
  CHECK(make_simulation_of_text(tank, {"dx=20mm"})->scene.particles.size() == 8);
  CHECK(make_simulation_of_text(tank, {"spacing=20mm"})->scene.particles.size() == 8);
  CHECK(presence(*make_simulation_of_text(tank, {"xsph.epsilon=0.5"}), "xsph").state == State::on);
  CHECK_THROWS_WITH(make_simulation_of_text(slam, {"material=water"}),
                    Catch::Contains("--set material=water: 'material' may be "
                                    "parts.panel.shell.material or parts.pool.sph.material"));
}

TEST_CASE("check: a spacing that does not divide a box is told with what results", "[app]") {
  const auto s = make_simulation_of_text(tank, {"dx=11mm"});
  // 40/11 = 3.6 -> 4 cells of 10 mm in each direction: 1 - (10/11)^3 = 24.9 % less.
  REQUIRE(s->scene.warnings.size() == 1);
  CHECK(s->scene.warnings[0] ==
        "case.yaml:4:60: parts.pool.fill.box: the spacing of 0.011 m does not divide the box, "
        "which is filled exactly by 4 cells of 0.01 m in x (-9.1 %), 4 cells of 0.01 m in y "
        "(-9.1 %), 4 cells of 0.01 m in z (-9.1 %); a particle has -25 % of volume and mass "
        "against spacing^3");
}

TEST_CASE("check: the particles that allow the smallest steps are named one by one", "[app]") {
  const auto s = make_simulation_of_text(tank + "effects: {viscosity: {alpha: 0.1, beta: 2}}\n");
  evaluate_start(s->models);
  auto& sph = s->scene.store.get<SphState>();
  // c^2 = gamma (p - p0 + B)/rho: of 64 particles, three get less and less pressure.
  const double B = sph.eos[0].B;
  sph.p[7] = 3 * B;
  sph.p[60] = 2 * B;
  sph.p[31] = B;
  std::fill(sph.drho_dt.begin(), sph.drho_dt.end(), 0);
  for (const Operation& op : s->models.list.front().plan.at(Stage::force)) {
    if (op.name.find("particle pair pass") == std::string::npos) continue;
    const std::vector<Vote> votes = op.smallest(3);
    REQUIRE(votes.size() == 3);
    CHECK(votes[0].who == text_of_particle(s->scene, 7));
    CHECK(votes[1].who == text_of_particle(s->scene, 60));
    CHECK(votes[2].who == text_of_particle(s->scene, 31));
    CHECK(votes[0].dt == Approx(op.stable_dt()).epsilon(1e-12));
    CHECK(votes[0].dt < votes[1].dt);
    CHECK(op.smallest(1000).size() == 64);
    // One that is compressed fast is damped more: beta mu counts.
    sph.drho_dt[12] = 1e3 * sph.rho[12] * sph.c0 / sph.h;
    CHECK(op.smallest(1)[0].who == text_of_particle(s->scene, 12));
  }
}

TEST_CASE("effects.csv: shares of operations, sums of effects, prices of pair terms", "[app]") {
  const auto simulation = make_simulation_of_text(drop + "effects: {xsph: {epsilon: 0.5}}\n");
  FirstShares first;
  for (int k = 0; k < FirstShares::steps + 1; ++k) {
    CHECK(first.shares().empty());
    advance(simulation->models);
    first.note(simulation->models);
  }
  double sum = 0;
  for (const double s : first.shares()) sum += s;
  CHECK(sum == Approx(1).epsilon(1e-12));

  // Wall time 2 s, 3 s for the operation "drift": the table divides, and asks nobody else.
  for (Operation& op : simulation->models.list.front().plan.at(Stage::drift)) {
    op.watch.seconds = op.name == "drift" ? 0.5 : 0.25;
  }
  std::istringstream table(effects_table(*simulation, first, {{"xsph", 4, "a, list"}}, 2, 1e8));
  std::string line;
  std::getline(table, line);
  CHECK(line ==
        "kind,effect,model,stage,name,calls,seconds,share,predicted_share,price_ns,price_source");
  std::vector<std::string> lines;
  while (std::getline(table, line)) lines.push_back(line);
  const auto begins = [&](const std::string& text) {
    return std::count_if(lines.begin(), lines.end(),
                         [&](const std::string& l) { return l.starts_with(text); });
  };
  CHECK(begins("operation,leapfrog,main,drift,drift,21,0.500000,0.25000,") == 1);
  CHECK(begins("operation,xsph,main,drift,XSPH drift,21,0.250000,0.12500,") == 1);
  CHECK(begins("effect,xsph,,,xsph,,0.250000,0.12500,") == 1);
  CHECK(begins("effect,viscosity") == 0);
  REQUIRE(begins("pair term,xsph,") == 1);
  CHECK(lines.back().ends_with(",4.000,\"a, list\""));
}

TEST_CASE("prices: every effect in the list is one of the table, on both instruction sets",
          "[app]") {
  REQUIRE(!effect_prices().empty());
  for (const EffectPrice& p : effect_prices()) {
    INFO(p.effect);
    CHECK(std::any_of(effects().begin(), effects().end(),
                      [&](const Effect& e) { return e.name == p.effect; }));
    CHECK(p.ratio > 0.5);
    CHECK(p.fma > 0);
  }
}

TEST_CASE("prices: scaled by the machine's rate, effects without a price left out", "[app]") {
  const auto simulation = make_simulation_of_text(drop + "effects: {xsph: {epsilon: 0.5}}\n");
  const auto slow = term_prices(simulation->scene, {"xsph", "guards"}, 10);
  const auto fast = term_prices(simulation->scene, {"xsph"}, 40);
  REQUIRE(slow.size() == 1);
  REQUIRE(fast.size() == 1);
  CHECK(slow[0].effect == "xsph");
  CHECK(slow[0].ns == Approx(4 * fast[0].ns));
  CHECK(slow[0].ns > 0);
}

TEST_CASE("check: a run's time is the sum of what happens in it", "[app]") {
  const RunTime t{{1000, 2e-3}, {50, 10e-3}, {20, 0.1}, {400, 1e-3}};
  CHECK(t.total() == Approx(2 + 0.5 + 2 + 0.4));

  const auto simulation = make_simulation_of_text(slam);
  const FirstSteps first = make_first_steps(*simulation, 0, 3, 3);
  CHECK(first.steps == 3);
  CHECK(first.list_seconds > 0);
  CHECK(flowing_step(first) == Approx(first.seconds / 3 + first.list_seconds / steps_per_list));
  const RunTime run = estimate_run_time(*simulation, first);
  CHECK(run.frames.count == 51);
  CHECK(run.frames.seconds > 0);
  const double dt = simulation->models.list.front().step.dt_old;
  CHECK(run.steps.count == std::ceil(10e-3 / dt));
  CHECK(run.lines.count == std::min(1001.0, run.steps.count));
  CHECK(simulation->scene.store.get<RunRecord>().folder.empty());
}

TEST_CASE("check: penetrations at the start are counted and the deepest is named", "[app]") {
  const auto simulation = make_simulation_of_text(slam);
  evaluate_start(simulation->models);
  const auto overlaps = start_overlaps(simulation->scene);
  const auto of = [&](const std::string& name) {
    for (const StartOverlap& o : overlaps) {
      if (o.contact == name) return o;
    }
    FAIL("no " + name);
    return StartOverlap{};
  };
  // The highest particles stand at 35 mm, 2 mm below the panel; contact begins at 6 mm.
  CHECK(of("contact touch").count > 0);
  CHECK(of("contact touch").depth == Approx(4e-3));
  // The lowest 100 particles stand 3 mm over a plane that they should be 5 mm from.
  CHECK(of("plane basin.z_min").count == 100);
  CHECK(of("plane basin.z_min").depth == Approx(2e-3));
  CHECK(of("plane basin.x_min").count == 0);
}

TEST_CASE("check: the elements that allow the smallest steps, in order", "[app]") {
  const auto simulation = make_simulation_of_text(R"(gannet: 1
materials: {steel: {card: steel}}
parts: {sheet: {shell: {material: steel, thickness: 1 mm}, shape: {plate: {size: [40 mm, 40 mm], elements: [4, 4]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)");
  // Moving one node into its element makes the elements around it the ones with the smallest steps.
  Nodes& nodes = simulation->scene.nodes;
  for (Index i = 0; i < nodes.n_owned; ++i) {
    if (std::abs(nodes.x[i].x) < 1e-9 && std::abs(nodes.x[i].y) < 1e-9) nodes.x[i].x = 4e-3;
  }
  evaluate_start(simulation->models);
  const Vote smallest = smallest_vote(simulation->models.list.front());
  for (const Operation& op : simulation->models.list.front().plan.at(Stage::force)) {
    if (!op.smallest) continue;
    const std::vector<Vote> votes = op.smallest(16);
    REQUIRE(votes.size() == 16);
    CHECK(votes[0].dt == Approx(smallest.dt).epsilon(1e-12));
    CHECK(votes[0].who == smallest.limited_by());
    CHECK(std::is_sorted(votes.begin(), votes.end(),
                         [](const Vote& a, const Vote& b) { return a.dt < b.dt; }));
    std::vector<std::string> names;
    for (const Vote& v : votes) names.push_back(v.who);
    std::sort(names.begin(), names.end());
    CHECK(std::unique(names.begin(), names.end()) == names.end());
    CHECK(op.smallest(3).size() == 3);
  }
}
