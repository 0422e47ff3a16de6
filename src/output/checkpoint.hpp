// Checkpoints: everything that the bits of the rest of a run depend on. They are written between
// steps only, so they hold the state at entry to a step: x, rho, p at n, v at n-1/2.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Writes all tracked fields with `checkpoint` (packed, without ghost or padding tricks: entry by
/// entry), index lists, node counts, models, ledger and output progress as the HDF5 file `path`:
/// temporary name, fsync, rename. Needs all models at one level. Throws std::runtime_error.
void write_checkpoint(const std::string& path, const Scene& scene, const Models& models,
                      const RunRecord& record);

/// Brings what the checkpoint counts on to the disk (frames and histories so far), writes
/// checkpoint_<step>.h5 into the output folder, and removes all others but the one before it.
/// Returns its path.
std::string write_next_checkpoint(const Scene& scene, const Models& models, RunRecord& record);

/// True where the next checkpoint of the output plan is due, in wall time or in simulated time.
/// Asked between steps. Never true where record.folder is empty.
bool checkpoint_due(const Models& models, const RunRecord& record);

/// Reads a checkpoint into a scene that was built from the same case, resizes what has to grow,
/// and calls scene.after_restart. Sets record.output, record.wall_before
/// and record.cpu_before.
/// Returns warnings: another instruction set or revision (the bits may then differ), and what
/// `force` let pass.
/// Throws InputError, one message that names the file: it is missing or damaged; it belongs to
/// another case or was written by another version (unless `force`); a field, list or model is
/// missing or has another shape.
std::vector<std::string> read_checkpoint(const std::string& path, Scene& scene, Models& models,
                                         RunRecord& record, bool force = false);

/// After read_checkpoint and prepare_output_folder: cuts histories and frames in the output folder
/// back to the level that the checkpoint holds.
void rewind_output(const Models& models, RunRecord& record);

}  // namespace gannet
