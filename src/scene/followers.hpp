// Nodes that have no mass of their own because they follow another node, as those of a rigid body
// do.
#pragma once

#include <vector>

#include "base/array.hpp"

namespace gannet {

/// By owned node; empty where no node follows: scene.store.get<Followers>(). Whoever pushes such a
/// node finds here what it pushes.
struct Followers {
  std::vector<Index> leader;  ///< the node that it follows; -1: none
  /// The largest acceleration that a unit force on the node can give it, 1/M + r^2/I_min with r the
  /// distance to the leader [1/kg].
  std::vector<double> inverse_mass;

  [[nodiscard]] Index leader_of(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    return i < leader.size() ? leader[i] : -1;
  }
};

}  // namespace gannet
