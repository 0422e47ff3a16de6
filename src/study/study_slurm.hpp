// The runs of a study as a Slurm job array.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gannet {

/// What was written.
struct JobArray {
  int n_runs = 0;      ///< that are not done yet; with none nothing is written
  std::string script;  ///< to be given to sbatch
  std::string list;    ///< one line of shell a run, the first for task 1
};

/// Writes DIR/study.sbatch and DIR/runs.txt: the runs that are not done, coarse ones first, each
/// the process that a study on this machine would start, into the same folder. A task that is
/// started again goes on from its checkpoint. All paths are absolute. Throws std::runtime_error
/// where it cannot be written.
JobArray write_job_array(const StudySpec& spec, const StudyProgram& program,
                         std::vector<StudyRun> runs, const std::string& dir);

/// A word as a shell reads it back: 'let.dx=20 mm'.
std::string shell_word(const std::string& word);

}  // namespace gannet
