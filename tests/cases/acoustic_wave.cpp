// An undamped standing sound wave in a plane periodic box: the scheme in time is neutral.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "../unit/sph/pool.hpp"
#include "kernel/cubic_spline.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

constexpr double mach = 1e-4;  // small: nonlinear change is of order mach^2 a period
constexpr double c0 = 10;

std::string box(double cfl) {
  return "materials: {water: {density: 1000, c0: 10 m/s}}\n"
         "parts: {box: {sph: {material: water, spacing: 0.02, cfl: " +
         std::to_string(cfl) +
         "}, fill: {box: {from: [0, 0, 0], to: [1, 0.2, 0]}}}}\n"
         "boundaries: {sides: {periodic: {x: [0, 1], y: [0, 0.2]}}}\n";
}

/// Amplitude of v = a sin(2 pi x) over the particles where they are, at v's level.
double amplitude(const Pool& pool) {
  double sum = 0;
  const Index n = pool.scene.particles.size();
  for (Index k = 0; k < n; ++k) sum += pool.v(k).x() * std::sin(2 * M_PI * pool.x(k).x());
  return 2 * sum / n;
}

/// Mean square of a[begin, begin + n) under the window sin^2, which leaves out what a window that
/// does not hold a whole number of periods would add.
double windowed_square(const std::vector<double>& a, std::size_t begin, std::size_t n) {
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double w = std::sin(M_PI * (k + 0.5) / n);
    sum += w * w * a[begin + k] * a[begin + k];
  }
  return sum / n;
}

/// Period of this wave on this lattice [s]:
///   omega = c0 |sum_j V F(r_j) x_j sin(k x_j)|,  and of the leapfrog: sin(omega' dt/2) = omega
///   dt/2.
double expected_period(double dt) {
  constexpr double dx = 0.02;
  const double h = usual_smoothing_ratio(KernelType::cubic_spline, 2) * dx;
  double slope = 0;
  for (int j = -3; j <= 3; ++j) {
    for (int i = -3; i <= 3; ++i) {
      const double r = dx * std::hypot(i, j);
      slope += dx * dx * cubic_spline::F(2, r, h) * i * dx * std::sin(2 * M_PI * i * dx);
    }
  }
  const double omega = c0 * std::abs(slope);
  return 2 * M_PI / (2 / dt * std::asin(0.5 * omega * dt));
}

/// Change of the amplitude a period, period and time step [s], over about 40 periods.
struct Wave {
  double growth = 0;
  double period = 0;
  double dt = 0;
};

Wave run(double cfl) {
  Pool pool(box(cfl), 2, Vec3::Zero(), [](Scene& scene) {
    for (Index i = 0; i < scene.nodes.n_owned; ++i) {
      scene.nodes.v[i].x = mach * c0 * std::sin(2 * M_PI * scene.nodes.x[i].x);
    }
  });
  std::vector<double> a;
  std::vector<double> t;  // of the level half a step before: v is there
  while (pool.at().t < 4) {
    pool.run(1);
    a.push_back(amplitude(pool));
    t.push_back(pool.at().t - 0.5 * pool.at().dt_old);
  }
  // The period from the zero crossings, each where a straight line between two steps passes.
  std::vector<double> zeros;
  for (std::size_t k = 1; k < a.size(); ++k) {
    if (a[k] * a[k - 1] >= 0) continue;
    zeros.push_back(t[k - 1] + (t[k] - t[k - 1]) * a[k - 1] / (a[k - 1] - a[k]));
  }
  const double period = 2 * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
  const double dt = t.back() / static_cast<double>(t.size());
  const double steps_a_period = period / dt;
  const auto n = static_cast<std::size_t>(std::lround(10 * steps_a_period));
  const double early = windowed_square(a, 0, n);
  const double late = windowed_square(a, a.size() - n, n);
  const double periods = static_cast<double>(a.size() - n) / steps_a_period;
  return {0.5 * std::log(late / early) / periods, period, dt};
}

}  // namespace

TEST_CASE("undamped sound neither grows nor decays by 1e-4 a period", "[sph][time]") {
  for (const double cfl : {0.3, 0.7, 1.2}) {
    const Wave wave = run(cfl);
    INFO("cfl " << cfl << ": growth " << wave.growth << " a period of " << wave.period << " s");
    CHECK(std::abs(wave.growth) < 1e-4);
    // Crossings by straight lines and Mach number squared leave less than 1e-6.
    CHECK(wave.period == Approx(expected_period(wave.dt)).epsilon(1e-5));
    CHECK(wave.period == Approx(1 / c0).epsilon(0.01));
  }
}
