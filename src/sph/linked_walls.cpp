#include "sph/linked_walls.hpp"

#include "plan/effect.hpp"
#include "plan/linked_weight.hpp"
#include "sph/carried_walls.hpp"

namespace gannet {

namespace {

/// What the water does to the wall, onto the centre of the body.
void push_body(const Wall& wall, Scene& scene) {
  const auto c = static_cast<std::size_t>(wall.carrier->node);
  add_xyz(scene.nodes.f[c], wall.force);
  add_xyz(scene.nodes.torque[c], wall.moment);
}

/// Gives the particles of the wall the velocity of the way that the body went.
void follow_body(const Walls& walls, Wall& wall, Scene& scene, const Step& step) {
  const MeanRates mean = mean_rates(wall, scene, step.dt);
  follow_acceleration(wall, mean.v, mean.omega, 0.5 * (step.dt_old + step.dt));
  const Mat3 turn =
      (wall.carrier->q.toRotationMatrix() - wall.q_level.toRotationMatrix()) / step.dt;
  for_wall_particles(walls, scene, [&](Index k, const Wall& its) {
    if (&its != &wall) return;
    set_xyz(scene.nodes.v[static_cast<std::size_t>(scene.particles.begin + k)],
            mean.v + turn * xyz(walls.arm[k]));
  });
}

/// Adds what terms of the force take out of the motion of the wall in the half step after the
/// level, which nobody knew at the level. Before particles are sorted: f of terms is not.
void add_late_work(Walls& walls, Scene& scene, Models& models, Model& slow, const Wall& wall) {
  for (const WallTerm& term : walls.terms) {
    LedgerEntry& entry = models.ledger.entry(term.entry, wall.name);
    slow.plan.add_first({.name = std::string("work of ") + term.entry + " after the level",
                         .reason = asked_for_at(wall.where),
                         .stage = Stage::half_drift,
                         .reads = {"v"},
                         .run = [&](const Step& step) {
                           entry.pending -=
                               0.5 * step.dt * sum_over_awake(scene, wall.part, [&](Index k) {
                                 const auto i = static_cast<std::size_t>(scene.particles.begin + k);
                                 return xyz(term.f[k]).dot(xyz(scene.nodes.v[i]));
                               });
                         }});
  }
}

}  // namespace

MeanRates mean_rates(const Wall& wall, const Scene& scene, double dt) {
  const auto c = static_cast<std::size_t>(wall.carrier->node);
  const Nodes& nodes = scene.nodes;
  if (!(dt > 0)) return {xyz(nodes.v[c]), xyz(nodes.omega[c])};
  const Link& link = *wall.link;
  return {(xyz(nodes.x[c]) - xyz(link.x_level[0])) / dt, xyz(link.turned[0]) / dt};
}

void link_wall(Walls& walls, Scene& scene, Models& models, Wall& wall, Model& slow, Model& fast) {
  Link& link = walls.links.emplace_back();
  link.name = "walls " + wall.name;
  link.slow = &slow;
  link.fast = &fast;
  link.nodes = {wall.carrier->node};
  link.of_bodies = true;
  wall.link = &link;
  const std::string reason = asked_for_at(wall.where);
  open_link(scene, link);
  move_weights(scene, link, {wall.carrier->node});
  slow.plan.add({.name = "push of walls on body " + wall.name,
                 .reason = reason,
                 .stage = Stage::accelerate,
                 .writes = {"f"},
                 .run = [&](const Step&) { push_body(wall, scene); }});
  close_link(scene, link, models.ledger);
  add_late_work(walls, scene, models, slow, wall);
  slow.plan.add_first({.name = "motion of walls on body " + wall.name,
                       .reason = reason,
                       .stage = Stage::half_drift,
                       .reads = {"q", "x"},
                       .writes = {"v"},
                       .run = [&](const Step& step) { follow_body(walls, wall, scene, step); }});
}

}  // namespace gannet
