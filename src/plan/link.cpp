#include "plan/link.hpp"

#include <algorithm>

#include "scene/bonds.hpp"

namespace gannet {

namespace {

bool same_level(const Link& link) { return link.slow->step.t == link.fast->step.t; }

/// Gives the nodes their mean velocities over the slow model's last step.
void lend_mean_velocities(Nodes& nodes, Link& link) {
  const double dT = link.slow->step.dt_old;
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    link.v_kept[k] = nodes.v[i];
    if (dT > 0) set_xyz(nodes.v[i], (xyz(nodes.x[i]) - xyz(link.x_level[k])) / dT);
    if (!nodes.rotating.contains(i)) continue;
    link.omega_kept[k] = nodes.omega[i];
    if (dT > 0) set_xyz(nodes.omega[i], xyz(link.turned[k]) / dT);
  }
}

void give_velocities_back(Nodes& nodes, const Link& link) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    set_xyz(nodes.v[i], xyz(link.v_kept[k]));
    if (nodes.rotating.contains(i)) set_xyz(nodes.omega[i], xyz(link.omega_kept[k]));
  }
}

void add_turns(const Nodes& nodes, Link& link) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    if (nodes.rotating.contains(i)) {
      add_xyz(link.turned[k], link.fast->step.dt * xyz(nodes.omega[i]));
    }
  }
}

/// Adds the work of the moments along the turns since the last level.
void collect_turns(const Nodes& nodes, Link& link, LedgerEntry& entry) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    if (!nodes.rotating.contains(link.nodes[k])) continue;
    const Vec3 mean = 0.5 * (xyz(link.moment[k]) + xyz(link.moment_level[k]));
    if (link.slow->step.dt_old > 0) entry.value += mean.dot(xyz(link.turned[k]));
    set_xyz(link.turned[k], Vec3::Zero());
  }
}

void clear_nodes(Nodes& nodes, const Link& link) {
  for (const Index i : link.nodes) {
    nodes.f[i] = {};
    if (nodes.rotating.contains(i)) set_xyz(nodes.torque[i], Vec3::Zero());
  }
}

/// Keeps what the fast model has put on bodies so far.
void keep_forces(const Nodes& nodes, Link& link) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    link.f_kept[k] = nodes.f[link.nodes[k]];
    link.torque_kept[k] = nodes.torque[link.nodes[k]];
  }
}

void give_forces_back(Nodes& nodes, const Link& link) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    nodes.f[link.nodes[k]] = link.f_kept[k];
    set_xyz(nodes.torque[link.nodes[k]], xyz(link.torque_kept[k]));
  }
}

/// Moves the forces that the slow model put on the linked nodes to the slow slot, and adds their
/// work along the path since the last level.
void collect(Nodes& nodes, Link& link, LedgerEntry& entry) {
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    link.force[k] = nodes.f[i];
    if (nodes.rotating.contains(i)) set_xyz(link.moment[k], xyz(nodes.torque[i]));
    const Vec3 f = xyz(link.force[k]);
    const Vec3 x = xyz(nodes.x[i]);
    if (link.held) {
      link.force_old[k] = link.f_level[k];
      link.moment_old[k] = link.moment_level[k];
    }
    link.path[k] = {};
    if (link.slow->step.dt_old > 0) {
      set_xyz(link.path[k], x - xyz(link.x_level[k]));
      entry.value += 0.5 * (f + xyz(link.f_level[k])).dot(x - xyz(link.x_level[k]));
    }
    set_xyz(link.x_level[k], x);
    set_xyz(link.f_level[k], f);
  }
  clear_nodes(nodes, link);
  if (link.turns()) collect_turns(nodes, link, entry);
  for (std::size_t k = 0; k < link.moment_level.size(); ++k) {
    set_xyz(link.moment_level[k], xyz(link.moment[k]));
  }
  if (link.of_elements) give_velocities_back(nodes, link);
  if (link.of_bodies) give_forces_back(nodes, link);
}

/// What a held force, `now` at the last level of the slow model and `before` at the one before it,
/// is in this kick of the fast model beyond `now`: nothing between levels.
Vec3 beyond_held(const Link& link, const Vec3& before, const Vec3& now) {
  if (!same_level(link)) return Vec3::Zero();
  const Step& fast = link.fast->step;
  const double dT_old = link.slow->step.dt_old;
  return (dT_old - fast.dt_old) / (fast.dt_old + fast.dt) * (now - before);
}

