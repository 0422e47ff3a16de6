// Contact of parts of elements with rigid planes against exact motions and balances.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "running.hpp"
#include "support/gravity.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

using test::g;

/// Mean place and velocity of a part by masses, or by its nodes alone where a body has taken them.
struct Mean {
  Vec3 x = Vec3::Zero();
  Vec3 v = Vec3::Zero();
};

Mean mean_of(const Scene& scene, int part) {
  Mean mean;
  double m = 0;
  const Range nodes = scene.parts[static_cast<std::size_t>(part)].nodes;
  for (Index i = nodes.begin; i < nodes.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double w = scene.nodes.x[k].w > 0 ? scene.nodes.x[k].w : 1;
    mean.x += w * xyz(scene.nodes.x[k]);
    mean.v += w * xyz(scene.nodes.v[k]);
    m += w;
  }
  mean.x /= m;
  mean.v /= m;
  return mean;
}

struct Slider {
  const char* name;
  const char* part;
  const char* body;  ///< what of `bodies` there is
  const char* keys;  ///< of the contact
  double height;     ///< at which its middle rests [m]
  double mass;
};

/// A thing 6 cm long that starts at the height where it rests and slides at 0.3 m/s.
std::unique_ptr<Simulation> sliding(const Slider& thing, double mu, double gravity_x) {
  return make_simulation_of_text(
      fmt::format("gannet: 1\n"
                  "materials: {{gum: {{density: 1000, young: 1 MPa, poisson: 0}}}}\n"
                  "parts: {{thing: {}}}\n"
                  "{}boundaries: {{ground: {{planes: {{z: 0}}}}}}\n"
                  "contacts: {{rub: {{between: [thing, ground], friction: {}, damping: 0.5{}}}}}\n"
                  "loads: {{gravity: [{}, 0, -9.81 m/s^2]}}\n"
                  "probes: {{floor: {{contact_force: rub}}}}\n"
                  "output: {{until: 1 s}}\n",
                  thing.part, thing.body, mu, thing.keys, gravity_x));
}

const char* block_of =
    "shape: {block: {from: [0, 0, 0], to: [6 cm, 6 cm, 2 cm], elements: [6, 6, 2]}}";

}  // namespace

