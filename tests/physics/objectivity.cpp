// Solids and shells of every kind of material, stressed, unloaded a little, and turned: what their
// stress, history and energy make of it. 20 turns; 1,000 with --long.
#include <numbers>
#include <random>

#include "../unit/fe/fe_testing.hpp"
#include "../unit/fe/shell_testing.hpp"
#include "fe/shell.hpp"
#include "fe/solid.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

struct Named {
  const char* name;
  ElasticPlastic material;
};

std::vector<Named> materials() {
  const ElasticPlastic elastic{.rho = 1000, .E = 1e6, .nu = 0.25};
  ElasticPlastic isotropic = elastic;
  isotropic.sigma_y = 5e3;
  isotropic.H = 1e5;
  ElasticPlastic kinematic = isotropic;
  kinematic.kinematic_fraction = 0.5;
  ElasticPlastic curve = elastic;
  curve.sigma_y = 5e3;
  curve.curve_strain = {0, 0.005, 0.05};
  curve.curve_stress = {5e3, 6e3, 9e3};
  ElasticPlastic johnson_cook = elastic;
  johnson_cook.sigma_y = 5e3;
  johnson_cook.power_factor = 8e3;
  johnson_cook.power = 0.3;
  johnson_cook.rate_law = RateLaw::johnson_cook;
  johnson_cook.rate_power = 0.02;
  johnson_cook.heating = {.specific_heat = 400, .range = 1000, .power = 1.1};
  return {{"elastic", elastic},
          {"J2, linear", isotropic},
          {"J2, kinematic", kinematic},
          {"J2, curve", curve},
          {"Johnson-Cook", johnson_cook}};
}

Named rubber() {
  ElasticPlastic gum{.rho = 1000, .E = 2.4e6, .nu = 0.45};
  gum.rubber = {.C10 = 0.3e6, .C01 = 0.1e6, .C20 = 0.02e6, .C30 = 0.01e6, .bulk = 5e6};
  return {"rubber", gum};
}

struct Turned {
  double drift = 0;   ///< of stress, history and hourglass forces, over the largest of each
  double energy = 0;  ///< gained, over what loading stored and dissipated
};

/// Drift of the numbers [0, n) of element 0 of a block, over the largest of [0, n_stress) for those
/// and of the rest for the rest.
template <class Block>
double drift_of(const Block& before, const Block& now, int n) {
  double most = 0;
  double largest = 0;
  for (int k = 0; k < n; ++k) {
    largest = std::max(largest, std::abs(before.value(0, k)));
    most = std::max(most, std::abs(now.value(0, k) - before.value(0, k)));
  }
  return most / largest;
}

Turned turn_solid(const ElasticPlastic& material, int points, int turns, int steps) {
  testing::Solid s = testing::bricks({1, 1, 1}, [](int i, int j, int k) {
    return Vec3(0.1 * i + 0.01 * j * k, 0.1 * j - 0.02 * k, 0.1 * k + 0.015 * i * j);
  });
  SolidBlock block =
      make_solid_block(s.cells, s.nodes.x, material,
                       {.points = points, .linear_viscosity = 0, .quadratic_viscosity = 0});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Line& v : s.nodes.v) set_xyz(v, 10 * Vec3(u(random), u(random), u(random)));
  double stored = 0;
  const auto move = [&](double share) {
    for (std::size_t i = 0; i < 8; ++i) {
      add_xyz(s.nodes.x[i], share * 1e-5 * xyz(s.nodes.v[i]));
    }
    Array<Line> keep = s.nodes.v;
    for (Line& v : s.nodes.v) set_xyz(v, share * xyz(v));
    const ElementWork w = solid_pass(block, s.nodes, 1e-5);
    s.nodes.v = keep;
    stored += w.internal + w.hourglass;
  };
  for (int k = 0; k < 20; ++k) move(1);
  for (int k = 0; k < 3; ++k) move(-1);  // off the yield surface, also that at rest
  const SolidBlock before = block;
  const Mat3 R =
      Eigen::AngleAxisd(2 * std::numbers::pi / steps, Vec3(1, 2, 2) / 3).toRotationMatrix();
  const double dt = 1e-3;
  double gain = 0;
  for (int k = 0; k < turns * steps; ++k) {
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      set_xyz(s.nodes.v[i], (R * x - x) / dt);
      set_xyz(s.nodes.x[i], R * x);
    }
    const ElementWork w = solid_pass(block, s.nodes, dt);
    gain += w.internal + w.hourglass;
  }
  return {drift_of(before, block, block.layout.viscous_pressure()), std::abs(gain) / stored};
}

