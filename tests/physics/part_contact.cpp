// Contact between parts of elements against exact solutions and conservation laws.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "contact/part_contact.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

Vec3 mean_velocity(const Scene& scene, int part) {
  Vec3 p = Vec3::Zero();
  double m = 0;
  const Range nodes = scene.parts[static_cast<std::size_t>(part)].nodes;
  for (Index i = nodes.begin; i < nodes.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    p += scene.nodes.x[k].w * xyz(scene.nodes.v[k]);
    m += scene.nodes.x[k].w;
  }
  return p / m;
}

/// Two steel bars of 1 cm^2, the left one of length L1, that meet at x = 0.
std::unique_ptr<Simulation> bars(double L1, int n1, double v1, int n2, double v2,
                                 const std::string& contact) {
  return make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{steel: {{density: 7800, young: 210 GPa, poisson: 0}}}}\n"
      "parts:\n"
      "  left: {{solid: {{material: steel}}, shape: {{block: {{from: [{} m, 0, 0], to: [0, 1 cm, 1 "
      "cm], elements: [{}, 1, 1]}}}}, initial_velocity: [{} m/s, 0, 0]}}\n"
      "  right: {{solid: {{material: steel}}, shape: {{block: {{from: [0, 0, 0], to: [1 m, 1 cm, 1 "
      "cm], elements: [{}, 1, 1]}}}}, initial_velocity: [{} m/s, 0, 0]}}\n"
      "contacts: {{meet: {{between: [left, right]{}}}}}\n"
      "output: {{until: 1 s}}\n",
      -L1, n1, v1, n2, v2, contact));
}

/// What an impact of two bars gives.
struct Impact {
  double impulse = 0;   ///< [N s]
  double duration = 0;  ///< from the first force to the last, at half the plateau [s]
  double plateau = 0;   ///< mean force over the middle half of the duration [N]
  double after_left = 0, after_right = 0;
  double energy_error = 0;
};

Impact impact_of(Simulation& s, double half_force, double until) {
  Impact result;
  Curve force;
  double begin = -1;
  double end = 0;
  run_until(s, until, [&] {
    const Step& step = s.models.list.front().step;
    const double F = measured(s.scene, "contact.meet.force");
    result.impulse += F * 0.5 * (step.dt_old + step.dt);
    force.add(step.t, F);
    if (F > half_force && begin < 0) begin = step.t;
    if (F > half_force) end = step.t;
  });
  result.duration = end - begin;
  int n = 0;
  for (std::size_t k = 0; k < force.t.size(); ++k) {
    const double share = (force.t[k] - begin) / result.duration;
    if (share < 0.25 || share > 0.75) continue;
    result.plateau += force.y[k];
    ++n;
  }
  result.plateau /= std::max(n, 1);
  result.after_left = mean_velocity(s.scene, s.scene.part_number("left")).x();
  result.after_right = mean_velocity(s.scene, s.scene.part_number("right")).x();
  result.energy_error = energy_error(s);
  return result;
}

void print(const char* what, const Impact& r) {
  fmt::print(
      "{}: impulse {:.5g} N s, {:.5g} us, plateau {:.5g} N, after {:.4f} and {:.4f} m/s, energy "
      "error {:.2g}\n",
      what, r.impulse, 1e6 * r.duration, r.plateau, r.after_left, r.after_right, r.energy_error);
}

}  // namespace

TEST_CASE("part contact: two equal bars exchange their velocities", "[contact][physics]") {
  // St. Venant: F = rho c A v, for 2 L/c; 400 elements a bar. What is lost is the bulk viscosity's.
  const double F = 20236.1063;
  const double t = 385.449645e-6;
  const auto s = bars(1, 400, 5, 400, -5, "");
  const Impact r = impact_of(*s, 0.5 * F, 0.6e-3);
  print("equal bars", r);
  CHECK(r.impulse == Approx(F * t).epsilon(0.005));
  CHECK(r.duration == Approx(t).epsilon(0.01));
  CHECK(r.plateau == Approx(F).epsilon(0.005));
  CHECK(r.after_right == Approx(5).epsilon(0.01));
  CHECK(r.after_left == Approx(-5).epsilon(0.01));
  CHECK(r.energy_error < 1e-4);
}

