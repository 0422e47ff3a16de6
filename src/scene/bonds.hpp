// Nodes that hang together, whatever their parts, and the models that parts advance in.
#pragma once

#include <string>
#include <vector>

#include "base/array.hpp"

namespace gannet {

/// Nodes that advance in one model, the fastest of those of their parts.
struct Bond {
  std::string name;
  std::vector<Index> nodes;
};

/// Found by scene.store.
struct Bonds {
  std::vector<Bond> list;
  /// By part the place in Models::list of the model that computes its elements; empty where there
  /// is one model. Nodes of the part that a bond holds may advance in a faster one.
  std::vector<std::size_t> model_of_part;
  /// Names of models that hold the forces of slower ones through their substeps (plan/link.hpp).
  std::vector<std::string> holding;
};

}  // namespace gannet
