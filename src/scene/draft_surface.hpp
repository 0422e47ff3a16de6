// The closed surface of parts that are drafts still.
#pragma once

#include <string>
#include <vector>

#include "mesh/closed_surface.hpp"
#include "scene/draft.hpp"

namespace gannet {

/// The surface that the named parts enclose together: their cells, or the outer faces of solids.
/// Complains of `key` of `keys`, and returns a surface without facets, where a part is not there or
/// the surface encloses nothing.
ClosedSurface closed_surface_of(const Draft& draft, const std::vector<std::string>& names,
                                const Keys& keys, const char* key);

}  // namespace gannet
