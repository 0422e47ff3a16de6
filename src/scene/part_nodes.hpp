// The nodes of a part, whatever order its particles are in, and the part of a node.
#pragma once

#include "scene/scene.hpp"

namespace gannet {

/// Calls f(node) for the nodes or particles of a part, in the order of the node table.
/// number: of the part in scene.parts.
template <class F>
void for_nodes_of_part(const Scene& scene, int number, F&& f) {
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  if (!part.is_particles()) {
    for (Index i = part.nodes.begin; i < part.nodes.end; ++i) f(i);
    return;
  }
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    if (scene.particle_part[i - scene.particles.begin] == number) f(i);
  }
}

/// Number of the part of a node that is no particle. Needs one that has it.
inline int part_of(const Scene& scene, Index node) {
  int number = 0;
  while (!scene.parts[static_cast<std::size_t>(number)].nodes.contains(node)) ++number;
  return number;
}

}  // namespace gannet