TEST_CASE("plane contact: what slides stops where friction says", "[contact][physics]") {
  const double mu = 0.2;
  const double v0 = 0.3;
  const std::string soft = fmt::format(
      "{{solid: {{material: gum, damping_ratio: 0.05}}, {}, initial_velocity: [0.3 m/s, "
      "0, 0]}}",
      block_of);
  const std::string stiff = fmt::format("{{solid: {{material: gum}}, {}}}", block_of);
  const char* body = "bodies: {box: {parts: thing, velocity: [0.3 m/s, 0, 0]}}\n";
  const Slider things[] = {
      {"soft block", soft.c_str(), "", "", 0.01, 0.072},
      {"rigid block", stiff.c_str(), body, "", 0.01, 0.072},
      {"rigid skin",
       "{rigid_surface: {mass_per_area: 40, thickness: 2 mm}, shape: {plate: {size: [6 cm, 6 cm], "
       "elements: [3, 3], centre: [0, 0, 1 mm]}}}",
       body, ", pressure_per_depth: 100 MPa/m", 0.001, 0.144},
      {"shell",
       "{shell: {material: gum, thickness: 4 mm, damping_ratio: 0.05}, shape: {plate: {size: [6 "
       "cm, "
       "6 cm], elements: [3, 3], centre: [0, 0, 2 mm]}}, initial_velocity: [0.3 m/s, 0, 0]}",
       "", "", 0.002, 0.0144},
      {"beam",
       "{beam: {material: gum, section: {solid_round: {diameter: 6 mm}}}, shape: {line: {from: "
       "[0, 0, 3 mm], to: [0, 6 cm, 3 mm], elements: 3}}, initial_velocity: [0.3 m/s, 0, 0]}",
       "", "", 0.003, 0.00169646},
      {"cable",
       "{cable: {material: gum, area: 28.2743338823 mm^2}, shape: {line: {from: [0, 0, 3 mm], "
       "to: "
       "[0, 6 cm, 3 mm], elements: 3}}, initial_velocity: [0.3 m/s, 0, 0]}",
       "", "", 0.003, 0.00169646}};
  for (const Slider& thing : things) {
    const auto s = sliding(thing, mu, 0);
    const double x0 = mean_of(s->scene, 0).x.x();
    double stop = 0;
    double impulse_x = 0;
    double impulse_z = 0;
    run_until(*s, 0.2, [&] {
      const Step& step = s->models.list.front().step;
      const double dt = step.dt_old;  // F is that of the level before the step, v after it
      impulse_x += measured(s->scene, "contact.rub.force", 0) * dt;
      impulse_z += measured(s->scene, "contact.rub.force", 2) * dt;
      if (mean_of(s->scene, 0).v.x() > 0.01 * v0) stop = time_of(*s);
    });
    const Mean end = mean_of(s->scene, 0);
    const double exact = v0 * v0 / (2 * mu * g);
    fmt::print(
        "{}: {:.5g} m (exact {:.5g}), {:.4g} s (exact {:.4g}), height {:.6g} m, impulses {:.5g} "
        "(exact {:.5g}) and {:.5g} (exact {:.5g}) N s, friction {:.4g} J; energy {:.1e}\n",
        thing.name, end.x.x() - x0, exact, stop, 0.99 * v0 / (mu * g), end.x.z(), impulse_x,
        -thing.mass * v0, impulse_z, thing.mass * g * 0.2, ledger_sum(*s, "friction"),
        energy_error(*s));
    CHECK(end.x.x() - x0 == Approx(exact).epsilon(0.01));
    CHECK(stop == Approx(0.99 * v0 / (mu * g)).epsilon(0.01));
    CHECK(end.x.z() == Approx(thing.height).epsilon(0.01));
    CHECK(impulse_x == Approx(-thing.mass * v0).epsilon(0.005));
    CHECK(impulse_z == Approx(thing.mass * g * 0.2).epsilon(0.005));
    CHECK(ledger_sum(*s, "friction") == Approx(0.5 * thing.mass * v0 * v0).epsilon(0.02));
    CHECK(energy_error(*s) < 0.01);
  }
}

TEST_CASE("plane contact: what friction holds stays", "[contact][physics]") {
  const std::string stiff = fmt::format("{{solid: {{material: gum}}, {}}}", block_of);
  const Slider block{"", stiff.c_str(), "bodies: {box: {parts: thing}}\n", "", 0.01, 0.072};
  const auto s = sliding(block, 0.2, 0.5 * 0.2 * g);
  const double x0 = mean_of(s->scene, 0).x.x();
  run_until(*s, 0.2, [] {});
  CHECK(std::abs(mean_of(s->scene, 0).x.x() - x0) < 1e-6);
  // All the energy that there is is that of settling by its own weight over a few steps.
  CHECK(energy_error(*s) < 0.02);
}

