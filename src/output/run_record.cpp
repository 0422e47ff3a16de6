#include "output/run_record.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace gannet {

void begin_run(RunRecord& record, const Models& models) {
  record.wall_start = RunRecord::Clock::now();
  record.last_checkpoint = record.wall_start;
  record.start_n.clear();
  for (const Model& m : models.list) record.start_n.push_back(m.step.n);
  record.start_t = models.list.empty() ? 0 : models.list.front().step.t;
  record.last_checkpoint_t = record.start_t;
}

double wall_time(const RunRecord& record) {
  return std::chrono::duration<double>(RunRecord::Clock::now() - record.wall_start).count();
}

double cpu_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

StepsDone steps_done(const Scene& scene, const Models& models, const RunRecord& record) {
  StepsDone done;
  std::size_t k = 0;
  for (const Model& m : models.list) {
    const std::int64_t start = k < record.start_n.size() ? record.start_n[k] : 0;
    const auto steps = static_cast<double>(m.step.n - start);
    ++k;
    for (const Range& r : m.ranges) {
      const Index begin = std::max(r.begin, scene.particles.begin);
      const Index end = std::min(r.end, scene.particles.end);
      done.particle_steps += steps * std::max(0, end - begin);
      for (const Part& p : scene.parts) {
        if (r.contains(p.nodes.begin)) done.element_steps += steps * p.n_cells();
      }
    }
  }
  return done;
}

std::string full_version(const RunRecord& record) {
  return record.revision.empty() ? record.version : record.version + " (" + record.revision + ")";
}

}  // namespace gannet
