// Frames on disk and the .pvd that names them all.
#pragma once

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Writes all parts at level n as the next frame, then the .pvd with it. Each file is complete
/// before it has its name, and the .pvd names only complete files. Call it in the look stage at a
/// level at which all models coincide. Throws std::runtime_error where a file cannot be written.
void write_frame(const Scene& scene, Models& models, RunRecord& record);

/// The text of the .pvd: one DataSet a frame and part, with true times and the names of the parts.
std::string pvd_text(const RunRecord& record);

/// Path of the .pvd.
std::string pvd_path(const RunRecord& record);

/// After a checkpoint was read: the .pvd names again what it named then (frames whose files are
/// in this folder), and frames that an interrupted run wrote later are removed.
void rewind_frames(RunRecord& record);

}  // namespace gannet