TEST_CASE("plane contact: a box that falls on its edge keeps the balance of momenta and energy",
          "[contact][physics]") {
  // Tilted about y, turning, dropped by 2 cm with friction; a light one of shells, rigid.
  const bool frictionless = GENERATE(true, false);
  const auto s = make_simulation_of_text(
      fmt::format("gannet: 1\n"
                  "materials: {{alu: {{density: 2700, young: 70 GPa, poisson: 0.3}}}}\n"
                  "parts: {{box: {{solid: {{material: alu}}, shape: {{block: {{from: [-5 cm, -3 "
                  "cm, -2 cm], to: "
                  "[5 cm, 3 cm, 2 cm], elements: [5, 3, 2]}}}}, map: [\"0.9*x + 0.436*z\", \"y\", "
                  "\"0.09 - 0.436*x + 0.9*z\"]}}}}\n"
                  "bodies: {{box: {{parts: box, velocity: [1 m/s, 0, -0.5 m/s], angular_velocity: "
                  "[2, 0, 1]}}}}\n"
                  "boundaries: {{ground: {{planes: {{z: 0}}}}}}\n"
                  "contacts: {{land: {{between: [box, ground]{}}}}}\n"
                  "loads: {{gravity: [0, 0, -9.81 m/s^2]}}\n"
                  "output: {{until: 1 s}}\n",
                  frictionless ? "" : ", friction: 0.3, damping: 0.3"));
  const double m = 2700 * 0.1 * 0.06 * 0.04 * (0.9 * 0.9 + 0.436 * 0.436);
  Vec3 impulse = Vec3::Zero();
  double z0 = 0;
  double most = 0;
  Vec3 v0(1, 0, -0.5);
  run_until(*s, 0.3, [&] {
    const Step& step = s->models.list.front().step;
    // The kick at the level whose force is at hand was (dt_old + dt)/2 long; both are past now.
    z0 = measured(s->scene, "contact.land.force", 2);
    most = std::max(most, z0);
    for (int d = 0; d < 3; ++d) {
      impulse[d] += measured(s->scene, "contact.land.force", d) * step.dt_old;
    }
  });
  const Index centre = s->scene.parts.back().nodes.begin;
  const Vec3 v = xyz(s->scene.nodes.v[static_cast<std::size_t>(centre)]);
  const Vec3 expected = m * (v - v0 + Vec3(0, 0, g * time_of(*s)));
  fmt::print(
      "box on its edge{}: impulse ({:.5g}, {:.3g}, {:.5g}), expected ({:.5g}, {:.3g}, {:.5g}) "
      "N s, largest force {:.0f} N, friction {:.3g} J of {:.3g}, energy {:.1e}\n",
      frictionless ? "" : " with friction", impulse.x(), impulse.y(), impulse.z(), expected.x(),
      expected.y(), expected.z(), most, ledger_sum(*s, "friction"), 0.5 * m * 1.25,
      energy_error(*s));
  CHECK(most > 20 * m * g);  // it has landed
  CHECK((impulse - expected).norm() < 0.005 * expected.norm());
  if (frictionless) CHECK(std::abs(v.x() - 1) < 1e-9);
  CHECK(energy_error(*s) < 0.02);
}

TEST_CASE("plane contact: a belt takes a block along", "[contact][physics]") {
  // The belt moves at V. The block slips for V/(mu g), and the belt puts in m V^2, half of it heat.
  const double mu = 0.3;
  const double V = 0.5;
  const std::string stiff = fmt::format("{{solid: {{material: gum}}, {}}}", block_of);
  const auto s = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{gum: {{density: 1000, young: 1 MPa, poisson: 0}}}}\n"
      "parts: {{block: {}}}\n"
      "bodies: {{block: {{parts: block}}}}\n"
      "boundaries: {{belt: {{planes: {{z: 0}}, motion: {{velocity: [{} m/s, 0, 0]}}}}}}\n"
      "contacts: {{rub: {{between: [block, belt], friction: {}, damping: 0.5}}}}\n"
      "loads: {{gravity: [0, 0, -9.81 m/s^2]}}\n"
      "output: {{until: 1 s}}\n",
      stiff, V, mu));
  const double x0 = mean_of(s->scene, 0).x.x();
  const double t = V / (mu * g);
  run_until(*s, 2 * t, [] {});
  const double m = 1000 * 0.06 * 0.06 * 0.02;
  const Mean end = mean_of(s->scene, 0);
  fmt::print(
      "belt: {:.5g} m (exact {:.5g}), {:.5g} m/s, put in {:.4g} J (exact {:.4g}), heat {:.4g} "
      "J; energy {:.1e}\n",
      end.x.x() - x0, 0.5 * V * t + V * (time_of(*s) - t), end.v.x(),
      ledger_sum(*s, "moving plane"), m * V * V, ledger_sum(*s, "friction"), energy_error(*s));
  CHECK(end.v.x() == Approx(V).epsilon(1e-3));
  CHECK(end.x.x() - x0 == Approx(0.5 * V * t + V * (time_of(*s) - t)).epsilon(0.005));
  CHECK(ledger_sum(*s, "moving plane") == Approx(m * V * V).epsilon(0.01));
  CHECK(ledger_sum(*s, "friction") == Approx(0.5 * m * V * V).epsilon(0.01));
  CHECK(energy_error(*s) < 0.01);
}
