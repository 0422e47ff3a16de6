// When output is due. Times come from whole numbers, k times the interval, never from adding up,
// and nothing here ever touches the time step: output is due at the first level at or past k
// intervals, and is written with the true time of that level.
#pragma once

#include <limits>
#include <string>

namespace gannet {

/// An interval in simulated time; 0 is never.
struct Every {
  double interval = 0;  ///< [s]
};

/// An interval of checkpoints, in simulated time or in wall time; both 0 is never.
struct CheckpointEvery {
  double interval = 0;       ///< simulated [s]
  double wall_interval = 0;  ///< wall clock [s]
};

/// What the key `output` of a case asks for.
struct OutputPlan {
  double until = std::numeric_limits<double>::infinity();  ///< end of the run [s]
  Every vtk;
  Every history;
  CheckpointEvery checkpoint;
};

/// True where some due time k * interval, k = 0, 1, 2, ..., lies in (last, t].
/// last: the time of the last level that was asked about, below 0 before the first; t: this level
/// [s]. Asking at every level finds each due time once, whatever the steps are, and needs no
/// other memory than `last`, so a run may be resumed with another interval.
bool due(const Every& every, double last, double t);

/// Largest k with k * interval <= t, both as rounded; -1 for t < 0. Needs interval > 0.
double intervals_until(double interval, double t);

/// Reads "every 0.25 ms" or "0.25 ms" (a bare number is seconds); "never" gives 0.
/// Throws std::invalid_argument that says what is wrong and what is allowed.
Every parse_every(const std::string& text);

/// Reads "every 5 min of wall time", "every 2 ms", "never".
/// Throws std::invalid_argument that says what is wrong and what is allowed.
CheckpointEvery parse_checkpoint_every(const std::string& text);

}  // namespace gannet
