// Hard cases: what the top-level map `hard` of a case file says. A hard case is a case that has
// been known to break codes like this one, with the limits that it must keep and with variants,
// some of which must break them.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plan/effect.hpp"

namespace gannet {

/// What a probe or another measure of the scene must show.
struct Exact {
  enum class When { always, end, mean };
  std::string name;
  std::string measure;  ///< "probe.NAME", or the whole name of another measure
  std::string component;
  double value = 0;          ///< SI, where there is no table
  double tolerance = 0;      ///< absolute, SI
  std::vector<double> t, y;  ///< table from a CSV file: time [s] and value; empty: `value` holds
  When when = When::always;
  double from = 0;  ///< from this time on [s]
  /// `value`, or that of the table at time t: straight between its points, level beyond.
  [[nodiscard]] double expected(double t) const;
};

/// Another start of the same case: the keys that it sets, and what must come of it.
struct HardVariant {
  std::string name;
  std::vector<std::string> set;  ///< "key.path=value"
  bool must_fail = false;
  std::vector<std::string> by;  ///< names of the limits of which one must fail; empty: any
  std::string because;
};

/// Where a run ends: after so many steps, or at a time; whichever comes first.
struct HardEnd {
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();
  double until = std::numeric_limits<double>::infinity();  ///< [s]
};

/// The limits of a case and its variants.
struct HardCase {
  std::string provokes;
  std::string cure;
  HardEnd end;
  HardEnd long_end;
  int every = 10;  ///< steps between two looks at particles
  double energy_growth = 1.02;
  std::optional<double> energy_error;
  std::optional<double> momentum;
  std::optional<double> penetration;       ///< [m]
  std::optional<double> smallest_spacing;  ///< [m]
  std::optional<double> smallest_dt;       ///< over the first step
  std::vector<Exact> exact;
  std::vector<HardVariant> variants;
};

/// The keys under `hard`. They change nothing in a run: only `gannet hard` reads them.
Effect hard_effect();

/// Reads the map `hard` of a case whose `output.until` ends the run where `hard` says nothing.
/// Mistakes in it are noted in the case's list.
HardCase read_hard_case(const Keys& root);

}  // namespace gannet
