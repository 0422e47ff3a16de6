// How long a run will take: steps, neighbour lists and output, each at its measured price.
#pragma once

#include "app/first_steps.hpp"
#include "app/simulation.hpp"

namespace gannet {

/// Something that happens a number of times in a run.
struct Priced {
  double count = 0;
  double seconds = 0;  ///< each
  [[nodiscard]] double total() const { return count * seconds; }
};

/// A run, taken apart. Wall time [s].
struct RunTime {
  Priced steps;   ///< without lists and output
  Priced lists;   ///< of neighbours
  Priced frames;  ///< VTK
  Priced lines;   ///< of histories
  [[nodiscard]] double total() const {
    return steps.total() + lists.total() + frames.total() + lines.total();
  }
};

/// Counts from the end time, the last step and the intervals of the output; prices from the first
/// steps, one frame and one line of the histories (written to a temporary folder that is removed).
/// Needs at least one step made.
RunTime estimate_run_time(Simulation& simulation, const FirstSteps& first);

}  // namespace gannet
