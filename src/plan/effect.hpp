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

/// Whether a case has an effect, and why.
struct Presence {
  /// Automatic: on because a rule says so, not a key of the case.
  enum class State { off, on, automatic };
  State state = State::off;
  std::string why;  ///< key and place ("effects.xsph at case.yaml:30:9"), or the rule with numbers
};

/// A value that the program chose because the case left it open. A choice follows from the case
/// alone, never from measured time, and the key that it names overrides it.
struct Choice {
  std::string key;     ///< "parts.panel.shell.points"
  std::string chosen;  ///< "5"
  std::string rule;    ///< "5 points where the material may yield, else 3"
};

struct Effect {
  std::string name;
  /// The keys that it adds to the case language.
  Schema (*schema)() = nullptr;
  /// Adds the parts that the case asks of it to the draft. Optional.
  void (*parts)(const Keys& root, Draft& draft) = nullptr;
  /// After all parts have their nodes: allocates its state, tracks its fields, adds its masses.
  /// Optional.
  void (*state)(const Keys& root, Scene& scene) = nullptr;
  /// After all masses are known: divides the nodes among models, slowest first. Of at most one
  /// effect; without any there is one model. Optional.
  void (*models)(const Keys& root, Scene& scene, Models& models) = nullptr;
  /// Adds its operations to the plans of the models it acts in. Optional.
  void (*operations)(const Keys& root, Scene& scene, Models& models) = nullptr;
  /// Whether the case has it, after the scene was built. Optional: without it that follows from
  /// what the effect added to the plan and from the keys of its table.
  Presence (*presence)(const Keys& root, Scene& scene) = nullptr;
  /// What it chose where the case left it open, after the scene was built. Optional.
  std::vector<Choice> (*choices)(const Keys& root, Scene& scene) = nullptr;
};

/// "asked for at case.yaml:41"
std::string asked_for_at(const Location& where);

}  // namespace gannet
