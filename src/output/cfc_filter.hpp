// Low-pass filters of impact tests: the channel frequency classes (CFC) of SAE J211-1.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/run_record.hpp"

namespace gannet {

/// Filters a signal in place: a Butterworth filter of two poles,
///   y_k = a0 (x_k + 2 x_(k-1) + x_(k-2)) + b1 y_(k-1) + b2 y_(k-2),
/// once forward and once backward, so that nothing is delayed and four poles act in all. Gain
///   |H(f)| = 1/(1 + (tan(pi f dt)/tan(pi f_d dt))^4),  f_d = 2.0775 cfc:
/// 0.95 at f = cfc, 0.71 (-3 dB) at 1.65 cfc. Before the first and after the last value the signal
/// goes on as its image through that point (x_0 - (x_k - x_0)), so that straight lines stay as
/// they are.
/// cfc: frequency class [Hz]; dt: time between values [s], 1/dt at least 10 cfc.
/// SAE J211-1 (1995), appendix C.
void cfc_filter(std::span<double> signal, double cfc, double dt);

/// Writes history/NAME_filtered.csv for each of record.filters from history/NAME.csv, whole, as a
/// function of that file alone: a run that was stopped and resumed ends with the same bytes.
/// Values are taken at equal intervals, those of the history, linearly between its lines. Nothing
/// is written for a table with less than two lines.
void write_filtered_histories(const RunRecord& record);

}  // namespace gannet
