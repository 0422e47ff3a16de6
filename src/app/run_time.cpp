#include "app/run_time.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>

#include "output/folder.hpp"
#include "output/run_record.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

/// An output folder for one try; gone with this object, and the record writes nothing again.
class TryFolder {
 public:
  explicit TryFolder(RunRecord& record) : record_(record) {
    path_ = fs::temp_directory_path() / fmt::format("gannet_check_{}", getpid());
    record_.folder = path_.string();
    record_.output = {};
    prepare_output_folder(record_.folder, true, false);
  }
  ~TryFolder() {
    record_.folder.clear();
    record_.output = {};
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TryFolder(const TryFolder&) = delete;
  TryFolder& operator=(const TryFolder&) = delete;

 private:
  RunRecord& record_;
  fs::path path_;
};

/// Seconds of one call of an output operation, at a level where it is due. The first call makes
/// what the second finds (headers, buffers), so the second counts.
double seconds_of(const std::string& name, Models& models) {
  using Clock = std::chrono::steady_clock;
  Model& model = models.list.back();
  double seconds = 0;
  for (const Operation& op : model.plan.at(Stage::look)) {
    if (op.name != name || op.effect != "output") continue;
    for (int k = 0; k < 2; ++k) {
      const auto start = Clock::now();
      op.run(model.step);
      seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
  }
  return seconds;
}

double due_times(double until, const Every& every) {
  return every.interval > 0 ? intervals_until(every.interval, until) + 1 : 0;
}

}  // namespace

RunTime estimate_run_time(Simulation& simulation, const FirstSteps& first) {
  RunRecord& record = simulation.scene.store.get<RunRecord>();
  const double until = record.plan.until;
  RunTime t;
  t.steps = {std::ceil(until / simulation.models.list.front().step.dt_old), first.per_step()};
  t.lists = {first.list_seconds > 0 ? t.steps.count / steps_per_list : 0, first.list_seconds};
  t.frames.count = due_times(until, record.plan.vtk);
  t.lines.count = std::min(due_times(until, record.plan.history), t.steps.count);
  t.frames.count = std::min(t.frames.count, t.steps.count);
  const TryFolder folder(record);
  t.frames.seconds = seconds_of("VTK frames", simulation.models);
  t.lines.seconds = seconds_of("histories", simulation.models);
  return t;
}

}  // namespace gannet
