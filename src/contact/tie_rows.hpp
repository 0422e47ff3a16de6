// Where nodes are tied: the segments of a part, and the place on them that is nearest to a node.
#pragma once

#include <string>
#include <vector>

#include "contact/part_tie.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// What nodes can be tied to: the outer faces of solids, shells, and the elements of cables and
/// beams. Corners are nodes of the scene; the last is repeated to fill four.
std::vector<Corners> tie_segments(const Part& part);

/// The nearest place on the segments for each node, in their order; `farthest` is the largest
/// distance, at `row_there`. A weight below 1e-9 counts as none.
struct TieRows {
  std::vector<TiedNode> rows;
  double farthest = 0;    ///< [m]
  double size_there = 0;  ///< longest side of the segment there [m]
  std::size_t row_there = 0;
};

/// Finds them. Needs at least one segment. However far a node is, it gets a row: farthest and
/// size_there tell the caller whether one is too far.
TieRows find_tie_rows(const Scene& scene, const std::vector<Index>& nodes,
                      const std::vector<Corners>& segments);

}  // namespace gannet
