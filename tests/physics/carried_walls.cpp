// Bodies whose skin is backed by dummy particles: momentum, energy, buoyancy.
#include <algorithm>

#include "body/rigid_body.hpp"
#include "running.hpp"
#include "water_meets_box.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Linear momentum of all that has a mass, and angular momentum about the origin with the spin of
/// bodies, at entry to a step.
struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
};

Momenta momenta(Simulation& s) {
  Momenta m{linear_momentum(s.scene).sum, angular_momentum(s.scene).sum};
  for (const RigidBody& body : s.scene.store.get<RigidBodies>().list) m.angular += body.L;
  return m;
}

/// A box of 0.4 m x `draft` + 0.1 m held in still water of 1.2 m x 0.4 m.
std::string held(double dx, double draft) {
  return fmt::format(R"case(gannet: 1
dimension: 2
let: {{dx: {}, d: {}, B: 0.4 m}}
materials: {{water: {{density: 1000, c0: 30 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: dx, kernel: quintic_spline}}
    fill: {{box: {{from: [-0.6 m, -0.4 m, 0], to: [0.6 m, 0, 0]}}, outside: box}}
    start: hydrostatic
  box:
    rigid_surface: {{}}
    shape:
      polyline:
        points: [["-B/2", "-d", 0], ["B/2", "-d", 0], ["B/2", 0.1, 0], ["-B/2", 0.1, 0], ["-B/2", "-d", 0]]
        elements: [20, 10, 20, 10]
bodies: {{box: {{parts: box, density: 500, walls: dummy, motion: {{velocity: [0, 0, 0], angular_velocity: [0, 0, 0]}}}}}}
boundaries: {{tank: {{planes: {{x: [-0.6 m, 0.6 m], y: -0.4 m}}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects:
  viscosity: {{type: monaghan, alpha: 0.1}}
  density_diffusion: {{delta: 0.1}}
  relaxation: {{rate: 5 1/s, until: 1.5 s}}
probes:
  left: {{surface_height: {{at: [-0.5 m]}}}}
  right: {{surface_height: {{at: [0.5 m]}}}}
output: {{until: 10 s, checkpoint: never}}
)case",
                     dx, draft);
}

/// How many particles of a bed of 20 x 10, 0.05 m apart, are left outside of a hull of 0.42 m x
/// 0.31 m; wall: the keys of the bed.
Index left_of_bed(const std::string& wall) {
  const auto s = make_simulation_of_text(fmt::format(R"case(gannet: 1
dimension: 2
materials: {{water: {{density: 1000, c0: 30 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: 0.05}}
    fill: {{box: {{from: [-0.5, 1, 0], to: [0.5, 1.2, 0]}}}}
  bed:
    wall: {}
    fill: {{box: {{from: [-0.5, -0.5, 0], to: [0.5, 0, 0]}}, outside: hull}}
  hull:
    rigid_surface: {{}}
    shape:
      polyline:
        points: [[-0.21, -0.31, 0], [0.21, -0.31, 0], [0.21, 0.1, 0], [-0.21, 0.1, 0], [-0.21, -0.31, 0]]
        elements: [2, 2, 2, 2]
bodies: {{hull: {{parts: hull, density: 500}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
                                                     wall));
  return s->scene.parts[static_cast<std::size_t>(s->scene.part_number("bed"))].nodes.size();
}

}  // namespace

TEST_CASE("walls: a bed keeps half a spacing off a hull, whether it names its fluid or not",
          "[physics]") {
  // 10 columns to 0.225 m and 7 rows to 0.325 m are in the hull or nearer to it than 0.025 m.
  CHECK(left_of_bed("{like: pool}") == 200 - 10 * 7);
  CHECK(left_of_bed("{}") == 200 - 10 * 7);
}

TEST_CASE("walls on bodies: momentum of water and body is kept to rounding", "[physics]") {
  for (const char* slip : {"free", "none"}) {
    const auto s = make_simulation_of_text(water_meets_box(slip, 300));
    const Momenta start = momenta(*s);
    const double p_scale = linear_momentum(s->scene).scale;
    const double L_scale = angular_momentum(s->scene).scale;
    double worst_p = 0;
    double worst_L = 0;
    double most_v = 0;
    run_until(*s, 0.1, [&] {
      const Momenta now = momenta(*s);
      worst_p = std::max(worst_p, (now.linear - start.linear).norm() / p_scale);
      worst_L = std::max(worst_L, (now.angular - start.angular).norm() / L_scale);
      most_v = std::max(most_v, measured(s->scene, "body.box.velocity", 1));
    });
    fmt::print(
        "box of walls, slip {}: momentum {:.1e}, angular {:.1e}, energy {:.1e}, box at "
        "{:.2f} m/s\n",
        slip, worst_p, worst_L, energy_error(*s), most_v);
    CHECK(most_v > 1);
    CHECK(worst_p < 1e-12);
    CHECK(worst_L < 1e-9);
    CHECK(energy_error(*s) < 5e-3);
  }
}

TEST_CASE("walls on bodies: a body lighter than the water at its skin is pushed, not shaken",
          "[physics]") {
  const auto s = make_simulation_of_text(water_meets_box("free", 10));
  const double speed = 2;  // of the water
  double most = 0;
  run_until(*s, 0.1,
            [&] { most = std::max(most, std::abs(measured(s->scene, "body.box.velocity", 1))); });
  fmt::print("box of 10 kg/m^3: at most {:.2f} m/s, energy {:.1e}\n", most, energy_error(*s));
  CHECK(most > 0.9 * speed);
  CHECK(most < 3 * speed);  // a light box is thrown off by what it compressed
  CHECK(energy_error(*s) < 1e-2);
}

TEST_CASE("walls on bodies: a box that is held has the buoyancy of what it displaces",
          "[physics]") {
  // On the lattice of the water, and a third of a spacing off it.
  for (const double draft : {0.1, 0.093}) {
    const auto s = make_simulation_of_text(held(0.02, draft));
    double force = 0;
    double surface = 0;
    int n = 0;
    run_until(*s, 2.5, [&] {
      if (time_of(*s) < 1.5) return;
      force += measured(s->scene, "wall.box.force", 1);
      surface += 0.5 * (measured(s->scene, "probe.left") + measured(s->scene, "probe.right"));
      ++n;
    });
    const double theory = 9810 * 0.4 * (surface / n + draft);
    fmt::print("box held {} m deep, 20 mm: force {:.2f} N, theory {:.2f} N: {:+.2f} %\n", draft,
               force / n, theory, 100 * (force / n / theory - 1));
    CHECK(force / n == Approx(theory).epsilon(0.01));
  }
}
