// summary.json: how a run ended, for scripts.
#pragma once

#include <string>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The summary as JSON text, all SI:
///   status (completed, stopped, failed), exit_reason, case, version
///   steps (of the fastest model), time, wall_time (this process), wall_time_before (of the runs
///   that it continues), cpu_time and cpu_time_before (the same of all threads, set-up included),
///   threads, instruction_set
///   energy_error: imbalance over the largest total energy so far
///   lost_particles, deepest_penetration [m]: the worst at any look (stray_particles.hpp);
///   null where nothing can be penetrated; only with particles
///   mass: sum m of the owned nodes; momentum: sum m v with v at the last half step
///   peak_memory_bytes: of this process
///   particle_steps_per_second, element_steps_per_second: over wall_time
///   operations: name, stage, model, calls, seconds, share of wall_time
std::string summary_text(Scene& scene, const Models& models, const RunRecord& record);

/// Writes summary_text() as FOLDER/summary.json, to a temporary name first. To be called however
/// the run ended. Throws std::runtime_error where it cannot be written.
void write_summary(Scene& scene, const Models& models, const RunRecord& record);

}  // namespace gannet
