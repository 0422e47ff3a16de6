#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <filesystem>

#include "app/commands.hpp"
#include "app/effects_csv.hpp"
#include "app/revision.hpp"
#include "app/simulation.hpp"
#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "base/units.hpp"
#include "input/resolved.hpp"
#include "output/checkpoint.hpp"
#include "output/folder.hpp"
#include "output/output.hpp"
#include "output/progress.hpp"
#include "output/report.hpp"
#include "output/summary.hpp"
#include "output/vtk_series.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

std::atomic<int> signal_seen{0};

extern "C" void note_signal(int number) { signal_seen = number; }

void fill_record(const RunOptions& options, const Simulation& simulation, RunRecord& record) {
  record.case_file = options.case_file;
  // What is written, and when, may change from one run to the next without another outcome.
  record.case_hash = fmt::format(
      "{:016x}",
      fnv1a(resolved_text(simulation.source->root, {"title", "output", "study", "hard"})));
  record.version = version();
  record.revision = revision();
  record.instruction_set = name_of(isa());
  record.threads = threads();
  record.name = case_name(options.case_file);
  record.folder = options.out.empty() ? default_output_folder(options.case_file) : options.out;
}

/// The end time may be moved from the command line without making another case of it, so that a
/// checkpoint still belongs to it.
void move_end(const RunOptions& options, RunRecord& record) {
  if (options.until.empty()) return;
  Quantity until;
  try {
    until = parse_quantity(options.until);
  } catch (const std::invalid_argument& e) {
    throw InputError(
        std::vector<std::string>{fmt::format("--until {}: {}", options.until, e.what())});
  }
  if ((!until.bare && until.dimension != dim::time) || !(until.value > 0)) {
    throw InputError(
        fmt::format("--until {}: a time above 0 is wanted (s, ms, us)", options.until));
  }
  record.plan.until = until.value;
}

/// --resume: the newest checkpoint of the output folder, or a start over what is there.
RunOptions resumed(RunOptions options) {
  if (!options.resume) return options;
  options.restart = newest_checkpoint(options.out.empty() ? default_output_folder(options.case_file)
                                                          : options.out);
  if (options.restart.empty()) options.force = true;
  return options;
}

void start_or_resume(const RunOptions& options, Simulation& simulation, RunRecord& record) {
  const bool resuming = !options.restart.empty();
  if (resuming) {
    for (const std::string& warning : read_checkpoint(options.restart, simulation.scene,
                                                      simulation.models, record, options.force)) {
      fmt::print(stderr, "warning: {}\n", warning);
    }
  }
  prepare_output_folder(record.folder, options.force, resuming);
  if (resuming) rewind_output(simulation.models, record);
}

/// Steps until output has looked at the end, or a signal asks to stop. Returns the signal or 0.
int step_to_end(Simulation& simulation, RunRecord& record, Progress& progress, FirstShares& first) {
  Scene& scene = simulation.scene;
  Models& models = simulation.models;
  while (!record.output.finished) {
    if (signal_seen != 0) return signal_seen;
    if (checkpoint_due(models, record)) write_next_checkpoint(scene, models, record);
    advance(models);
    first.note(models);
    for (const std::string& warning : scene.warnings) {
      progress.finish();
      fmt::print(stderr, "warning: {}\n", warning);
    }
    scene.warnings.clear();
    progress.update(scene, models, record);
  }
  return 0;
}

int end_stopped(Simulation& simulation, RunRecord& record, const FirstShares& first, int number) {
  const std::string path = write_next_checkpoint(simulation.scene, simulation.models, record);
  record.status = "stopped";
  record.exit_reason = fmt::format("signal {}", number);
  write_summary(simulation.scene, simulation.models, record);
  write_effects_csv(simulation, first);
  fmt::print(stderr, "stopped by a signal; go on with: gannet run {} --restart {}\n",
             record.case_file, path);
  return 130;
}

/// After a guard tripped: says what is left, writes the summary, passes the error on.
[[noreturn]] void end_failed(Simulation& simulation, RunRecord& record, const FirstShares& first,
                             const RunError& error) {
  RunFailure failure = error.failure();
  failure.why += fmt::format("; last good output: {}", last_output(record));
  record.status = "failed";
  record.exit_reason = failure.what;
  write_frame(simulation.scene, simulation.models, record);
  write_summary(simulation.scene, simulation.models, record);
  write_effects_csv(simulation, first);
  throw RunError(failure);
}

}  // namespace

int run_command(const RunOptions& asked) {
  const RunOptions options = resumed(asked);
  set_threads(options.threads);
  const auto simulation = make_simulation(options.case_file, options.set);
  RunRecord& record = simulation->scene.store.get<RunRecord>();
  fill_record(options, *simulation, record);
  move_end(options, record);
  start_or_resume(options, *simulation, record);
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);

  fmt::print("{}\n{} threads, {}; output in {}\n", simulation->scene.title, record.threads,
             record.instruction_set, record.folder);
  begin_run(record, simulation->models);
  Progress progress(stderr);
  FirstShares first;
  int stopped = 0;
  try {
    stopped = step_to_end(*simulation, record, progress, first);
  } catch (const RunError& error) {
    progress.finish();
    end_failed(*simulation, record, first, error);
  }
  progress.finish();
  if (stopped != 0) return end_stopped(*simulation, record, first, stopped);
  record.status = "completed";
  record.exit_reason =
      record.stop_reason.empty() ? "reached the end time" : "stopped: " + record.stop_reason;
  write_summary(simulation->scene, simulation->models, record);
  write_effects_csv(*simulation, first);
  fmt::print("{}", report(simulation->scene, simulation->models, record));
  return 0;
}

}  // namespace gannet
