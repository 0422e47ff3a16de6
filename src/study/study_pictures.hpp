// The pictures of a study: convergence, work and precision, and what effects change.
#pragma once

#include <array>
#include <string>

#include "study/study_analysis.hpp"

namespace gannet {

/// Error against the size along the refined key, with the fitted laws. Empty where no key is
/// refined.
std::string convergence_picture(const StudyResult& result, const MeasureResult& m);

/// Error against wall time, with the Pareto front.
std::string work_picture(const StudyResult& result, const MeasureResult& m);

/// Percentiles over the repeats of a setting that are shown and written.
inline constexpr std::array<int, 5> spread_percents = {10, 25, 50, 75, 90};

/// How the results of the repeats of each setting are distributed. Empty without repeats.
std::string spread_picture(const StudyResult& result, const MeasureResult& m);

/// What each other value of a key changes in the result and in time. Empty where there is none.
std::string changes_picture(const MeasureResult& m);

}  // namespace gannet
