#include "sph/moving_gauges.hpp"

#include <algorithm>

#include "scene/tracked_values.hpp"

namespace gannet {

namespace {

/// The wall of a part, or the plane or the first plane of a boundary of that name.
bool find_wall(const std::string& on, Scene& scene, Wall& wall) {
  if (scene.store.has<Walls>()) {
    const Walls& walls = scene.store.get<Walls>();
    const auto found = std::ranges::find(walls.list, on, &Wall::name);
    if (found != walls.list.end()) {
      wall = *found;
      return true;
    }
  }
  const auto plane = std::ranges::find_if(
      scene.planes, [&](const Plane& p) { return p.name == on || p.name.starts_with(on + "."); });
  if (plane == scene.planes.end()) return false;
  wall.plane = static_cast<int>(plane - scene.planes.begin());
  return true;
}

}  // namespace

MovingGauge* gauge_on_wall(const std::string& name, const std::string& on, const Vec3& x,
                           Scene& scene) {
  Wall wall;
  if (!find_wall(on, scene, wall)) return nullptr;
  auto& list = scene.store.get<MovingGauges>().list;
  list.push_back({.name = name, .wall = std::move(wall), .x = x});
  MovingGauge& gauge = list.back();
  if (moves(gauge.wall, scene)) {
    track_values(scene, "moving gauges", "gauge." + name, "m", 3,
                 [&gauge] { return gauge.x.data(); });
  }
  return &gauge;
}

void add_gauge_motion(Scene& scene, Models& models) {
  if (!scene.store.has<MovingGauges>()) return;
  Plan& plan = models.of_node(scene.particles.begin).plan;
  for (MovingGauge& gauge : scene.store.get<MovingGauges>().list) {
    if (!moves(gauge.wall, scene)) continue;
    const std::string reason = "rule: the gauge sits on a wall that moves";
    plan.add({.name = "velocity of gauge " + gauge.name,
              .reason = reason,
              .stage = Stage::kick,
              .reads = {"planes"},
              .run = [&](const Step& step) {
                gauge.v = mean_velocity(gauge.wall, scene, gauge.x, step);
              }});
    plan.add({.name = "new place of gauge " + gauge.name,
              .reason = reason,
              .stage = Stage::drift,
              .run = [&](const Step& step) { gauge.x += step.dt * gauge.v; }});
  }
}

}  // namespace gannet
