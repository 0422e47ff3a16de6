// Rigid bodies as a case asks for them: free rotation, given motion, mass, impact with water.
#include <fmt/format.h>

#include <numbers>

#include "body/body_mass.hpp"
#include "body/rigid_body.hpp"
#include "body/rigid_measures.hpp"
#include "running.hpp"
#include "scene/followers.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

const RigidBody& body_of(Simulation& s, std::size_t k = 0) {
  return s.scene.store.get<RigidBodies>().list[k];
}

Vec3 vector_measure(const Scene& scene, const std::string& name) {
  return {measured(scene, name, 0), measured(scene, name, 1), measured(scene, name, 2)};
}

/// A skin of 2 m x 1 m x 0.5 m with the given keys of its body.
std::string skin(const std::string& body, const std::string& more = "") {
  return R"case(gannet: 1
parts:
  skin:
    rigid_surface: {}
    shape: {box: {from: [-1, -0.5, -0.25], to: [1, 0.5, 0.25], elements: [2, 1, 1]}}
bodies: {top: {parts: skin, )case" +
         body + "}}\n" + more + "output: {until: 10000 s, checkpoint: never}\n";
}

/// Something that limits the step to 1 ms where a body does not turn.
const std::string clock_part = R"case(
  clock:
    cable: {EA: 1 N, mass_per_length: 1 kg/m, dt_factor: 1, tension_only: no}
    shape: {line: {from: [50, 50, 50], to: [50.001, 50, 50], elements: 1}}
)case";

/// Two flat plates of steel, 2 m x 1 m, 0.4 m apart, of n x n shells.
std::string plates(int n) {
  return fmt::format(R"case(gannet: 1
materials: {{steel: {{density: 7800, young: 210 GPa, poisson: 0.3}}}}
parts:
  below:
    shell: {{material: steel, thickness: 10 mm}}
    shape: {{plate: {{size: [2, 1], elements: [{0}, {0}], centre: [3, 0, -0.2]}}}}
  above:
    shell: {{material: steel, thickness: 10 mm}}
    shape: {{plate: {{size: [2, 1], elements: [{0}, {0}], centre: [3, 0, 0.2]}}}}
bodies: {{pair: {{parts: [below, above]}}}}
output: {{until: 1 s, checkpoint: never}}
)case",
                     n);
}

Mat3 inertia_of_plates(int n) {
  const auto s = make_simulation_of_text(plates(n));
  return body_of(*s).inertia;
}

}  // namespace

TEST_CASE("bodies: an asymmetric top turns for 1e5 steps with its energy and momentum",
          "[physics]") {
  const auto s = make_simulation_of_text(
      skin("mass: 12 kg, centre: [0, 0, 0], inertia: [1, 2, 4, 0.1, 0.2, -0.1], "
           "angular_velocity: [0.3, 4, 0.2], velocity: [1, 0, 0]"));
  const RigidBody& body = body_of(*s);
  advance(s->models);
  const Vec3 L = body.L;
  const double E = ledger_sum(*s, "kinetic of rotation");
  double worst_L = 0;
  double worst_E = 0;
  double lowest = 1e9;
  for (int k = 1; k < 100000; ++k) {
    advance(s->models);
    worst_L = std::max(worst_L, (body.L - L).norm() / L.norm());
    worst_E = std::max(worst_E, std::abs(ledger_sum(*s, "kinetic of rotation") / E - 1));
    const Quaternion q(body.q[3], body.q[0], body.q[1], body.q[2]);
    lowest = std::min(lowest,
                      (q.conjugate() * vector_measure(s->scene, "body.top.angular_velocity")).y());
  }
  fmt::print("top: after 1e5 steps of {:.3g} s energy {:.2g}, angular momentum {:.2g}\n",
             s->models.list.front().step.dt, worst_E, worst_L);
  CHECK(lowest < -3);  // about its middle axis it turns over
  CHECK(worst_L < 1e-9);
  CHECK(worst_E < 1e-9);
  // No part of it has moved against another: its corners are where the quaternion puts them.
  const Vec3 corner = xyz(s->scene.nodes.x[static_cast<std::size_t>(body.members[0])]);
  const Vec3 centre = xyz(s->scene.nodes.x[static_cast<std::size_t>(body.node)]);
  CHECK((corner - centre).norm() == Approx(std::sqrt(1 + 0.25 + 0.0625)).epsilon(1e-12));
}

