// Bodies whose skin is backed by dummy particles and that advance in substeps of the water's step.
#include <algorithm>
#include <string>

#include "body/rigid_body.hpp"
#include "running.hpp"
#include "water_meets_box.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// The model of the box takes its own steps; slow_forces: how the water pushes it.
std::string meeting(const char* slow_forces) {
  return water_meets_box(
      "none", 300,
      fmt::format("models: {{sea: {{parts: water}}, rest: {{parts: box, slow_forces: {}}}}}\n",
                  slow_forces));
}

/// The box of cases/floating_box with coarser water, released above where it floats.
std::string floating(const char* models) {
  return fmt::format(R"case(gannet: 1
dimension: 2
materials: {{water: {{density: 1000, c0: 30 m/s}}}}
parts:
  pool:
    sph: {{material: water, spacing: 20 mm, kernel: quintic_spline}}
    fill: {{box: {{from: [-0.6, -0.4, 0], to: [0.6, 0, 0]}}, outside: box}}
    start: hydrostatic
  box:
    rigid_surface: {{}}
    shape: {{polyline: {{points: [[-0.2, -0.08, 0], [0.2, -0.08, 0], [0.2, 0.12, 0], [-0.2, 0.12, 0], [-0.2, -0.08, 0]], elements: [20, 10, 20, 10]}}}}
bodies: {{box: {{parts: box, density: 500, walls: dummy}}}}
boundaries: {{tank: {{planes: {{x: [-0.6, 0.6], y: -0.4}}}}}}
loads: {{gravity: [0, -9.81 m/s^2, 0]}}
effects:
  viscosity: {{type: monaghan, alpha: 0.1}}
  density_diffusion: {{delta: 0.1}}
  relaxation: {{rate: 5 1/s, until: 1.5 s}}
probes:
  left: {{surface_height: {{at: [-0.48]}}}}
  right: {{surface_height: {{at: [0.48]}}}}
{}output: {{until: 10 s, checkpoint: never}}
)case",
                     models);
}

/// Lets the model of the body take n substeps a step of the water.
void subdivide(Simulation& s, int n) {
  const Model& slow = s.models.list.front();
  s.models.list.back().plan.add({.name = "short steps of the test",
                                 .stage = Stage::force,
                                 .run = [](const Step&) {},
                                 .stable_dt = [&slow, n] { return slow.step.dt / n; }});
}

const RigidBody& box_of(Simulation& s) { return s.scene.store.get<RigidBodies>().list.front(); }

struct Motion {
  Vec3 p;  ///< linear momentum of the box [kg m/s]
  Vec3 L;  ///< its spin [kg m^2/s]
};

Motion motion_of(Simulation& s) {
  const auto c = static_cast<std::size_t>(box_of(s).node);
  return {s.scene.nodes.x[c].w * xyz(s.scene.nodes.v[c]), box_of(s).L};
}

Vec3 vector_of(const Simulation& s, const std::string& name) {
  return {measured(s.scene, name, 0), measured(s.scene, name, 1), measured(s.scene, name, 2)};
}

Motion pushed(const Simulation& s) {
  return {vector_of(s, "wall.box.force"), vector_of(s, "wall.box.moment")};
}

}  // namespace

TEST_CASE("linked walls: one step of the water gives its body the impulse F dT", "[physics]") {
  const auto s = make_simulation_of_text(meeting("impulses"));
  subdivide(*s, 7);
  run_until(*s, 0.01, [] {});
  Model& slow = s->models.list.front();
  double most = 0;
  for (int k = 0; k < 20; ++k) {
    const double dT_old = slow.step.dt_old;
    const auto n = s->models.list.back().step.n;
    const Motion before = motion_of(*s);
    advance(s->models);
    CHECK(s->models.list.back().step.n == n + 7);
    const Motion now = motion_of(*s);
    const Motion f = pushed(*s);
    const double T = 0.5 * (dT_old + slow.step.dt_old);
    most = std::max(most, f.p.norm());
    CHECK((now.p - before.p - T * f.p).norm() < 1e-12 * now.p.norm());
    CHECK((now.L - before.L - T * f.L).norm() < 1e-12 * now.L.norm());
  }
  CHECK(most > 100);
}

