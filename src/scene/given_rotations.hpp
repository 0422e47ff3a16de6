// Nodes whose rotation is given and not found from torques.
#pragma once

#include <vector>

#include "base/array.hpp"

namespace gannet {

/// scene.store.get<GivenRotations>(), filled while the state is made: nodes some component of whose
/// rotation a boundary prescribes.
struct GivenRotations {
  std::vector<Index> nodes;
};

}  // namespace gannet