TEST_CASE("bodies: two plates become one body with the inertia of both", "[physics]") {
  // Exact: m = 7800 * 0.01 * 2 = 156 kg each; Ixx = 2 m (b^2/12 + z^2), b = 1, z = 0.2. Masses at
  // the nodes make it sum m r^2 by the trapezoid rule: b^2/12 (1 + 2/n^2).
  const auto exact = [](double lumped) -> Vec3 {
    const double m = 2 * 156;
    const double xx = m * (1.0 / 12 * lumped + 0.04);
    const double yy = m * (4.0 / 12 * lumped + 0.04);
    return {xx, yy, m * 5.0 / 12 * lumped};
  };
  for (const int n : {4, 16}) {
    const Mat3 I = inertia_of_plates(n);
    const Mat3 expected = exact(1 + 2.0 / (n * n)).asDiagonal();
    CHECK((I - expected).norm() < 1e-10 * expected.norm());
  }
  const Mat3 exactly = exact(1).asDiagonal();
  CHECK((inertia_of_plates(16) - exactly).norm() < 0.01 * exactly.norm());
  const auto s = make_simulation_of_text(plates(4));
  CHECK((xyz(s->scene.nodes.x[static_cast<std::size_t>(body_of(*s).node)]) - Vec3(3, 0, 0)).norm() <
        1e-12);
  for (const Operation& op : s->models.list.front().plan.at(Stage::force)) {
    CHECK(op.effect != "shell");  // rigid parts are not computed
  }
}

TEST_CASE("bodies: a homogeneous ball has the inertia 2/5 m R^2", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
parts:
  ball:
    rigid_surface: {}
    shape: {box: {from: [-1, -1, -1], to: [1, 1, 1], elements: [24, 24, 24]}}
    map: ["0.5*x*sqrt(1-y*y/2-z*z/2+y*y*z*z/3)", "0.5*y*sqrt(1-z*z/2-x*x/2+z*z*x*x/3)",
          "2+0.5*z*sqrt(1-x*x/2-y*y/2+x*x*y*y/3)"]
bodies: {ball: {parts: ball, density: 500, angular_velocity: [0, 0, 1 rad/s]}}
output: {until: 1 s, checkpoint: never}
)case");
  const RigidBody& ball = body_of(*s);
  const double m = 500 * 4 * std::numbers::pi / 3 * 0.125;
  const Line& centre = s->scene.nodes.x[static_cast<std::size_t>(ball.node)];
  CHECK(centre.w == Approx(m).epsilon(5e-3));
  CHECK((xyz(centre) - Vec3(0, 0, 2)).norm() < 1e-12);
  const Mat3 expected = 0.4 * m * 0.25 * Mat3::Identity();
  CHECK((ball.inertia - expected).norm() < 8e-3 * expected.norm());
}

TEST_CASE("bodies: motion that is given is followed exactly, whatever the steps", "[physics]") {
  const auto s =
      make_simulation_of_text(skin("density: 800, motion: {velocity: [\"0.3*t\", 0, free], "
                                   "angular_velocity: [0, 0, \"1+2*t\"]}",
                                   "probes: {top: {body: top}}\n"));
  const Scene& scene = s->scene;
  run_until(*s, 0.7, [] {});
  const double t = time_of(*s);
  const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(body_of(*s).node)]);
  CHECK((x - Vec3(0.15 * t * t, 0, 0)).norm() < 1e-13);
  CHECK(roll_pitch_yaw(body_of(*s).q).z() == Approx(t + t * t).epsilon(1e-12));
  CHECK(energy_error(*s) < 1e-3);  // steps of 0.1 s: (omega dt)^2/12 = 3e-3
}

TEST_CASE("bodies: held until a time, let go into the motion that is given", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
parts:
  skin:
    rigid_surface: {}
    shape: {box: {from: [-1, -0.5, -0.25], to: [1, 0.5, 0.25], elements: [2, 1, 1]}})case" +
                                         clock_part + R"case(
bodies:
  top: {parts: skin, density: 800, held_until: 0.3 s, motion: {velocity: [0, free, free], angular_velocity: [free, 0, "2*(t-0.3)"]}}
