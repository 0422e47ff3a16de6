// The effect `mirror_walls`: a plane across an axis mirrors the water in front
// of it. Beyond the plane stand images of the particles near it, with the same
// density and pressure and the mirrored velocity, so that sums over neighbours
// are as complete at a wall as within the water:
//   x_image = x - 2 ((x - x_plane) . n) n,   v_image = v - 2 ((v - v_plane) . n) n
// Without them the water at a wall is pulled into the gap that the kernel finds
// there, and a tank at rest does not keep its pressure. Water and images
// together are symmetric about the plane: nothing flows through it, it does not
// hold back what slides along, and energy is kept as without it. The penalty of
// the plane (contact/planes.hpp) stays for what comes nearer than half a
// spacing. Planes that move along take their images with them
// (moving_walls.hpp); planes that turn mirror nothing. Where water sticks to a wall its images go
// the other way (sticking_walls.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "plan/effect.hpp"
#include "scene/tracked_values.hpp"
#include "sph/effects.hpp"
#include "sph/ghost_force.hpp"
#include "sph/moving_walls.hpp"
#include "sph/sph_state.hpp"
#include "sph/sticking_walls.hpp"

namespace gannet {

namespace {
namespace mirror_walls {

/// The axis that a plane mirrors across; -1 for one that leans or turns, which
/// only pushes, and for one that was asked to do without images.
int axis_of(const Plane& plane, const Scene& scene) {
  if (plane.turns || plane.behind != Behind::mirror) return -1;
  for (int d = 0; d < scene.dimension; ++d) {
    if (std::abs(plane.normal[d]) == 1) return d;
  }
  return -1;
}

/// Where walls were when images were made is state: a restart makes the same.
void track_walls(Halo& halo, Scene& scene) {
  track_values(scene, "mirror_walls", "halo.low", "m", 3, [&halo] { return halo.low.data(); });
  track_values(scene, "mirror_walls", "halo.high", "m", 3, [&halo] { return halo.high.data(); });
}

/// The plane that mirrors at an end of a direction: the innermost one at the
/// start. Walls that move are noted.
void note_moving_walls(Halo& halo, Scene& scene) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const int d = axis_of(plane, scene);
    if (!plane.moves || d < 0 || halo.periodic[static_cast<std::size_t>(d)]) continue;
    const bool lower = plane.normal[d] > 0;
    if ((lower ? halo.low : halo.high)[d] != plane.point[d]) continue;
    const bool known = std::ranges::any_of(
        halo.moving, [&](const MirrorWall& wall) { return wall.axis == d && wall.lower == lower; });
    if (!known) halo.moving.push_back({d, lower, k});
  }
  if (!halo.moving.empty()) track_walls(halo, scene);
}

/// The end of a direction where a plane mirrors; nothing for one that does not.
/// At the start: walls that move are then where their planes are.
std::optional<MirrorWall> mirrored_at(const Halo& halo, const Scene& scene, std::size_t k) {
  const Plane& plane = scene.planes[k];
  const int d = axis_of(plane, scene);
  if (d < 0) return std::nullopt;
  const bool lower = plane.normal[d] > 0;
  const bool wall = (lower ? halo.wall_low : halo.wall_high)[static_cast<std::size_t>(d)];
  if (!wall || (lower ? halo.low : halo.high)[d] != plane.point[d]) return std::nullopt;
  return MirrorWall{d, lower, k};
}

/// The boundary that a plane belongs to: "basin" of "basin.x_min".
Keys boundary_of(const Keys& root, const Plane& plane) {
  return root.map("boundaries").map(plane.name.substr(0, plane.name.find('.')));
}

void note_sticking_walls(const Keys& root, Halo& halo, const Scene& scene) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    if (plane.slips || plane.behind != Behind::mirror) continue;
    const auto wall = mirrored_at(halo, scene, k);
    if (wall) {
      halo.sticking.push_back(*wall);
    } else {
      boundary_of(root, plane)
          .complain("slip", "nothing is mirrored at '" + plane.name +
                                "' (it leans, turns, lies behind another or in a periodic "
                                "direction): say walls: dummy");
    }
  }
}

