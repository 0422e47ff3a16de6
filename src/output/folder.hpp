// The output folder: what it is called, when it may be written to, what lies in it.
//
//   NAME.pvd                    all frames: open this one in ParaView
//   vtk/PART_000012.vtp, .vtu   one file a part and frame
//   history/energy.csv, ...     one line a history interval
//   checkpoint_001200.h5        the last two
//   summary.json                how the run ended
#pragma once

#include <string>
#include <vector>

namespace gannet {

/// What a case is called: the name of its file without ".yaml", or of its folder where the file is
/// called case.yaml.
std::string case_name(const std::string& case_file);

/// Folder of the case file + case_name + ".out".
std::string default_output_folder(const std::string& case_file);

/// Makes the folder ready for a run.
/// - It does not exist or is empty: it is made.
/// - resuming: what is there stays, but for temporary files that a killed run left.
/// - Otherwise, where something is in it: with `force` the results of an earlier run are removed
///   (only files that a run writes), without it an InputError says what to do.
/// Throws InputError where the folder cannot be made or is no folder.
void prepare_output_folder(const std::string& folder, bool force, bool resuming);

/// "FOLDER/checkpoint_001200.h5"; number: the step that it holds.
std::string checkpoint_path(const std::string& folder, long long number);

/// Numbers of the checkpoints in a folder, rising.
std::vector<long long> checkpoints_in(const std::string& folder);

/// The newest checkpoint of a folder; empty where there is none.
std::string newest_checkpoint(const std::string& folder);

}  // namespace gannet
