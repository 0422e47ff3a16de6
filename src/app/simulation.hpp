// From a case file to a scene with a plan.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/case.hpp"
#include "plan/effect.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What one effect allocated in arrays while scene and plan were built: its tracked fields and what
/// it keeps beside them (lists, copies). Ghosts of all fields count for the effect that makes them.
struct EffectMemory {
  std::string effect;  ///< "nodes" for the node table
  std::int64_t bytes = 0;
  std::size_t measures = 0;  ///< numbers that it lets the scene be asked for
};

/// A case, the scene built from it and the plans of its models. Operations refer to the scene by
/// address, so a simulation is made once and stays where it is.
struct Simulation {
  std::unique_ptr<Case> source;
  Scene scene;
  Models models;
  std::vector<EffectMemory> memory;  ///< the node table, then one entry an effect of the table
};

/// Reads a case file, checks all of it and builds scene and plans: nothing is written, no step is
/// made. overrides: "key.path=value". Throws InputError with every mistake found.
std::unique_ptr<Simulation> make_simulation(const std::string& file,
                                            const std::vector<std::string>& overrides);

/// As make_simulation, of the text of a case instead of a file.
std::unique_ptr<Simulation> make_simulation_of_text(const std::string& text,
                                                    const std::vector<std::string>& overrides = {});

}  // namespace gannet