/// The innermost plane of each end of a direction mirrors.
void make_state(const Keys& root, Scene& scene) {
  if (scene.particles.empty()) return;
  Halo& halo = scene.store.get<SphState>().halo;
  for (const Plane& plane : scene.planes) {
    const int d = axis_of(plane, scene);
    if (d < 0 || halo.periodic[static_cast<std::size_t>(d)]) continue;
    const bool lower = plane.normal[d] > 0;
    bool& wall = (lower ? halo.wall_low : halo.wall_high)[static_cast<std::size_t>(d)];
    double& at = (lower ? halo.low : halo.high)[d];
    const double here = plane.point[d];
    at = !wall ? here : (lower ? std::max(at, here) : std::min(at, here));
    wall = true;
  }
  note_moving_walls(halo, scene);
  note_sticking_walls(root, halo, scene);
}

bool sticks(const Halo& halo, const MirrorWall& wall) {
  return std::ranges::any_of(halo.sticking,
                             [&](const MirrorWall& other) { return other.plane == wall.plane; });
}

/// Force of the water on a mirror wall, the reaction to that of its images. Along a wall to slide
/// along the images pull as much one way as the other.
GhostForce force_on_wall(SphState& sph, Scene& scene, const MirrorWall& wall) {
  std::vector<char> behind;
  for (const ImageKind& kind : sph.halo.kinds) {
    behind.push_back(is_behind(sph.halo, wall, kind.image) ? 1 : 0);
  }
  const GhostForce on_water = force_of_ghosts(sph, scene, behind);
  Vec3 felt = Vec3::Ones();
  if (!sticks(sph.halo, wall)) felt = Vec3::Unit(wall.axis);
  return {-felt.cwiseProduct(on_water.total), -felt.cwiseProduct(on_water.viscous)};
}

/// The work that the motion of a wall takes: the pressure of its images on the
/// water along its own path.
void add_work(const SphState& sph, Scene& scene, Models& models, const MirrorWall& wall) {
  const Plane& plane = scene.planes[wall.plane];
  LedgerEntry& work = models.ledger.entry("moving mirror", plane.name);
  work.external = true;
  models.of_node(scene.particles.begin)
      .plan.add({.name = "work of mirror " + plane.name,
                 .reason = asked_for_at(plane.where),
                 .stage = Stage::look,
                 .reads = {"x", "rho", "p"},
                 .run = [&sph, &scene, &work, wall](const Step& step) {
                   const Plane& now = scene.planes[wall.plane];
                   const double force = force_of_images(sph, scene, wall);
                   work.add_work({0.5 * step.dt_old * force * now.velocity_old[wall.axis],
                                  0.5 * step.dt * force * now.velocity[wall.axis]});
                 }});
}

/// What a wall that moves and that water sticks to puts in by its viscous force: from outside, and
/// into what the viscous terms take, which is measured on the water alone.
void add_viscous_work(SphState& sph, Scene& scene, Models& models, const MirrorWall& wall) {
  const Plane& plane = scene.planes[wall.plane];
  LedgerEntry& outside = models.ledger.entry("mirror drag", plane.name);
  outside.external = true;
  const char* term = sph.f_laminar.empty() ? "artificial_viscosity" : "laminar_viscosity";
  LedgerEntry& taken = models.ledger.entry(term, plane.name);
  models.of_node(scene.particles.begin)
      .plan.add({.name = "viscous work of mirror " + plane.name,
                 .reason = asked_for_at(plane.where),
                 .stage = Stage::look,
                 .reads = {"x", "v", "rho"},
                 .run = [&sph, &scene, &outside, &taken, wall](const Step& step) {
                   const Plane& now = scene.planes[wall.plane];
                   const Vec3 force = -force_on_wall(sph, scene, wall).viscous;
                   const Work work{0.5 * step.dt_old * force.dot(now.velocity_old),
                                   0.5 * step.dt * force.dot(now.velocity)};
                   outside.add_work(work);
                   taken.add_work(work);
                 }});
}

/// Images go with walls that move, after every copy to them.
void add_moving_walls(SphState& sph, Scene& scene, Models& models) {
  Plan& plan = models.of_node(scene.particles.begin).plan;
  for (const Stage stage : {Stage::half_drift, Stage::rates, Stage::drift}) {
    plan.add({.name = fmt::format("mirror: images go with their walls after {}", name_of(stage)),
              .reason = "rule: walls across an axis mirror the water, also while they move",
              .stage = stage,
              .reads = {"planes", "x", "v"},
              .writes = {"ghosts"},
              .run = [&sph, &scene](const Step&) { move_images(sph.halo, scene); }});
  }
  for (const MirrorWall& wall : sph.halo.moving) {
    add_work(sph, scene, models, wall);
    const bool viscous = !sph.f_viscous.empty() || !sph.f_laminar.empty();
    if (viscous && sticks(sph.halo, wall)) add_viscous_work(sph, scene, models, wall);
  }
}