TEST_CASE("part contact: a short bar stops at a long one", "[contact][physics]") {
  // The short bar stays at rest, the long one leaves with half the speed. What the penalty's
  // softness adds to the impulse falls as its stiffness grows, and is small at the standard one.
  const double F = 20236.1063;
  const double t = 192.724822e-6;
  double last = 1;
  for (const char* stiffness : {"", ", stiffness: 4"}) {
    const auto s = bars(0.5, 100, 10, 200, 0, stiffness);
    const Impact r = impact_of(*s, 0.5 * F, 0.3e-3);
    print("short bar", r);
    const double error = std::abs(r.impulse / (F * t) - 1);
    CHECK(error < 0.5 * last);
    last = error;
    CHECK(r.duration == Approx(t).epsilon(0.01));
    CHECK(r.plateau == Approx(F).epsilon(0.005));
    CHECK(r.energy_error < 1e-3);
    CHECK(error < 0.005);
  }
}

TEST_CASE("part contact: momentum through a violent impact of two blocks", "[contact][physics]") {
  // Off centre, turning, with meshes that do not fit, until they part: no friction, no gravity.
  const bool shells = GENERATE(false, true);
  const auto s = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{alu: {{density: 2700, young: 70 GPa, poisson: 0.3}}, gum: {{density: 1100, "
      "young: 20 MPa, poisson: 0.45}}}}\n"
      "parts:\n"
      "  one: {{solid: {{material: gum}}, shape: {{block: {{from: [0, 0, 0], to: [4 cm, 3 cm, 3 "
      "cm], "
      "elements: [8, 6, 6]}}}}, initial_velocity: [\"20 + 300*(y-0.015)\", \"-300*(x-0.02)\", "
      "0]}}\n"
      "  two: {}, initial_velocity: [-30 m/s, 0, 3 m/s]}}\n"
      "contacts: {{meet: {{between: [one, two]}}}}\n"
      "output: {{until: 1 s}}\n",
      shells ? "{shell: {material: alu, thickness: 1 mm}, shape: {plate: {size: [3 cm, 4 cm], "
               "elements: [7, 9]}}, map: [\"0.042 + 0.3*x\", \"0.01 + y\", \"0.012 - x\"]"
             : "{solid: {material: gum, formulation: tetrahedra}, shape: {block: {from: [41 mm, 13 "
               "mm, 7 mm], to: [7 cm, 4 cm, "
               "41 mm], elements: [5, 5, 7]}}"));
  const Total p0 = linear_momentum(s->scene);
  // The nodes of shells turn too.
  const auto angular = [&]() -> Vec3 {
    return angular_momentum(s->scene).sum + spin_of_nodes(s->scene);
  };
  const Vec3 L0 = angular();
  double most_force = 0;
  double active = 0;
  run_until(*s, 3e-3, [&] {
    most_force = std::max(most_force, std::abs(measured(s->scene, "contact.meet.force")));
    active = std::max(active, measured(s->scene, "contact.meet.active"));
  });
  const double p_error = (linear_momentum(s->scene).sum - p0.sum).norm() / p0.scale;
  const double turned = (angular() - L0).norm() / angular_momentum(s->scene).scale;
  fmt::print(
      "{}: momentum {:.2g}, angular momentum {:.2g}, energy {:.2g}, largest force {:.0f} N, "
      "{} pairs\n",
      shells ? "block and plate" : "two blocks", p_error, turned, energy_error(*s), most_force,
      active);
  CHECK(active > 20);
  CHECK(p_error < 1e-12);
  CHECK(turned < 1e-9);
  CHECK(energy_error(*s) < 0.02);
}

TEST_CASE("part contact: a sliding block stops where friction says", "[contact][physics]") {
  const bool slides = GENERATE(true, false);
  const double mu = 0.2;
  const double v0 = 0.3;
  const double g = 9.81;
  const auto s = make_simulation_of_text(
      fmt::format("gannet: 1\n"
                  "materials: {{gum: {{density: 1000, young: 1 MPa, poisson: 0}}}}\n"
                  "parts:\n"
                  "  block: {{solid: {{material: gum, damping_ratio: 0.05}}, shape: {{block: "
                  "{{from: [0, 0, 0], to: [6 cm, 6 cm, "
                  "2 cm], elements: [6, 6, 2]}}}}, initial_velocity: [{} m/s, 0, 0]}}\n"
                  "  table: {{rigid_surface: {{}}, shape: {{plate: {{size: [40 cm, 20 cm], "
                  "elements: [11, 5]}}}}}}\n"
                  "contacts: {{rub: {{between: [block, table], friction: {}, damping: 0.5, "
                  "thickness: 2 mm}}}}\n"
                  "loads: {{gravity: [{}, 0, -9.81 m/s^2]}}\n"
                  "output: {{until: 1 s}}\n",
                  slides ? v0 : 0, mu, slides ? 0 : 0.5 * mu * g));
  const auto x_mean = [&] {
    double sum = 0, m = 0;
    const Range nodes = s->scene.parts[0].nodes;
    for (Index i = nodes.begin; i < nodes.end; ++i) {
      sum += s->scene.nodes.x[static_cast<std::size_t>(i)].w *
             s->scene.nodes.x[static_cast<std::size_t>(i)].x;
      m += s->scene.nodes.x[static_cast<std::size_t>(i)].w;
    }
    return sum / m;
  };
  const double x0 = x_mean();
  double stop = 0;
  run_until(*s, 0.25, [&] {
    if (mean_velocity(s->scene, 0).x() > 0.01 * v0) stop = time_of(*s);
  });
  const double way = x_mean() - x0;
  fmt::print(
      "sliding block: {:.5g} m (exact {:.5g}), {:.4g} s (exact {:.4g}); friction {:.4g} J; energy "
      "{:.2g}\n",
      way, slides ? v0 * v0 / (2 * mu * g) : 0, stop, v0 / (mu * g), ledger_sum(*s, "friction"),
      energy_error(*s));
  if (slides) {
    CHECK(way == Approx(v0 * v0 / (2 * mu * g)).epsilon(0.01));
    CHECK(stop == Approx(0.99 * v0 / (mu * g)).epsilon(0.01));
    CHECK(ledger_sum(*s, "friction") == Approx(0.5 * 0.072 * v0 * v0).epsilon(0.02));
  } else {
    CHECK(std::abs(way) < 1e-4);
  }
}

TEST_CASE("part contact: Hertz, a cylinder pressed on a rigid plane", "[contact][physics]") {
  // Johnson, Contact Mechanics: b^2 = 4 F' R/(pi E*), p0 = 2 F'/(pi b); R = 1 m, b/R = 0.048, six
  // elements over b. A block with a round foot is pressed by its weight and comes to rest by
  // damping. b is that of the second moment of the pressure, <x^2> = b^2/4: its
  // edge falls between two nodes.
  const double pi = 3.14159265358979;
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "dimension: 2\n"
      "materials: {soft: {density: 1000, young: 1 GPa, poisson: 0.3}}\n"
      "parts:\n"
      "  block: {solid: {material: soft}, damping: 1500 1/s, shape: {block: {from: [-1, 0, 0], to: "
      "[1, 1, 0], elements: [48, 30]}}, map: [\"0.5*(0.3*x + 0.7*x^3)\", \"0.001 + 0.5*(0.3*y + "
      "0.7*y^2) + 0.125*(0.3*x + 0.7*x^3)^2*(1 - y)\", 0]}\n"
      "  plane: {rigid_surface: {}, shape: {line: {from: [-2, 0, 0], to: [2, 0, 0], elements: "
      "1}}}\n"
      "contacts: {press: {between: [block, plane], thickness: 1 mm}}\n"
      "loads: {gravity: [0, -4315.4 m/s^2, 0]}\n"
      "output: {until: 1 s}\n");
  double mass = 0;
  const Range nodes = s->scene.parts[0].nodes;
  for (Index i = nodes.begin; i < nodes.end; ++i) {
    mass += s->scene.nodes.x[static_cast<std::size_t>(i)].w;
  }
  run_until(*s, 12e-3, [] {});
  const double F = mass * 4315.4;
  const double b = std::sqrt(4 * F / (pi * 1e9 / (1 - 0.3 * 0.3)));
  const PartContact& c = s->scene.store.get<PartContacts>().list.front();
  const PartDirection& d = c.directions.front();
  double p0 = 0;
  double second = 0;
  for (std::size_t r = 0; r < d.gaps.size(); ++r) {
    const auto i = static_cast<std::size_t>(d.candidates.point[r]);
    const double f = d.forces.normal[r].y();
    p0 = std::max(p0, f / std::abs(c.sides[0].facing[i].y()));
    second += f * c.sides[0].surface.x[i].x * c.sides[0].surface.x[i].x;
  }
  const double force = -measured(s->scene, "contact.press.force", 1);
  const double b_found = 2 * std::sqrt(second / force);
  fmt::print(
      "Hertz: force {:.5g} (weight {:.5g}), p0 {:.4g} (exact {:.4g}), b {:.4g} (exact {:.4g})\n",
      force, F, p0, 2 * F / (pi * b), b_found, b);
  CHECK(force == Approx(F).epsilon(0.001));
  CHECK(p0 == Approx(2 * F / (pi * b)).epsilon(0.03));
  CHECK(b_found == Approx(b).epsilon(0.03));
}

