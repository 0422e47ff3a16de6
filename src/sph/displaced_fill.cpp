// fill.outside: particles stand only where bodies are not. It looks at the parts of the draft once
// all of them are there, and so stands in the table behind whoever makes them.
#include <algorithm>
#include <cstdint>

#include "base/parallel.hpp"
#include "scene/draft_surface.hpp"
#include "sph/effects.hpp"

namespace gannet {

namespace {

Schema schema() {
  return {{"parts.*.fill",
           {.name = "outside",
            .kind = Kind::names,
            .text = "parts that together enclose a volume in which no particles start, nor nearer "
                    "to it than half a spacing"}}};
}

/// Removes the points that are inside of the surface or nearer to it than `gap` [m].
void clear_inside(const ClosedSurface& surface, double gap, std::vector<Vec3>& points) {
  Vec3 low = surface.points.front();
  Vec3 high = low;
  for (const Vec3& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // A point that is meant to stand at this distance misses it by rounding.
  const double nearest = gap * (1 - 1e-6);
  std::vector<std::uint8_t> inside(points.size(), 0);
  parallel_for(static_cast<Index>(points.size()), 256, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const Vec3& x = points[k];
      if (((x - low).array() < -gap).any() || ((x - high).array() > gap).any()) continue;
      inside[k] = contains(surface, x) || distance(surface, x) < nearest ? 1 : 0;
    }
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (inside[k] == 0) points[kept++] = points[k];
  }
  points.resize(kept);
}

/// Distance of neighbouring particles of a part; 0 where it has none of its own.
double spacing_of(const Keys& root, const Keys& part) {
  if (part.has("sph")) return part.map("sph").number_or("spacing", 0);
  const Keys wall = part.map("wall");
  if (!wall.has("like") || !root.map("parts").has(wall.word("like"))) return 0;
  return root.map("parts").map(wall.word("like")).map("sph").number_or("spacing", 0);
}

void parts(const Keys& root, Draft& draft) {
  for (PartDraft& part : draft.parts) {
    const Keys keys = root.map("parts").map(part.name);
    const Keys fill = keys.map("fill");
    if (part.cell != Cell::none || !fill.has("outside") || part.points.empty()) continue;
    const ClosedSurface surface = closed_surface_of(draft, fill.words("outside"), fill, "outside");
    if (surface.facets.empty()) continue;
    clear_inside(surface, 0.5 * spacing_of(root, keys), part.points);
    if (part.points.empty()) fill.complain("outside", "leaves no particle");
  }
}

}  // namespace

Effect displaced_fill_effect() {
  return {.name = "displaced fill", .schema = schema, .parts = parts};
}

}  // namespace gannet
