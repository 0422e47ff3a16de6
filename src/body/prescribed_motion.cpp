#include "body/prescribed_motion.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "plan/effect.hpp"
#include "plan/link.hpp"

namespace gannet {

namespace {

constexpr Index chunk = 1024;
constexpr std::uint8_t rotations = 0b111000;

/// Sets the masked components of `rate` (v or omega; w: 1/m or 1/I) and returns what it took;
/// `bits`: three bits, `wanted`: three values.
Vec3 constrain(Line& rate, unsigned bits, const double* wanted, double dt) {
  Vec3 reaction = Vec3::Zero();
  Vec3 now = xyz(rate);
  for (int d = 0; d < 3; ++d) {
    if ((bits >> d & 1u) == 0) continue;
    reaction[d] = (wanted[d] - now[d]) / (rate.w * dt);
    now[d] = wanted[d];
  }
  set_xyz(rate, now);
  return reaction;
}

template <class F>
void for_entries(const std::vector<Index>& entries, F&& f) {
  parallel_for(static_cast<Index>(entries.size()), chunk, [&](Index a, Index b) {
    for (Index e = a; e < b; ++e) f(static_cast<std::size_t>(entries[static_cast<std::size_t>(e)]));
  });
}

}  // namespace

WorkPath rotation_path(const Nodes& nodes, Index i, const Step& step) {
  const Line& omega = nodes.omega[static_cast<std::size_t>(i)];
  const Vec3 a = xyz(nodes.torque[static_cast<std::size_t>(i)]) * omega.w;
  WorkPath path;
  path.col(0) = (xyz(omega) - a * (0.5 * (step.dt_old + step.dt))) * (0.5 * step.dt_old);
  path.col(1) = xyz(omega) * (0.5 * step.dt);
  return path;
}

void kick_prescribed(PrescribedMotion& motion, const std::vector<Index>& entries, Nodes& nodes,
                     const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  std::array<double, 6> wanted;
  for (std::size_t d = 0; d < 6; ++d) {
    wanted[d] = mean_over(motion.rate[d], step.t, step.t + step.dt);
  }
  for_entries(entries, [&](std::size_t k) {
    const auto i = static_cast<std::size_t>(motion.nodes[k]);
    const Vec3 force = constrain(nodes.v[i], motion.mask[k] & 7u, wanted.data(), dt);
    add_xyz(nodes.f[i], force);
    set_xyz(motion.reaction[k], force);
    if ((motion.mask[k] & rotations) == 0) return;
    const Vec3 couple = constrain(nodes.omega[i], motion.mask[k] >> 3, wanted.data() + 3, dt);
    add_xyz(nodes.torque[i], couple);
    set_xyz(motion.couple[k], couple);
  });
}

Work work_of_reactions(const PrescribedMotion& motion, const std::vector<Index>& entries,
                       const Nodes& nodes, const Step& step) {
  const Work none = Work::Zero();
  return parallel_sum(static_cast<Index>(entries.size()), chunk, none, [&](Index a, Index b) {
    Work work = none;
    for (Index e = a; e < b; ++e) {
      const auto k = static_cast<std::size_t>(entries[static_cast<std::size_t>(e)]);
      const Index i = motion.nodes[k];
      work += work_along(work_path(nodes, i, step), xyz(motion.reaction[k]));
      if ((motion.mask[k] & rotations) == 0) continue;
      work += work_along(rotation_path(nodes, i, step), xyz(motion.couple[k]));
    }
    return work;
  });
}

Vec3 reaction_force(const PrescribedMotion& motion) {
  Vec3 sum = Vec3::Zero();
  for (const Line& r : motion.reaction) sum += xyz(r);
  return sum;
}

Vec3 reaction_moment(const PrescribedMotion& motion, const Nodes& nodes) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < motion.nodes.size(); ++k) {
    const Vec3 x = xyz(nodes.x[static_cast<std::size_t>(motion.nodes[k])]);
    sum += x.cross(xyz(motion.reaction[k])) + xyz(motion.couple[k]);
  }
  return sum;
}

