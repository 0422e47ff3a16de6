// What is known about a run beside the scene: where it came from, where its output goes, how far
// the output is, and how the run ended. One record a scene: scene.store.get<RunRecord>().
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "output/schedule.hpp"
#include "output/stray_particles.hpp"
#include "plan/plan.hpp"

namespace gannet {

/// One VTK frame: its time, and the files that were completed for it.
struct Frame {
  int number = 0;  ///< in the names of its files
  double t = 0;    ///< [s]
  struct File {
    std::string part;  ///< name of the part
    std::string path;  ///< relative to the output folder
  };
  std::vector<File> files;
};

/// How far output is. A checkpoint holds it all, so that a resumed run goes on where the other
/// stopped.
struct OutputProgress {
  /// Time of the last level that output looked at [s]; below 0 before the first.
  double last_look = -std::numeric_limits<double>::infinity();
  std::vector<Frame> frames;  ///< complete frames, in order
  StrayParticles strays;      ///< the worst at any look so far
  bool finished = false;      ///< the level at or past `until` was looked at: the run is done
  /// Files that were renamed or appended since the last checkpoint; a checkpoint brings them to
  /// the disk first, so that after a power cut nothing is missing that it counts on.
  std::vector<std::string> not_on_disk;
};

/// A history that is filtered at the end of the run.
struct HistoryFilter {
  std::string history;  ///< name of its table: "keel_pressure"
  double cfc = 0;       ///< channel frequency class [Hz]
};

struct RunRecord {
  std::string case_file;
  std::string case_hash;  ///< what a checkpoint must match
  std::string version;    ///< "0.1.0"
  std::string revision;   ///< of git; empty where unknown
  std::string instruction_set;
  int threads = 1;

  std::string name;    ///< of the case: names the .pvd
  std::string folder;  ///< output folder; empty: nothing is written
  OutputPlan plan;     ///< when to write what
  std::vector<HistoryFilter> filters;
  OutputProgress output;

  std::string status = "running";  ///< completed, stopped, failed
  std::string exit_reason;
  std::string stop_reason;  ///< of output.stop, from the level on at which it ends the run

  using Clock = std::chrono::steady_clock;
  Clock::time_point wall_start = Clock::now();
  double wall_before = 0;  ///< wall time of the runs that this one continues [s]
  double cpu_before = 0;   ///< their CPU time up to the checkpoint, set-up included [s]
  Clock::time_point last_checkpoint = Clock::now();
  double last_checkpoint_t = 0;       ///< simulated time of the last checkpoint [s]
  double start_t = 0;                 ///< simulated time at which this process began [s]
  std::vector<std::int64_t> start_n;  ///< step number of each model at that time
};

/// Starts the clocks of the run: call it once, right before the first step of this process (after
/// read_checkpoint where there is one).
void begin_run(RunRecord& record, const Models& models);

/// Wall time since begin_run() [s].
double wall_time(const RunRecord& record);

/// CPU time of this process, set-up and all threads included [s].
double cpu_time();

/// Particles and elements that this process advanced by one step so far.
struct StepsDone {
  double particle_steps = 0;
  double element_steps = 0;
};

/// Sums over models the steps that each made since begin_run() times what it holds.
StepsDone steps_done(const Scene& scene, const Models& models, const RunRecord& record);

/// "0.1.0 (a1b2c3d)", or the version alone where the revision is unknown.
std::string full_version(const RunRecord& record);

}  // namespace gannet
