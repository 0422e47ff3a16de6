// The effects of the pair passes in whole runs: what they keep, and what they leave alone.
#include <algorithm>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A square of water that shears and rotates in free space.
std::string drop(const std::string& sph, const std::string& effects) {
  return fmt::format(R"(gannet: 1
dimension: 2
materials: {{water: {{density: 1000, c0: 30 m/s}}}}
parts:
  drop:
    sph: {{material: water, spacing: 10 mm{}}}
    fill: {{box: {{from: [-0.15 m, -0.15 m, 0], to: [0.15 m, 0.15 m, 0]}}}}
effects: {{{}}}
output: {{until: 1 s}}
)",
                     sph, effects);
}

/// v = (a sin(2 y/L), -b x/L), which stretches and turns the drop.
std::unique_ptr<Simulation> moving_drop(const std::string& sph, const std::string& effects) {
  auto s = make_simulation_of_text(drop(sph, effects));
  Scene& scene = s->scene;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Line& x = scene.nodes.x[k];
    scene.nodes.v[k].x = 1.5 * std::sin(20 * x.y) + 0.3;
    scene.nodes.v[k].y = -4 * x.x;
  }
  return s;
}

/// Water at rest in a tank, started with the hydrostatic pressure.
std::unique_ptr<Simulation> tank(const std::string& effects) {
  return make_simulation_of_text(fmt::format(R"(gannet: 1
dimension: 2
materials: {{water: {{card: water}}}}
parts:
  pool:
    sph: {{material: water, spacing: 25 mm}}
    fill: {{box: {{from: [0, 0, 0], to: [0.5 m, 1 m, 0]}}}}
    start: hydrostatic
boundaries: {{tank: {{planes: {{x: [0, 0.5 m], y: 0}}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects: {{{}}}
output: {{until: 1 s}}
)",
                                             effects));
}

double front_of_dam(const std::vector<std::string>& set, double* error) {
  std::vector<std::string> all{"let.dx=a/20", "output.vtk=never", "output.history=never"};
  all.insert(all.end(), set.begin(), set.end());
  const auto s = make_simulation("cases/dam_break_2d/case.yaml", all);
  run_until(*s, 0.1, [] {});
  *error = energy_error(*s);
  return measured(s->scene, "probe.front");
}

}  // namespace

TEST_CASE("particle terms: pairs keep linear momentum to rounding", "[physics]") {
  const auto s =
      moving_drop(", kernel: wendland_c2",
                  "viscosity: {alpha: 0.05, beta: 0.1}, laminar_viscosity: {mu: 2 Pa*s}, "
                  "tensile_cure: {epsilon: 0.2}, density_diffusion: {delta: 0.1}, "
                  "xsph: {epsilon: 0.3}");
  const Total before = linear_momentum(s->scene);
  for (int k = 0; k < 400; ++k) advance(s->models);
  const Total after = linear_momentum(s->scene);
  CHECK((after.sum - before.sum).norm() < 1e-12 * before.scale);
  CHECK(ledger_sum(*s, "laminar_viscosity") > 0);
  CHECK(ledger_sum(*s, "artificial_viscosity") > 0);
  WARN(fmt::format("momentum {:.1e} of its scale, energy error {:.1e}",
                   (after.sum - before.sum).norm() / before.scale, energy_error(*s)));
  CHECK(energy_error(*s) < 2e-3);
}

TEST_CASE("particle terms: density diffusion leaves water at rest alone", "[physics]") {
  const auto s = tank("density_diffusion: {delta: 0.1}");
  advance(s->models);
  const SphState& sph = s->scene.store.get<SphState>();
  const auto [low, high] = std::minmax_element(sph.rho.begin(), sph.rho.end());
  // Without the hydrostatic part taken off, densities over 2 h at the surface would differ by
  // about 2 h/H of all of it, and flow at 2 delta c0/h of that a second.
  const double naive = 2 * 0.1 * sph.c0 / sph.h * (*high - *low) * 2 * sph.h;
  double most = 0;
  for (const double d : sph.drho_diffusion) most = std::max(most, std::abs(d));
  WARN(fmt::format("largest rate {:.2e}, without gravity {:.2e} kg/(m^3 s)", most, naive));
  CHECK(most < 0.01 * naive);
  CHECK(most > 0);  // it is there: the start is hydrostatic to first order only
}

TEST_CASE("particle terms: the free surface of a square is its rim", "[physics]") {
  const auto s = make_simulation_of_text(drop("", "free_surface: {}"));
  advance(s->models);
  const Field* field = s->scene.field("free_surface");
  REQUIRE(field != nullptr);
  field->prepare();
  int wrong = 0;
  for_particles(s->scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    const bool rim = std::max(std::abs(x.x()), std::abs(x.y())) > 0.14;
    const bool found = *field->at(static_cast<Index>(k)) != std::byte{0};
    wrong += rim != found ? 1 : 0;
  });
  CHECK(wrong == 0);
}

TEST_CASE("particle terms: shifting evens out what is crowded, not the surface", "[physics]") {
  const auto unevenness = [](Simulation& s) {
    const SphState& sph = s.scene.store.get<SphState>();
    double sum = 0;
    for (const Line& c : sph.concentration) {
      if (c.w > 0.95 * 2) sum += xyz(c).squaredNorm();
    }
    return std::sqrt(sum);
  };
  const auto after = [&](const char* effects) {
    const auto s = moving_drop("", effects);
    // The rim of a square at rest but for the shear: what the surface does without shifting.
    for (int k = 0; k < 300; ++k) advance(s->models);
    return unevenness(*s);
  };
  const double without = after("viscosity: {alpha: 0.05}, free_surface: {}");
  const double with = after("viscosity: {alpha: 0.05}, shifting: {}");
  WARN(fmt::format("unevenness {:.3g} without, {:.3g} with shifting", without, with));
  CHECK(with < 0.5 * without);
  const auto still = make_simulation_of_text(drop("", "shifting: {}"));
  Scene& scene = still->scene;
  scene.nodes.v[static_cast<std::size_t>(scene.particles.begin)].x = 1;  // one corner moves
  advance(still->models);
  const SphState& sph = scene.store.get<SphState>();
  for_particles(scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
    const bool rim = std::max(std::abs(x.x()), std::abs(x.y())) > 0.14;
    if (rim) CHECK(xyz(sph.shift[k]).norm() == 0);
  });
}