/// Images behind walls that water sticks to, as the force pass of the next step sees them.
void add_sticking_walls(const SphState& sph, Scene& scene, Models& models) {
  const Plane& plane = scene.planes[sph.halo.sticking.front().plane];
  models.of_node(scene.particles.begin)
      .plan.add({.name = "mirror: water sticks to walls",
                 .reason = asked_for_at(plane.where),
                 .stage = Stage::drift,
                 .reads = {"v"},
                 .writes = {"ghosts"},
                 .run = [&sph, &scene](const Step&) { stick_images(sph.halo, scene); }});
}

/// What the planes already measure is the force of their penalty: adds that of the images.
void add_measures(SphState& sph, Scene& scene, const MirrorWall& wall) {
  const std::string name = "plane." + scene.planes[wall.plane].name;
  for (Measure& m : scene.measures) {
    if (m.name != name + ".force") continue;
    m.sample = [&sph, &scene, wall, penalty = m.sample](double* out) {
      penalty(out);
      const Vec3 force = force_on_wall(sph, scene, wall).total;
      for (int d = 0; d < 3; ++d) out[d] += force[d];
    };
  }
  if (sph.f_viscous.empty() && sph.f_laminar.empty()) return;
  scene.measures.push_back({.name = name + ".viscous_force",
                            .unit = "N",
                            .components = {"x", "y", "z"},
                            .sample = [&sph, &scene, wall](double* out) {
                              const Vec3 force = force_on_wall(sph, scene, wall).viscous;
                              for (int d = 0; d < 3; ++d) out[d] = force[d];
                            }});
}

void add_operations(const Keys&, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  SphState& sph = scene.store.get<SphState>();
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const auto wall = mirrored_at(sph.halo, scene, k);
    if (wall) add_measures(sph, scene, *wall);
  }
  if (!sph.halo.moving.empty()) add_moving_walls(sph, scene, models);
  if (!sph.halo.sticking.empty()) add_sticking_walls(sph, scene, models);
}

bool stands_across_an_axis(const Plane& plane, const Scene& scene) {
  Plane mirror = plane;
  mirror.behind = Behind::mirror;
  return axis_of(mirror, scene) >= 0;
}

/// Automatic where no boundary says `walls`.
Presence presence(const Keys& root, Scene& scene) {
  using State = Presence::State;
  if (scene.particles.empty()) return {State::off, "no part is made of particles"};
  const Halo& halo = scene.store.get<SphState>().halo;
  std::size_t n = 0;
  std::string asked;
  std::string refused;
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const Keys boundary = boundary_of(root, plane);
    const bool mirrors = mirrored_at(halo, scene, k).has_value();
    if (mirrors) ++n;
    if (!boundary.given("walls") || !stands_across_an_axis(plane, scene)) continue;
    std::string& place = mirrors ? asked : refused;
    if (place.empty()) {
      place = fmt::format("{}.walls: {} at {}", boundary.path(), boundary.word("walls"),
                          boundary.where("walls").text());
    }
  }
  if (n == 0) return {State::off, refused.empty() ? "no plane stands across an axis" : refused};
  if (!asked.empty()) return {State::on, asked};
  return {State::automatic, fmt::format("rule: {} planes across an axis mirror the water", n)};
}

/// What stands behind planes, where the boundary does not say.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (scene.particles.empty()) return list;
  for (const Plane& plane : scene.planes) {
    const Keys boundary = boundary_of(root, plane);
    const std::string key = boundary.path() + ".walls";
    if (boundary.given("walls") || !stands_across_an_axis(plane, scene)) continue;
    if (!list.empty() && list.back().key == key) continue;
    list.push_back({key, "mirror", "planes across an axis mirror the water (or: dummy, contact)"});
  }
  return list;
}

}  // namespace mirror_walls
}  // namespace

Effect mirror_walls_effect() {
  return {.name = "mirror_walls",
          .state = mirror_walls::make_state,
          .operations = mirror_walls::add_operations,
          .presence = mirror_walls::presence,
          .choices = mirror_walls::choices};
}

}  // namespace gannet
