// From what a user asks to the list of runs, coarse ones first, each checked and measured out
// before anything starts; and the prediction of what a run costs.
#pragma once

#include <vector>

#include "study/study.hpp"

namespace gannet {

/// The runs of a study, by rising work. Fills spec.refine where it is empty and some axis is a
/// resolution. Throws InputError with the mistakes of all settings.
std::vector<StudyRun> plan_runs(StudySpec& spec, const StudyProgram& program);

/// Wall time of a run of so much work [s], from those that are done: a power of the work through
/// the two largest different ones, its exponent kept within 0.7 and 1.5; through the only one with
/// exponent 1; unknown where nothing is done.
double predict_wall(const std::vector<StudyRun>& runs, const StudyRun& next);

}  // namespace gannet
