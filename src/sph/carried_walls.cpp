#include "sph/carried_walls.hpp"

#include <cmath>
#include <limits>

#include "plan/effect.hpp"
#include "sph/linked_walls.hpp"

namespace gannet {

namespace {

bool any_on_body(const Walls& walls) {
  return std::ranges::any_of(walls.list, [](const Wall& wall) { return wall.on_body; });
}

MeanRates rates_of(const Scene& scene, const Carrier& carrier) {
  const auto c = static_cast<std::size_t>(carrier.node);
  return {xyz(scene.nodes.v[c]), xyz(scene.nodes.omega[c])};
}

Vec3 moment_on(const Walls& walls, const Wall& wall, const Scene& scene) {
  const Mat3 R = wall.carrier->q.toRotationMatrix();
  return sum_over_awake(scene, wall.part, [&](Index k) -> Vec3 {
    return (R * xyz(walls.arm[k])).cross(xyz(walls.f[k]));
  });
}

void gather(Walls& walls, const SphState& sph, const Scene& scene, const Step& step) {
  for (Wall& wall : walls.list) {
    if (wall.carrier == nullptr) continue;
    wall.moment = moment_on(walls, wall, scene);
    wall.share = 1 / (2 + sph.m * wall.ease);
    const MeanRates before = wall.link != nullptr ? mean_rates(wall, scene, step.dt_old)
                                                  : rates_of(scene, *wall.carrier);
    wall.v_before = before.v;
    wall.omega_before = before.omega;
    wall.q_level = wall.carrier->q;
    if (wall.link != nullptr) continue;
    wall.carrier->force = wall.force;
    wall.carrier->moment = wall.moment;
  }
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
       .run = [&](const Step& step) { gather(walls, sph, scene, step); },
       .stable_dt = [&] { return stable_step_on_bodies(walls, sph); },
       .limited_by = [] { return "the mass of a body, beside that of the water at its skin"; }});
}

void follow_acceleration(Wall& wall, const Vec3& v, const Vec3& omega, double dt) {
  wall.a += wall.share * ((v - wall.v_before) / dt - wall.a);
  wall.alpha += wall.share * ((omega - wall.omega_before) / dt - wall.alpha);
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
    if (wall.carrier == nullptr || wall.link != nullptr) continue;
    const Carrier& carrier = *wall.carrier;
    const MeanRates now = rates_of(scene, carrier);
    motion[w] = {now.v,
                 (carrier.q_next.toRotationMatrix() - carrier.q.toRotationMatrix()) / step.dt};
    follow_acceleration(wall, now.v, now.omega, dt);
  }
  const auto first = static_cast<std::size_t>(scene.particles.begin);
  for_wall_particles(walls, scene, [&](Index k, const Wall& wall) {
    if (wall.carrier == nullptr || wall.link != nullptr) return;
    const Motion& m = motion[static_cast<std::size_t>(&wall - walls.list.data())];
    const std::size_t i = first + static_cast<std::size_t>(k);
    const Vec3 v = m.v + m.turn * xyz(walls.arm[k]);
    set_xyz(scene.nodes.f[i], (v - xyz(scene.nodes.v[i])) / dt);
    scene.nodes.v[i] = {v.x(), v.y(), v.z(), 1};
  });
}

}  // namespace gannet
