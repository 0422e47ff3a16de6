// Which parts have a surface that contact knows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace gannet {

/// Parts of cables and beams: nodes, and no surface.
inline bool is_line(const Part& part) { return part.kind == "cable" || part.kind == "beam"; }

/// Parts of shells, solids and rigid surfaces; not cables, beams and particles.
inline bool has_surface(const Part& part) {
  return !part.is_particles() && !is_line(part) && part.cell != Cell::point;
}

/// The numbers of two parts of elements; {-1, -1} where the names are not two, or one is no part or
/// a part of particles.
inline std::array<int, 2> element_parts(const Scene& scene, const std::vector<std::string>& names) {
  if (names.size() != 2) return {-1, -1};
  std::array<int, 2> parts{};
  for (std::size_t k = 0; k < 2; ++k) {
    parts[k] = scene.part_number(names[k]);
    if (parts[k] < 0 || scene.parts[static_cast<std::size_t>(parts[k])].is_particles()) {
      return {-1, -1};
    }
  }
  return parts;
}

}  // namespace gannet
