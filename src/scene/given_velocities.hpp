// Nodes whose velocity is given and not found from forces.
#pragma once

#include <map>

#include "base/array.hpp"

namespace gannet {

/// scene.store.get<GivenVelocities>(), filled while the state is made: by node the components that
/// boundaries prescribe, bit d for component d of the velocity.
struct GivenVelocities {
  std::map<Index, unsigned> masks;

  [[nodiscard]] unsigned mask_of(Index node) const {
    const auto found = masks.find(node);
    return found == masks.end() ? 0 : found->second;
  }
};

}  // namespace gannet
