// What must not change where nothing acts from outside: linear and angular momentum.
#include <algorithm>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Largest change so far of a total, over the scale that it had at the start.
struct Drift {
  Total start;
  double worst = 0;
  Vec3 worst_of = Vec3::Zero();  ///< by component

  void look(const Total& now) {
    const Vec3 change = (now.sum - start.sum) / start.scale;
    worst = std::max(worst, change.norm());
    worst_of = worst_of.cwiseMax(change.cwiseAbs());
  }
};

/// A shell panel, tilted and moving sideways, falls on a block of water in free flight, fast
/// enough to yield.
const char* const free_flight = R"(gannet: 1
title: A panel and a block of water meet in free flight
materials:
  water: {density: 1000, c0: 200 m/s}
  skin: {density: 2700, young: 70 GPa, poisson: 0.3, yield_stress: 50 MPa, hardening_modulus: 300 MPa}
parts:
  block:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [0, 0, -0.2 m], to: [0.24 m, 0.24 m, 0]}}
    initial_velocity: [0.5 m/s, -1 m/s, 2 m/s]
  panel:
    shell: {material: skin, thickness: 2 mm, points: 5}
    shape: {plate: {size: [300 mm, 300 mm], elements: [12, 12], tilt: 8 deg, lowest_point: [0, 0.1 m, 3 mm]}}
    initial_velocity: [2 m/s, 1 m/s, -20 m/s]
contacts: {slam: {between: [block, panel]}}
effects:
  viscosity: {type: monaghan, alpha: 0.1}
  xsph: {epsilon: 0.5}
output: {until: 1 s}
)";

/// A block that is set spinning: it stretches at its corners and breaks up.
std::string drop(int dimension, const std::string& sph = "",
                 const std::string& effects = "xsph: {epsilon: 0.5}") {
  const char* const depth = dimension == 3 ? "0.1 m" : "0";
  return fmt::format(R"(gannet: 1
title: A drop that spins in free flight
dimension: {}
materials: {{water: {{density: 1000, c0: 40 m/s}}}}
parts:
  drop:
    sph: {{material: water, spacing: 10 mm{}}}
    fill: {{box: {{from: [0, 0, 0], to: [0.16 m, 0.12 m, {}]}}, jitter: 0.05}}
effects:
  viscosity: {{type: monaghan, alpha: 0.1}}
  {}
output: {{until: 1 s}}
)",
                     dimension, sph, depth, effects);
}

/// Spins the particles as a rigid body about the origin, with a velocity on top.
void spin(Scene& scene, const Vec3& omega, const Vec3& v) {
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 u = v + omega.cross(xyz(scene.nodes.x[k]));
    scene.nodes.v[k].x = u.x();
    scene.nodes.v[k].y = u.y();
    scene.nodes.v[k].z = u.z();
  }
}

struct SpinResult {
  Drift angular;
  Drift linear;
  double moved = 0;  ///< largest |X|, the XSPH velocity, over the largest speed
};

SpinResult run_drop(const std::string& text, int dimension, int n_steps) {
  const auto s = make_simulation_of_text(text);
  Scene& scene = s->scene;
  const Vec3 omega = dimension == 3 ? Vec3(3, -5, 12) : Vec3(0, 0, 12);
  spin(scene, omega, dimension == 3 ? Vec3(1, 2, -0.5) : Vec3(1, 2, 0));
  SpinResult r;
  advance(s->models);
  r.angular.start = angular_momentum(scene);
  r.linear.start = linear_momentum(scene);
  for (int i = 0; i < n_steps; ++i) {
    advance(s->models);
    r.angular.look(angular_momentum(scene));
    r.linear.look(linear_momentum(scene));
  }
  const SphState& sph = scene.store.get<SphState>();
  if (sph.X.empty()) return r;
  for_particles(scene, [&](std::size_t k, const Vec3&, const Vec3& v) {
    r.moved = std::max(r.moved, xyz(sph.X[k]).norm() / v.norm());
  });
  return r;
}

}  // namespace

TEST_CASE("physics: a panel and water in free flight keep their momentum", "[physics]") {
  const auto s = make_simulation_of_text(free_flight);
  advance(s->models);
  Drift drift{linear_momentum(s->scene)};
  const double water_before = ledger_sum(*s, "internal");
  int active = 0;
  int steps = 0;
  while (active < 1500 && steps < 12000) {
    advance(s->models);
    ++steps;
    active += measured(s->scene, "contact.slam.active") > 0 ? 1 : 0;
    drift.look(linear_momentum(s->scene));
  }
  const double plastic = ledger_sum(*s, "plastic");
  WARN(
      fmt::format("{} steps, contact active in {}, plastic work {:.3g} J, sum m|v| {:.4g}; drift "
                  "of sum m v over it: x {:.2e}, y {:.2e}, z {:.2e}; energy error {:.2e}",
                  steps, active, plastic, drift.start.scale, drift.worst_of.x(), drift.worst_of.y(),
                  drift.worst_of.z(), energy_error(*s)));
  CHECK(active >= 1000);
  CHECK(plastic > 0);  // the panel does yield
  CHECK(ledger_sum(*s, "internal") != water_before);
  // Every force is given and taken: only rounding is left, 1e-16 a step.
  CHECK(drift.worst < 1e-12);
}

TEST_CASE("physics: a spinning drop keeps its momenta with XSPH", "[physics]") {
  for (const int dimension : {2, 3}) {
    const SpinResult r = run_drop(drop(dimension), dimension, 1500);
    WARN(
        fmt::format("{}D: drift of L over sum m|x||v| {:.2e}, of sum m v over sum m|v| {:.2e}; "
                    "largest |X|/|v| at the end {:.2g}",
                    dimension, r.angular.worst, r.linear.worst, r.moved));
    CHECK(r.moved > 1e-3);  // XSPH does something here
    CHECK(r.angular.worst < 1e-12);
    CHECK(r.linear.worst < 1e-12);
  }
}

// Angular momentum is that about the origin, and scales with sum m |x||v|.
TEST_CASE("physics: what each effect leaves of the momenta of a spinning drop", "[physics]") {
  struct Choice {
    const char* effects;
    const char* sph;
    double linear;   ///< allowed change over sum m |v|
    double angular;  ///< over sum m |x||v|
  };
  const std::vector<Choice> choices = {
      {"", "", 1e-12, 1e-12},
      {"xsph: {epsilon: 0.5}", "", 1e-12, 1e-12},
      {"density_diffusion: {delta: 0.1}", "", 1e-12, 1e-12},
      {"tensile_cure: {epsilon: 0.2}", "", 1e-12, 1e-12},
      {"laminar_viscosity: {mu: 1, form: central}", "", 1e-12, 1e-12},
      {"laminar_viscosity: {mu: 1}", "", 1e-12, 2e-2},
      {"renormalisation: {every: 10}", "", 1e-12, 1e-12},
      {"shifting: {}", "", 1e-12, 1e-2},
      {"shifting: {}\n  corrected_gradients: on", "", 2e-2, 2e-2},
      {"", ", precision: single", 1e-8, 1e-8},
  };
  std::string table;
  for (const Choice& c : choices) {
    const SpinResult r = run_drop(drop(2, c.sph, c.effects), 2, 400);
    table += fmt::format("\n  {:<48}{:<20}{:.1e}  {:.1e}", c.effects, c.sph, r.linear.worst,
                         r.angular.worst);
    INFO(c.effects << c.sph);
    CHECK(r.linear.worst < c.linear);
    CHECK(r.angular.worst < c.angular);
  }
  WARN("change of linear and angular momentum in 400 steps:" << table);
}
