// Walls of dummy particles: momentum and energy that pass between water and wall.
#include <algorithm>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A column that collapses in a basin. parts: further ones; alpha: of the viscosity.
std::string basin(const char* slip, const char* parts, const char* alpha) {
  return fmt::format(R"(gannet: 1
title: Water sloshes between dummy particles
dimension: 2
let: {{dx: 20 mm}}
materials: {{water: {{card: water, c0: 40 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: dx, cfl: 0.35}}
    fill: {{box: {{from: [0, 0, 0], to: [0.6 m, 0.5 m, 0]}}}}
    start: hydrostatic
{}
boundaries: {{tank: {{planes: {{x: [0, 1 m], y: 0}}, walls: dummy, slip: {}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects: {{viscosity: {{type: monaghan, alpha: {}}}}}
output: {{until: 10 s}}
)",
                     parts, slip, alpha);
}

const char* const piston = R"(  piston:
    fill: {box: {from: [0.6 m, 0, 0], to: [0.66 m, 0.8 m, 0]}}
    wall: {slip: none, velocity: [-1 m/s, 0, 0], factor: [[0, 0], [0.1 s, 1], [0.2 s, 0]]}
)";

/// A tank of 0.4 x 0.2 m between dummy particles, with a gauge on its left wall near the floor that
/// goes with it.
std::string tank(const char* motion, const char* gravity_x) {
  return fmt::format(R"(gannet: 1
title: A tank that moves
dimension: 2
let: {{dx: 10 mm, A: 30 mm, w: 6 rad/s}}
materials: {{water: {{card: water, c0: 25 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: dx}}
    fill: {{box: {{from: [0, 0, 0], to: [0.4 m, 0.2 m, 0]}}}}
    start: hydrostatic
boundaries: {{tank: {{planes: {{x: [0, 0.4 m], y: 0}}, walls: dummy{}}}}}
loads: {{gravity: [{}, -9.81 m/s^2, 0]}}
effects: {{viscosity: {{type: monaghan, alpha: 0.1}}}}
probes:
  side: {{pressure: {{at: [0, 50 mm, 0], on: tank}}}}
  held: {{wall_force: tank}}
output: {{until: 10 s}}
)",
                     motion, gravity_x);
}

/// What the gauge on the side reads at every step.
std::vector<std::pair<double, double>> side_pressure(Simulation& s, double until) {
  std::vector<std::pair<double, double>> out;
  run_until(s, until, [&] { out.emplace_back(time_of(s), measured(s.scene, "probe.side")); });
  return out;
}

/// Of the fluid alone, at entry to a step.
Total momentum_of_fluid(const Scene& scene) {
  Total p;
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (scene.parts[static_cast<std::size_t>(scene.particle_part[k])].kind != "sph") continue;
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    const Vec3 mv = scene.nodes.x[i].w * xyz(scene.nodes.v[i]);
    p.sum += mv;
    p.scale += mv.norm();
  }
  return p;
}

Index n_fluid(const Scene& scene) {
  Index n = 0;
  for (const Index part : scene.particle_part) {
    n += scene.parts[static_cast<std::size_t>(part)].kind == "sph" ? 1 : 0;
  }
  return n;
}

/// Largest |change of momentum - impulse of walls, planes and weight| of a step, over sum m |v|.
double worst_balance(Simulation& s, int n_steps) {
  const Scene& scene = s.scene;
  const Vec3 weight = n_fluid(scene) * s.scene.store.get<SphState>().m * scene.gravity;
  double worst = 0;
  for (int n = 0; n < n_steps; ++n) {
    const Total before = momentum_of_fluid(scene);
    const double dt_old = s.models.list.front().step.dt_old;
    advance(s.models);
    const double dt = 0.5 * (dt_old + s.models.list.front().step.dt_old);
    Vec3 force = weight;
    for (const Measure& m : scene.measures) {
      const bool wall = m.name.starts_with("wall.") && m.name.ends_with(".force");
      if (!wall && !m.name.starts_with("plane.")) continue;
      double f[3];
      m.sample(f);
      force -= Vec3(f[0], f[1], f[2]);
    }
    const Total after = momentum_of_fluid(scene);
    if (n < 10) continue;  // from rest: the scale is near 0
    worst = std::max(worst, (after.sum - before.sum - dt * force).norm() / after.scale);
  }
  return worst;
}

}  // namespace

TEST_CASE("physics: what walls and weight give is the momentum of the water", "[physics]") {
  for (const char* slip : {"free", "none"}) {
    const auto s = make_simulation_of_text(basin(slip, piston, "0.2"));
    const double worst = worst_balance(*s, 600);
    WARN(fmt::format("slip {}: worst imbalance of a step {:.1e} of sum m|v|", slip, worst));
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("physics: a column that sloshes between dummy walls keeps its energy", "[physics]") {
  const auto s = make_simulation_of_text(basin("none", "", "0.05"));
  double most = 0;
  double wall = 0;
  run_until(*s, 0.7, [&] {
    most = std::max(most, energy_error(*s));
    wall = std::max(wall, std::abs(ledger_sum(*s, "wall")));
  });
  const double scale = s->scene.store.get<GuardState>().balance.largest_total;
  WARN(fmt::format("largest energy error {:.2e}, entry wall up to {:.2e} of the energy", most,
                   wall / scale));
  CHECK(most < 1.5e-3);        // of the scheme in time: a quarter with half the step
  CHECK(wall / scale > most);  // without the entry the balance would not close
}

TEST_CASE("physics: the work of a piston is the energy that the water gains", "[physics]") {
  const auto s = make_simulation_of_text(basin("free", piston, "0.05"));
  run_until(*s, 0.3, [] {});
  const double work = ledger_sum(*s, "wall motion");
  const GuardState& guard = s->scene.store.get<GuardState>();
  WARN(fmt::format("the piston does {:.4g} J of work; energy error {:.2e}, {:.2e} of that work",
                   work, energy_error(*s), std::abs(guard.balance.imbalance) / work));
  CHECK(work > 1);
  CHECK(std::abs(guard.balance.imbalance) < 1e-4 * work);
  // It stands where the integral of its velocity says: 0.1 m further in.
  double low = 1e9;
  const int part = s->scene.part_number("piston");
  for_particles(s->scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    if (s->scene.particle_part[k] == part) low = std::min(low, x.x());
  });
  CHECK(low == Approx(0.6 + 0.01 - 0.1).epsilon(1e-12));
}

TEST_CASE("physics: a tank that sways, seen from outside and from within", "[physics]") {
  const auto outside = make_simulation_of_text(
      tank(", motion: {displacement: [\"A*(w*t - sin(w*t))\", 0, 0]}", "0"));
  const auto within = make_simulation_of_text(tank("", "\"-A*w^2*sin(w*t)\""));
  const auto a = side_pressure(*outside, 1.5);
  const auto b = side_pressure(*within, 1.5);
  double sum = 0;
  double scale = 0;
  std::size_t k = 0;
  for (const auto& [t, p] : a) {
    while (k + 1 < b.size() && b[k].first < t) ++k;
    sum += (p - b[k].second) * (p - b[k].second);
    scale += std::pow(b[k].second - 1000 * 9.81 * 0.15, 2);
  }
  const double rms = std::sqrt(sum / scale);
  WARN(
      fmt::format("pressure on the side: rms of the difference {:.2g} of that of the sloshing; "
                  "energy error {:.1e}, {:.1e}",
                  rms, energy_error(*outside), energy_error(*within)));
  CHECK(scale / static_cast<double>(a.size()) > 100 * 100);
  CHECK(rms < 0.02);
  CHECK(energy_error(*outside) < 1e-3);
}

TEST_CASE("physics: a tank that is turned holds its water level", "[physics]") {
  const auto s = make_simulation_of_text(
      tank(", motion: {rotation: {axis: [0, 0, 1], angle: \"min(t, 0.2)*0.5\"}}", "0"));
  const auto p = side_pressure(*s, 3);
  double mean = 0;
  double held = 0;  // by all walls along y
  int n = 0;
  double worst = -1;
  run_until(*s, 3.5, [&] {
    mean += measured(s->scene, "probe.side");
    held += measured(s->scene, "probe.held", 7);
    ++n;
  });
  mean /= n;
  CHECK(held / n == Approx(-9.81 * 80).epsilon(0.01));  // 0.4 x 0.2 m of water
  // Turned by 0.1 rad about the corner: the gauge's depth below the surface, which is level at
  // half a tank's length.
  const double up = 0.2 / std::cos(0.1) + 0.2 * std::tan(0.1);
  const double depth = (up - 0.05) * std::cos(0.1);
  for_particles(s->scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    if (!is_fluid(s->scene, static_cast<Index>(k))) return;
    const Vec3 q = Eigen::AngleAxisd(-0.1, Vec3::UnitZ()) * x;
    worst = std::max({worst, -q.x(), q.x() - 0.4, -q.y()});
  });
  WARN(
      fmt::format("gauge at rest in a tank turned by 0.1 rad: {:.1f} Pa, {:.1f} Pa by its depth; "
                  "furthest behind a wall {:.2f} dx; energy error {:.1e}",
                  mean, 9810 * depth, worst / 0.01, energy_error(*s)));
  CHECK(mean == Approx(9810 * depth).epsilon(0.02));
  CHECK(worst < 0);
  CHECK(energy_error(*s) < 2e-3);
}
