// A number as a function of time, by points.
#pragma once

#include <vector>

namespace gannet {

/// y(t): straight lines between the points, constant before the first and after the last.
/// No points: 1 at all times, the factor that changes nothing.
struct TimeTable {
  std::vector<double> t;  ///< rising [s]
  std::vector<double> y;  ///< as many
  friend bool operator==(const TimeTable&, const TimeTable&) = default;
};

/// y at time t [s].
double value_at(const TimeTable& table, double t);

/// Mean of y over [from, to], from < to [s]: (1/(to - from)) integral of y dt, exact for the
/// straight lines. A velocity that is this mean over each step moves its node along the integral
/// of the table, whatever the steps.
double mean_over(const TimeTable& table, double from, double to);

/// 0 before `from`, then rising evenly to 1 within `ramp` (a jump where ramp is 0) [s].
/// Needs ramp >= 0. A jump holds from the time `from` on.
TimeTable step_from(double from, double ramp);

}  // namespace gannet
