// Where a mooring line lies at the start: the chain of its elements at rest.
#pragma once

#include <string>
#include <vector>

#include "fe/line_at_rest.hpp"
#include "fe/mooring.hpp"

namespace gannet {

/// A line at rest, its nodes from the anchor to the upper end.
struct LineStart {
  std::vector<Vec3> x;         ///< [m]
  std::vector<Vec3> friction;  ///< of the bed on each node [N]
  double largest = 0;          ///< tension of its elements [N]
  std::string trouble;         ///< why there is none, with numbers; empty: it was found
};

/// Brings the discrete line to rest: from the elastic catenary between its ends (catenary.hpp), or
/// where that does not exist from a line that hangs down and lies slack, by the chain's energy
/// (line_at_rest.hpp). Loads that depend on the place (the share under water, the drag of a
/// current, friction) follow until they no longer change. Friction is what holds back a line that
/// was pulled tight: mu times the push of the bed on each node, from the upper end on until no pull
/// is left (Jonkman 2007). gravity: along -z.
LineStart start_of(const MooringLine& line, const Vec3& gravity);

/// What an element of the block answers to its strain, without damping.
AxialAnswer answer_of(const TrussBlock& block, double strain);

}  // namespace gannet
