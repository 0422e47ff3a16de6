#include "sph/carried_walls.hpp"

#include <cmath>
#include <limits>

#include "plan/effect.hpp"

namespace gannet {

namespace {

bool any_on_body(const Walls& walls) {
  return std::ranges::any_of(walls.list, [](const Wall& wall) { return wall.on_body; });
}

/// What the centre moved with before the kick: {velocity, angular velocity}.
struct Rates {
  Vec3 v;
  Vec3 omega;
};

Rates rates_of(const Scene& scene, const Carrier& carrier) {
  const auto c = static_cast<std::size_t>(carrier.node);
  return {xyz(scene.nodes.v[c]), xyz(scene.nodes.omega[c])};
}

void gather(Walls& walls, const SphState& sph, const Scene& scene) {
  struct Sum {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
  };
  for (Wall& wall : walls.list) {
    if (wall.carrier == nullptr) continue;
    const Mat3 R = wall.carrier->q.toRotationMatrix();
    wall.carrier->force = wall.force;
    wall.carrier->moment = sum_over_awake(scene, wall.part, [&](Index k) -> Vec3 {
      return (R * xyz(walls.arm[k])).cross(xyz(walls.f[k]));
    });
    wall.share = 1 / (2 + sph.m * wall.ease);
    const Rates before = rates_of(scene, *wall.carrier);
    wall.v_before = before.v;
    wall.omega_before = before.omega;
  }
}

/// Takes part of what the last kick did into the acceleration that pressures follow.
void follow_acceleration(Wall& wall, const Scene& scene, double dt) {
  const Rates now = rates_of(scene, *wall.carrier);
  wall.a += wall.share * ((now.v - wall.v_before) / dt - wall.a);
  wall.alpha += wall.share * ((now.omega - wall.omega_before) / dt - wall.alpha);
}

double stable_step_on_bodies(const Walls& walls, const SphState& sph) {
  double largest = 0;
  for (const Wall& wall : walls.list) {
    if (wall.carrier == nullptr) continue;
    const double stiffness = sph.m * std::pow(sph.c0 / sph.dx, 2) / wall.n_layers;
    largest = std::max(largest, stiffness * wall.ease);
  }
  return largest > 0 ? 4.0 / std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

}  // namespace

void note_ease(Walls& walls, const Scene& scene) {
  if (walls.arm.empty()) return;
  for (Wall& wall : walls.list) wall.ease = 0;
  for (std::size_t c = 0; c < walls.clusters.size(); ++c) {
    for (Index lane = 0; lane < ClusterList::lanes; ++lane) {
      const Index k = ClusterList::lanes * walls.clusters[c] + lane;
      if (k >= scene.particles.size()) break;
      const WallSums& sums = walls.sums[ClusterList::lanes * c + static_cast<std::size_t>(lane)];
      const int w = walls.of_part[static_cast<std::size_t>(scene.particle_part[k])];
      if (w < 0 || !(sums.W > 0)) continue;
      Wall& wall = walls.list[static_cast<std::size_t>(w)];
      if (wall.carrier != nullptr) wall.ease += wall.carrier->inverse_mass_at(xyz(walls.arm[k]));
    }
  }
}

void add_gathering(Walls& walls, SphState& sph, Scene& scene, Plan& plan) {
  if (!any_on_body(walls)) return;
  const auto first = std::ranges::find(walls.list, true, &Wall::on_body);
  plan.add(
      {.name = "force of walls on their bodies",
       .reason = asked_for_at(first->where),
       .stage = Stage::accelerate,
       .reads = {"x", "q"},
       .run = [&](const Step&) { gather(walls, sph, scene); },
       .stable_dt = [&] { return stable_step_on_bodies(walls, sph); },
       .limited_by = [] { return "the mass of a body, beside that of the water at its skin"; }});
}

Vec3 acceleration_on_body(const Wall& wall, const Scene& scene, const Vec3& arm) {
  const Vec3 r = wall.carrier->q * arm;
  const Vec3 omega = rates_of(scene, *wall.carrier).omega;
  return wall.a + wall.alpha.cross(r) + omega.cross(omega.cross(r));
}

void kick_carried_walls(Walls& walls, Scene& scene, const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  struct Motion {
    Vec3 v;
    Mat3 turn;
  };
  std::vector<Motion> motion(walls.list.size());
  for (std::size_t w = 0; w < walls.list.size(); ++w) {
    Wall& wall = walls.list[w];
    if (wall.carrier == nullptr) continue;
    const Carrier& carrier = *wall.carrier;
    motion[w] = {rates_of(scene, carrier).v,
                 (carrier.q_next.toRotationMatrix() - carrier.q.toRotationMatrix()) / step.dt};
    follow_acceleration(wall, scene, dt);
  }
  const auto first = static_cast<std::size_t>(scene.particles.begin);
  for_wall_particles(walls, scene, [&](Index k, const Wall& wall) {
    if (wall.carrier == nullptr) return;
    const Motion& m = motion[static_cast<std::size_t>(&wall - walls.list.data())];
    const std::size_t i = first + static_cast<std::size_t>(k);
    const Vec3 v = m.v + m.turn * xyz(walls.arm[k]);
    set_xyz(scene.nodes.f[i], (v - xyz(scene.nodes.v[i])) / dt);
    scene.nodes.v[i] = {v.x(), v.y(), v.z(), 1};
  });
}

}  // namespace gannet
