// fill.outside: particles stand only where bodies are not. It looks at the parts of the draft once
// all of them are there, and so stands in the table behind whoever makes them.
#include <cstdint>

#include "scene/draft_surface.hpp"
#include "scene/periods.hpp"
#include "sph/effects.hpp"
#include "sph/outer_layers.hpp"

namespace gannet {

namespace {

Schema schema() {
  return {
      {"parts.*.fill",
       {.name = "outside",
        .kind = Kind::names,
        .text = "parts that together enclose a volume in which no particles start; those next to "
                "it stand evenly, half a spacing off"}}};
}

/// Takes out the points that the surface displaces, and lets those next to it stand around it.
/// Looks at the image of each point that is nearest to the middle of the surface, which must be
/// smaller than the periods.
void clear_inside(const ClosedSurface& surface, double spacing, const Periods& periods,
                  std::vector<Vec3>& points) {
  Vec3 low = surface.points.front();
  Vec3 high = low;
  for (const Vec3& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Vec3> shift(points.size(), Vec3::Zero());
  if (periods.any()) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3 image = image_near(periods, points[k], 0.5 * (low + high));
      shift[k] = image - points[k];
      points[k] = image;
    }
  }
  const std::vector<std::uint8_t> stays = stand_outside(surface, spacing, points);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (stays[k] != 0) points[kept++] = points[k] - shift[k];
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

/// The periods of the domain as the case has them; whether they are sound is for sph/periodic.cpp,
/// which complains of those below two spacings [m] that are left out here: a unit mistaken would
/// make images without number.
Periods periods_of(const Keys& root, int dimension, double spacing) {
  Periods periods;
  if (!root.has("boundaries")) return periods;
  for (const std::string& name : root.map("boundaries").names()) {
    const Keys keys = root.map("boundaries").map(name).map("periodic");
    for (int d = 0; d < dimension; ++d) {
      const std::string axis(1, "xyz"[d]);
      if (!keys.has(axis) || keys.numbers(axis).size() != 2) continue;
      const double length = keys.numbers(axis)[1] - keys.numbers(axis)[0];
      if (length > 2 * spacing) periods.length[d] = length;
    }
  }
  return periods;
}

void parts(const Keys& root, Draft& draft) {
  for (PartDraft& part : draft.parts) {
    const Keys keys = root.map("parts").map(part.name);
    const Keys fill = keys.map("fill");
    if (part.cell != Cell::none || !fill.has("outside") || part.points.empty()) continue;
    const ClosedSurface surface = closed_surface_of(draft, fill.words("outside"), fill, "outside");
    if (surface.facets.empty()) continue;
    const double spacing = spacing_of(root, keys);
    clear_inside(surface, spacing, periods_of(root, draft.dimension, spacing), part.points);
    if (part.points.empty()) fill.complain("outside", "leaves no particle");
  }
}

}  // namespace

Effect displaced_fill_effect() {
  return {.name = "displaced fill", .schema = schema, .parts = parts};
}

}  // namespace gannet
