#include "plan/linked_weight.hpp"

#include <algorithm>

namespace gannet {

namespace {

void add_weight(Scene& scene, Model& model, const Link& link, const std::vector<Index>& bodies,
                double sign) {
  model.plan.add(
      {.name = sign > 0 ? "weight of what the water carries" : "weight acts with the water",
       .reason = "rule: " + link.name + " acts in impulses, and so does what it carries",
       .stage = sign > 0 ? link.stage() : Stage::force,
       .reads = {"m"},
       .writes = {"f"},
       .run = [&scene, bodies, sign](const Step&) {
         for (const Index node : bodies) {
           const auto i = static_cast<std::size_t>(node);
           add_xyz(scene.nodes.f[i], sign * scene.nodes.x[i].w * scene.gravity);
         }
       }});
}

}  // namespace

std::vector<Index> bodies_of(const Scene& scene, const Link& link, const Followers& followers) {
  std::vector<Index> bodies;
  for (const Index node : link.nodes) {
    const Index leader = followers.leader_of(node);
    if (leader >= 0 && std::ranges::find(bodies, leader) == bodies.end()) bodies.push_back(leader);
  }
  const Links* links = scene.store.find<Links>();
  std::erase_if(bodies, [&](Index body) {
    return links != nullptr && std::ranges::any_of(links->list, [&](const Link* other) {
             return std::ranges::find(other->nodes, body) != other->nodes.end();
           });
  });
  return bodies;
}

void move_weights(Scene& scene, Link& link, const std::vector<Index>& bodies) {
  if (bodies.empty()) return;
  add_weight(scene, *link.slow, link, bodies, 1);
  add_weight(scene, *link.fast, link, bodies, -1);
}

}  // namespace gannet
