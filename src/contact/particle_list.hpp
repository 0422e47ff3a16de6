// What the lists of contacts between particles and surfaces have in common.
#pragma once

#include <span>

#include "contact/surface.hpp"
#include "scene/periods.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The lines of the particles, of lines of all nodes.
std::span<const Line> particle_lines(const Scene& scene, const Array<Line>& lines);

/// The lines of the scene's own particles, of lines of particles and their images.
std::span<const Line> owned_lines(const Scene& scene, const Array<Line>& lines);

/// Bounds of a skin [m].
struct SkinRange {
  double least = 0;
  double most = 0;
};

/// The skin of a new list [m]: what the fastest particle, seen from the first node of the surface,
/// goes in eight steps of dt [s], within the range and never beyond a quarter of a period, where it
/// would not be known which image is meant.
double list_skin(const Scene& scene, const Surface& surface, const Periods& periods, double dt,
                 SkinRange range);

}  // namespace gannet