void apply_held(Nodes& nodes, Link& link) {
  link.ratio = 1;
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    const Vec3 f = xyz(link.force[k]);
    set_xyz(link.beyond[k], beyond_held(link, xyz(link.force_old[k]), f));
    add_xyz(nodes.f[i], f + xyz(link.beyond[k]));
    if (!nodes.rotating.contains(i)) continue;
    const Vec3 moment = xyz(link.moment[k]);
    set_xyz(link.moment_beyond[k], beyond_held(link, xyz(link.moment_old[k]), moment));
    add_xyz(nodes.torque[i], moment + xyz(link.moment_beyond[k]));
  }
}

void apply(Nodes& nodes, Link& link) {
  if (link.of_bodies) {
    for (std::size_t k = 0; k < link.nodes.size(); ++k) {
      link.omega_kept[k] = nodes.omega[link.nodes[k]];
    }
  }
  if (link.held) return apply_held(nodes, link);
  link.ratio = 0;
  if (!same_level(link)) return;
  const Step& slow = link.slow->step;
  const Step& fast = link.fast->step;
  link.ratio = (slow.dt_old + slow.dt) / (fast.dt_old + fast.dt);
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Index i = link.nodes[k];
    add_xyz(nodes.f[i], link.ratio * xyz(link.force[k]));
    if (nodes.rotating.contains(i)) add_xyz(nodes.torque[i], link.ratio * xyz(link.moment[k]));
  }
}

/// What a body turns by in the half steps before and after this level [rad].
WorkPath turn_of_body(const Nodes& nodes, const Link& link, std::size_t k) {
  WorkPath turn;
  turn.col(0) = 0.5 * link.fast->step.dt_old * xyz(link.omega_kept[k]);
  turn.col(1) = 0.5 * link.fast->step.dt * xyz(nodes.omega[link.nodes[k]]);
  return turn;
}

/// Takes off the work of held forces, which act at every level of the fast model.
void measure_held(const Nodes& nodes, const Link& link, LedgerEntry& entry) {
  Work work = Work::Zero();
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Vec3 f = xyz(link.force[k]) + xyz(link.beyond[k]);
    work += work_along(work_path(nodes, link.nodes[k], link.fast->step), f);
    if (!link.of_bodies) continue;
    work +=
        work_along(turn_of_body(nodes, link, k), xyz(link.moment[k]) + xyz(link.moment_beyond[k]));
  }
  entry.add_work(-work);
}

/// Angular velocity at a coinciding level, after the kick [rad/s].
Vec3 omega_at_level(const Nodes& nodes, const Link& link, std::size_t k) {
  const auto i = static_cast<std::size_t>(link.nodes[k]);
  const Step& fast = link.fast->step;
  if (link.of_bodies) {
    return (fast.dt * xyz(link.omega_kept[k]) + fast.dt_old * xyz(nodes.omega[i])) /
           (fast.dt_old + fast.dt);
  }
  const double half = 0.5 * fast.dt * nodes.omega[i].w;
  return xyz(nodes.omega[i]) - half * xyz(nodes.torque[i]);
}

/// Takes off the work of the impulses at a coinciding level. The kinetic energy at level n is taken
/// in the middle of the kick, so the impulse counts half before the level and half after it.
void measure(const Nodes& nodes, const Link& link, LedgerEntry& entry) {
  if (link.held) return measure_held(nodes, link, entry);
  if (!same_level(link)) return;
  const Step& slow = link.slow->step;
  double work = 0;
  for (std::size_t k = 0; k < link.nodes.size(); ++k) {
    const Vec3 v = velocity_at_level(nodes, link.nodes[k], link.fast->step.dt);
    work += xyz(link.force[k]).dot(v);
    if (!link.turns() || !nodes.rotating.contains(link.nodes[k])) continue;
    work += xyz(link.moment[k]).dot(omega_at_level(nodes, link, k));
  }
  entry.add_work(-0.5 * work * Work(slow.dt_old, slow.dt));
}

}  // namespace

namespace {

Vec3 excess_at(const Link& link, std::size_t k) {
  return link.held ? xyz(link.beyond[k]) : (link.ratio - 1) * xyz(link.force[k]);
}

}  // namespace

Excess excess_of_impulses(const Scene& scene, const Vec3& about,
                          const std::function<bool(Index)>& counts) {
  Excess excess;
  const Links* links = scene.store.find<Links>();
  if (links == nullptr) return excess;
  for (const Link* link : links->list) {
    if (link->ratio == 0) continue;
    for (std::size_t k = 0; k < link->nodes.size(); ++k) {
      const Index i = link->nodes[k];
      if (!counts(i)) continue;
      const Vec3 f = excess_at(*link, k);
      const Vec3 arm = xyz(scene.nodes.x[static_cast<std::size_t>(i)]) - about;
      excess.force += f;
      excess.moment += arm.cross(f) + (link->held ? xyz(link->moment_beyond[k])
                                                  : (link->ratio - 1) * xyz(link->moment[k]));
    }
  }
  return excess;
}

