// Waves in channels: what a sponge sends back.
#include <numbers>

#include "running.hpp"

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
