// Parts at steps of their own, joined by contact and ties: momentum, energy, and the same motion as
// in one model.
#include <fmt/format.h>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A box in a pool, held by two stiff lines that are tied to its upper corners.
std::string moored(bool subcycled) {
  const std::string models = "models: {water: {parts: pool}, lines: {parts: [left, right]}}\n";
  return R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [-0.6, -0.4, 0], to: [0.6, 0, 0]}, outside: box}
    start: hydrostatic
  box:
    rigid_surface: {}
    shape: {polyline: {points: [[-0.2, -0.08, 0], [0.2, -0.08, 0], [0.2, 0.12, 0], [-0.2, 0.12, 0], [-0.2, -0.08, 0]], elements: [10, 5, 10, 5]}}
  left: {cable: {EA: 1 MN, mass_per_length: 1 kg/m}, shape: {line: {from: [-1, 0.5, 0], to: [-0.2, 0.12, 0], elements: 20}}}
  right: {cable: {EA: 1 MN, mass_per_length: 1 kg/m}, shape: {line: {from: [1, 0.5, 0], to: [0.2, 0.12, 0], elements: 20}}}
bodies: {box: {parts: box, density: 500}}
ties:
  aft: {nodes: {nearest: [-0.2, 0.12, 0], of: left}, to: box}
  fore: {nodes: {nearest: [0.2, 0.12, 0], of: right}, to: box}
boundaries:
  tank: {planes: {x: [-0.6, 0.6], y: -0.4}}
  aft_pile: {nodes: {nearest: [-1, 0.5, 0], of: left}, fix: [x, y]}
  fore_pile: {nodes: {nearest: [1, 0.5, 0], of: right}, fix: [x, y]}
contacts: {hull: {between: [pool, box]}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {alpha: 0.1}}
)case" + (subcycled ? models : "") +
         "output: {until: 10 s, checkpoint: never}\n";
}

/// A drop that hits a floating body with a line tied to it, without gravity.
const std::string struck = R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  drop:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [-0.1, 0.13, 0], to: [0.2, 0.43, 0]}}
    initial_velocity: [0.2, -3, 0]
  plate:
    rigid_surface: {mass_per_area: 40 kg/m^2}
    shape: {line: {from: [-0.3, 0.1, 0], to: [0.3, 0.1, 0], elements: 20}}
  tail: {cable: {EA: 0.2 MN, mass_per_length: 2 kg/m}, shape: {line: {from: [0.3, 0.1, 0], to: [0.9, 0.1, 0], elements: 20}}}
bodies: {plate: {parts: plate}}
ties: {end: {nodes: {nearest: [0.3, 0.1, 0], of: tail}, to: plate}}
models: {water: {parts: drop}, rest: {parts: tail}}
contacts: {hit: {between: [drop, plate]}}
effects: {viscosity: {alpha: 0.1}}
output: {until: 1 s, checkpoint: never}
)case";

struct Momenta {
  Vec3 linear = Vec3::Zero();
  double scale = 0;
};

Momenta momenta_of(const Scene& scene) {
  Momenta sum;
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 p = scene.nodes.x[k].w * xyz(scene.nodes.v[k]);
    sum.linear += p;
    sum.scale += p.norm();
  }
  return sum;
}

double height_of_body(const Simulation& s) { return measured(s.scene, "body.box.position", 1); }

void run_to(Simulation& s, double t) {
  while (s.models.list.front().step.t < t) advance(s.models);
}

}  // namespace

TEST_CASE("models: water and a body with a line at their own steps keep momentum", "[physics]") {
  const auto s = make_simulation_of_text(struck);
  advance(s->models);
  const Momenta before = momenta_of(s->scene);
  run_to(*s, 0.12);
  const Momenta after = momenta_of(s->scene);
  const Model& fast = s->models.list.back();
  fmt::print("struck body: {} steps of the water, {} of line and body; momentum {:.2g}\n",
             s->models.list.front().step.n, fast.step.n,
             (after.linear - before.linear).norm() / before.scale);
  CHECK(fast.step.n > 5 * s->models.list.front().step.n);
  CHECK(measured(s->scene, "body.plate.velocity", 1) < -0.3);  // it was hit
  CHECK((after.linear - before.linear).norm() < 1e-12 * before.scale);
}

