// The effect `models`: parts at steps of their own.
#pragma once

#include <string>
#include <vector>

#include "plan/effect.hpp"

namespace gannet {

/// A division that was found for `models: auto`, slowest first: scene.store.get<ChosenModels>(),
/// before models are made. Without it such a case has one model.
struct ChosenModels {
  struct One {
    std::string name;
    std::vector<int> parts;  ///< numbers in the scene
    double dt = 0;           ///< that they allow at the start [s]
  };
  std::vector<One> list;
  double share_of_work = 1;  ///< steps of elements and particles, of those with one model
};

/// models.NAME, or models: auto: divides the parts of a case among models, slowest first.
Effect models_effect();

}  // namespace gannet
