// `models: auto`: parts grouped by the steps that they allow.
#pragma once

#include "app/simulation.hpp"
#include "time/models_effect.hpp"

namespace gannet {

/// Whether a case leaves the division among models to the program.
bool wants_auto_models(const Keys& root);

/// Groups the parts of a case, built with one model, by the smallest votes of its operations in the
/// state at the start. What cannot be parted stays together: particles; a rigid body and all that
/// is tied to it; parts of elements that are tied to each other or may touch each other. What
/// allows no smaller step than the water goes with the water. Of the rest, a group of parts begins
/// a model of its own where its step is at most half of that of the model before it. Evaluates the
/// forces of the start (evaluate_start()) and leaves the simulation fit for nothing else.
ChosenModels choose_models(Simulation& in_one_model);

}  // namespace gannet
