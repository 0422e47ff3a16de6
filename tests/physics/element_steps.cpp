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

namespace {

/// A part that swings in a mode of its own: text of the part up to the damping, and what of a node
/// at x the mode is.
struct Swinging {
  const char* name;
  std::string kind;   ///< "solid: {material: soft"
  std::string shape;  ///< the rest of the part
  int axis;           ///< of the displacement
};

std::vector<Swinging> swinging() {
  const std::string line = "shape: {line: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 16}}";
  const std::string plate =
      "shape: {plate: {size: [1 m, 0.1 m], centre: [0.5 m, 0, 0], elements: [16, 1]";
  const std::string block =
      "shape: {block: {from: [0, 0, 0], to: [1 m, 0.1 m, 0.1 m], elements: [16, 1, 1]}}";
  const std::string still = "bulk_viscosity: {linear: 0, quadratic: 0}";
  return {
      {"solid", "solid: {material: soft, " + still, block, 0},
      {"eight points", "solid: {material: soft, formulation: eight_points, " + still, block, 0},
      {"tetrahedra", "solid: {material: soft, formulation: tetrahedra, " + still, block, 0},
      {"shell, stretched", "shell: {material: soft, thickness: 50 mm", plate + "}}", 0},
      {"shell, bent", "shell: {material: soft, thickness: 50 mm", plate + "}}", 2},
      {"full shell, stretched",
       "shell: {material: soft, thickness: 50 mm, formulation: fully_integrated", plate + "}}", 0},
      {"full shell, bent",
       "shell: {material: soft, thickness: 50 mm, formulation: fully_integrated", plate + "}}", 2},
      {"triangles, bent", "shell: {material: soft, thickness: 50 mm", plate + ", triangles: yes}}",
       2},
      {"beam, stretched",
       "beam: {material: soft, section: {rectangle: {width: 20 mm, height: "
       "20 mm}}",
       line, 0},
      {"beam, bent",
       "beam: {material: soft, section: {rectangle: {width: 20 mm, height: "
       "20 mm}}",
       line, 2}};
}

/// Both ends are held in x where it is stretched, supported where it is bent: the mode is sin(pi
/// x).
std::unique_ptr<Simulation> swing(const Swinging& part, const std::string& damping) {
  const char* start = part.axis == 0 ? "[\"1e-3*sin(pi*x)\", 0, 0]" : "[0, 0, \"1e-3*sin(pi*x)\"]";
  return make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{soft: {{density: 1000, young: 1 MPa, poisson: 0}}}}\n"
      "parts: {{a: {{{}{}}}, {}, initial_velocity: {}}}}}\n"
      "boundaries:\n"
      "  left: {{nodes: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, of: a}}, fix: [{}]}}\n"
      "  right: {{nodes: {{plane: {{point: [1 m, 0, 0], normal: [1, 0, 0]}}, of: a}}, fix: [{}]}}\n"
      "output: {{until: 1000 s}}\n",
      part.kind, damping, part.shape, start, part.axis == 0 ? "x" : "x, z",
      part.axis == 0 ? "x" : "z"));
}

/// Half a period [s], and the rate at which the energy falls [1/s], both from the first passage
/// through the middle to the third: the damping force of level 0, where no rate is known, is zero.
struct Decay {
  double half = 0;
  double rate = 0;
  double error = 0;
};

Decay decay_of(Simulation& s, int axis) {
  const auto coordinate = [&] {
    double q = 0;
    for (const Line& x : s.scene.nodes.x) {
      const double place = axis == 0 ? x.x - std::round(16 * x.x) / 16 : x.z;
      q += place * std::sin(3.14159265358979 * x.x);
    }
    return q;
  };
  // After a step positions are those of the next level, the ledger is that of the last one.
  std::vector<double> t, q, lost;
  std::vector<double> passed, energy;
  double start = 0;
  while (energy.size() < 3) {
    advance(s.models);
    if (start == 0) start = ledger_sum(s, "kinetic") + ledger_sum(s, "internal");
    lost.push_back(ledger_sum(s, "damping"));
    const std::size_t n = q.size();
    if (n > 1 && q[n - 2] * q[n - 1] < 0) {
      const double share = q[n - 2] / (q[n - 2] - q[n - 1]);
      passed.push_back(t[n - 2] + share * (t[n - 1] - t[n - 2]));
      energy.push_back(start - lost[n - 1] - share * (lost[n] - lost[n - 1]));
    }
    q.push_back(coordinate());
    t.push_back(time_of(s));
  }
  const double time = passed[2] - passed[0];
  return {0.5 * time, std::log(energy[0] / energy[2]) / time, energy_error(s)};
}

}  // namespace

