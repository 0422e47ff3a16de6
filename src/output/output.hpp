// The effect "output": when a run writes what. It reads the scene and never changes it.
#pragma once

#include "output/run_record.hpp"
#include "plan/effect.hpp"

namespace gannet {

/// The effect "output", last in the table of effects. Key `output`:
///   until       end of the run [time]; required
///   vtk         "every 0.25 ms", "never"; default: 50 frames over the run
///   history     "every 10 us", "never"; default: 1000 lines over the run
///   checkpoint  "every 5 min of wall time" (default), "every 2 ms", "never"
/// Its operations stand at the end of look of the fastest model and act at levels at which all
/// models coincide: the first level at or past each due time, the first level of all, and the
/// first at or past `until`, after which record.output.finished is true and the caller of the
/// step function stops. Nothing is written where record.folder is empty; the caller fills the
/// record (scene.store.get<RunRecord>()) before the first step.
Effect output_effect();

/// The last complete frame, for messages: "frame 12 at 3.002 ms in panel_slam.out/panel_slam.pvd",
/// or that there is none.
std::string last_output(const RunRecord& record);

}  // namespace gannet