TEST_CASE("part contact: a cable and a beam slide on a bed and stop", "[contact][physics]") {
  const bool beam = GENERATE(false, true);
  const double mu = 0.2;
  const double v0 = 1;
  const double g = 9.81;
  const auto s = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{wood: {{density: 1000, young: 100 MPa, poisson: 0.3}}}}\n"
      "parts:\n"
      "  line: {{{}, shape: {{line: {{from: [0, 0, 0.1], to: [10 m, 0, 0.1], elements: 10}}}}, "
      "initial_velocity: [0.6 m/s, 0.8 m/s, 0]}}\n"
      "  bed: {{rigid_surface: {{}}, shape: {{plate: {{size: [30 m, 10 m], elements: [7, 3]}}}}}}\n"
      "contacts: {{lie: {{between: [line, bed], friction: {}, damping: 0.5}}}}\n"
      "loads: {{gravity: [0, 0, -9.81 m/s^2]}}\n"
      "output: {{until: 1 s}}\n",
      beam ? "beam: {material: wood, section: {solid_round: {diameter: 0.2 m}}}"
           : "cable: {material: wood, area: 0.031415926535898 m^2}",
      mu));
  const Range nodes = s->scene.parts[0].nodes;
  const Vec3 x0 = xyz(s->scene.nodes.x[static_cast<std::size_t>(nodes.begin)]);
  double weight = 0;
  double time = 0;
  double last = 0;
  run_until(*s, 1, [&] {
    const Step& step = s->models.list.front().step;
    if (step.t > 0.3) {
      weight += measured(s->scene, "contact.lie.force", 2) * (step.t - last);
      time += step.t - last;
    }
    last = step.t;
  });
  const Vec3 way = xyz(s->scene.nodes.x[static_cast<std::size_t>(nodes.begin)]) - x0;
  const double exact = v0 * v0 / (2 * mu * g);
  fmt::print("{} on a bed: {:.5g} m (exact {:.5g}), force on the bed {:.5g} N; energy {:.2g}\n",
             beam ? "beam" : "cable", std::hypot(way.x(), way.y()), exact, weight / time,
             energy_error(*s));
  CHECK(std::hypot(way.x(), way.y()) == Approx(exact).epsilon(0.01));
  CHECK(weight / time == Approx(-1000 * 0.0314159265 * 10 * g).epsilon(0.005));
  CHECK(energy_error(*s) < 0.01);
}

