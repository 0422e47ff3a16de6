#include "scene/draft_surface.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gannet {

namespace {

/// Cells that fill a volume; all others are taken as the surface of one.
bool is_solid(const PartDraft& part, int dimension) {
  if (part.cell == Cell::tetrahedron || part.cell == Cell::hexahedron) return true;
  return dimension == 2 && part.cell == Cell::quad;
}

}  // namespace

ClosedSurface closed_surface_of(const Draft& draft, const std::vector<std::string>& names,
                                const Keys& keys, const char* key) {
  ClosedSurface surface{.dimension = draft.dimension};
  const auto say = [&](const std::string& message) {
    keys.complain(key, message);
    return ClosedSurface{};
  };
  for (const std::string& name : names) {
    const auto part = std::ranges::find(draft.parts, name, &PartDraft::name);
    if (part == draft.parts.end()) return say(fmt::format("there is no part '{}'", name));
    const bool in_space = draft.dimension == 3 && part->cell == Cell::line;
    if (part->cell == Cell::none || in_space) {
      return say(
          fmt::format("part '{}' encloses no volume: a closed surface or solids are wanted", name));
    }
    add_boundary(part->points, part->connectivity, nodes_per(part->cell),
                 is_solid(*part, draft.dimension), surface);
  }
  const std::string why_not = close_surface(surface);
  return why_not.empty() ? surface : say(why_not);
}

}  // namespace gannet
