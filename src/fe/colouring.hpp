// Chunks of consecutive elements in colours: chunks of one colour share no node, so they may add
// their forces at the same time; colours run one after the other, so every node collects its forces
// in the same order whatever the number of threads.
#pragma once

#include <span>
#include <vector>

#include "base/array.hpp"

namespace gannet {

/// Chunk numbers by colour, in rising order within a colour.
struct ChunkColours {
  Index chunk = 0;  ///< elements per chunk
  Index n_chunks = 0;
  std::vector<std::vector<Index>> colours;
};

/// Gives each chunk of `chunk` consecutive elements the first colour that none of its neighbours
/// has. connectivity: nodes_per_element nodes an element. Needs chunk > 0. Throws
/// std::length_error where more than 64 colours would be needed (a hopeless numbering).
ChunkColours colour_chunks(std::span<const Index> connectivity, int nodes_per_element, Index chunk);

}  // namespace gannet
