// What all parts of cable elements have in common, however their line was drawn: keys, tracked
// fields, measures and the force operation.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/truss.hpp"
#include "plan/effect.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The keys of parts.NAME.cable.
std::vector<Key> cable_keys();

/// What `cable` says of its elements: stiffness, mass per length, damping, strength. root: for the
/// material that it may name. A block that has its stiffness and mass already keeps them. Complains
/// and returns false where they are not said once.
bool read_cable(const Keys& root, const Keys& cable, TrussBlock& block);

/// Tracks what a pass takes from the level before; the force is also shown. owner: the effect.
void track_cable(Scene& scene, TrussBlock& block, const std::string& owner);

/// The largest force and the number of broken elements, for histories.
void add_cable_measures(Scene& scene, const TrussBlock& block);

/// Adds the force operation of a block to the plan of its model; reason: as of Operation, or empty
/// where parts.NAME.cable asks for it. The block must stay where it is.
void add_cable_operation(const Keys& root, Scene& scene, Models& models, TrussBlock& block,
                         const std::string& reason);

}  // namespace gannet
