// How an effect enters the program: one struct of four functions, one line in the table of effects
// (app/effects.cpp). An effect never asks which other effects exist; two that must meet name a
// field, a measure or a stage between them.
#pragma once

#include <string>
#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "plan/plan.hpp"
#include "scene/draft.hpp"
#include "scene/scene.hpp"

namespace gannet {

struct Effect {
  std::string name;
  /// The keys that it adds to the case language.
  Schema (*schema)() = nullptr;
  /// Adds the parts that the case asks of it to the draft. Optional.
  void (*parts)(const Keys& root, Draft& draft) = nullptr;
  /// After all parts have their nodes: allocates its state, tracks its fields, adds its masses.
  /// Optional.
  void (*state)(const Keys& root, Scene& scene) = nullptr;
  /// Adds its operations to the plans of the models it acts in. Optional.
  void (*operations)(const Keys& root, Scene& scene, Models& models) = nullptr;
};

/// "asked for at case.yaml:41"
std::string asked_for_at(const Location& where);

}  // namespace gannet
