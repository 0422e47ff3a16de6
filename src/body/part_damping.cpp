// parts.NAME.damping: damping in proportion to mass of one part of elements,
//   v(n+1/2) -= gamma dt (v(n-1/2) + v(n+1/2))/2            `damp_elements()`
// and angular velocities alike, so that the ratio of a mode of angular frequency omega is
// gamma/(2 omega). For particles there are sponges and `effects.relaxation`.
#include <deque>
#include <string>

#include "body/effects.hpp"
#include "body/element_relaxation.hpp"

namespace gannet {

namespace {
namespace part_damping {

/// A damping without an end, of one part. Found by scene.store.
struct PartDamping {
  int part = -1;
  ElementRelaxation damping;
};

struct PartDampings {
  std::deque<PartDamping> list;  ///< addresses never change
};

Schema schema() {
  return {{"parts.*",
           Key{.name = "damping",
               .unit = dim::frequency,
               .text = "of elements: share of the velocity of their nodes that is taken, per time",
               .limits = positive()}}};
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("parts")) return;
  for (const std::string& name : root.map("parts").names()) {
    const Keys keys = root.map("parts").map(name);
    const int number = scene.part_number(name);
    if (!keys.has("damping") || number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    if (part.is_particles()) {
      keys.complain("damping",
                    "is for parts of elements; water has boundaries.NAME.sponge and "
                    "effects.relaxation");
      continue;
    }
    PartDamping& made = scene.store.get<PartDampings>().list.emplace_back();
    made.part = number;
    ElementRelaxation& d = made.damping;
    d.asked_for = true;
    d.automatic = false;
    d.phase.rate = keys.number("damping");
    d.nodes = part.nodes;
    const Range& turning = scene.nodes.rotating;
    const Index end = std::min(part.nodes.end, turning.end);
    d.turning = {std::min(std::max(part.nodes.begin, turning.begin), end), end};
    d.f.assign(d.nodes.size(), {});
    d.torque.assign(d.turning.size(), {});
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<PartDampings>()) return;
  Nodes& nodes = scene.nodes;
  for (PartDamping& one : scene.store.get<PartDampings>().list) {
    const std::string& name = scene.parts[static_cast<std::size_t>(one.part)].name;
    if (scene.parts[static_cast<std::size_t>(one.part)].rigid) {
      root.map("parts").map(name).complain("damping", "has no meaning: the part is rigid");
      continue;
    }
    ElementRelaxation& d = one.damping;
    const std::string reason = asked_for_at(root.map("parts").map(name).where("damping"));
    Plan& plan = models.of_node(d.nodes.begin).plan;
    LedgerEntry& lost = models.ledger.entry("damping", name);
    plan.add({.name = "damping of " + name,
              .reason = reason,
              .stage = Stage::kick,
              .reads = {"v", "omega", "f", "torque"},
              .writes = {"v", "omega", "f", "torque"},
              .run = [&d, &nodes](const Step& step) { damp_elements(d, nodes, step); }});
    plan.add(
        {.name = "work of the damping of " + name,
         .reason = reason,
         .stage = Stage::look,
         .reads = {"v", "omega", "f", "torque"},
         .run = [&d, &nodes, &lost](const Step& step) { lost.add_work(work_of(d, nodes, step)); }});
  }
}

}  // namespace part_damping
}  // namespace

Effect part_damping_effect() {
  return {.name = "damping",
          .schema = part_damping::schema,
          .state = part_damping::state,
          .operations = part_damping::operations};
}

}  // namespace gannet
