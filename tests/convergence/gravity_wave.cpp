// A standing gravity wave in deep water with a large viscosity: period and decay against
//   eta = A sin(w t) cos(k x) exp(-2 nu k^2 t),  w^2 = g k tanh(k H)
// (Lamb 1932, Hydrodynamics, sections 228 and 348).
#include <numbers>

#include "physics/running.hpp"
#include "support/gravity.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

using std::numbers::pi;
constexpr double wave_nu = 0.01;  // [m^2/s]
using test::g;

/// n particles over the length of 1 m, half a wave, and over the depth.
std::string tank(int n, const char* form) {
  return fmt::format(R"yaml(gannet: 1
title: Standing wave
dimension: 2
let: {{A: 20 mm, k: pi, w: "sqrt(9.81*k*tanh(k))", U: "A*9.81*k/w/cosh(k)"}}
materials: {{water: {{density: 1000, c0: 45 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: {} m, kernel: quintic_spline}}
    fill: {{box: {{from: [0, 0, 0], to: [1 m, 1 m, 0]}}}}
    start: hydrostatic
    initial_velocity: ["-U*cosh(k*y)*sin(k*x)", "U*sinh(k*y)*cos(k*x)", 0]
boundaries: {{tank: {{planes: {{x: [0, 1 m], y: 0}}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects: {{laminar_viscosity: {{mu: {} Pa*s, form: {}}}}}
output: {{until: 10 s}}
)yaml",
                     1.0 / n, 1000 * wave_nu, form);
}

struct Wave {
  double period = 0;  ///< [s]
  double decay = 0;   ///< of the amplitude [1/s]
};

/// What moves like the wave: sum m v_y cosh(k y) cos(k x), which is as the wave's velocity. Its
/// zeros give the period, its crests by parabolas the decay.
Wave run(int n, const char* form, double until) {
  const auto s = make_simulation_of_text(tank(n, form));
  std::vector<double> t, a, zeros, crest_t, crest_log;
  run_until(*s, until, [&] {
    double sum = 0;
    for_particles(s->scene, [&](std::size_t, const Vec3& x, const Vec3& v) {
      sum += v.y() * std::cosh(pi * x.y()) * std::cos(pi * x.x());
    });
    t.push_back(time_of(*s));
    a.push_back(sum);
    const std::size_t m = a.size() - 1;
    if (m >= 1 && a[m - 1] * a[m] < 0) {
      zeros.push_back(t[m - 1] + (t[m] - t[m - 1]) * a[m - 1] / (a[m - 1] - a[m]));
    }
  });
  Wave wave;
  REQUIRE(zeros.size() >= 3);
  wave.period = 2 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
  std::size_t k = 0;
  for (std::size_t z = 0; z + 1 < zeros.size(); ++z) {
    double most = 0, when = 0;
    for (; k < t.size() && t[k] < zeros[z + 1]; ++k) {
      if (t[k] < zeros[z] || std::abs(a[k]) <= most) continue;
      most = std::abs(a[k]);
      when = t[k];
    }
    crest_t.push_back(when);
    crest_log.push_back(std::log(most));
  }
  wave.decay = (crest_log.front() - crest_log.back()) / (crest_t.back() - crest_t.front());
  return wave;
}

const double period = 2 * pi / std::sqrt(g * pi * std::tanh(pi));
constexpr double decay = 2 * wave_nu * pi * pi;

}  // namespace

TEST_CASE("gravity wave: period and decay of a standing wave", "[convergence][sph]") {
  std::vector<double> error;
  for (const int n : {16, 32}) {
    const Wave wave = run(n, "central", 2.6);
    error.push_back(wave.decay / decay - 1);
    WARN(fmt::format("standing wave, {} a half wave: period {:+.2f} %, decay {:+.1f} %", n,
                     100 * (wave.period / period - 1), 100 * error.back()));
    CHECK(wave.period == Approx(period).epsilon(0.01));
  }
  WARN(fmt::format("standing wave: order of the decay {:.2f}", std::log2(error[0] / error[1])));
  CHECK(std::abs(error[1]) < 0.1);
  CHECK(std::log2(error[0] / error[1]) > 1);
}

// Along v_ij the sum dissipates mu |grad v|^2, in potential flow half of 2 mu e : e.
TEST_CASE("gravity wave: with the Laplacian form it decays too slowly", "[convergence][sph]") {
  const Wave wave = run(24, "laplacian", 2.6);
  WARN(fmt::format("standing wave, Laplacian form: decay {:+.1f} %",
                   100 * (wave.decay / decay - 1)));
  CHECK(wave.decay < 0.65 * decay);
}
