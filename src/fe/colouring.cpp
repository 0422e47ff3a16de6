#include "fe/colouring.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <stdexcept>

namespace gannet {

ChunkColours colour_chunks(std::span<const Index> connectivity, int nodes_per_element,
                           Index chunk) {
  assert(chunk > 0 && nodes_per_element > 0);
  ChunkColours result;
  result.chunk = chunk;
  const std::size_t per_chunk =
      static_cast<std::size_t>(chunk) * static_cast<std::size_t>(nodes_per_element);
  result.n_chunks = static_cast<Index>((connectivity.size() + per_chunk - 1) / per_chunk);
  Index highest = -1;
  for (const Index node : connectivity) highest = std::max(highest, node);
  // Bit c of a node: a chunk of colour c uses it.
  std::vector<std::uint64_t> used(static_cast<std::size_t>(highest + 1), 0);
  for (Index k = 0; k < result.n_chunks; ++k) {
    const std::size_t first = static_cast<std::size_t>(k) * per_chunk;
    const auto mine = connectivity.subspan(first, std::min(per_chunk, connectivity.size() - first));
    std::uint64_t taken = 0;
    for (const Index node : mine) taken |= used[static_cast<std::size_t>(node)];
    const int colour = std::countr_one(taken);
    if (colour >= 64) throw std::length_error("colour_chunks: more than 64 colours needed");
    if (colour >= static_cast<int>(result.colours.size())) result.colours.emplace_back();
    result.colours[static_cast<std::size_t>(colour)].push_back(k);
    for (const Index node : mine) {
      used[static_cast<std::size_t>(node)] |= std::uint64_t{1} << colour;
    }
  }
  return result;
}

}  // namespace gannet
