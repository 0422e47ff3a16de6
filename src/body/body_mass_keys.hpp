// What a case says of the mass of a rigid body.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "body/body_mass.hpp"

namespace gannet {

/// Mass, centre and inertia of a body, and where they come from.
struct WeighedBody {
  BodyMass of;
  std::string rule;
};

/// The keys mass, density, centre and inertia of a body.
std::vector<Key> body_mass_keys();

/// The mass of a body out of these parts (numbers in the scene) and their nodes: that of the nodes,
/// or what the keys of the body say. Nothing after a mistake, which is noted: keys that contradict
/// each other, no mass, an inertia that is not positive definite. Needs the masses of the nodes.
/// tied: nodes of other parts that move along; their masses come on top of all that.
std::optional<WeighedBody> weigh_body(const Keys& keys, const Scene& scene,
                                      const std::vector<int>& parts,
                                      const std::vector<Index>& members,
                                      const std::vector<Index>& tied);

}  // namespace gannet
