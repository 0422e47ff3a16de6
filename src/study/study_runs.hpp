// Making the runs of a study: child processes of the program itself, one folder each.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gannet {

/// Threads of each run: as asked for, or its share of the cores of this machine.
int threads_of(const StudySpec& spec);

/// The words of the process that makes a run: goes on from a checkpoint where there is one.
std::vector<std::string> words_of(const StudySpec& spec, const StudyRun& run);

/// Reads what a run left in its folder: its state (done where summary.json says completed, failed
/// where it says failed, else waiting) and its costs.
void read_run(StudyRun& run);

/// How the runs ended.
struct StudyOutcome {
  double wall = 0;       ///< [s] of this call
  bool stopped = false;  ///< by a signal
  bool out_of_budget = false;
};

/// Makes all runs that are not done yet (none with spec.collect), in their order, at most
/// spec.parallel at once, and goes on from checkpoints of those that were interrupted. A run whose
/// predicted time is not left of the budget is not started and says so; one that is still running
/// when the budget is spent (and a tenth more) is stopped, and keeps its checkpoint. `stop` (a
/// signal number, 0 for none) ends children and call. Prints a line a run. Throws
/// std::runtime_error where no process can be made.
StudyOutcome make_runs(const StudySpec& spec, const StudyProgram& program,
                       std::vector<StudyRun>& runs, const std::atomic<int>& stop);

}  // namespace gannet
