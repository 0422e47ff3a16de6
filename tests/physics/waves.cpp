// Waves in channels: what a sponge sends back, how a tank is brought to rest, whether waves from a
// field of waves go on as they began.
#include <numbers>

#include "running.hpp"
#include "sph/neighbour_lists.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A pulse of sound, p = P q exp(-q^2), q = (x - 1)/0.2, with u = p/(rho c0), on its way to x = 4
/// m, where a mirror stands. Its mean is zero: a sponge damps motion and keeps what is compressed.
std::string pulse(const std::string& sponge, double cfl) {
  return fmt::format(R"yaml(gannet: 1
dimension: 2
let: {{dx: 20 mm, c0: 10, P: 1}}
materials: {{water: {{density: 1000, c0: 10 m/s}}}}
parts:
  channel:
    sph: {{material: water, spacing: dx, cfl: {}}}
    fill: {{box: {{from: [0, 0, 0], to: [4 m, 0.2 m, 0]}}}}
    initial_pressure: "P*(x - 1)/0.2*exp(-((x - 1)/0.2)^2)"
    initial_velocity: ["P/(1000*c0)*(x - 1)/0.2*exp(-((x - 1)/0.2)^2)", 0, 0]
boundaries:
  sides: {{periodic: {{y: [0, 0.2 m]}}}}
  ends: {{planes: {{x: [0, 4 m]}}}}
{}
probes: {{gauge: {{pressure: {{at: [2 m, 0.1 m, 0]}}}}}}
output: {{until: 1 s}}
)yaml",
                     cfl, sponge);
}

struct Passing {
  double there = 0;  ///< largest |p| at x = 2 m before 0.2 s, while the pulse goes by [Pa]
  double back = 0;   ///< from 0.4 s on, when it would be back [Pa]
  double imbalance = 0;
  double taken = 0;  ///< by the sponge, of all energy at the start [-]
};

Passing run_pulse(const std::string& sponge, double cfl = 0.7) {
  const auto s = make_simulation_of_text(pulse(sponge, cfl));
  Passing result;
  double first = 0;
  run_until(*s, 0.6, [&] {
    if (first == 0) first = ledger_sum(*s, "kinetic") + ledger_sum(*s, "internal");
    const double p = std::abs(measured(s->scene, "probe.gauge"));
    // The crest is at 2 m at 0.1 s, and there again at 0.5 s.
    if (time_of(*s) < 0.2) result.there = std::max(result.there, p);
    if (time_of(*s) > 0.4) result.back = std::max(result.back, p);
  });
  result.imbalance = energy_error(*s);
  result.taken = ledger_sum(*s, "sponge") / first;
  return result;
}

}  // namespace

namespace {

/// Particles out of order at the start, all at p0, that settle.
constexpr const char* jittered = R"yaml(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 20 mm, kernel: quintic_spline}
    fill: {box: {from: [0, 0, 0], to: [0.4 m, 0.6 m, 0]}}
boundaries: {tank: {planes: {x: [0, 0.4 m], y: 0}}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects:
  viscosity: {alpha: 0.05}
  density_diffusion: {delta: 0.1}
  relaxation: {rate: 80 1/s, until: 5 s, motion: 1e-4}
output: {until: 5 s}
)yaml";

double kinetic(Scene& scene) {
  double sum = 0;
  for_particles(scene, [&](std::size_t, const Vec3&, const Vec3& v) { sum += v.squaredNorm(); });
  return 0.5 * scene.store.get<SphState>().m * sum;
}

}  // namespace