loads: {gravity: [0, 0, -9.81 m/s^2]}
effects: {guards: {energy_error: 100 %}}  # right at the release there is no energy to compare with
output: {until: 10 s, checkpoint: never}
)case");
  double release = -1;
  double held = 0;
  run_until(*s, 0.8, [&] {
    if (release >= 0) return;
    const double reaction = measured(s->scene, "body.top.reaction", 2);
    if (reaction == 0) release = time_of(*s) - s->models.list.front().step.dt_old;
    held = std::max(held, std::abs(reaction - 9.81 * 800));
    if (release < 0) CHECK(vector_measure(s->scene, "body.top.velocity").norm() == 0);
  });
  CHECK(release == Approx(0.3).margin(1e-3));  // the level whose kick was free
  // Then it falls and turns, at n-1/2 after kicks of dt each from the level of the release.
  const Vec3 v = xyz(s->scene.nodes.v[static_cast<std::size_t>(body_of(*s).node)]);
  CHECK((v - Vec3(0, 0, -9.81 * (time_of(*s) - release))).norm() < 1e-9);
  const double omega = xyz(s->scene.nodes.omega[static_cast<std::size_t>(body_of(*s).node)]).z();
  CHECK(omega == Approx(2 * (time_of(*s) - 0.3)).margin(2e-3));
  // Its weight was carried until then; the last value of all is that of the release.
  CHECK(held == Approx(9.81 * 800));
  CHECK(energy_error(*s) < 1e-3);
}

TEST_CASE("bodies: the force that shakes a body is m a, and the couple is I alpha", "[physics]") {
  // x = A sin(w t), about z the angle B sin(w t): R = -m A w^2 sin(w t), C = -Izz B w^2 sin(w t);
  // gravity is carried by the reaction in z.
  const std::string text = R"case(gannet: 1
let: {w: 6, A: 0.1, B: 0.2}
parts:
  skin:
    rigid_surface: {}
    shape: {box: {from: [-1, -0.5, -0.25], to: [1, 0.5, 0.25], elements: [2, 1, 1]}})case" +
                           clock_part + R"case(
bodies:
  top: {parts: skin, density: 800, motion: {velocity: ["A*w*cos(w*t)", 0, 0], angular_velocity: [0, 0, "B*w*cos(w*t)"]}}
loads: {gravity: [0, 0, -9.81 m/s^2]}
output: {until: 10 s, checkpoint: never}
)case";
  const auto s = make_simulation_of_text(text);
  const double m = 800 * 2 * 1 * 0.5;
  const double Izz = m * (4 + 1) / 12.0;
  double worst = 0;
  double t = 0;  // measures are those of the level that the step began at
  while (t < 0.8) {
    t = time_of(*s);
    advance(s->models);
    if (t == 0) continue;  // the first kick is half a step: its mean is not at the level
    const Vec3 R = vector_measure(s->scene, "body.top.reaction");
    const Vec3 C = vector_measure(s->scene, "body.top.reaction_moment");
    const double a = -36 * std::sin(6 * t);
    worst = std::max({worst, (R - Vec3(m * 0.1 * a, 0, 9.81 * m)).norm() / (m * 3.6),
                      (C - Vec3(0, 0, Izz * 0.2 * a)).norm() / (Izz * 7.2)});
  }
  fmt::print("shaken body: steps of {:.3g} s, reactions within {:.2g} of their peak\n",
             s->models.list.front().step.dt, worst);
  CHECK(worst < 1e-4);  // (w dt)^2/12 with steps of 1 ms is 3e-6; varying steps add first order
  CHECK(energy_error(*s) < 1e-4);
}

