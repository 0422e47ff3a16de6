#include <catch2/catch.hpp>
#include <cmath>

#include "kernel/cubic_spline.hpp"
#include "pool.hpp"
#include "sph/ghost_force.hpp"
#include "sph/probe_functions.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

const char* water_card = "materials: {water: {density: 1000, c0: 30 m/s}}\n";

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
  Pool pool(std::string(water_card) +
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

TEST_CASE("probes: water through a plane, the rate and the volume since the start", "[sph]") {
  Pool pool(std::string(water_card) +
            "parts: {drop: {sph: {material: water, spacing: 0.1}, initial_velocity: [1, 0, 0], "
            "fill: {box: {from: [0, 0, 0], to: [0.8, 0.8, 0.8]}}}}\n"
            "boundaries: {sides: {periodic: {x: [0, 0.8]}}}\n"
            "probes: {middle: {flow: {plane: {point: [0.31, 0, 0], normal: [2, 0, 0]}}}, "
            "seam: {flow: {plane: {point: [0.02, 0, 0], normal: [1, 0, 0]}}}, "
            "back: {flow: {plane: {point: [0.31, 0, 0], normal: [-1, 0, 0]}}}}");
  CHECK(measured(pool.scene, "probe.middle")[1] == 0);
  pool.run(300);
  // Layers of 0.064 m^3 follow each other every 0.1 s; the last look was a step ago.
  const double t = pool.at().t - pool.at().dt_old;
  REQUIRE(t > 0.5);
  CHECK(measured(pool.scene, "probe.middle")[0] == Approx(0.64).epsilon(1e-9));
  CHECK(measured(pool.scene, "probe.middle")[1] ==
        Approx(0.064 * (std::floor((t - 0.06) / 0.1) + 1)).epsilon(1e-9));
  CHECK(measured(pool.scene, "probe.back")[1] == -measured(pool.scene, "probe.middle")[1]);
  CHECK(measured(pool.scene, "probe.seam")[1] ==
        Approx(0.064 * (std::floor((t - 0.07) / 0.1) + 1)).epsilon(1e-9));
  CHECK_THROWS_WITH(
      Pool(std::string(water_card) +
           "parts: {drop: {sph: {material: water, spacing: 0.1}, "
           "fill: {box: {from: [0, 0, 0], to: [0.8, 0.8, 0.8]}}}}\n"
           "probes: {q: {flow: {plane: {point: [0, 0, 0], normal: [0, 0, 0]}}}}"),
      Catch::Contains("pool.yaml:4:") && Catch::Contains("a normal needs a length above 0"));
}

TEST_CASE("probes: how far pressures are from a function of place", "[sph]") {
  Pool pool(std::string(water_card) +
                "parts: {pool: {sph: {material: water, spacing: 0.25}, start: hydrostatic, "
                "fill: {box: {from: [0, 0, -1], to: [0.5, 0.5, 0]}}}}\n"
                "probes: {none: {deviation: {part: pool, pressure: \"-1e4*z\"}}, "
                "some: {deviation: {part: pool, pressure: \"-1e4*z - 400*x\"}}, "
                "last: {front: {part: pool}}, edge: {front: {part: pool, edge: yes}}}",
            3, {0, 0, -10});
  CHECK(measured(pool.scene, "probe.none")[1] < 1e-6);
  // x is 0.125 and 0.375 m: 50 and 150 Pa.
  CHECK(measured(pool.scene, "probe.some")[0] == Approx(std::sqrt(12500.0)).epsilon(1e-9));
  CHECK(measured(pool.scene, "probe.some")[1] == Approx(150).epsilon(1e-9));
  CHECK(measured(pool.scene, "probe.last")[0] == Approx(0.375).epsilon(1e-14));
  CHECK(measured(pool.scene, "probe.edge")[0] == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("probes: a gauge finds the same particles as a look at all of them", "[sph]") {
  Pool pool(std::string(water_card) +
                "parts: {pool: {sph: {material: water, spacing: 0.1}, start: hydrostatic, "
                "fill: {box: {from: [0, 0, -1], to: [0.9, 0.8, 0]}, jitter: 0.2}}}",
            3, {0, 0, -10});
  const SphState& sph = pool.sph();
  for (const Vec3& x :
       {Vec3(0.4, 0.3, -0.5), Vec3(0, 0, -1), Vec3(0.45, 0.4, 0.1), Vec3(2, 0, 0)}) {
    double volume = 0;
    double pressure = 0;
    for (Index k = 0; k < pool.scene.particles.size(); ++k) {
      const double r = (pool.x(k) - x).norm();
      if (r >= 2 * sph.h) continue;
      const double VW = sph.m / sph.rho[k] * cubic_spline::W(3, r, sph.h);
      volume += VW;
      pressure += VW * (sph.p[k] + sph.rho[k] * 10 * (pool.x(k).z() - x.z()));
    }
    const ParticleBoxes& boxes = boxes_of(pool.scene);
    CHECK(volume_fraction_at(sph, pool.scene, boxes, x) == Approx(volume).epsilon(1e-14));
    const double expected = volume > 0 ? std::max(pressure / volume, 0.0) : 0.0;
    CHECK(pressure_at(sph, pool.scene, boxes, x) == Approx(expected).epsilon(1e-13));
  }
}

TEST_CASE("probes: gauges see water that has left a periodic domain", "[sph]") {
  Pool pool(std::string(water_card) +
            "parts: {drop: {sph: {material: water, spacing: 0.1}, initial_velocity: [1, 0, 0], "
            "fill: {box: {from: [0, 0, 0], to: [0.8, 0.8, 0.8]}}}}\n"
            "boundaries: {sides: {periodic: {x: [0, 0.8]}}}\n"
            "probes: {top: {surface_height: {at: [0.5, 0.4]}}}");
  const auto fraction = [&](double x) {
    return volume_fraction_at(pool.sph(), pool.scene, boxes_of(pool.scene), {x, 0.4, 0.4});
  };
  pool.run(330);
  REQUIRE(pool.at().t > 0.8);
  for (const double x : {0.0, 0.3, 0.79}) CHECK(fraction(x) == Approx(1).epsilon(2e-2));
  CHECK(measured(pool.scene, "probe.top")[0] == Approx(0.8).epsilon(0.03));
}

TEST_CASE("probes: pressure within, at the surface and at a wall of still water", "[sph]") {
  Pool pool(std::string(water_card) +
                "parts: {pool: {sph: {material: water, spacing: 0.05}, start: hydrostatic, "
                "fill: {box: {from: [0, 0, -1], to: [0.6, 0.6, 0]}}}}",
            3, {0, 0, -10}, [](Scene& scene) {
              scene.planes.push_back({"floor", {0, 0, -1}, Vec3::UnitZ(), {}});
            });
  const auto p = [&](double z) {
    return pressure_at(pool.sph(), pool.scene, boxes_of(pool.scene), {0.3, 0.3, z});
  };
  // B + p loses a few digits, and rho differs from rho0 by a share of 1e-2.
  CHECK(p(-0.5) == Approx(5000).epsilon(1e-3));
  CHECK(p(-0.525) == Approx(5250).epsilon(1e-3));
  CHECK(p(-1) == Approx(1e4).epsilon(1e-3));
  CHECK(p(-0.02) == Approx(200).epsilon(0.02));
  CHECK(std::abs(p(0)) < 5);
  CHECK(p(0.06) == 0);  // above the surface, and not below p0
}

TEST_CASE("probes: a gauge on a thin surface reads its wet side", "[sph]") {
  Pool pool(std::string(water_card) +
            "parts: {pool: {sph: {material: water, spacing: 0.1}, "
            "fill: {box: {from: [-0.4, -0.4, -0.4], to: [0.4, 0.4, 0.4]}}}}");
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    pool.sph().p[k] = pool.x(k).z() > 0 ? 100 : 200;
  }
  WettedPoint at{Vec3::Zero(), Vec3::UnitZ(), 0.05, 1};
  const auto read = [&](double side) {
    at.side = side;
    return pressure_beside(pool.sph(), pool.scene, boxes_of(pool.scene), at);
  };
  CHECK(read(1) == Approx(100).epsilon(1e-14));
  CHECK(read(-1) == Approx(200).epsilon(1e-14));
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    if (pool.x(k).z() > 0) pool.scene.nodes.x[pool.scene.particles.begin + k].z += 3;
  }
  pool.scene.store.get<ParticleBoxes>().fresh = false;
  CHECK(read(0) == Approx(200).epsilon(1e-14));
  CHECK(read(1) == 0);  // dry
}