TEST_CASE("part contact: parts far apart cost next to nothing", "[contact][physics]") {
  std::string parts;
  std::string contacts;
  for (int k = 0; k < 100; ++k) {
    parts += fmt::format(
        "  b{}: {{solid: {{material: gum}}, shape: {{block: {{from: [{} m, 0, 0], to: [{} m, 0.1, "
        "0.1], "
        "elements: [10, 10, 10]}}}}, initial_velocity: [\"sin(50*x)\", \"sin(50*z)\", 0]}}\n",
        k, 0.3 * k, 0.3 * k + 0.1);
    if (k > 0) contacts += fmt::format("  c{0}: {{between: [b{1}, b{0}]}}\n", k, k - 1);
  }
  const auto s = make_simulation_of_text(
      "gannet: 1\nmaterials: {gum: {density: 1000, young: 1 MPa, poisson: 0.3}}\nparts:\n" + parts +
      "contacts:\n" + contacts + "output: {until: 1 s}\n");
  for (int k = 0; k < 150; ++k) advance(s->models);
  double of_contact = 0;
  double all = 0;
  for (const Stage stage : {Stage::force, Stage::kick, Stage::look, Stage::drift, Stage::accelerate,
                            Stage::half_drift}) {
    for (const Operation& op : s->models.list.front().plan.at(stage)) {
      all += op.watch.seconds;
      if (op.name.starts_with("contact: ")) of_contact += op.watch.seconds;
    }
  }
  fmt::print("99 contacts of 100 parts far apart: {:.2f} % of the step\n", 100 * of_contact / all);
  const auto& waits = s->scene.store.get<PartContacts>().waits;
  CHECK(*std::min_element(waits.begin(), waits.end()) >
        20);                       // 0.2 m at 1 mm a step, from step 0 on
  CHECK(of_contact < 0.03 * all);  // measured on a quiet machine: 0.5 %
}
