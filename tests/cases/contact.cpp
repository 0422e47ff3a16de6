// Water and walls, water and a panel: contact within whole scenes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "app/simulation.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

double measure(const Scene& scene, const std::string& name, int component) {
  for (const Measure& m : scene.measures) {
    if (m.name != name) continue;
    double value[3] = {0, 0, 0};
    m.sample(value);
    return value[component];
  }
  FAIL("no measure " << name);
  return 0;
}

/// Lowest coordinate of all particles along an axis.
double lowest(const Scene& scene, int axis) {
  double least = 1e300;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    least = std::min(least, xyz(scene.nodes.x[static_cast<std::size_t>(i)])[axis]);
  }
  return least;
}

double top_speed(const Scene& scene) {
  double most = 0;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    most = std::max(most, xyz(scene.nodes.v[static_cast<std::size_t>(i)]).norm());
  }
  return most;
}

double rms_speed(const Scene& scene) {
  double sum = 0;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    sum += xyz(scene.nodes.v[static_cast<std::size_t>(i)]).squaredNorm();
  }
  return std::sqrt(sum / scene.particles.size());
}

/// Energy held less work put in [J].
double balance(const Models& models) { return models.ledger.held() - models.ledger.external(); }

/// Total momentum and the sum of its sizes, all nodes.
struct Momentum {
  Vec3 sum = Vec3::Zero();
  double scale = 0;
};

Momentum momentum(const Scene& scene) {
  Momentum p;
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 mv = scene.nodes.x[k].w * xyz(scene.nodes.v[k]);
    p.sum += mv;
    p.scale += mv.norm();
  }
  return p;
}

}  // namespace

TEST_CASE("contact case: walls hold a column of water at rest", "[contact][cases]") {
  const auto s = make_simulation_of_text(R"(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [0, 0, 0], to: [0.4 m, 0.5 m, 0]}}
    start: hydrostatic
boundaries: {tank: {planes: {x: [0, 0.4 m], y: 0}}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {type: monaghan, alpha: 0.2}}
output: {until: 10 s}
)");
  Models& models = s->models;
  double force = 0;
  double time = 0;
  while (models.list.front().step.t < 1.5) {
    advance(models);
    const Step& step = models.list.front().step;
    if (step.t < 0.5) continue;
    force += measure(s->scene, "plane.tank.y_min.force", 1) * step.dt_old;
    time += step.dt_old;
  }
  // The floor carries the weight, rho g A = 1962 N: mean of a second.
  CHECK(-force / time == Approx(1962).epsilon(0.01));
  // k = rho c0^2: the pressure of 0.5 m presses the lowest layer in by g H dx/c0^2 = 0.005 dx.
  CHECK(lowest(s->scene, 1) > 0.4 * 20e-3);
  CHECK(lowest(s->scene, 0) > 0.3 * 20e-3);
  // Rows of the lattice still slip into closer packings now and then; at large it rests.
  CHECK(rms_speed(s->scene) < 0.05 * std::sqrt(9.81 * 0.5));
}

TEST_CASE("contact case: a floor survives water that falls at half the speed of sound",
          "[contact][cases]") {
  const auto s = make_simulation_of_text(R"(gannet: 1
materials: {water: {density: 1000, c0: 20 m/s}}
parts:
  block:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [0, 0, 5 mm], to: [0.2 m, 0.2 m, 0.205 m]}}
    initial_velocity: [0, 0, -10 m/s]
boundaries: {floor: {planes: {z: 0}}}
effects: {viscosity: {type: monaghan, alpha: 0.5}}
output: {until: 10 s}
)");
  Models& models = s->models;
  double deepest = 0;
  double first = 0;
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    advance(models);
    deepest = std::min(deepest, lowest(s->scene, 2));
    if (i == 0) first = balance(models);
    worst = std::max(worst, std::abs(balance(models) - first));
  }
  CHECK(std::isfinite(top_speed(s->scene)));
  CHECK(top_speed(s->scene) < 4 * 10);
  CHECK(deepest > -1.5 * 20e-3);
  CHECK(worst < 0.05 * first);
  UNSCOPED_INFO("deepest " << deepest << ", energy " << worst / first);
  CHECK(lowest(s->scene, 2) > -0.5 * 20e-3);
}

TEST_CASE("contact case: free flight of panel and water keeps its momentum", "[contact][cases]") {
  const auto s = make_simulation_of_text(R"(gannet: 1
materials:
  water: {density: 1000, c0: 60 m/s}
  skin: {density: 2700, young: 70 GPa, poisson: 0.3}
parts:
  blob:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [0, 0, -0.2 m], to: [0.2 m, 0.2 m, 0]}}
  panel:
    shell: {material: skin, thickness: 4 mm, points: 3}
    shape: {plate: {size: [240 mm, 240 mm], elements: [8, 8], tilt: 10 deg, lowest_point: [0.1 m, 0.1 m, 1 mm]}}
    initial_velocity: [1 m/s, 0, -4 m/s]
contacts: {slam: {between: [blob, panel]}}
effects: {viscosity: {type: monaghan, alpha: 0.1}}
output: {until: 10 s}
)");
  Models& models = s->models;
  advance(models);
  const Momentum before = momentum(s->scene);
  int active = 0;
  double worst = 0;
  for (int i = 0; i < 6000 && active < 1500; ++i) {
    advance(models);
    active += measure(s->scene, "contact.slam.active", 0) > 0 ? 1 : 0;
    worst = std::max(worst, (momentum(s->scene).sum - before.sum).norm());
  }
  CHECK(active >= 1000);
  CHECK(worst < 1e-12 * before.scale);
}