TEST_CASE("models: a moored box moves as in one model", "[physics]") {
  const auto one = make_simulation_of_text(moored(false));
  const auto two = make_simulation_of_text(moored(true));
  double worst = 0;
  double range = 0;
  for (double t = 0.05; t < 0.5; t += 0.05) {
    run_to(*one, t);
    run_to(*two, one->models.list.front().step.t);
    worst = std::max(worst, std::abs(height_of_body(*two) - height_of_body(*one)));
    range = std::max(range, std::abs(height_of_body(*one) - 0.02));
  }
  const double external = std::abs(ledger_sum(*one, "gravity"));
  const double link = std::abs(ledger_sum(*two, "link"));
  fmt::print(
      "moored box: {} and {} steps of the water, height differs by {:.2g} of {:.3g} m, link "
      "{:.2g} J of {:.3g} J, energy {:.2g} and {:.2g}\n",
      one->models.list.front().step.n, two->models.list.front().step.n, worst, range, link,
      external, energy_error(*one), energy_error(*two));
  CHECK(two->models.list.front().step.n * 4 < one->models.list.front().step.n);
  CHECK(worst < 0.03 * range);
  CHECK(energy_error(*two) < 2e-3);
}

TEST_CASE("models: held, slow forces move a body as impulses do, without the jolts", "[physics]") {
  std::string text = moored(true);
  text.replace(text.find("parts: [left, right]}"), 21, "parts: [left, right], slow_forces: held}");
  const auto held = make_simulation_of_text(text);
  const auto one = make_simulation_of_text(moored(false));
  const Scene& scene = held->scene;
  const int number = scene.part_number("body.box");
  const auto body =
      static_cast<std::size_t>(scene.parts[static_cast<std::size_t>(number)].nodes.begin);
  double last = scene.nodes.v[body].y;
  double jump = 0;
  held->models.list.back().plan.add(
      {.name = "watch", .stage = Stage::look, .run = [&](const Step& step) {
         if (step.t > 0.1) jump = std::max(jump, std::abs(scene.nodes.v[body].y - last));
         last = scene.nodes.v[body].y;
       }});
  double worst = 0;
  double range = 0;
  for (double t = 0.05; t < 0.5; t += 0.05) {
    run_to(*one, t);
    run_to(*held, one->models.list.front().step.t);
    worst = std::max(worst, std::abs(height_of_body(*held) - height_of_body(*one)));
    range = std::max(range, std::abs(height_of_body(*one) - 0.02));
  }
  const double dT = held->models.list.front().step.dt_old;
  fmt::print(
      "held: height differs by {:.2g} of {:.3g} m, largest jump {:.2g} of g dT, link {:.2g} J, "
      "energy {:.2g}\n",
      worst, range, jump / (9.81 * dT), ledger_sum(*held, "link"), energy_error(*held));
  CHECK(worst < 0.03 * range);
  CHECK(jump < 0.2 * 9.81 * dT);  // 0.43 with impulses
  CHECK(energy_error(*held) < 2e-3);
}

TEST_CASE("models: auto groups parts by the steps that they allow", "[physics]") {
  std::string text = moored(true);
  const std::string given = "models: {water: {parts: pool}, lines: {parts: [left, right]}}";
  text.replace(text.find(given), given.size(), "models: auto");
  const auto s = make_simulation_of_text(text);
  REQUIRE(s->models.list.size() == 2);
  const auto same = make_simulation_of_text(moored(true));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& mine = s->models.list[k].ranges;
    const auto& given_ranges = same->models.list[k].ranges;
    REQUIRE(mine.size() == given_ranges.size());
    CHECK(mine.front().begin == given_ranges.front().begin);
    CHECK(mine.back().end == given_ranges.back().end);
  }
  run_to(*s, 0.05);
  run_to(*same, 0.05);
  CHECK(height_of_body(*s) == height_of_body(*same));
  // Parts that allow about the same step are left in one model.
  std::string alike = text;
  for (const char* what : {"left: {cable: {EA: 1 MN, mass_per_length: 1 kg/m}",
                           "right: {cable: {EA: 1 MN, mass_per_length: 1 kg/m}"}) {
    std::string soft = what;
    soft.replace(soft.find("1 MN"), 4, "20 kN");
    alike.replace(alike.find(what), std::string(what).size(), soft);
  }
  CHECK(make_simulation_of_text(alike)->models.list.size() == 1);
}