void set_velocities(const PrescribedMotion& motion, Nodes& nodes, double t) {
  std::array<double, 6> rates;
  for (std::size_t d = 0; d < 6; ++d) rates[d] = value_at(motion.rate[d], t);
  for (std::size_t k = 0; k < motion.nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(motion.nodes[k]);
    const unsigned mask = motion.mask[k];
    for (unsigned d = 0; d < 6; ++d) {
      if ((mask >> d & 1u) == 0) continue;
      Line& line = d < 3 ? nodes.v[i] : nodes.omega[i];
      Vec3 rate = xyz(line);
      rate[static_cast<int>(d % 3)] = rates[d];
      set_xyz(line, rate);
    }
  }
}

namespace {

/// What impulses of slower models add to the forces that the motion holds back: off the reactions,
/// it leaves those to the forces themselves.
Excess held_impulses(const PrescribedMotion& motion, const Scene& scene) {
  Excess held;
  const Links* links = scene.store.find<Links>();
  if (links == nullptr) return held;
  const auto masked = [](Vec3 value, unsigned mask) {
    for (int d = 0; d < 3; ++d)
      value[d] = (mask >> static_cast<unsigned>(d) & 1u) != 0 ? value[d] : 0;
    return value;
  };
  for (const Link* link : links->list) {
    if (link->ratio == 0) continue;
    for (std::size_t k = 0; k < link->nodes.size(); ++k) {
      const auto at = std::ranges::find(motion.nodes, link->nodes[k]);
      if (at == motion.nodes.end()) continue;
      const unsigned mask = motion.mask[static_cast<std::size_t>(at - motion.nodes.begin())];
      const Vec3 f = (link->ratio - 1) * masked(xyz(link->force[k]), mask);
      const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(link->nodes[k])]);
      held.force += f;
      held.moment += x.cross(f) + (link->ratio - 1) * masked(xyz(link->moment[k]), mask >> 3);
    }
  }
  return held;
}

}  // namespace

void add_prescribed_motion(PrescribedMotion& motion, Scene& scene, Models& models) {
  Nodes& nodes = scene.nodes;
  motion.reaction.assign(motion.nodes.size(), {});
  motion.couple.assign(motion.nodes.size(), {});
  LedgerEntry& work = models.ledger.entry("prescribed motion", motion.name);
  work.external = true;
  for (Model& model : models.list) {
    std::vector<Index> mine;
    for (std::size_t k = 0; k < motion.nodes.size(); ++k) {
      if (&models.of_node(motion.nodes[k]) == &model) mine.push_back(static_cast<Index>(k));
    }
    if (mine.empty()) continue;
    model.plan.add({.name = "prescribed motion of " + motion.name,
                    .reason = asked_for_at(motion.where),
                    .stage = Stage::kick,
                    .writes = {"v", "omega", "f", "torque"},
                    .run = [&motion, &nodes, mine](const Step& step) {
                      kick_prescribed(motion, mine, nodes, step);
                    }});
    model.plan.add({.name = "work of " + motion.name,
                    .reason = asked_for_at(motion.where),
                    .stage = Stage::look,
                    .reads = {"v", "omega", "f", "torque"},
                    .run = [&motion, &nodes, &work, mine](const Step& step) {
                      work.add_work(work_of_reactions(motion, mine, nodes, step));
                    }});
  }
  const std::vector<std::string> components{"x", "y", "z"};
  const auto write = [](const Vec3& value, double* to) {
    for (int d = 0; d < 3; ++d) to[d] = value[d];
  };
  scene.measures.push_back(
      {"boundary." + motion.name + ".force", "N", components, [&motion, &scene, write](double* to) {
         write(reaction_force(motion) + held_impulses(motion, scene).force, to);
       }});
  scene.measures.push_back(
      {"boundary." + motion.name + ".moment", "N m", components,
       [&motion, &scene, &nodes, write](double* to) {
         write(reaction_moment(motion, nodes) + held_impulses(motion, scene).moment, to);
       }});
}

}  // namespace gannet
