// Stressed shells turned many times: what their stress and energy make of it.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "unit/fe/shell_testing.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

constexpr double dt = 1e-6;

/// Largest difference of the states over the largest number of the first, stresses only.
double drift_of(const ShellBlock& a, const ShellBlock& b) {
  double largest = 0;
  double most = 0;
  for (Index e = 0; e < a.n_elements; ++e) {
    for (int k = 0; k < a.layout.hourglass(); ++k) {
      largest = std::max(largest, std::abs(a.value(e, k)));
      most = std::max(most, std::abs(a.value(e, k) - b.value(e, k)));
    }
  }
  return most / largest;
}

struct Turned {
  double stress = 0;  ///< drift over the stress
  double energy = 0;  ///< gained, over the elastic energy
};

/// A warped sheet is strained, then turned rigidly. Chords of a turn by theta belong to the angular
/// velocity 2 tan(theta/2)/dt.
Turned turn(ShellKind kind, int turns, int steps_a_turn) {
  Sheet s = crumpled(2, 2, 5);
  ShellBlock block =
      block_of(s, {.rho = 7800, .E = 210e9, .nu = 0.3}, {.kind = kind, .thickness = 0.01});
  random_motion(s, 7, 20, 200);
  for (std::size_t i = 0; i < s.size(); ++i) add_xyz(s.nodes.x[i], dt * xyz(s.nodes.v[i]));
  const double stored = shell_pass(block, s.nodes, dt).internal;
  const ShellBlock before = block;
  const Array<Line> start = s.nodes.x;
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  const double theta = 2 * std::numbers::pi / steps_a_turn;
  Turned turned;
  for (int k = 1; k <= turns * steps_a_turn; ++k) {
    const Mat3 R = Eigen::AngleAxisd(theta * (k % steps_a_turn), axis).toRotationMatrix();
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = R * xyz(start[i]);
      set_xyz(s.nodes.v[i], (x - xyz(s.nodes.x[i])) / dt);
      set_xyz(s.nodes.omega[i], 2 * std::tan(theta / 2) / dt * axis);
      set_xyz(s.nodes.x[i], x);
    }
    turned.energy += shell_pass(block, s.nodes, dt).internal;
  }
  turned.energy = std::abs(turned.energy) / stored;
  turned.stress = drift_of(before, block);
  return turned;
}

}  // namespace

TEST_CASE("shell objectivity: 1,000 turns", "[convergence]") {
  for (const ShellKind kind : {ShellKind::one_point, ShellKind::quad, ShellKind::triangle}) {
    for (const int steps : {100, 1000}) {
      const Turned t = turn(kind, 1000, steps);
      WARN(fmt::format(
          "element {}, 1000 turns of {} steps: stress drifts by {:.1e}, energy by {:.1e}",
          static_cast<int>(kind), steps, t.stress, t.energy));
      CHECK(t.stress < 1e-6);
      CHECK(t.energy < 1e-6);
    }
  }
}
