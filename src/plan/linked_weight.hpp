// The weight of a body that water of a slower model carries. Buoyancy acts in impulses, once a step
// of the water; were the weight to act in every substep, a body at rest would fall and be thrown up
// again by g dT, and shake what is tied to it. So its weight acts with the water: only what is left
// of both, the acceleration of the body, comes in impulses.
#pragma once

#include "plan/link.hpp"
#include "scene/followers.hpp"

namespace gannet {

/// The bodies that the linked nodes belong to, each once; without those that an earlier link of the
/// scene has already.
std::vector<Index> bodies_of(const Scene& scene, const Link& link, const Followers& followers);

/// Takes the weights of these nodes out of the fast model and into the link, to be called between
/// open_link() and close_link(); the nodes must be linked. The ledger's work of gravity stays that
/// along the path of the body: what impulses and path differ by is in the link's entry.
void move_weights(Scene& scene, Link& link, const std::vector<Index>& bodies);

}  // namespace gannet
