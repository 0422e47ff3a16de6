// Planes that move: the work of a piston, the momentum of a tank that sways.
#include <array>
#include <cmath>
#include <vector>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double A = 0.005;  // [m]
constexpr double w = 25;     // [rad/s]

/// Water 0.3 x 0.1 m in a tank in the plane.
std::string text(const std::string& boundaries, bool viscous = true) {
  return fmt::format(R"(gannet: 1
title: Walls that move
dimension: 2
let: {{A: {} m, w: {} rad/s}}
materials: {{water: {{card: water, c0: 15 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: 10 mm}}
    fill: {{box: {{from: [0, 0, 0], to: [0.3 m, 0.1 m, 0]}}}}
    start: hydrostatic
boundaries:
{}loads: {{gravity: [0, -9.81 m/s^2, 0]}}
{}output: {{until: 0.5 s}}
)",
                     A, w, boundaries,
                     viscous ? "effects: {viscosity: {type: monaghan, alpha: 0.05}}\n" : "");
}

/// What a level shows, taken where forces and positions belong together.
struct Level {
  double t = 0;
  double dt_mean = 0;  ///< (dt_old + dt)/2
  double p_x = 0;      ///< momentum after the kick
  double scale = 0;    ///< sum m |v|
  double force = 0;    ///< of the water on the planes along x
  double viscous = 0;  ///< its viscous part
};

std::vector<Level> run(Simulation& s, const std::vector<std::string>& planes, double until) {
  std::vector<Level> levels;
  s.models.list.front().plan.add(
      {.name = "look of the test", .stage = Stage::look, .run = [&](const Step& step) {
         Level level{step.t, 0.5 * (step.dt_old + step.dt)};
         const Total p = linear_momentum(s.scene);
         level.p_x = p.sum.x();
         level.scale = p.scale;
         for (const std::string& plane : planes) {
           level.force += measured(s.scene, "plane." + plane + ".force", 0);
           if (s.scene.store.get<SphState>().f_viscous.empty()) continue;
           level.viscous += measured(s.scene, "plane." + plane + ".viscous_force", 0);
         }
         levels.push_back(level);
       }});
  run_until(s, until, [] {});
  return levels;
}

/// A plate of shells that falls by 5 mm on a floor that moves, and water beside it that falls from
/// far above.
std::string block_on(const std::string& motion, const std::string& models) {
  return fmt::format(R"(gannet: 1
materials: {{water: {{density: 1000, c0: 20 m/s}}, steel: {{density: 7800, young: 20 GPa, poisson: 0.3}}}}
parts:
  water: {{sph: {{material: water, spacing: 0.1}}, fill: {{box: {{from: [2, 0, 1], to: [2.4, 0.4, 1.2]}}}}}}
  block: {{shell: {{material: steel, thickness: 20 mm}}, shape: {{plate: {{size: [0.5, 0.5], elements: [8, 8], centre: [0.5, 0, 0.015]}}}}}}
boundaries:
  floor: {{planes: {{z: 0}}, motion: {{{}}}}}
contacts: {{c: {{between: [block, floor]}}}}
{}loads: {{gravity: [0, 0, -9.81]}}
output: {{until: 0.3 s}}
)",
                     motion, models);
}

/// Mean height of the block at its levels [m], to 0.3 s.
std::vector<std::array<double, 2>> heights(Simulation& s) {
  std::vector<std::array<double, 2>> list;
  const Range nodes = s.scene.parts.back().nodes;
  s.models.list.back().plan.add(
      {.name = "look of the test", .stage = Stage::look, .run = [&](const Step& step) {
         double sum = 0;
         for (Index i = nodes.begin; i < nodes.end; ++i) {
           sum += s.scene.nodes.x[static_cast<std::size_t>(i)].z;
         }
         list.push_back({step.t, sum / nodes.size()});
       }});
  run_until(s, 0.3, [] {});
  return list;
}

/// The largest difference of two such series [m].
double largest_difference(const std::vector<std::array<double, 2>>& a,
                          const std::vector<std::array<double, 2>>& b) {
  double most = 0;
  std::size_t k = 1;
  for (const auto& [t, z] : a) {
    while (k + 1 < b.size() && b[k][0] < t) ++k;
    const double share = (t - b[k - 1][0]) / (b[k][0] - b[k - 1][0]);
    most = std::max(most, std::abs(b[k - 1][1] + share * (b[k][1] - b[k - 1][1]) - z));
  }
  return most;
}

}  // namespace

