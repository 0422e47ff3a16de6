// A standing sound wave in a periodic box: frequency and amplitude against p = P cos(k x) cos(k c0
// t).
#include <numbers>

#include "physics/running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

using std::numbers::pi;
constexpr double c0 = 10;             // [m/s]
constexpr double rho_at_rest = 1000;  // [kg/m^3]
constexpr double P = 1;               // 1e-5 of rho_at_rest c0^2: no steepening [Pa]
constexpr double k = 2 * pi;          // one wave over the length of 1 m [1/m]

/// n particles a wave.
std::string column(int n, const std::string& sph, const std::string& effects) {
  return fmt::format(R"yaml(gannet: 1
title: Standing sound wave
dimension: 2
let: {{dx: {} m}}
materials: {{water: {{density: 1000, c0: 10 m/s}}}}
parts:
  column:
    sph: {{material: water, spacing: dx{}}}
    fill: {{box: {{from: [0, 0, 0], to: [1 m, {} m, 0]}}}}
    initial_pressure: "cos(2*pi*x)"
boundaries: {{around: {{periodic: {{x: [0, 1 m], y: [0, {} m]}}}}}}
effects: {{{}}}
output: {{until: 10 s}}
)yaml",
                     1.0 / n, sph, 10.0 / n, 10.0 / n, effects);
}

/// Amplitude of the wave's pressure [Pa], twice the mean of p cos(k x) over the particles.
double wave_of(Scene& scene) {
  const SphState& sph = scene.store.get<SphState>();
  double sum = 0;
  for_particles(scene, [&](std::size_t i, const Vec3& x, const Vec3&) {
    sum += sph.p[i] * std::cos(k * x.x());
  });
  return 2 * sum / scene.particles.size();
}

struct SoundWaveResult {
  double frequency_error = 0;  ///< measured over c0/L, less 1 [-]
  double loss_per_period = 0;  ///< of amplitude [-]
  double imbalance = 0;        ///< energy error [-]
};

/// Ten periods. The frequency is that of the times when the wave passes zero. The size of its
/// crests, by a parabola through the three largest values, is fitted with a straight line.
SoundWaveResult run(int n, const std::string& sph, const std::string& effects) {
  const auto s = make_simulation_of_text(column(n, sph, effects));
  std::vector<double> t, a, zeros, crest_times, crests;
  run_until(*s, 10.1 * 2 * pi / (k * c0), [&] {
    const std::size_t m = a.size();
    t.push_back(time_of(*s));
    a.push_back(wave_of(s->scene));
    if (m >= 1 && a[m - 1] * a[m] < 0) {
      zeros.push_back(t[m - 1] + (t[m] - t[m - 1]) * a[m - 1] / (a[m - 1] - a[m]));
    }
    if (m < 2) return;
    const double l = std::abs(a[m - 2]), c = std::abs(a[m - 1]), r = std::abs(a[m]);
    if (c <= l || c < r) return;
    crest_times.push_back(t[m - 1]);
    crests.push_back(c + (l - r) * (l - r) / (8 * (2 * c - l - r)));
  });
  REQUIRE(zeros.size() >= 19);
  REQUIRE(crests.size() >= 18);
  SoundWaveResult result;
  const double f = 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
  result.frequency_error = f * 2 * pi / (k * c0) - 1;
  double tt = 0, ta = 0, t_mean = 0, a_mean = 0;
  const auto count = static_cast<double>(crests.size());
  for (std::size_t i = 0; i < crests.size(); ++i) {
    t_mean += crest_times[i] / count;
    a_mean += crests[i] / count;
  }
  for (std::size_t i = 0; i < crests.size(); ++i) {
    tt += (crest_times[i] - t_mean) * (crest_times[i] - t_mean);
    ta += (crest_times[i] - t_mean) * (crests[i] - a_mean);
  }
  result.loss_per_period = -ta / tt * 2 * pi / (k * c0) / P;
  return result;
}

/// Three resolutions, whose frequencies differ from the exact one by e0 + C h^order.
struct Series {
  double e0 = 0, order = 0;
  SoundWaveResult finest;
};

Series series(const std::string& sph, const std::string& effects) {
  const SoundWaveResult r[3] = {run(16, sph, effects), run(32, sph, effects),
                                run(64, sph, effects)};
  const double e[3] = {r[0].frequency_error, r[1].frequency_error, r[2].frequency_error};
  const double ratio = (e[0] - e[1]) / (e[1] - e[2]);
  const Series all{e[2] - (e[1] - e[2]) / (ratio - 1), std::log2(ratio), r[2]};
  WARN(fmt::format(
      "sound wave{} {}: frequency {:+.2e}, {:+.2e}, {:+.2e} with 16, 32, 64 a wave, order {:.2f} "
      "to {:+.2e}; amplitude lost a period {:+.1e}, {:+.1e}, {:+.1e}",
      sph, effects, e[0], e[1], e[2], all.order, all.e0, r[0].loss_per_period, r[1].loss_per_period,
      r[2].loss_per_period));
  return all;
}

/// A kernel and its h/dx where a case does not say.
struct Kernel {
  const char* kernel;
  KernelType type;
};

/// Sum of V F x^2 over a square lattice in the plane, less -1: what the lattice leaves of the
/// divergence and of the pressure gradient, however small h is.
double lattice_bias(const Kernel& c) {
  const SmoothingKernel kernel{c.type, 2, usual_smoothing_ratio(c.type, 2)};
  double sum = 0;
  for (int i = -6; i <= 6; ++i) {
    for (int j = -6; j <= 6; ++j) sum -= kernel.F(std::hypot(i, j)) * i * i;
  }
  return sum - 1;
}

const std::vector<Kernel> choices = {{"cubic_spline", KernelType::cubic_spline},
                                     {"wendland_c2", KernelType::wendland_c2},
                                     {"wendland_c4", KernelType::wendland_c4},
                                     {"quintic_spline", KernelType::quintic_spline}};

}  // namespace

// Sound takes the factor 1 + bias once from the divergence and once from the gradient, in c^2: the
// frequency tends to (1 + bias) c0/L and comes to it with h^2.
TEST_CASE("sound wave: frequency of order 2, no damping", "[convergence][sph]") {
  for (const Kernel& c : choices) {
    const Series plain = series(fmt::format(", kernel: {}", c.kernel), "");
    const double bias = lattice_bias(c);
    WARN(fmt::format("{}: bias of the sums over a lattice {:+.2e}", c.kernel, bias));
    CHECK(plain.order == Approx(2).margin(0.1));
    CHECK(plain.e0 == Approx(bias).margin(1e-4));
    CHECK(std::abs(plain.finest.frequency_error) < 0.01);
    CHECK(std::abs(plain.finest.loss_per_period) < 1e-6);  // the scheme is neutral
  }
}

TEST_CASE("sound wave: corrected gradients take the bias away", "[convergence][sph]") {
  for (const char* kernel : {"cubic_spline", "wendland_c2"}) {
    const Series corrected = series(fmt::format(", kernel: {}", kernel), "corrected_gradients: on");
    CHECK(corrected.order == Approx(2).margin(0.1));
    CHECK(std::abs(corrected.e0) < 1e-4);
    CHECK(std::abs(corrected.finest.loss_per_period) < 1e-6);
  }
}
