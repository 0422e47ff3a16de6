// What parts ask of their own step: mass scaling, and damping in proportion to stiffness.
#include <string>

#include "base/error.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A bar of two elements, 0.1 m and 0.9 m long, with c = 1000 m/s.
std::string uneven_bar(const std::string& more) {
  return "gannet: 1\n"
         "parts: {bar: {cable: {EA: 1 MN, mass_per_length: 1, tension_only: no}, shape: {line: "
         "{from: [0, 0, 0], to: [1 m, 0, 0], elements: 2}}, map: [\"1.6*x*x-0.6*x\", 0, 0], "
         "initial_velocity: [\"10*x\", 0, 0]" +
         more +
         "}}\n"
         "output: {until: 1 s}\n";
}

/// The step that the model would take first [s].
double first_step(Simulation& s) {
  evaluate_start(s.models);
  return smallest_vote(s.models.list.front()).dt;
}

double total_mass(const Simulation& s) {
  double sum = 0;
  for (const Line& x : s.scene.nodes.x) sum += x.w;
  return sum;
}

/// The sum of a field over the cells of the only part.
double sum_of(const Simulation& s, const std::string& name) {
  const Field* field = s.scene.field(name);
  REQUIRE(field != nullptr);
  double sum = 0;
  for (Index e = 0; e < field->count(); ++e) sum += *reinterpret_cast<double*>(field->at(e));
  return sum;
}

}  // namespace

TEST_CASE("mass scaling: two elements by hand", "[physics]") {
  // Steps of 0.9 l/c: 90 us and 810 us. For 180 us the short one needs four times its mass of 0.1
  // kg: 0.3 kg more, half at each of its nodes.
  auto s = make_simulation_of_text(uneven_bar(""));
  CHECK(first_step(*s) == Approx(90e-6).epsilon(1e-12));
  CHECK(s->scene.field("bar.added_mass") == nullptr);
  s = make_simulation_of_text(uneven_bar(", mass_scaling: {step: 180 us, ceiling: 40 %}"));
  const Nodes& nodes = s->scene.nodes;
  double mass[3] = {};
  for (const Line& x : nodes.x) mass[x.x < 0.05 ? 0 : (x.x < 0.5 ? 1 : 2)] = x.w;
  CHECK(mass[0] == Approx(0.20).epsilon(1e-12));
  CHECK(mass[1] == Approx(0.65).epsilon(1e-12));
  CHECK(mass[2] == Approx(0.45).epsilon(1e-12));
  CHECK(sum_of(*s, "bar.added_mass") == Approx(0.3).epsilon(1e-12));
  CHECK(first_step(*s) == Approx(180e-6).epsilon(1e-12));
  advance(s->models);
  // v = 10 x at the start: 0.15 kg at rest, 0.15 kg at 1 m/s, to what the first step changes.
  CHECK(ledger_sum(*s, "mass_scaling") == Approx(0.075).epsilon(1e-3));
  CHECK(ledger_sum(*s, "kinetic") == Approx(0.5 * 0.65 + 0.5 * 45).epsilon(1e-3));
}

TEST_CASE("mass scaling: what would pass the ceiling is refused with numbers", "[physics]") {
  try {
    make_simulation_of_text(uneven_bar(", mass_scaling: {step: 180 us, ceiling: 5 %}"));
    FAIL("30 % were accepted");
  } catch (const std::exception& e) {
    const std::string text = e.what();
    INFO(text);
    // The short element may carry 1.5 times its mass, a step of 90 us sqrt(1.5) = 110.2 us.
    for (const char* part : {"= 0.00018 s", "0.3 kg", "30 %", "5 %",
                             "by up to a factor of 4 in bar", "a step of 0.0001102 s is within"}) {
      INFO(part);
      CHECK(text.find(part) != std::string::npos);
    }
  }
}