TEST_CASE("relaxation brings a jittered tank to rest under its own weight", "[physics]") {
  const auto s = make_simulation_of_text(jittered);
  Scene& scene = s->scene;
  // Half of a golden ratio's rests: a spread without a pattern, up to 0.15 dx along each axis.
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const double a = std::fmod(0.6180339887 * i, 1.0) - 0.5;
    const double b = std::fmod(0.7548776662 * i, 1.0) - 0.5;
    Line& x = scene.nodes.x[i];
    // Walls would store energy in what is nearer than half a spacing.
    if (x.x < 0.02 || x.x > 0.38 || x.y < 0.02) continue;
    x.x += 0.3 * 0.02 * a;
    x.y += 0.3 * 0.02 * b;
  }
  rebuild_lists(scene.store.get<SphState>(), scene);
  double ended = 0;
  double largest = 0;
  double taken = 0;
  run_until(*s, 2, [&] {
    largest = std::max(largest, kinetic(scene));
    const double now = ledger_sum(*s, "relaxation");
    if (now != taken) ended = time_of(*s);
    taken = now;
  });
  // p = rho g depth, a layer at a time.
  const SphState& sph = scene.store.get<SphState>();
  double error = 0;
  int n = 0;
  double top = 0;
  for_particles(scene,
                [&](std::size_t, const Vec3& x, const Vec3&) { top = std::max(top, x.y()); });
  for_particles(scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    if (x.y() < 0.1 || x.y() > 0.5) return;
    const double e = sph.p[k] - 1000 * 9.81 * (top + 0.01 - x.y());
    error += e * e;
    ++n;
  });
  const double rms = std::sqrt(error / n) / (1000 * 9.81 * 0.6);
  fmt::print(
      "jittered tank: phase over after {:.3f} s, kinetic {:.1e} of its largest; pressure rms "
      "{:.4f} of rho g H; taken {:.3f} J, imbalance {:.1e}\n",
      ended, kinetic(scene) / largest, rms, taken, energy_error(*s));
  CHECK(ended < 1.5);
  CHECK(kinetic(scene) < 3e-3 * largest);  // 1e-4 when the phase ends; then it is free
  CHECK(rms < 0.03);
  CHECK(taken > 0.5 * largest);
  CHECK(energy_error(*s) < 2e-3);
}

TEST_CASE("a sponge swallows a pulse of sound", "[physics]") {
  const std::string beach =
      "  beach: {sponge: {box: {from: [2.2 m, -9, 0], to: [9 m, 9 m, 0]}, ramp: 1.8 m, "
      "length: 0.35 m, speed: 10 m/s}}";
  const Passing free = run_pulse("");
  const Passing damped = run_pulse(beach);
  const Passing fine = run_pulse(beach, 0.35);
  fmt::print(
      "pulse of sound: comes back {:.3f} without sponge, {:.4f} with; energy taken {:.4f}, "
      "imbalance {:.1e}, {:.1e} with half the step\n",
      free.back / free.there, damped.back / damped.there, damped.taken, damped.imbalance,
      fine.imbalance);
  CHECK(free.back > 0.9 * free.there);
  CHECK(damped.back < 0.05 * damped.there);
  CHECK(damped.taken == Approx(1).margin(0.02));
  // What the leapfrog lets swing, of order 2.
  CHECK(damped.imbalance < 4e-3);
  CHECK(fine.imbalance < 0.4 * damped.imbalance);
}

namespace {

/// One wave of 1 m in water that repeats; `floor` is what stands below.
std::string travelling(double bottom, const std::string& sea, const std::string& floor) {
  return fmt::format(R"yaml(gannet: 1
dimension: 2
let: {{dx: 20 mm}}
materials: {{water: {{density: 1000, c0: 16 m/s}}}}
parts:
  water:
    sph: {{material: water, spacing: dx, kernel: quintic_spline}}
    fill: {{box: {{from: [0, {} m, 0], to: [1 m, 0, 0]}}}}
    start: waves
{}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
sea: {}
effects: {{viscosity: {{alpha: 0.002}}, density_diffusion: {{delta: 0.1}}}}
output: {{until: 10 s}}
)yaml",
                     bottom, floor, sea);
}

struct Travel {
  double height = 0;  ///< at the end over that at the start [-]
  double speed = 0;   ///< of the phase [m/s]
  double imbalance = 0;
};