TEST_CASE("bodies: an impact with water keeps momentum", "[physics]") {
  const bool xsph = GENERATE(false, true);
  const auto s = make_simulation_of_text(std::string(R"case(gannet: 1
materials: {water: {density: 1000, c0: 60 m/s}}
parts:
  drop:
    sph: {material: water, spacing: 50 mm}
    fill: {box: {from: [-0.3, -0.3, 0.4], to: [0.4, 0.3, 0.9]}}
    initial_velocity: [0.5 m/s, 0, -6 m/s]
  hull:
    rigid_surface: {}
    shape: {box: {from: [-0.5, -0.5, -0.2], to: [0.5, 0.5, 0.2], elements: [3, 3, 1]}}
bodies: {hull: {parts: hull, density: 300, velocity: [0, 0, 4 m/s], angular_velocity: [1 rad/s, 0.5 rad/s, 0]}}
contacts: {slam: {between: [drop, hull]}}
output: {until: 1 s, checkpoint: never}
effects: {viscosity: {type: monaghan, alpha: 0.1})case") +
                                         (xsph ? ", xsph: {epsilon: 0.5}}\n" : "}\n"));
  const RigidBody& hull = body_of(*s);
  const auto angular = [&] {
    // x at n and v at n-1/2: both at n-1/2, where the pair has moved by half of v dt.
    Total L;
    const Scene& scene = s->scene;
    const double half = 0.5 * s->models.list.front().step.dt_old;
    for (Index i = 0; i < scene.nodes.n_owned; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3 v = xyz(scene.nodes.v[k]);
      const Vec3 x = xyz(scene.nodes.x[k]) - half * v;
      L.sum += scene.nodes.x[k].w * x.cross(v);
      L.scale += scene.nodes.x[k].w * x.norm() * v.norm();
    }
    L.sum += hull.L;
    return L;
  };
  const Vec3 p = linear_momentum(s->scene).sum;
  const Vec3 L = angular().sum;
  double worst_p = 0;
  double worst_L = 0;
  double hardest = 0;
  run_until(*s, 0.12, [&] {
    const Total now = linear_momentum(s->scene);
    worst_p = std::max(worst_p, (now.sum - p).norm() / now.scale);
    const Total turned = angular();
    worst_L = std::max(worst_L, (turned.sum - L).norm() / turned.scale);
    hardest = std::max(hardest, vector_measure(s->scene, "contact.slam.force").norm());
  });
  fmt::print(
      "impact{}: force up to {:.3g} N, momentum {:.2g}, angular momentum {:.2g}, energy "
      "{:.2g}\n",
      xsph ? " with XSPH" : "", hardest, worst_p, worst_L, energy_error(*s));
  CHECK(hardest > 1e4);
  CHECK(worst_p < 1e-12);
  CHECK(worst_L < 1e-9);
  // Of second order in the step without XSPH, whose displacement contact does not count.
  CHECK(energy_error(*s) < (xsph ? 0.03 : 0.005));
}

TEST_CASE("bodies: a light body in contact votes for its own frequency", "[physics]") {
  // One particle's worth of mass in the hull: were the body left out, the step of the water would
  // be taken, at which the pair blows up.
  const auto run = [](const std::string& density) {
    const auto s = make_simulation_of_text(R"case(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 20 mm}
    fill: {box: {from: [-0.5, -0.3, 0], to: [0.5, 0, 0]}, outside: hull}
    start: hydrostatic
  hull:
    rigid_surface: {}
    shape: {polyline: {points: [[-0.2, -0.04, 0], [0.2, -0.04, 0], [0.2, 0.16, 0], [-0.2, 0.16, 0], [-0.2, -0.04, 0]], elements: [20, 10, 20, 10]}}
bodies: {hull: {parts: hull, density: )case" +
                                           density + R"case(}}
boundaries: {tank: {planes: {x: [-0.5, 0.5], y: -0.3}}}
contacts: {hull: {between: [pool, hull]}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
effects: {viscosity: {alpha: 0.1}}
output: {until: 1 s, checkpoint: never}
)case");
    run_until(*s, 0.1, [] {});
    return std::pair{s->models.list.front().vote.dt, energy_error(*s)};
  };
  const auto [heavy_dt, heavy_error] = run("200");
  const auto [light_dt, light_error] = run("5");
  fmt::print("density 200: step {:.3g} s, energy {:.2g}; density 5: {:.3g} s, {:.2g}\n", heavy_dt,
             heavy_error, light_dt, light_error);
  CHECK(light_dt < 0.5 * heavy_dt);
  CHECK(light_error < 0.01);
  CHECK(heavy_error < 0.01);
}

TEST_CASE("fill: particles start outside of bodies, half a spacing off", "[physics]") {
  const auto pool = [](const std::string& shape, const std::string& map) {
    return make_simulation_of_text(R"case(gannet: 1
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  pool:
    sph: {material: water, spacing: 0.1}
    fill: {box: {from: [-1, -1, -1], to: [1, 1, 0]}, outside: hull}
  hull:
    rigid_surface: {}
    shape: {box: )case" + shape + "}\n" +
                                   map + "output: {until: 1 s, checkpoint: never}\n");
  };
  // A box of 6 x 4 cells, 3 deep, on the lattice: what it displaces is left out, and no more.
  const auto box = pool("{from: [-0.3, -0.2, -0.3], to: [0.3, 0.2, 0.4], elements: [2, 2, 2]}", "");
  CHECK(box->scene.particles.size() == 20 * 20 * 10 - 6 * 4 * 3);
  // A ball of radius 0.45, half of it below the surface: its volume is left out, and none stands
  // nearer than half a spacing.
  const auto ball =
      pool("{from: [-1, -1, -1], to: [1, 1, 1], elements: [24, 24, 24]}",
           "    map: [\"0.45*x*sqrt(1-y*y/2-z*z/2+y*y*z*z/3)\", "
           "\"0.45*y*sqrt(1-z*z/2-x*x/2+z*z*x*x/3)\", \"0.45*z*sqrt(1-x*x/2-y*y/2+x*x*y*y/3)\"]\n");
  const double left_out = 2.0 / 3 * std::numbers::pi * std::pow(4.5, 3);  // in particles
  // Points go by fours at one depth: half of them are left over.
  CHECK(static_cast<double>(4000 - ball->scene.particles.size()) == Approx(left_out).margin(2));
  for_particles(ball->scene,
                [](std::size_t, const Vec3& x, const Vec3&) { REQUIRE(x.norm() > 0.495); });
}

TEST_CASE("ties: a body that hangs on a line pulls with its weight", "[physics]") {
  const auto s = make_simulation_of_text(R"case(gannet: 1
materials: {steel: {density: 7800, young: 210 GPa, poisson: 0.3}}
parts:
  plate:
    shell: {material: steel, thickness: 10 mm}
    shape: {plate: {size: [0.2, 0.2], elements: [2, 2], centre: [0, 0, 0]}}
  line: {cable: {EA: 1 MN, mass_per_length: 0.5 kg/m}, shape: {line: {from: [0, 0, 1], to: [0, 0, 0], elements: 10}}}
bodies: {weight: {parts: plate}}
ties: {hook: {nodes: {nearest: [0, 0, 0], of: line}, to: weight}}
boundaries: {top: {nodes: {nearest: [0, 0, 1], of: line}, fix: [x, y, z]}}
loads: {gravity: [0, 0, -9.81 m/s^2]}
output: {until: 10 s, checkpoint: never}
)case");
  const double plate = 0.2 * 0.2 * 0.01 * 7800;
  const double node = 0.5 * 0.5 * 0.1;
  const RigidBody& body = s->scene.store.get<RigidBodies>().list.front();
  CHECK(s->scene.nodes.x[static_cast<std::size_t>(body.node)].w ==
        Approx(plate + node).epsilon(1e-12));
  double force = 0;
  double weight = 0;
  run_until(*s, 0.1, [] {});
  while (s->models.list.front().step.t < 1.1) {  // a mean over many bounces
    advance(s->models);
    const double dt = s->models.list.front().step.dt_old;
    force += dt * measured(s->scene, "tie.hook.force", 2);
    weight += dt * plate * 9.81;
  }
  CHECK(force == Approx(weight).epsilon(0.01));
}

TEST_CASE("bodies: nothing stops a scene in which nothing happens", "[physics]") {
  const auto s = make_simulation_of_text(R"(gannet: 1
dimension: 2
materials: {water: {density: 1000, c0: 30 m/s}}
parts:
  box:
    rigid_surface: {}
    shape: {polyline: {points: [[0.4, 0.3, 0], [0.6, 0.3, 0], [0.6, 0.4, 0], [0.4, 0.4, 0], [0.4, 0.3, 0]], elements: 1}}
  line: {cable: {EA: 20 MN, mass_per_length: 0.5 kg/m}, shape: {line: {from: [0.1, 0.5, 0], to: [0.4, 0.4, 0], elements: 12}}}
bodies: {box: {parts: box, density: 400}}
ties: {aft: {nodes: {nearest: [0.4, 0.4, 0], of: line}, to: box}}
output: {until: 1 s}
)");
  for (int k = 0; k < 200; ++k) CHECK_NOTHROW(advance(s->models));
  // Rounding of the line's ends moves it, by less than the guard looks at.
  CHECK(linear_momentum(s->scene).scale < 1e-9);
}