TEST_CASE("particle terms: the energy balance of a dam break closes with each", "[physics]") {
  double error = 0;
  const double plain = front_of_dam({}, &error);
  CHECK(std::abs(error) < 5e-3);
  const std::vector<std::pair<std::string, std::vector<std::string>>> all = {
      {"single precision", {"parts.column.sph.precision=single"}},
      {"Wendland C2", {"parts.column.sph.kernel=wendland_c2"}},
      {"Wendland C4", {"parts.column.sph.kernel=wendland_c4"}},
      {"quintic spline", {"parts.column.sph.kernel=quintic_spline"}},
      {"density diffusion", {"effects.density_diffusion.delta=0.1"}},
      {"laminar viscosity", {"effects.laminar_viscosity.mu=1e-3"}},
      {"tensile cure", {"effects.tensile_cure.epsilon=0.2"}},
      {"shifting", {"effects.shifting.coefficient=0.5"}},
      {"renormalisation", {"effects.renormalisation.every=30"}},
      {"corrected gradients",
       {"effects.corrected_gradients=on", "effects.density_diffusion.delta=0.1",
        "effects.shifting.coefficient=0.5"}}};
  for (const auto& [name, set] : all) {
    const double front = front_of_dam(set, &error);
    WARN(fmt::format("{}: front {:+.2f} % of the plain one, energy error {:.1e}", name,
                     100 * (front / plain - 1), error));
    CHECK(std::abs(error) < 0.02);
    CHECK(std::abs(front / plain - 1) < 0.1);
  }
}

TEST_CASE("particle terms: a cavitating fluid forgets voids beyond the largest", "[physics]") {
  const auto drawn = [](const std::string& largest) {
    auto s = make_simulation_of_text(fmt::format(R"(gannet: 1
dimension: 2
materials: {{water: {{density: 1000, c0: 30 m/s, cavitation: -2 kPa, void: {}}}}}
parts:
  water:
    sph: {{material: water, spacing: 10 mm}}
    fill: {{box: {{from: [-0.2 m, 0, 0], to: [0.2 m, 0.1 m, 0]}}}}
    initial_velocity: ["8*x", 0, 0]
boundaries: {{sides: {{periodic: {{y: [0, 0.1 m]}}}}}}
effects: {{viscosity: {{alpha: 0.1}}}}
output: {{until: 1 s}}
)",
                                                 largest));
    run_until(*s, 0.03, [] {});  // drawn out by a fifth
    return s;
  };
  const auto held = drawn("0.05");
  const auto& sph = held->scene.store.get<SphState>();
  const double rho_min = density(sph.eos[0], -2e3);
  const double least = *std::ranges::min_element(sph.rho);
  CHECK(least == Approx(0.95 * rho_min).epsilon(1e-14));
  // p_min dV of what was forgotten: less than where nothing slows the water, 1.24 of its volume;
  // far more than the balance would leave unnoticed.
  const double volume = 0.4 * 0.1;
  const double taken = ledger_sum(*held, "cavities");
  CHECK(taken < 2e3 * volume * 0.24);
  const double kinetic = 0.5 * 1000 * volume * 64 * 0.16 / 12;
  CHECK(energy_error(*held) < 2e-3);
  CHECK(taken > 20 * 2e-3 * kinetic);
  // A void of 1 is none that is forgotten.
  const auto free = drawn("1");
  const auto& loose = free->scene.store.get<SphState>();
  CHECK(*std::ranges::min_element(loose.rho) < 0.9 * rho_min);
  CHECK(ledger_sum(*free, "cavities") == 0);
}