/// Size and phase of the wave by the mean of v_y exp(i k x) over the water.
Travel travel(const std::string& text, double until) {
  const auto s = make_simulation_of_text(text);
  const double k = 2 * std::numbers::pi;
  double first = 0;
  double first_time = 0;
  double phase = 0;
  double last = 0;
  Travel out;
  const auto look = [&] {
    double re = 0;
    double im = 0;
    for_particles(s->scene, [&](std::size_t n, const Vec3& x, const Vec3& v) {
      if (s->scene.particle_part[n] != s->scene.part_number("water")) return;
      re += v.y() * std::sin(k * x.x());
      im += v.y() * std::cos(k * x.x());
    });
    const double size = std::hypot(re, im);
    const double angle = std::atan2(-im, re);  // v_y ~ sin(k x - angle)
    if (first == 0) {
      first = size;
      first_time = time_of(*s);
    } else {
      phase += std::remainder(angle - last, 2 * std::numbers::pi);
      out.speed = phase / k / (time_of(*s) - first_time);
    }
    last = angle;
    out.height = size / first;
  };
  run_until(*s, until, look);
  out.imbalance = energy_error(*s);
  return out;
}

}  // namespace

TEST_CASE("a linear wave goes on with its height and speed", "[physics]") {
  const double k = 2 * std::numbers::pi;
  // Three periods over a flat floor at the depth of the sea.
  const double flat = std::sqrt(9.81 / k * std::tanh(0.5 * k));
  const Travel one =
      travel(travelling(-0.5, "{depth: 0.5 m, wave: {height: 20 mm, length: 1 m}}",
                        "boundaries: {b: {periodic: {x: [0, 1 m]}}, floor: {planes: {y: -0.5 m}}}"),
             3 / flat);
  fmt::print(
      "wave over a flat floor: height {:.4f}, speed {:.4f} of {:.4f} m/s after 3 periods, "
      "imbalance {:.1e}\n",
      one.height, one.speed / flat, flat, one.imbalance);
  CHECK(one.height == Approx(1).margin(0.05));
  CHECK(one.speed == Approx(flat).epsilon(0.02));
  CHECK(one.imbalance < 2e-3);
  // Deeper sea, of which 0.3 m are filled, over a floor that moves with the waves; at rest, and on
  // a current against them.
  const double deep = std::sqrt(9.81 / k * std::tanh(2 * k));
  for (const double current : {0.0, -0.4}) {
    const std::string sea = fmt::format(
        "{{depth: 2 m, current: [{} m/s, 0, 0], wave: {{height: 20 mm, length: 1 m}}}}", current);
    const Travel two = travel(
        travelling(-0.3, sea,
                   "  bed:\n    wall: {motion: waves}\n    fill: {box: {from: [0, -0.38 m, 0], to: "
                   "[1 m, -0.3 m, 0]}}\nboundaries: {b: {periodic: {x: [0, 1 m]}}}"),
        3 / deep);
    fmt::print(
        "wave over a floor that moves, current {} m/s: height {:.4f}, speed {:.4f} m/s "
        "for {:.4f} after 3 periods, imbalance {:.1e}\n",
        current, two.height, two.speed, deep + current, two.imbalance);
    CHECK(two.height == Approx(1).margin(0.05));
    CHECK(two.speed - current == Approx(deep).epsilon(0.02));
    CHECK(two.imbalance < 2e-3);
  }
}

// The case of 4 waves over 10 periods in short: one of its waves, three periods, its coarse
// spacing.
TEST_CASE("the case of travelling waves, in short: height, phase and mean at the gauge",
          "[physics]") {
  const auto s =
      make_simulation("cases/travelling_waves/case.yaml", {"let.n=1", "let.dx=filled/7"});
  constexpr double pi = std::numbers::pi;
  constexpr double period = 15.29;
  double next = 2 * period;  // the third period is read, 60 times
  double mean = 0;
  double in_phase = 0;
  double ahead = 0;
  constexpr int n = 60;
  run_until(*s, 3 * period, [&] {
    const double t = time_of(*s);
    if (t < next) return;
    next += period / n;
    const double eta = measured(s->scene, "probe.gauge");
    mean += eta / n;
    in_phase += 2 * eta * std::cos(2 * pi * t / period) / n;
    ahead -= 2 * eta * std::sin(2 * pi * t / period) / n;
  });
  const double height = std::hypot(in_phase, ahead) / 3.9;
  const double phase = std::atan2(ahead, in_phase);
  fmt::print("travelling waves in short: height {:.3f}, {:.3f} rad ahead, mean {:.2f} m\n", height,
             phase, mean);
  CHECK(height == Approx(1).margin(0.05));
  CHECK(std::abs(phase) < 0.1);
  CHECK(std::abs(mean) < 0.1 * 55 / 7);  // a tenth of a spacing
}
