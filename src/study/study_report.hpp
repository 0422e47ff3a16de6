// The results of a study as files.
#pragma once

#include <string>

#include "study/study_analysis.hpp"

namespace gannet {

/// One line a run: repeat, a column a key, state, then costs, then value and error of each measure.
std::string study_csv(const StudyResult& result);

/// Everything: settings, runs, measures with orders, limits, fronts and prices.
std::string study_json(const StudyResult& result);

/// One page with sentences, pictures and tables; needs no other file.
std::string study_html(const StudyResult& result);

/// Writes study.csv, study.json, study.html and the pictures as SVG into the folder of the study.
void write_study(const StudyResult& result);

/// Sentences, and a table of the settings, for the terminal.
std::string study_text(const StudyResult& result);

/// "order 1.02 (95 % 0.9 to 1.1); limit 3.2 N; grid convergence index 1.2 %", or why not.
std::string convergence_text(const MeasureResult& m, const StudySeries& series);

}  // namespace gannet
