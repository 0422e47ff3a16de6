#include "fe/beam_turns.hpp"

#include <algorithm>
#include <cstddef>

#include "base/parallel.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

namespace {

void turn_node(BeamBlock& block, const Nodes& nodes, Index k, double dt) {
  Line& line = block.turned[static_cast<std::size_t>(k)];
  const Vec3 half = 0.5 * dt * xyz(nodes.omega[static_cast<std::size_t>(block.nodes.begin + k)]);
  const Quaternion old(line.x, line.y, line.z, line.w);
  const Quaternion q = (Quaternion(1, half.x(), half.y(), half.z()) * old).normalized();
  line = {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

void turn_nodes(BeamBlock& block, const Nodes& nodes, double dt) {
  const bool all = block.elsewhere.empty();
  parallel_for(block.nodes.size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      if (all || block.elsewhere[static_cast<std::size_t>(k)] == 0) turn_node(block, nodes, k, dt);
    }
  });
}

std::vector<Index> nodes_in(const BeamBlock& block, const Model& model) {
  std::vector<Index> found;
  for (const Range& r : model.ranges) {
    const Index end = std::min(r.end, block.nodes.end);
    for (Index i = std::max(r.begin, block.nodes.begin); i < end; ++i) {
      found.push_back(i - block.nodes.begin);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void add_turns_elsewhere(Scene& scene, BeamBlock& block, Models& models) {
  const Model& own = model_of_part(scene, models, block.part);
  for (Model& model : models.list) {
    if (&model == &own) continue;
    const std::vector<Index> mine = nodes_in(block, model);
    if (mine.empty()) continue;
    block.elsewhere.resize(static_cast<std::size_t>(block.nodes.size()), 0);
    for (const Index k : mine) block.elsewhere[static_cast<std::size_t>(k)] = 1;
    model.plan.add({.name = "beam " + block.name + ": turns of nodes held here",
                    .reason = "elements of model " + own.name + " turn with its nodes",
                    .stage = Stage::drift,
                    .reads = {"omega"},
                    .run = [&scene, &block, mine](const Step& step) {
                      for (const Index k : mine) turn_node(block, scene.nodes, k, step.dt);
                    }});
  }
}

}  // namespace gannet
