// The phase of settling at the start of a run, and when it is over.
#pragma once

namespace gannet {

struct SettlingPhase {
  double rate = 0;   ///< of damping [1/s]
  double until = 0;  ///< end at the latest [s]
  double share =
      0;  ///< of the largest kinetic energy, below which motion counts as none; 0: unused
  // State, tracked:
  double over = 0;         ///< 1 once the phase has ended
  double largest = 0;      ///< kinetic energy so far [J]
  double still_since = 0;  ///< since when there is little motion; t itself where there is more [s]
};

/// Ends the phase at level n where t has reached `until`, or the kinetic energy [J] was below its
/// share of the largest for the time 1/rate. A water that swings to and fro is still only for a
/// moment, and does not end it.
void look_at(SettlingPhase& phase, double kinetic, double t);

}  // namespace gannet
