// What `gannet explain` says of every effect that the program knows: on, off or automatic, why,
// what it holds and what it costs; and the values that the program chose by itself.
#pragma once

#include <string>
#include <vector>

#include "app/simulation.hpp"

namespace gannet {

struct EffectLine {
  std::string name;
  Presence presence;
  std::int64_t bytes = 0;  ///< in arrays, see EffectMemory
  double seconds = 0;      ///< of its own operations, by their stopwatches
};

/// "off", "on", "automatic"
const char* name_of(Presence::State state);

/// Whether a built case has an effect. Where the effect does not say so itself: one that added
/// operations is on for the reason of the first that the case asked for, automatic where rules
/// alone brought them; one that only brings measures or keys is on where the case has the key that
/// it is known by; all else is off.
Presence presence_of(const Effect& effect, Simulation& simulation);

/// One line an effect, in the order of the table. The line "nodes" is first: the node table.
std::vector<EffectLine> effect_lines(Simulation& simulation);

/// All values that the program chose because the case left them open: of the effects, the speed of
/// sound of fluids, instruction set and threads. None depends on measured time.
std::vector<Choice> all_choices(Simulation& simulation);

}  // namespace gannet
