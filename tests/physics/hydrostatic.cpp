// Water at rest in a tank: the pressure is rho g depth, and stays so.
#include <algorithm>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

struct Tank {
  int n_deep = 30;     ///< particles over the depth
  double width = 0.5;  ///< over the depth
  double alpha = 0.1;  ///< of the artificial viscosity
};

constexpr double depth = 1;
constexpr double g = 9.81;
constexpr double rho0 = 1000;

std::string text(const Tank& tank) {
  return fmt::format(R"(gannet: 1
title: Water at rest
dimension: 2
let: {{H: {} m, W: {} m, dx: {} m}}
materials: {{water: {{card: water, c0: auto}}}}
parts:
  pool:
    sph: {{material: water, spacing: dx}}
    fill: {{box: {{from: [0, 0, 0], to: [W, H, 0]}}}}
    start: hydrostatic
boundaries: {{tank: {{planes: {{x: [0, W], y: 0}}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects: {{viscosity: {{type: monaghan, alpha: {}}}}}
output: {{until: 2 s}}
)",
                     depth, tank.width * depth, depth / tank.n_deep, tank.alpha);
}

/// Kinetic energy over the potential energy rho g H^2/2 W of the water at rest.
double kinetic_ratio(Scene& scene, const Tank& tank) {
  double sum = 0;
  for_particles(scene, [&](std::size_t, const Vec3&, const Vec3& v) { sum += v.squaredNorm(); });
  const double m = scene.store.get<SphState>().m;
  return 0.5 * m * sum / (0.5 * rho0 * g * depth * depth * tank.width * depth);
}

struct Pressures {
  double rms = 0;        ///< of p - rho g depth over all particles, over rho g H
  double worst_bin = 0;  ///< largest |mean of a bin - rho g depth| over rho g H
  int n_bins = 0;
};

/// Bins of depth of one spacing and a half, from 3 h below the surface, 2 h from walls and floor.
Pressures compare(Scene& scene, const Tank& tank) {
  const SphState& sph = scene.store.get<SphState>();
  constexpr double scale = rho0 * g * depth;
  const double bin = 1.5 * sph.dx;
  struct Bin {
    double p = 0;
    double exact = 0;
    int n = 0;
  };
  std::vector<Bin> bins(static_cast<std::size_t>(depth / bin) + 1);
  Pressures out;
  for_particles(scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    const double d = depth - x.y();
    const double error = sph.p[k] - rho0 * g * d;
    out.rms += error * error;
    const bool inner = x.x() > 2 * sph.h && x.x() < tank.width * depth - 2 * sph.h;
    if (!inner || d < 3 * sph.h || x.y() < 2 * sph.h) return;
    Bin& b = bins[static_cast<std::size_t>(d / bin)];
    b.p += sph.p[k];
    b.exact += rho0 * g * d;
    ++b.n;
  });
  out.rms = std::sqrt(out.rms / scene.particles.size()) / scale;
  for (const Bin& b : bins) {
    if (b.n < 3) continue;
    ++out.n_bins;
    out.worst_bin = std::max(out.worst_bin, std::abs(b.p - b.exact) / b.n / scale);
  }
  return out;
}

void check_tank(const Tank& tank) {
  const auto s = make_simulation_of_text(text(tank));
  double half = 0;
  double next = 0;
  std::string course;
  run_until(*s, 2, [&] {
    if (time_of(*s) < next) return;
    const double ratio = kinetic_ratio(s->scene, tank);
    const Pressures p = compare(s->scene, tank);
    course += fmt::format("\n  t {:.2f} s: KE/PE {:.2e}, worst bin {:.4f}, rms {:.4f}", time_of(*s),
                          ratio, p.worst_bin, p.rms);
    if (next > 0.9 && half == 0) half = ratio;
    next += 0.25;
  });
  const Pressures p = compare(s->scene, tank);
  const double end = kinetic_ratio(s->scene, tank);
  WARN(
      fmt::format("{} particles, alpha {}: at {:.2f} s worst of {} bins {:.4f}, rms of p/(rho g H) "
                  "{:.4f}, KE/PE {:.2e}, energy error {:.2e}{}",
                  s->scene.particles.size(), tank.alpha, time_of(*s), p.n_bins, p.worst_bin, p.rms,
                  end, energy_error(*s), course));
  CHECK(p.n_bins >= 5);
  CHECK(p.worst_bin < 0.02);
  CHECK(end < 1e-6);
  CHECK(end < half);  // it settles
}

}  // namespace

TEST_CASE("physics: water in a tank keeps the hydrostatic pressure", "[physics]") {
  check_tank({.n_deep = 30});
}

TEST_CASE("physics: water in a tank keeps the hydrostatic pressure, 10000 particles",
          "[.][physics_long]") {
  check_tank({.n_deep = 100, .width = 1});
}
