// fill.outside: particles stand only where bodies are not. It looks at the parts of the draft once
// all of them are there, and so stands in the table behind whoever makes them.
#include <cstdint>

#include "base/parallel.hpp"
#include "scene/draft_surface.hpp"
#include "scene/periods.hpp"
#include "sph/effects.hpp"
#include "sph/outer_layers.hpp"
#include "sph/wall_parts.hpp"

namespace gannet {

namespace {
namespace displaced_fill {

Schema schema() {
  return {
      {"parts.*.fill",
       {.name = "outside",
        .kind = Kind::names,
        .text = "parts that together enclose a volume in which no particles start; water next to "
                "it stands evenly, half a spacing off"}}};
}

/// Where the domain repeats.
struct Repeats {
  Periods periods;
  Vec3 middle = Vec3::Zero();  ///< of the domain, in directions that repeat [m]
};

struct Box {
  Vec3 low;
  Vec3 high;
};

Box box_around(const ClosedSurface& surface) {
  Box box{surface.points.front(), surface.points.front()};
  for (const Vec3& p : surface.points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

void keep(const std::vector<std::uint8_t>& stays, std::vector<Vec3>& points) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (stays[k] != 0) points[kept++] = points[k];
  }
  points.resize(kept);
}

/// Removes the points that are, or have an image that is, inside of the surface or nearer to it
/// than `gap` [m].
void cut(const ClosedSurface& surface, double gap, const Periods& periods,
         std::vector<Vec3>& points) {
  const auto [low, high] = box_around(surface);
  // A point that is meant to stand at this distance misses it by rounding.
  const double nearest = gap * (1 - 1e-6);
  std::vector<std::uint8_t> stays(points.size(), 1);
  const auto look_at = [&](std::size_t k) {
    for_images_in(periods, points[k], low.array() - gap, high.array() + gap, [&](const auto& n) {
      const Vec3 x = image_of(periods, points[k], n);
      if (((x - low).array() < -gap).any() || ((x - high).array() > gap).any()) return;
      if (contains(surface, x) || distance(surface, x) < nearest) stays[k] = 0;
    });
  };
  parallel_for(static_cast<Index>(points.size()), 256, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) look_at(static_cast<std::size_t>(k));
  });
  keep(stays, points);
}

/// Whether no point is near two images of the surface.
bool has_room(const ClosedSurface& surface, double spacing, const Periods& periods) {
  const auto [low, high] = box_around(surface);
  const double reach = reach_outside(surface, spacing);
  for (int d = 0; d < 3; ++d) {
    const double L = periods.length[d];
    if (L > 0 && high[d] - low[d] + 2 * reach > L) return false;
  }
  return true;
}

/// Takes out the points that the surface displaces, and lets those next to it stand around it.
/// Looks at the image of each point that is nearest to the middle of the surface; needs has_room().
void part_water(const ClosedSurface& surface, double spacing, const Repeats& repeats,
                std::vector<Vec3>& points) {
  const auto [low, high] = box_around(surface);
  std::vector<Vec3> images = points;
  for (Vec3& x : images) x = image_near(repeats.periods, x, 0.5 * (low + high));
  const std::vector<Vec3> before = images;
  const std::vector<std::uint8_t> stays = stand_outside(surface, spacing, images);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (images[k] != before[k]) points[k] = image_near(repeats.periods, images[k], repeats.middle);
  }
  keep(stays, points);
}

/// Distance of neighbouring particles of a part; 0 where it has none of its own.
double spacing_of(const Keys& root, const Keys& part) {
  if (part.has("sph")) return part.map("sph").number_or("spacing", 0);
  if (!part.has("wall")) return 0;
  const std::string fluid = named_fluid(root, part.map("wall"));
  if (fluid.empty() || !root.map("parts").has(fluid)) return 0;
  return root.map("parts").map(fluid).map("sph").number_or("spacing", 0);
}

/// The periods of the domain as the case has them; whether they are sound is for sph/periodic.cpp,
/// which complains of those below two spacings [m] that are left out here: a unit mistaken would
/// make images without number.
Repeats repeats_of(const Keys& root, int dimension, double spacing) {
  Repeats repeats;
  if (!root.has("boundaries")) return repeats;
  for (const std::string& name : root.map("boundaries").names()) {
    const Keys keys = root.map("boundaries").map(name).map("periodic");
    for (int d = 0; d < dimension; ++d) {
      const std::string axis(1, "xyz"[d]);
      if (!keys.has(axis) || keys.numbers(axis).size() != 2) continue;
      const std::vector<double> ends = keys.numbers(axis);
      if (ends[1] - ends[0] <= 2 * spacing) continue;
      repeats.periods.length[d] = ends[1] - ends[0];
      repeats.middle[d] = 0.5 * (ends[0] + ends[1]);
    }
  }
  return repeats;
}

void parts(const Keys& root, Draft& draft) {
  for (PartDraft& part : draft.parts) {
    const Keys keys = root.map("parts").map(part.name);
    const Keys fill = keys.map("fill");
    if (part.cell != Cell::none || !fill.has("outside") || part.points.empty()) continue;
    const ClosedSurface surface = closed_surface_of(draft, fill.words("outside"), fill, "outside");
    if (surface.facets.empty()) continue;
    const double spacing = spacing_of(root, keys);
    const Repeats repeats = repeats_of(root, draft.dimension, spacing);
    if (keys.has("sph") && has_room(surface, spacing, repeats.periods)) {
      part_water(surface, spacing, repeats, part.points);
    } else {
      cut(surface, 0.5 * spacing, repeats.periods, part.points);
    }
    if (part.points.empty()) fill.complain("outside", "leaves no particle");
  }
}

}  // namespace displaced_fill
}  // namespace

Effect displaced_fill_effect() {
  return {
      .name = "displaced fill", .schema = displaced_fill::schema, .parts = displaced_fill::parts};
}

}  // namespace gannet
