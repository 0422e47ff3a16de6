// The model that computes the elements of a part.
#pragma once

#include "plan/plan.hpp"
#include "scene/bonds.hpp"

namespace gannet {

/// The model that computes the elements of a part. Nodes of the part that hang on others may
/// advance in a faster one (scene/bonds.hpp), so that its first node does not tell.
inline Model& model_of_part(const Scene& scene, Models& models, int part) {
  const auto p = static_cast<std::size_t>(part);
  const Bonds* bonds = scene.store.find<Bonds>();
  if (bonds != nullptr && p < bonds->model_of_part.size()) {
    return models.list[bonds->model_of_part[p]];
  }
  return models.of_node(scene.parts[p].nodes.begin);
}

}  // namespace gannet
