#include <catch2/catch.hpp>
#include <cmath>

#include "kernel/cubic_spline.hpp"
#include "pool.hpp"
#include "sph/ghost_force.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

const char* water = "materials: {water: {density: 1000, c0: 30 m/s}}\n";

std::vector<double> measured(const Scene& scene, const std::string& name) {
  for (const Measure& m : scene.measures) {
    if (m.name != name) continue;
    std::vector<double> values(m.components.size());
    m.sample(values.data());
    return values;
  }
  return {};
}

/// Force of all ghosts on the water along z, total and viscous, pair by pair.
std::pair<double, double> by_brute_force(Pool& pool, const Array<Line>& v) {
  const SphState& sph = pool.sph();
  const Scene& scene = pool.scene;
  const auto x = [&](Index k) { return xyz(scene.nodes.x[scene.particles.begin + k]); };
  const Index n = scene.particles.size();
  double total = 0;
  double viscous = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = n; j < n + scene.nodes.n_ghosts; ++j) {
      const Vec3 r = x(i) - x(j);
      if (r.norm() >= 2 * sph.h) continue;
      const double F = cubic_spline::F(3, r.norm(), sph.h);
      const double v_r = std::min(
          0.0, r.dot(xyz(v[scene.particles.begin + i]) - xyz(v[scene.particles.begin + j])));
      const double mu = sph.h * v_r / (r.squaredNorm() + 0.01 * sph.h * sph.h);
      const double Pi = (-sph.terms.alpha * sph.c0 * mu + sph.terms.beta * mu * mu) /
                        (0.5 * (sph.rho[i] + sph.rho[j]));
      const double p = sph.p[i] / (sph.rho[i] * sph.rho[i]) + sph.p[j] / (sph.rho[j] * sph.rho[j]);
      total -= sph.m * sph.m * (p + Pi) * F * r.z();
      viscous -= sph.m * sph.m * Pi * F * r.z();
    }
  }
  return {total, viscous};
}

}  // namespace

TEST_CASE("mirror walls: the force on a wall is that of its images on the water", "[sph]") {
  Pool pool(std::string(water) +
                "parts: {pool: {sph: {material: water, spacing: 0.1}, start: hydrostatic, "
                "fill: {box: {from: [0, 0, -1], to: [0.6, 0.5, 0]}}}}\n"
                "effects: {viscosity: {alpha: 0.1, beta: 0.3}}",
            3, {0, 0, -10}, [](Scene& scene) {
              scene.planes.push_back({"floor", {0, 0, -1}, Vec3::UnitZ(), {}});
              scene.measures.push_back({"plane.floor.force", "N", {"x", "y", "z"}, [](double* to) {
                                          to[0] = to[1] = to[2] = 0;
                                        }});
              for (Line& v : scene.nodes.v) set_xyz(v, {0, 0, -1});
            });
  Array<Line> v;
  int looks = 0;
  pool.plan().add({.name = "look of the test", .stage = Stage::look, .run = [&](const Step&) {
                     const auto [total, viscous] = by_brute_force(pool, v);
                     CHECK(measured(pool.scene, "plane.floor.force")[2] ==
                           Approx(-total).epsilon(1e-11));
                     CHECK(measured(pool.scene, "plane.floor.viscous_force")[2] ==
                           Approx(-viscous).epsilon(1e-11));
                     CHECK(viscous > 10);
                     CHECK(std::abs(total) > 100);
                     ++looks;
                   }});
  for (int k = 0; k < 12; ++k) {
    v = pool.scene.nodes.v;
    pool.run(1);
  }
  CHECK(looks == 12);
  CHECK(pool.sph().n_builds > 1);
}