TEST_CASE("piston: the ledger holds the work of its force along its way", "[physics]") {
  const auto s = make_simulation_of_text(
      text("  piston: {planes: {x: 0}, motion: {velocity: [\"A*w*sin(w*t)\", 0, 0]}}\n"
           "  end: {plane: {point: [0.3 m, 0, 0], normal: [-1, 0, 0]}}\n"
           "  floor: {planes: {y: 0}}\n"));
  const auto levels = run(*s, {"piston.x_min"}, 0.5);
  const auto way = [](double t) { return A * (1 - std::cos(w * t)); };
  // Of the piston's pressure and push on the water: what its viscous force does is part of the work
  // of artificial viscosity, which counts the forces of images as well.
  double work = 0;
  double size = 0;
  const auto force = [](const Level& level) { return level.force - level.viscous; };
  for (std::size_t n = 1; n < levels.size(); ++n) {
    const double step = way(levels[n].t) - way(levels[n - 1].t);
    const double here = -0.5 * (force(levels[n]) + force(levels[n - 1])) * step;
    work += here;
    size += std::abs(here);
  }
  const double ledger = ledger_sum(*s, "moving plane") + ledger_sum(*s, "moving mirror");
  const double error = energy_error(*s);
  fmt::print(
      "piston, 0.5 s: work {:.6g} J of {:.6g} J to and fro, ledger {:.6g} J, energy error "
      "{:.2e}\n",
      work, size, ledger, error);
  CHECK(size > 0.01);
  // Push and pressure both take part.
  CHECK(std::abs(ledger_sum(*s, "moving mirror")) > 0.01);
  CHECK(std::abs(ledger_sum(*s, "moving plane")) > 0.01);
  // Both add up the same trapezoids; the way is exact to the rounding of its sum.
  CHECK(ledger == Approx(work).margin(1e-9 * size));
  // 3e-5 here; 6e-4 where the piston only pushes.
  CHECK(error < 1e-4);
}

TEST_CASE("sway: the force on the walls is the change of momentum", "[physics]") {
  const auto s = make_simulation_of_text(
      text("  tank: {planes: {x: [0, 0.3 m], y: 0}, motion: {displacement: [\"A*sin(w*t)\", 0, "
           "0]}}\n",
           false));
  const auto levels = run(*s, {"tank.x_min", "tank.x_max"}, 0.3);
  double worst = 0;
  double moved = 0;
  for (std::size_t n = 1; n < levels.size(); ++n) {
    const double change = levels[n].p_x - levels[n - 1].p_x;
    worst =
        std::max(worst, std::abs(change + levels[n].force * levels[n].dt_mean) / levels[n].scale);
    moved = std::max(moved, std::abs(levels[n].p_x));
  }
  fmt::print("sway, 0.3 s: dP = -F dt to {:.2e} of sum m |v|; largest P {:.3g} kg m/s\n", worst,
             moved);
  // 30 kg that follow A w sin: a good share of 3.75 kg m/s.
  CHECK(moved > 1);
  CHECK(worst < 1e-12);
}

TEST_CASE("roll: a tank that turns keeps its water and its energy", "[physics]") {
  const auto s = make_simulation_of_text(
      text("  tank: {planes: {x: [0, 0.3 m], y: 0}, motion: {rotation: {axis: [0, 0, 1], centre: "
           "[0.15 m, 0, 0], angle: \"0.05*sin(w*t)\"}}}\n"));
  run(*s, {}, 0.3);
  double lowest = 1;
  for_particles(s->scene, [&](std::size_t, const Vec3& x, const Vec3&) {
    for (const Plane& plane : s->scene.planes) {
      lowest = std::min(lowest, plane.normal.dot(x - plane.point));
    }
  });
  fmt::print("roll, 0.3 s: nearest {:.3g} m to a plane, energy error {:.2e}\n", lowest,
             energy_error(*s));
  CHECK(lowest > 0);
  CHECK(energy_error(*s) < 2e-3);
}

TEST_CASE("a block on a rising floor moves as in one model where it is in a faster one",
          "[physics]") {
  for (const char* motion : {"velocity: [0, 0, \"2*t\"]", "displacement: [0, 0, \"t^2\"]"}) {
    const auto one = make_simulation_of_text(block_on(motion, ""));
    const auto two = make_simulation_of_text(
        block_on(motion, "models: {water: {parts: water}, fast: {parts: block}}\n"));
    const auto alone = heights(*one);
    const double apart = largest_difference(alone, heights(*two));
    const double way = alone.back()[1];
    const double put_in = ledger_sum(*two, "moving plane");
    fmt::print(
        "block, floor with {}: {:.3g} apart of {:.3g} m, put in {:.6g} J of {:.6g} J, energy error "
        "{:.2e}, in one model {:.2e}, {} and {} steps\n",
        motion, apart, way, put_in, ledger_sum(*one, "moving plane"), energy_error(*two),
        energy_error(*one), one->models.list.front().step.n, two->models.list.back().step.n);
    CHECK(two->models.list.back().step.n > 4 * two->models.list.front().step.n);
    CHECK(apart < 1e-2 * way);  // 5e-3 after several bounces, each of some other steps
    CHECK(energy_error(*two) < 1e-10);
  }
}
