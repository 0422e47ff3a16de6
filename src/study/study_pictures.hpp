// The pictures of a study: convergence, work and precision, and what effects change.
#pragma once

#include <string>

#include "study/study_analysis.hpp"

namespace gannet {

/// Error against the size along the refined key, with the fitted laws. Empty where no key is
/// refined.
std::string convergence_picture(const StudyResult& result, const MeasureResult& m);

/// Error against wall time, with the Pareto front.
std::string work_picture(const StudyResult& result, const MeasureResult& m);

/// What each other value of a key changes in the result and in time. Empty where there is none.
std::string changes_picture(const MeasureResult& m);

}  // namespace gannet