TEST_CASE("linked walls: held, the force acts through the substeps, its change at the level",
          "[physics]") {
  const auto s = make_simulation_of_text(meeting("held"));
  subdivide(*s, 7);
  run_until(*s, 0.01, [] {});
  const Step& slow = s->models.list.front().step;
  const Step& fast = s->models.list.back().step;
  for (int k = 0; k < 20; ++k) {
    const double dT_old = slow.dt_old;
    const double dt_old = fast.dt_old;
    const Motion before = motion_of(*s);
    const Motion f_old = pushed(*s);
    advance(s->models);
    const Motion now = motion_of(*s);
    const Motion f = pushed(*s);
    // f(n-1) dt_old/2 + (f(n) - f(n-1)) dT_old/2 + f(n) (dT - dt/2)
    const double of_old = 0.5 * (dt_old - dT_old);
    const double of_new = 0.5 * dT_old + slow.dt_old - 0.5 * fast.dt_old;
    CHECK((now.p - before.p - of_old * f_old.p - of_new * f.p).norm() < 1e-12 * now.p.norm());
    CHECK((now.L - before.L - of_old * f_old.L - of_new * f.L).norm() < 1e-12 * now.L.norm());
  }
}

TEST_CASE("linked walls: momentum of water and body is kept to rounding", "[physics]") {
  for (const char* scheme : {"impulses", "held"}) {
    const auto s = make_simulation_of_text(meeting(scheme));
    subdivide(*s, 10);
    const bool held = std::string(scheme) == "held";
    // A held force is ahead of the water's by (dT - dt)/2 of its last level.
    const auto ahead = [&] {
      return held ? 0.5 * (s->models.list.front().step.dt_old - s->models.list.back().step.dt_old)
                  : 0;
    };
    const auto linear = [&]() -> Vec3 {
      return linear_momentum(s->scene).sum - ahead() * pushed(*s).p;
    };
    const auto angular = [&]() -> Vec3 {
      const Motion f = pushed(*s);
      const Vec3 centre = xyz(s->scene.nodes.x[static_cast<std::size_t>(box_of(*s).node)]);
      return angular_momentum(s->scene).sum + box_of(*s).L - ahead() * (f.L + centre.cross(f.p));
    };
    const Vec3 p = linear();
    const Vec3 L = angular();
    const double p_scale = linear_momentum(s->scene).scale;
    const double L_scale = angular_momentum(s->scene).scale;
    double worst_p = 0;
    double worst_L = 0;
    double most_v = 0;
    run_until(*s, 0.1, [&] {
      worst_p = std::max(worst_p, (linear() - p).norm() / p_scale);
      worst_L = std::max(worst_L, (angular() - L).norm() / L_scale);
      most_v = std::max(most_v, measured(s->scene, "body.box.velocity", 1));
    });
    fmt::print("linked walls, {}: momentum {:.1e}, angular {:.1e}, energy {:.1e}, box at {:.2f}\n",
               scheme, worst_p, worst_L, energy_error(*s), most_v);
    CHECK(most_v > 1);
    CHECK(worst_p < 1e-12);
    CHECK(worst_L < 1e-9);
    CHECK(energy_error(*s) < 5e-3);
  }
}

TEST_CASE("linked walls: a box floats as in one model, at ratios of 10 and 50", "[physics]") {
  double draft_in_one = 0;
  for (const int n : {1, 10, 50}) {
    const auto s = make_simulation_of_text(floating(
        n > 1 ? "models: {sea: {parts: pool}, rest: {parts: box, slow_forces: held}}\n" : ""));
    if (n > 1) subdivide(*s, n);
    double draft = 0;
    double most_aside = 0;
    int samples = 0;
    run_until(*s, 2.0, [&] {
      most_aside = std::max(most_aside, std::abs(measured(s->scene, "body.box.position", 0)));
      if (time_of(*s) < 1.5) return;
      draft += 0.5 * (measured(s->scene, "probe.left") + measured(s->scene, "probe.right")) -
               (measured(s->scene, "body.box.position", 1) - 0.1);
      ++samples;
    });
    draft /= samples;
    if (n == 1) draft_in_one = draft;
    const double link = std::abs(ledger_sum(*s, "link"));
    const double external = std::abs(s->models.ledger.external());
    fmt::print(
        "box on walls, ratio {}: {} steps, draft {:.3f} mm, aside {:.1e} m, link {:.2e} of "
        "external work, energy {:.1e}\n",
        n, s->models.list.front().step.n, 1e3 * draft, most_aside, link / external,
        energy_error(*s));
    CHECK(draft == Approx(0.1).margin(1e-3));
    CHECK(draft == Approx(draft_in_one).margin(5e-6));
    CHECK(most_aside < 1e-9);
    CHECK(link < 3e-5 * external);
  }
}
