// Whether a tie across models stands away from the waves that only the fine mesh holds.
#pragma once

#include <string>

#include "contact/part_tie.hpp"

namespace gannet {

/// Layers of elements of a part, counted from nodes of it: the largest number of elements on the
/// shortest ways from these nodes to any other, 0 without nodes of the part.
/// Counts to `most` and no further, for each layer is a pass over the part.
int layers_from(const Part& part, const std::vector<Index>& nodes, int most);

/// What a tie of parts in two models lacks for its fast side to be a buffer: at least three layers
/// of elements whose waves the slow mesh holds too, taken as elements that allow at least 0.7 of
/// the step of the slow part's ("Ties of parts in different models" in docs/theory.md). "" where it
/// lacks nothing, where both sides belong to one model, or where the fast one takes no smaller
/// steps. Reads the votes of the last force stage.
std::string missing_buffer(const Scene& scene, Models& models, const PartTie& tie);

}  // namespace gannet
