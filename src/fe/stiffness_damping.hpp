// Damping of elements in proportion to their stiffness: forces beta K v, K that of the elastic
// element, so that a mode of angular frequency omega has the ratio beta omega/2.
#pragma once

#include <vector>

#include "base/array.hpp"
#include "base/keys.hpp"
#include "base/schema.hpp"
#include "fe/element_votes.hpp"

namespace gannet {

/// What a part asks for.
struct StiffnessDamping {
  double ratio = 0;  ///< zeta of the highest mode of each element at the start, >= 0
  double time = 0;   ///< beta, added to it [s], >= 0
  [[nodiscard]] bool given() const { return ratio > 0 || time > 0; }
};

/// The keys `damping_ratio` and `damping_time` of a kind of elements.
std::vector<Key> stiffness_damping_keys();

/// Reads them from the map of the kind.
StiffnessDamping read_stiffness_damping(const Keys& kind);

/// beta of each element [s]: time + 2 ratio/omega. omega2: squares of the frequencies of undamped
/// elements [1/s^2]; of those that are 0 the ratio counts for nothing.
Array<double> damping_times(const StiffnessDamping& damping, const Array<double>& omega2);

/// What the arrays of a block mean for its votes.
ElementVotes votes_of(const Array<double>& inverse_mass, const Array<double>& damping_time);

}  // namespace gannet