TEST_CASE("mass scaling: stable up to the step of the heavier element, and no further",
          "[physics]") {
  // One free element: its bound is its frequency. The vote is 0.9 of the limit. It flies, so that
  // the energy at full levels, which is no constant so near the limit, is mostly that of the
  // flight.
  const auto run = [](const char* scaling, double share) {
    auto s = make_simulation_of_text(fmt::format(
        "gannet: 1\n"
        "parts: {{bar: {{cable: {{EA: 1 MN, mass_per_length: 1, tension_only: no}}, shape: {{line: "
        "{{from: [0, 0, 0], to: [0.1 m, 0, 0], elements: 1}}}}, initial_velocity: [\"1+0.1*x\", 0, "
        "0]{}}}"
        "}}\n"
        "effects: {{time_step: {{scale: {:.9g}}}}}\n"
        "output: {{until: 1 s}}\n",
        scaling, share));
    for (int k = 0; k < 3000; ++k) advance(s->models);
    return s;
  };
  const char* scaled = ", mass_scaling: {step: 180 us, ceiling: 400 %}";
  const auto at = run(scaled, 0.99 / 0.9);
  CHECK(at->models.list.front().step.dt == Approx(198e-6).epsilon(1e-6));
  CHECK(energy_error(*at) < 1e-3);
  CHECK_THROWS_AS(run(scaled, 1.02 / 0.9), RunError);
  CHECK_THROWS_AS(run("", 2.04 / 0.9), RunError);
}

TEST_CASE("mass scaling: every kind of element reaches the step and keeps momentum", "[physics]") {
  // A row of cells that become narrow at one end.
  const std::string steel = "materials: {steel: {density: 7800, young: 210 GPa, poisson: 0.3}}\n";
  const std::string fast =
      ", map: [\"x*x\", \"y\", \"z\"], initial_velocity: [\"3*x-z\", "
      "\"2*x*x+z\", \"x-4*x*y\"]";
  const std::string plate =
      ", shape: {plate: {size: [1 m, 0.2 m], elements: [10, 3]}}, map: [\"(x+0.6)^2\", \"y\", "
      "\"0.1*x*x\"], initial_velocity: [\"3*x\", \"2*x*y\", \"x-4*x*y\"]";
  const std::string block =
      ", shape: {block: {from: [0.1 m, 0, 0], to: [1.1 m, 0.2 m, 0.2 m], elements: [10, 2, 2]}}" +
      fast;
  const std::string line =
      ", shape: {line: {from: [0.1 m, 0, 0], to: [1.1 m, 0, 0], elements: 10}}" + fast;
  const std::pair<const char*, std::string> parts[] = {
      {"shell", "shell: {material: steel, thickness: 10 mm}" + plate},
      {"full shell",
       "shell: {material: steel, thickness: 10 mm, formulation: fully_integrated}" + plate},
      {"solid", "solid: {material: steel}" + block},
      {"eight points", "solid: {material: steel, formulation: eight_points}" + block},
      {"tetrahedra", "solid: {material: steel, formulation: tetrahedra}" + block},
      {"cable", "cable: {material: steel, area: 1 cm^2, tension_only: no}" + line},
      {"beam",
       "beam: {material: steel, section: {rectangle: {width: 20 mm, height: 10 mm}}}" + line}};
  for (const auto& [kind, part] : parts) {
    INFO(kind);
    const auto text = [&](const std::string& more) {
      return "gannet: 1\n" + steel + "parts: {a: {" + part + more + "}}\noutput: {until: 1 s}\n";
    };
    const auto plain = make_simulation_of_text(text(""));
    const double own = first_step(*plain);
    const double wanted = 1.7 * own;
    const auto s = make_simulation_of_text(
        text(fmt::format(", mass_scaling: {{step: {:.17g} s, ceiling: 20 %}}", wanted)));
    const double added = total_mass(*s) - total_mass(*plain);
    CHECK(sum_of(*s, "a.added_mass") == Approx(added).epsilon(1e-9));
    CHECK(added > 0.01 * total_mass(*plain));
    CHECK(first_step(*s) == Approx(wanted).epsilon(1e-9));
    const Total start = linear_momentum(s->scene);
    for (int k = 0; k < 300; ++k) advance(s->models);
    const Total end = linear_momentum(s->scene);
    CHECK((end.sum - start.sum).norm() < 1e-12 * std::max(start.scale, end.scale));
    const double held = ledger_sum(*s, "mass_scaling");
    CHECK(held > 0);
    CHECK(held < ledger_sum(*s, "kinetic"));
    WARN(fmt::format("{}: {:.1f} % added for 1.7 times the step, energy error {:.1e}", kind,
                     100 * added / total_mass(*plain), energy_error(*s)));
    CHECK(energy_error(*s) < 0.01);
  }
}
