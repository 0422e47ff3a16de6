// The decay of a Taylor-Green vortex in a periodic square, Re = U L/nu = 100, against
//   u = -U exp(-2 k^2 nu t) cos kx sin ky,  v = U exp(-2 k^2 nu t) sin kx cos ky,  k = 2 pi/L
//   p = -(rho U^2/4) exp(-4 k^2 nu t) (cos 2kx + cos 2ky)
// (Taylor and Green 1937, Proc. R. Soc. Lond. A 158, 499.)
#include <numbers>

#include "physics/running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

using std::numbers::pi;
constexpr double nu = 0.01;  // U = 1 m/s, L = 1 m [m^2/s]

/// n particles across.
std::string vortex(int n, const std::string& effects) {
  return fmt::format(R"yaml(gannet: 1
title: Taylor-Green vortex
dimension: 2
let: {{dx: {:.12g} m}}
materials: {{water: {{density: 1000, c0: 10 m/s}}}}
parts:
  water:
    sph: {{material: water, spacing: dx, smoothing_ratio: 1.3}}
    fill: {{box: {{from: [0, 0, 0], to: [1 m, 1 m, 0]}}}}
    initial_velocity: ["-cos(2*pi*x)*sin(2*pi*y)", "sin(2*pi*x)*cos(2*pi*y)", 0]
    initial_pressure: "-250*(cos(4*pi*x) + cos(4*pi*y))"
boundaries: {{around: {{periodic: {{x: [0, 1 m], y: [0, 1 m]}}}}}}
effects: {{laminar_viscosity: {{mu: 10 Pa*s}}{}}}
output: {{until: 10 s}}
)yaml",
                     1.0 / n, effects);
}

struct TaylorGreenResult {
  double decay_error = 0;  ///< of the rate of decay of kinetic energy, over 4 k^2 nu [-]
  double speed_error = 0;  ///< mean over time of |largest speed - exact|/U [-]
  double v_error = 0;      ///< rms of v - exact at the end over U [-]
  double imbalance = 0;    ///< energy error [-]
};

/// The flow at one time.
struct Look {
  double t = 0, kinetic = 0, top = 0, v_error = 0;
};

/// Kinetic energy over its first, largest speed and rms error, all of v(n-1/2).
Look look_at(const Simulation& s) {
  const Step& step = s.models.list.front().step;
  Look now;
  now.t = step.t - 0.5 * step.dt_old;
  const double decay = std::exp(-8 * pi * pi * nu * now.t);
  for_particles(s.scene, [&](std::size_t, const Vec3& x, const Vec3& v) {
    const Vec3 y = x - 0.5 * step.dt_old * v;
    const double cx = std::cos(2 * pi * y.x()), sx = std::sin(2 * pi * y.x());
    const double cy = std::cos(2 * pi * y.y()), sy = std::sin(2 * pi * y.y());
    now.kinetic += v.squaredNorm();
    now.top = std::max(now.top, v.norm());
    now.v_error += (v - decay * Vec3(-cx * sy, sx * cy, 0)).squaredNorm();
  });
  const double n = s.scene.particles.size();
  now.kinetic /= 0.5 * n;
  now.v_error = std::sqrt(now.v_error / n);
  return now;
}

TaylorGreenResult run(int n, double until, const std::string& effects) {
  const auto s = make_simulation_of_text(vortex(n, effects));
  std::vector<Look> looks;
  run_until(*s, until, [&] { looks.push_back(look_at(*s)); });
  const Look& end = looks.back();
  TaylorGreenResult r;
  r.decay_error = -std::log(end.kinetic) / (16 * pi * pi * nu * end.t) - 1;
  for (const Look& l : looks) {
    r.speed_error += std::abs(l.top - std::exp(-8 * pi * pi * nu * l.t));
  }
  r.speed_error /= static_cast<double>(looks.size());
  r.v_error = end.v_error;
  r.imbalance = energy_error(*s);
  return r;
}

/// Both runs to t = 1 s, when a fifth of the kinetic energy is left, with density diffusion and
/// shifting; returns the order of the rms error of v.
double compare(const std::vector<int>& across, double shifting, std::vector<TaylorGreenResult>& r) {
  const auto effects =
      fmt::format(", density_diffusion: {{delta: 0.1}}, shifting: {{coefficient: {}}}", shifting);
  for (const int n : across) {
    r.push_back(run(n, 1, effects));
    WARN(
        fmt::format("Taylor-Green, {} across, shifting {}: rate of decay {:+.2e}, largest speed "
                    "{:.1e}, rms of v {:.1e} of U; energy error {:.1e}",
                    n, shifting, r.back().decay_error, r.back().speed_error, r.back().v_error,
                    r.back().imbalance));
    CHECK(r.back().imbalance < 1e-2);
  }
  const double refined = std::log(static_cast<double>(across[1]) / across[0]);
  const double order = std::log(r[0].v_error / r[1].v_error) / refined;
  WARN(fmt::format("Taylor-Green, shifting {}: order of v {:.2f}", shifting, order));
  return order;
}

}  // namespace

// Where the flow stretches them, particles gather on lines and the sums lose what the lattice
// gives, which costs more energy than laminar viscosity does. Shifting keeps them spread: 25 across
// it takes a coefficient of 2, from 50 across 1 is enough. What stays is the bias of the viscous
// sum at a fixed h/dx over particles in no order, up to 1 % of the rate. (At the usual h/dx, 1.25,
// 50 across decay 1.4 % too fast, 100 across 0.1 %.)
TEST_CASE("Taylor-Green vortex: decay of the exact solution", "[convergence][sph]") {
  std::vector<TaylorGreenResult> r;
  CHECK(compare({25, 50}, 1, r) > 1.5);
  CHECK(std::abs(r[1].decay_error) < 0.01);
  CHECK(r[1].speed_error < 0.01);
}

TEST_CASE("Taylor-Green vortex: with strong shifting 25 across do", "[convergence][sph]") {
  std::vector<TaylorGreenResult> r;
  CHECK(compare({25, 50}, 2, r) > 0.2);  // down to the bias
  for (const TaylorGreenResult& each : r) {
    CHECK(std::abs(each.decay_error) < 0.01);
    CHECK(each.speed_error < 0.01);
  }
}

TEST_CASE("Taylor-Green vortex: without shifting it is lost", "[convergence][sph]") {
  const TaylorGreenResult r = run(25, 1, "");
  WARN(fmt::format(
      "Taylor-Green, 25 across, no shifting: rate of decay {:+.2e}, largest speed {:.1e}",
      r.decay_error, r.speed_error));
  CHECK(r.speed_error > 0.05);
}

TEST_CASE("Taylor-Green vortex: 100 across", "[.][convergence_long]") {
  std::vector<TaylorGreenResult> r;
  CHECK(compare({50, 100}, 1, r) > 0.5);
  CHECK(std::abs(r[1].decay_error) < 0.01);
  CHECK(r[1].speed_error < 0.005);
}
