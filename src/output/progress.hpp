// How far a run is, while it runs: a redrawn bar on a terminal, plain lines elsewhere.
#pragma once

#include <cstdio>
#include <string>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What a progress line says.
struct ProgressValues {
  double done = 0;  ///< fraction of the simulated time, 0 to 1
  double t = 0;     ///< [s]
  std::int64_t step = 0;
  double dt = 0;    ///< [s]
  std::string who;  ///< limits the step
  double energy_error = 0;
  double particle_steps_per_second = 0;
  double element_steps_per_second = 0;
  double seconds_left = 0;  ///< of wall time
};

/// " 42 %  t 10.5 ms  step 8400  dt 1.25 us (panel: element 7)  energy error 0.01 %  1.25 M
/// particles/s  ETA 1 min 05 s": rates that are 0 are left out.
std::string progress_line(const ProgressValues& values);

/// Shows progress on a stream.
class Progress {
 public:
  /// out: usually stderr; a terminal gets a bar, redrawn five times a second at most; anything
  /// else gets a line every 5 s of wall time and whenever another tenth of the run is done.
  explicit Progress(std::FILE* out);
  /// To be called after every step; looks at the clock and mostly returns at once.
  void update(Scene& scene, const Models& models, const RunRecord& record);
  /// Ends the bar, so that later text starts on a line of its own.
  void finish();

 private:
  [[nodiscard]] ProgressValues values(Scene& scene, const Models& models, const RunRecord& record);
  void show(const ProgressValues& values);

  std::FILE* out_;
  bool terminal_;
  bool drawn_ = false;
  int tenths_ = 0;
  double last_wall_ = 0;
  StepsDone last_done_;
};

}  // namespace gannet