Turned turn_shell(const ElasticPlastic& material, ShellKind kind, int turns, int steps) {
  constexpr double dt = 1e-5;
  testing::Sheet s = testing::crumpled(1, 1, 5);
  ShellBlock block = testing::block_of(s, material, {.kind = kind, .thickness = 0.01});
  testing::random_motion(s, 7, 2, 20);
  double stored = 0;
  const auto move = [&](double share) {
    const Array<Line> v = s.nodes.v;
    const Array<Line> w = s.nodes.omega;
    for (std::size_t i = 0; i < s.size(); ++i) {
      set_xyz(s.nodes.v[i], share * xyz(v[i]));
      set_xyz(s.nodes.omega[i], share * xyz(w[i]));
      add_xyz(s.nodes.x[i], dt * xyz(s.nodes.v[i]));
    }
    const ElementWork work = shell_pass(block, s.nodes, dt);
    stored += work.internal + work.hourglass;
    s.nodes.v = v;
    s.nodes.omega = w;
  };
  for (int k = 0; k < 20; ++k) move(1);
  for (int k = 0; k < 6; ++k) move(-1);
  const ShellBlock before = block;
  const Array<Line> start = s.nodes.x;
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  const double theta = 2 * std::numbers::pi / steps;
  double gain = 0;
  for (int k = 1; k <= turns * steps; ++k) {
    const Mat3 R = Eigen::AngleAxisd(theta * (k % steps), axis).toRotationMatrix();
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = R * xyz(start[i]);
      set_xyz(s.nodes.v[i], (x - xyz(s.nodes.x[i])) / dt);
      set_xyz(s.nodes.omega[i], 2 * std::tan(theta / 2) / dt * axis);
      set_xyz(s.nodes.x[i], x);
    }
    const ElementWork work = shell_pass(block, s.nodes, dt);
    gain += work.internal + work.hourglass;
  }
  return {drift_of(before, block, block.layout.hourglass()), std::abs(gain) / stored};
}

void check(const std::string& what, const Turned& t) {
  INFO(what);
  WARN(fmt::format("{}: state drifts by {:.1e}, energy by {:.1e}", what, t.drift, t.energy));
  CHECK(t.drift < 1e-6);
  CHECK(t.energy < 1e-6);
}

void check_all(int turns) {
  std::vector<Named> of_solids = materials();
  of_solids.push_back(rubber());
  for (const Named& m : of_solids) {
    for (const int points : {1, 8}) {
      check(fmt::format("solid, {} points, {}, {} turns of 1000 steps", points, m.name, turns),
            turn_solid(m.material, points, turns, 1000));
    }
  }
  const std::pair<const char*, ShellKind> kinds[] = {{"one point", ShellKind::one_point},
                                                     {"full", ShellKind::quad},
                                                     {"triangle", ShellKind::triangle}};
  for (const Named& m : materials()) {
    for (const auto& [name, kind] : kinds) {
      check(fmt::format("shell, {}, {}, {} turns of 1000 steps", name, m.name, turns),
            turn_shell(m.material, kind, turns, 1000));
    }
  }
}

}  // namespace

TEST_CASE("objectivity: 20 turns of every material", "[physics]") { check_all(20); }

TEST_CASE("objectivity: 1,000 turns of every material", "[.][physics_long]") { check_all(1000); }
