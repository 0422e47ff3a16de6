// Reading a checkpoint of a case whose parts were divided among other models.
#pragma once

#include <string>

#include "output/checkpoint_head.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Whether the file's models are those of the case.
bool same_models(const CheckpointHead& head, const Models& models);

/// Whether an entry of the file holds a state (kinetic energy, that of rotary inertia) under a name
/// that the ledger of other models does not have: nothing would bring it up to date.
bool is_state_of_another(const LedgerEntry& e, const Ledger& ledger);

/// A field that only a link between models has: it is not in files of other divisions.
bool is_of_link(const std::string& field);

/// Why models of the file cannot be taken over by others; "" where they can: elements of its slower
/// models hold the stress of a step that no other model has made.
std::string trouble_with_models(const CheckpointHead& head, const Scene& scene);

/// Sets the models of the case to the level of the file, all with the step dt_old of its fastest
/// model before them. Velocities of nodes of its slower models, v(n - 1/2) of a longer step, go
/// there:
///   v += f/m (dT_old - dt_old)/2
/// f that of their last kick, which is of the order of the scheme. Links begin a path of that step.
/// Needs the fields read, and no trouble_with_models().
void take_other_models(const CheckpointHead& head, Scene& scene, Models& models);

}  // namespace gannet