TEST_CASE("models: auto lets a body with walls advance with its lines", "[physics]") {
  std::string text = moored(false);
  const auto put = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  put("density: 500}", "density: 500, walls: dummy}");
  put("contacts: {hull: {between: [pool, box]}}", "models: auto");
  const auto s = make_simulation_of_text(text);
  REQUIRE(s->models.list.size() == 2);
  const auto first_of = [&](const char* part) {
    return s->scene.parts[static_cast<std::size_t>(s->scene.part_number(part))].nodes.begin;
  };
  const Model& water = s->models.list.front();
  CHECK(&s->models.of_node(first_of("pool")) == &water);
  CHECK(&s->models.of_node(first_of("walls.box")) == &water);
  CHECK(&s->models.of_node(first_of("body.box")) == &s->models.list.back());
  CHECK(&s->models.of_node(first_of("left")) == &s->models.list.back());
  run_to(*s, 2e-3);
}

TEST_CASE("models: the weight of a body acts with the water that carries it", "[physics]") {
  const auto s = make_simulation_of_text(moored(true));
  run_to(*s, 0.1);
  Model& fast = s->models.list.back();
  const Scene& scene = s->scene;
  const int number = scene.part_number("body.box");
  const auto body =
      static_cast<std::size_t>(scene.parts[static_cast<std::size_t>(number)].nodes.begin);
  double last = scene.nodes.v[body].y;
  double jump = 0;
  fast.plan.add({.name = "watch", .stage = Stage::look, .run = [&](const Step&) {
                   jump = std::max(jump, std::abs(scene.nodes.v[body].y - last));
                   last = scene.nodes.v[body].y;
                 }});
  run_to(*s, 0.2);
  const double dT = s->models.list.front().step.dt_old;
  fmt::print("largest change of a floating body's velocity in a substep: {:.2g} of g dT\n",
             jump / (9.81 * dT));
  CHECK(jump < 0.6 * 9.81 * dT);  // more than all of it where the weight acts in the substeps
}

TEST_CASE("models: a mooring line that is tied to a body pulls with its catenary", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
parts:
  hull: {rigid_surface: {}, shape: {plate: {size: [10, 10], elements: [2, 2], centre: [0, 0, 0]}}}
bodies:
  float: {parts: hull, mass: 1000 t, centre: [0, 0, 0], inertia: [1e7, 1e7, 1e7, 0, 0, 0],
          motion: {velocity: [0, 0, 0], angular_velocity: [0, 0, 0]}}
moorings:
  line:
    from: [0, 0, 0]
    to: [900 m, 0, -310 m]
    length: 1000 m
    elements: 80
    EA: 1.335962 GN
    mass_per_length: 49.6215 kg/m
    diameter: 90 mm
    free: [from]
    water: {density: 1025 kg/m^3}
    bed: {}
ties: {fairlead: {nodes: {nearest: [0, 0, 0], of: line}, to: float}}
loads: {gravity: [0, 0, -9.80665 m/s^2]}
output: {until: 100 s, checkpoint: never}
)case");
  run_to(*s, 2);
  const auto force = [&](int d) { return measured(s->scene, "tie.fairlead.force", d); };
  const double tension = std::hypot(force(0), force(2));
  // The closed form of the elastic catenary on its bed: 371,256 N.
  fmt::print("tension at the tie {:.6g} N\n", tension);
  CHECK(tension == Approx(371256).epsilon(3e-4));
  for (const int d : {0, 2}) {
    CHECK(measured(s->scene, "mooring.line.force", d) == Approx(force(d)).epsilon(1e-9));
    CHECK(measured(s->scene, "body.float.reaction", d) ==
          Approx(-measured(s->scene, "body.float.force", d)).epsilon(1e-6));
  }
}

TEST_CASE("models: what holds a body is what acts on it, not the impulse of it", "[physics]") {
  std::string text = struck;
  text.replace(text.find("{parts: plate}}"), 15,
               "{parts: plate, motion: {velocity: [0, 0, 0], angular_velocity: [0, 0, 0]}}}");
  const auto s = make_simulation_of_text(text);
  struct Sample {
    double force = 0, reaction = 0, water = 0;
  };
  Sample largest;
  s->models.list.back().plan.add(
      {.name = "watch", .stage = Stage::look, .run = [&](const Step& step) {
         const Sample now{measured(s->scene, "body.plate.force", 1),
                          measured(s->scene, "body.plate.reaction", 1),
                          measured(s->scene, "contact.hit.force", 1)};
         if (step.coincides && std::abs(now.water) > std::abs(largest.water)) largest = now;
       }});
  run_to(*s, 0.03);
  fmt::print("force on a held plate {:.4g} N, reaction {:.4g} N, of water {:.4g} N\n",
             largest.force, largest.reaction, largest.water);
  CHECK(std::abs(largest.water) > 1000);
  CHECK(largest.reaction == Approx(-largest.force).epsilon(1e-6));
  CHECK(largest.water == Approx(largest.force).epsilon(0.02));
}
