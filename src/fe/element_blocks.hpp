// Elements in blocks of eight, one a lane of a vector, and passes over them chunk by chunk.
#pragma once

#include <span>

#include "base/array.hpp"
#include "base/parallel.hpp"
#include "fe/colouring.hpp"

namespace gannet {

inline constexpr Index lanes = 8;

/// Number of blocks that n elements fill.
inline Index blocks_for(Index n) { return (n + lanes - 1) / lanes; }

/// Corner a of lane l of block b at (nodes b + a) lanes + l, nodes = nodes_per_element; the empty
/// lanes of the last block repeat the last element. connectivity: the nodes of each element.
Array<Index> corners_by_block(std::span<const Index> connectivity, int nodes_per_element);

/// Corner a of element e of such an array.
inline Index corner_of(std::span<const Index> corners, int nodes_per_element, Index e, int a) {
  return corners[static_cast<std::size_t>((e / lanes * nodes_per_element + a) * lanes + e % lanes)];
}

/// Where number k of element e stands in the state of a block: n_values numbers an element, eight
/// elements beside each other.
inline std::size_t place_in_blocks(Index e, int k, int n_values) {
  return static_cast<std::size_t>((e / lanes * n_values + k) * lanes + e % lanes);
}

/// Calls f(chunk, first block, end of blocks) for all chunks, those of one colour at the same time.
template <class F>
void for_chunks_by_colour(const ChunkColours& colouring, Index n_elements, F&& f) {
  const Index per_chunk = colouring.chunk / lanes;
  const Index n_blocks = blocks_for(n_elements);
  for (const std::vector<Index>& colour : colouring.colours) {
    parallel_for(static_cast<Index>(colour.size()), 1, [&](Index begin, Index end) {
      for (Index k = begin; k < end; ++k) {
        const Index chunk = colour[static_cast<std::size_t>(k)];
        f(chunk, chunk * per_chunk, std::min(n_blocks, (chunk + 1) * per_chunk));
      }
    });
  }
}

}  // namespace gannet
