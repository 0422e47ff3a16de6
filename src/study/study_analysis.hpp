// What the runs of a study show: values, errors, orders, limits, fronts and prices.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/study.hpp"
#include "study/study_fit.hpp"
#include "study/study_runs.hpp"

namespace gannet {

inline constexpr std::size_t no_point = static_cast<std::size_t>(-1);

/// One setting, with all its repeats.
struct StudyPoint {
  std::vector<std::string> choices;
  double h = unknown;
  std::vector<std::size_t> runs;  ///< those that are done
  double wall = unknown;          ///< median [s]
  double work = 0;
  [[nodiscard]] bool done() const { return !runs.empty(); }
};

/// A measure over the repeats of a setting.
struct StudyValue {
  double value = unknown;                ///< median
  double low = unknown;                  ///< smallest
  double high = unknown;                 ///< largest
  double error = unknown;                ///< relative, of the median; 0 at the reference itself
  std::vector<double> of_runs{};         ///< one a run of the point, in the same order
  std::vector<double> errors_of_runs{};  ///< relative
};

/// Settings that differ in the refined key only, coarse first.
struct StudySeries {
  std::string label;  ///< "xsph = off"; "" where nothing else varies
  std::vector<std::size_t> points;
  OrderFit order;
  LimitFit limit;  ///< not for distances
  PowerLaw cost;   ///< wall time over size, from the two finest levels
};

/// What another value of a key changes where all else is as in the first setting.
struct StudyChange {
  std::string key;
  std::string from;
  std::string to;
  std::string at;          ///< the level of refinement, "dx = 4 mm"
  double value = unknown;  ///< relative change of the measure
  double time = unknown;   ///< relative change of the wall time
};

/// All that is known about one measure.
struct MeasureResult {
  StudyMeasure measure;
  std::string unit;
  double reference = unknown;
  std::string reference_text;              ///< "the finest run (let.dx = 2 mm)"
  std::size_t reference_point = no_point;  ///< where the reference is one of the runs
  std::vector<StudyValue> values;          ///< one a point
  std::vector<StudySeries> series;
  std::vector<std::size_t> pareto;  ///< by rising time
  std::vector<StudyChange> changes;
  std::vector<std::string> sentences;
  std::string problem;  ///< why there is no result
};

struct StudyResult {
  StudySpec spec;
  std::string title;
  std::string version;
  std::vector<StudyRun> runs;
  StudyOutcome outcome;
  std::vector<StudyPoint> points;
  std::vector<MeasureResult> measures;
};

/// Works out everything from the folders of the runs. Fills result.points and result.measures from
/// spec and runs. A history that is missing is a problem of its measure, not an error.
void analyse(StudyResult& result);

/// Indices of the points that no other beats in both time and error, by rising time. Points without
/// an error or time, and those to leave out, are not among them.
std::vector<std::size_t> pareto_front(const std::vector<double>& time,
                                      const std::vector<double>& error,
                                      std::size_t leave_out = no_point);

/// "" or "xsph = off": a setting without the refined key.
std::string label_without_refined(const StudySpec& spec, const std::vector<std::string>& choices);

/// The q-quantile, 0 <= q <= 1, linear between samples; unknown for none. Unknown values are left
/// out.
double quantile_of(std::vector<double> x, double q);

/// Linear between the middle two; unknown for none.
double median_of(std::vector<double> x);

}  // namespace gannet