TEST_CASE("stiffness damping: a mode decays at beta omega^2/2", "[physics]") {
  // Its energy falls by exp(-beta omega^2 t) over whole half periods.
  for (const Swinging& part : swinging()) {
    INFO(part.name);
    const auto free = swing(part, "");
    const double omega = 3.14159265358979 / decay_of(*free, part.axis).half;
    const double beta = 2 * 0.02 / omega;
    const auto s = swing(part, fmt::format(", damping_time: {:.9g} s", beta));
    const Decay d = decay_of(*s, part.axis);
    WARN(fmt::format("{}: omega {:.3f}, rate over beta omega^2 {:.4f}, energy error {:.1e}",
                     part.name, omega, d.rate / (beta * omega * omega), d.error));
    CHECK(d.rate == Approx(beta * omega * omega).epsilon(0.003));
    CHECK(d.error < 1e-3);
  }
}

TEST_CASE("stiffness damping: the step falls as its ratio says", "[physics]") {
  for (const Swinging& part : swinging()) {
    INFO(part.name);
    const double free = first_step(*swing(part, ""));
    const double damped = first_step(*swing(part, ", damping_ratio: 0.3"));
    CHECK(damped == Approx(free * (std::sqrt(1.09) - 0.3)).epsilon(1e-12));
    const double omega = 0.9 * 2 / free;
    const double beta = 2 * 0.3 / omega;
    CHECK(first_step(*swing(part, fmt::format(", damping_time: {:.17g} s", beta))) ==
          Approx(damped).epsilon(1e-9));
  }
}

TEST_CASE("stiffness damping: stable up to the step and no further", "[physics]") {
  // One free element whose highest mode is its bound: a cube that breathes, a square that grows, a
  // beam that is stretched. They fly, so that most of the energy is no vibration.
  const std::string unit = "density: 1000, young: 1 MPa, poisson: ";
  struct Free {
    std::string poisson, part;
  };
  const Free frees[] = {
      {"0.3",
       "solid: {material: soft, damping_ratio: 0.4, hourglass: {coefficient: 0}, bulk_viscosity: "
       "{linear: 0, quadratic: "
       "0}}, shape: {block: {from: [0, 0, 0], to: [0.1 m, 0.1 m, 0.1 m], elements: [1, 1, "
       "1]}}, initial_velocity: [\"0.1+0.01*x\", \"0.01*y\", \"0.01*z\"]"},
      {"0.3",
       "shell: {material: soft, thickness: 1 mm, formulation: fully_integrated, "
       "damping_ratio: 0.4}, shape: {plate: {size: [0.1 m, 0.1 m], elements: [1, 1]}}, "
       "initial_velocity: [\"0.1+0.01*x\", \"0.01*y\", 0]"},
      {"0.3",
       "beam: {material: soft, section: {rectangle: {width: 2 mm, height: 2 mm}}, "
       "damping_ratio: 0.4}, shape: {line: {from: [0, 0, 0], to: [0.1 m, 0, 0], elements: "
       "1}}, initial_velocity: [\"0.1+0.01*x\", 0, 0]"}};
  for (const Free& one : frees) {
    INFO(one.part);
    // Whether the vibration grows: by what the guards see, or by what it stores.
    const auto grows = [&](double share) {
      const auto s = make_simulation_of_text(fmt::format(
          "gannet: 1\nmaterials: {{soft: {{{}{}}}}}\nparts: {{a: {{{}}}}}\neffects: {{time_step: "
          "{{scale: {:.9g}}}}}\noutput: {{until: 1000 s}}\n",
          unit, one.poisson, one.part, share));
      for (int k = 0; k < 3; ++k) advance(s->models);
      const double start = ledger_sum(*s, "internal");
      CHECK(start > 0);
      try {
        for (int k = 0; k < 1000; ++k) advance(s->models);
      } catch (const RunError&) {
        return true;
      }
      return ledger_sum(*s, "internal") > start;
    };
    CHECK(!grows(0.99 / 0.9));
    CHECK(grows(1.02 / 0.9));
  }
}

TEST_CASE("stiffness damping: rigid rotation is not damped", "[physics]") {
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "materials: {soft: {density: 1000, young: 1 MPa, poisson: 0.3}}\n"
      "parts: {a: {solid: {material: soft, damping_ratio: 0.5}, shape: {block: {from: [-0.1 m, "
      "-0.1 m, -0.1 m], to: [0.1 m, 0.1 m, 0.1 m], elements: [2, 2, 2]}}, initial_velocity: "
      "[\"-y\", \"x\", 0]}}\n"
      "output: {until: 100 s}\n");
  run_until(*s, 6.283, [] {});
  const double lost = ledger_sum(*s, "damping");
  WARN(fmt::format("of a turn {:.1e} of the energy is damped", lost / ledger_sum(*s, "kinetic")));
  CHECK(lost < 1e-5 * ledger_sum(*s, "kinetic"));
}
