// Histories of a run, and the numbers that are taken from them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gannet {

/// One column of a history: times rising [s], values [SI].
struct TimeSeries {
  std::vector<double> t;
  std::vector<double> y;
  std::string unit;  ///< "N"; "1" for plain numbers, empty where the file does not say
};

/// Reads a history CSV: lines that start with # are left out, then one header line, time first.
/// column: a name of the header without its unit, or the last word of one ("z"); empty: the only
/// column, or the length of the vector where there are three columns x, y, z. A last line without
/// its end is left out. Throws std::runtime_error that names the file and says which columns there
/// are.
TimeSeries read_time_series(const std::string& file, const std::string& column);

/// The part within from <= t <= until.
TimeSeries window_of(const TimeSeries& series, double from, double until);

/// The words of the kinds of measure: peak, mean, impulse, ..., distance.
const std::vector<std::string>& measure_kinds();

/// The number that a measure (all kinds but distance) takes from a series [SI]:
///   peak: the value that is largest in size, with its sign; time_of_peak: where it first stands
///   impulse: integral y dt by trapezoids; mean: impulse over the time
///   rms: sqrt(integral y^2 dt / time) by trapezoids
///   percentile: of the samples, between them linearly; slope: least squares dy/dt
///   largest_mean: largest mean over measure.width, of windows that begin or end at a sample;
///   time_of_largest_mean: the middle of that window
///   amplitude, phase, midline: A >= 0, phi in (-pi, pi], m of the least squares of
///   m + A sin(2 pi t/period + phi)
///   rise: largest value less the first
///   arrival: when y first reaches measure.level from below, linear between samples; unknown where
///   it never does
/// Throws std::runtime_error where the window holds too few samples.
double evaluate(const StudyMeasure& measure, const TimeSeries& series);

/// y(t) between samples linearly, the end values beyond them. Needs at least one sample.
double value_of(const TimeSeries& series, double t);

/// How far two histories are apart.
struct Distance {
  double rms = 0;    ///< over the times of b that a covers too
  double shift = 0;  ///< [s] a(t + shift) was compared with b(t)
  double range = 0;  ///< largest minus smallest b there
};

/// sqrt(mean (a(t + s) - b(t))^2) over the times t of b that lie in a and where both have
/// a value, at the shift |s| <=
/// max_shift that makes it smallest (s = 0 where max_shift is 0). Throws std::runtime_error where
/// fewer than two times are common.
Distance distance_of(const TimeSeries& a, const TimeSeries& b, double max_shift);

/// Unit of a measure: "N*s" for the impulse of a force.
std::string unit_of(const StudyMeasure& measure, const std::string& unit);

}  // namespace gannet
