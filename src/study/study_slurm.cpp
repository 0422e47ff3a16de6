#include "study/study_slurm.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "output/files.hpp"
#include "study/study_runs.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

std::string absolute(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

std::string line_of(StudySpec spec, const StudyProgram& program, StudyRun run) {
  spec.case_file = absolute(spec.case_file);
  run.folder = absolute(run.folder);
  std::string line = shell_word(fs::canonical(program.path).string());
  for (const std::string& word : words_of(spec, run)) line += " " + shell_word(word);
  return line + " > " + shell_word(run.folder + ".log") + " 2>&1\n";
}

std::string script_of(const StudySpec& spec, const StudyProgram& program, const JobArray& array) {
  const std::string folder = fs::path(array.list).parent_path().string();
  return fmt::format(R"sh(#!/bin/bash
#SBATCH --job-name=gannet_study
#SBATCH --array=1-{0}
#SBATCH --cpus-per-task={1}
#SBATCH --requeue
#SBATCH --output={2}
# A study with {0} runs that are not done yet, one a task. Submit with:  sbatch [--time=1:00:00] {3}
# (%4 behind the array's range, say, keeps it at four at a time). Then, where the study was asked
# for, `gannet study ... --collect` shows what is done.
program={4}
version={5}
if [ "$("$program" --version)" != "$version" ]; then
  echo "$program is another version now; write the job array again" >&2
  exit 2
fi
run=$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {6})
if [ -z "$run" ]; then
  echo "there is no run ${{SLURM_ARRAY_TASK_ID}}" >&2
  exit 2
fi
eval "exec $run"
)sh",
                     array.n_runs, threads_of(spec), folder + "/task_%a.log", array.script,
                     shell_word(fs::canonical(program.path).string()),
                     shell_word("gannet " + program.short_version), shell_word(array.list));
}

}  // namespace

std::string shell_word(const std::string& word) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

JobArray write_job_array(const StudySpec& spec, const StudyProgram& program,
                         std::vector<StudyRun> runs, const std::string& dir) {
  JobArray array{0, absolute(dir + "/study.sbatch"), absolute(dir + "/runs.txt")};
  std::string list;
  for (StudyRun& run : runs) {
    read_run(run);
    if (run.state != StudyState::waiting) continue;
    list += line_of(spec, program, run);
    ++array.n_runs;
  }
  if (array.n_runs == 0) return array;
  fs::create_directories(dir);
  fs::create_directories(spec.out + "/runs");
  write_whole_file(array.list, list);
  write_whole_file(array.script, script_of(spec, program, array));
  return array;
}

}  // namespace gannet
