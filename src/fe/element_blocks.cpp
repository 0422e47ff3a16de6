#include "fe/element_blocks.hpp"

#include <algorithm>

namespace gannet {

Array<Index> corners_by_block(std::span<const Index> connectivity, int nodes_per_element) {
  const auto nodes = static_cast<Index>(nodes_per_element);
  const Index n = static_cast<Index>(connectivity.size()) / nodes;
  Array<Index> corners(static_cast<std::size_t>(blocks_for(n) * nodes * lanes), 0);
  for (Index lane = 0; lane < lanes * blocks_for(n); ++lane) {
    const Index e = std::min(lane, n - 1);
    for (Index a = 0; a < nodes; ++a) {
      corners[static_cast<std::size_t>((lane / lanes * nodes + a) * lanes + lane % lanes)] =
          connectivity[static_cast<std::size_t>(nodes * e + a)];
    }
  }
  return corners;
}

}  // namespace gannet
