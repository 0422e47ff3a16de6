// A given force on a set of nodes: loads.NAME.force: {nodes, value, from, ramp}.
#include <deque>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "body/effects.hpp"
#include "scene/node_set.hpp"

namespace gannet {

namespace {
namespace nodal_force {

constexpr Index chunk = 1024;

struct NodalForce {
  std::string name;
  Location where;
  std::vector<Index> nodes;
  VectorFunction total;  ///< of all nodes together [N]
  Function factor{1.0};
};

struct NodalForces {
  std::deque<NodalForce> list;
};

Schema schema() {
  Key force{.name = "force", .kind = Kind::map, .text = "a force shared evenly by nodes"};
  force.keys = {node_set_key("nodes", true),
                Key{.name = "value",
                    .kind = Kind::vector_function,
                    .unit = dim::force,
                    .text = "of all nodes together",
                    .required = true,
                    .variables = {"t"}},
                Key{.name = "from", .unit = dim::time, .text = "when it starts"},
                Key{.name = "ramp",
                    .unit = dim::time,
                    .text = "how long it takes to rise evenly to its value",
                    .limits = at_least(0)}};
  return {{"loads.*", force}};
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("loads")) return;
  const Keys loads = root.map("loads");
  for (const std::string& name : loads.names()) {
    if (!loads.value(name).is_map || !loads.map(name).has("force")) continue;
    const Keys force = loads.map(name).map("force");
    NodalForce load{name, force.where(), select_nodes(force.map("nodes"), scene),
                    force.vector_function("value")};
    if (load.nodes.empty()) continue;
    if (force.has("from") || force.has("ramp")) {
      load.factor = Function(step_from(force.number_or("from", 0), force.number_or("ramp", 0)));
    }
    scene.store.get<NodalForces>().list.push_back(std::move(load));
  }
}

/// The share of one node at time t [N].
Vec3 share_at(const NodalForce& load, double t) {
  return value_at(load.factor, t) / static_cast<double>(load.nodes.size()) *
         value_at(load.total, t);
}

Work work_of(const NodalForce& load, const std::vector<Index>& mine, const Nodes& nodes,
             const Step& step) {
  const Vec3 share = share_at(load, step.t);
  const Work none = Work::Zero();
  return parallel_sum(static_cast<Index>(mine.size()), chunk, none, [&](Index a, Index b) {
    Work work = none;
    for (Index k = a; k < b; ++k) {
      work += work_along(work_path(nodes, mine[static_cast<std::size_t>(k)], step), share);
    }
    return work;
  });
}

void add_operations(const NodalForce& load, Scene& scene, Model& model, Ledger& ledger,
                    const std::vector<Index>& mine) {
  Nodes& nodes = scene.nodes;
  LedgerEntry& work = ledger.entry("force", load.name);
  work.external = true;
  model.plan.add({.name = "force " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::force,
                  .writes = {"f"},
                  .run = [&load, &nodes, mine](const Step& step) {
                    const Vec3 share = share_at(load, step.t);
                    for (const Index i : mine) {
                      add_xyz(nodes.f[static_cast<std::size_t>(i)], share);
                    }
                  }});
  model.plan.add({.name = "work of " + load.name,
                  .reason = asked_for_at(load.where),
                  .stage = Stage::look,
                  .reads = {"v", "f"},
                  .run = [&load, &nodes, &work, mine](const Step& step) {
                    work.add_work(work_of(load, mine, nodes, step));
                  }});
}

void operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!scene.store.has<NodalForces>()) return;
  for (NodalForce& load : scene.store.get<NodalForces>().list) {
    for (Model& model : models.list) {
      std::vector<Index> mine;
      for (const Index i : load.nodes) {
        if (&models.of_node(i) == &model) mine.push_back(i);
      }
      if (!mine.empty()) add_operations(load, scene, model, models.ledger, mine);
    }
  }
}

}  // namespace nodal_force
}  // namespace

Effect nodal_force_effect() {
  return {.name = "nodal force",
          .schema = nodal_force::schema,
          .state = nodal_force::state,
          .operations = nodal_force::operations};
}

}  // namespace gannet
