// The first steps of a case, made in memory: what a step costs, by operation.
#pragma once

#include "app/simulation.hpp"

namespace gannet {

/// Steps that were timed. The stopwatch of an operation then holds these steps times its median, so
/// that a step in which the machine did something else counts for nothing.
struct FirstSteps {
  int steps = 0;
  double seconds = 0;  ///< of all operations and steps [s]
  /// To make the neighbour lists of particles anew once [s]; 0 without particles. Water at rest
  /// keeps its lists, so the first steps do not show it.
  double list_seconds = 0;
  [[nodiscard]] double per_step() const { return seconds / steps; }
};

/// Makes one step that is not timed (lists of contacts and work arrays come with it), then `least`
/// steps, then more until `most` are made or `budget` [s] is spent. Nothing is written.
/// least, most: > 0. The state of the simulation is then that of a later level.
FirstSteps make_first_steps(Simulation& simulation, double budget, int least, int most);

/// Steps from one list of neighbours to the next in water that flows as fast as its speed of sound
/// was chosen for. Measured as seconds of the operation over those of one list: 3 in dam_break_2d
/// (a/30), 6 in panel_slam (40 mm); the one that costs more is taken.
inline constexpr double steps_per_list = 3;

/// Mean cost of a step once the water flows [s]: the first steps, and lists every steps_per_list.
double flowing_step(const FirstSteps& first);

}  // namespace gannet