Vec3 excess_on_node(const Scene& scene, Index node) {
  Vec3 excess = Vec3::Zero();
  const Links* links = scene.store.find<Links>();
  if (links == nullptr) return excess;
  for (const Link* link : links->list) {
    const auto found = std::lower_bound(link->places.begin(), link->places.end(),
                                        std::pair<Index, std::size_t>{node, 0});
    if (found == link->places.end() || found->first != node) continue;
    excess += excess_at(*link, found->second);
  }
  return excess;
}

namespace {

bool holds_forces(const Scene& scene, const Model& fast) {
  const Bonds* bonds = scene.store.find<Bonds>();
  return bonds != nullptr &&
         std::find(bonds->holding.begin(), bonds->holding.end(), fast.name) != bonds->holding.end();
}

}  // namespace

void open_link(Scene& scene, Link& link) {
  scene.store.get<Links>().list.push_back(&link);
  const std::size_t n = link.nodes.size();
  link.force.assign(n, {});
  link.moment.assign(n, {});
  link.x_level.assign(n, {});
  link.f_level.assign(n, {});
  link.path.assign(n, {});
  const auto track = [&](const char* what, const char* unit, Array<Line>& lines) {
    Field f = line_field("link." + link.name + "." + what, unit, "", Over::scene, lines, 0, 4,
                         GhostRule::none);
    f.owner = "link " + link.name;
    scene.fields.push_back(std::move(f));
  };
  track("x_level", "m", link.x_level);
  track("f_level", "N", link.f_level);
  for (std::size_t k = 0; k < n; ++k) link.places.emplace_back(link.nodes[k], k);
  std::sort(link.places.begin(), link.places.end());
  const auto make = [n](std::initializer_list<Array<Line>*> arrays) {
    for (Array<Line>* lines : arrays) lines->assign(n, {});
  };
  link.held = !link.of_elements && holds_forces(scene, *link.fast);
  if (link.held) make({&link.force_old, &link.moment_old, &link.beyond, &link.moment_beyond});
  if (link.of_elements) make({&link.v_kept, &link.omega_kept});
  if (link.of_bodies) make({&link.omega_kept, &link.f_kept, &link.torque_kept});
  if (link.held || link.turns()) {
    make({&link.moment_level});
    track("moment_level", "N m", link.moment_level);
  }
  if (link.turns()) {
    make({&link.turned});
    track("turned", "rad", link.turned);
    link.fast->plan.add({.name = "turns of link " + link.name,
                         .reason = "what model " + link.slow->name + " pushes turns with its nodes",
                         .stage = Stage::drift,
                         .reads = {"omega"},
                         .run = [&scene, &link](const Step&) { add_turns(scene.nodes, link); }});
  }
  link.slow->plan.add({.name = "clear link " + link.name,
                       .reason = "the nodes belong to model " + link.fast->name,
                       .stage = link.stage(),
                       .writes = {"f"},
                       .run = [&scene, &link](const Step&) {
                         if (link.of_bodies) keep_forces(scene.nodes, link);
                         clear_nodes(scene.nodes, link);
                         if (link.of_elements) lend_mean_velocities(scene.nodes, link);
                       }});
}

void close_link(Scene& scene, Link& link, Ledger& ledger) {
  const std::string reason =
      "links model " + link.slow->name + " to the faster model " + link.fast->name;
  LedgerEntry& entry = ledger.entry("link", link.name);
  link.slow->plan.add(
      {.name = "collect link " + link.name,
       .reason = reason,
       .stage = link.stage(),
       .reads = {"f", "x"},
       .owns = {"link." + link.name},
       .run = [&scene, &link, &entry](const Step&) { collect(scene.nodes, link, entry); }});
  // Before anything there looks at forces that are whole.
  link.fast->plan.add_first({.name = "apply link " + link.name,
                             .reason = reason,
                             .stage = Stage::accelerate,
                             .writes = {"f"},
                             .run = [&scene, &link](const Step&) { apply(scene.nodes, link); }});
  link.fast->plan.add(
      {.name = "link energy " + link.name,
       .reason = reason,
       .stage = Stage::look,
       .reads = {"v"},
       .run = [&scene, &link, &entry](const Step&) { measure(scene.nodes, link, entry); }});
}

}  // namespace gannet
