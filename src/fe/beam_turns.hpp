// How the nodes of beams turn, each with the model that it advances in.
#pragma once

#include "fe/beam.hpp"
#include "plan/plan.hpp"

namespace gannet {

/// Turns the nodes of a block by omega dt [rad] by the midpoint rule, q <- (1, omega dt/2) q/|.|,
/// but those that advance in another model than the elements (block.elsewhere). dt: t(n) - t(n-1)
/// [s]. Throws nothing.
void turn_nodes(BeamBlock& block, const Nodes& nodes, double dt);

/// Nodes that ties or bodies hold may advance in a faster model than the elements do: finds them
/// (block.elsewhere), and lets each turn at the end of every step of its own, for elements and
/// rotary inertia alike.
void add_turns_elsewhere(Scene& scene, BeamBlock& block, Models& models);

/// The nodes of a block that advance in a model, as their places in the block, rising.
std::vector<Index> nodes_in(const BeamBlock& block, const Model& model);

}  // namespace gannet
