// The subcommands of the program, one function each. They return the exit code (0, or 130 after a
// signal) and throw InputError (2) or RunError (3).
#pragma once

#include <string>
#include <vector>

#include "study/bench.hpp"

namespace gannet {

struct RunOptions {
  std::string case_file;
  std::string out;               ///< output folder; empty: beside the case
  std::string restart;           ///< checkpoint to go on from; empty: from the start
  std::vector<std::string> set;  ///< "key.path=value"
  int threads = 0;               ///< 0: all cores
  std::string until;             ///< overrides output.until; with unit
  bool force = false;            ///< overwrite results, or accept a checkpoint of a changed case
};

/// Runs a case to its end.
int run_command(const RunOptions& options);

/// Reads and checks a case; prints counts, memory and time step; runs nothing.
int check_command(const RunOptions& options);

/// Prints the plan of a case: the operations of a step in order, each with its reason.
int explain_command(const RunOptions& options);

/// Times kernels and whole steps beside the limits of the machine.
int bench_command(const BenchOptions& options);

}  // namespace gannet
