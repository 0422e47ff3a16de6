// Which parts have a surface that contact knows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Parts of cables and beams: nodes, and no surface.
inline bool is_line(const Part& part) { return part.kind == "cable" || part.kind == "beam"; }

/// Parts of shells, solids and rigid surfaces; not cables, beams and particles.
inline bool has_surface(const Part& part) {
  return !part.is_particles() && !is_line(part) && part.cell != Cell::point;
}

/// Whether a contact is of type kernel, which contact/kernel_contacts.cpp reads and no other.
inline bool is_kernel_contact(const Keys& keys) { return keys.word("type") == "kernel"; }

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

/// Numbers of the planes of a boundary, those named NAME or NAME.something.
inline std::vector<std::size_t> planes_of(const Scene& scene, const std::string& name) {
  std::vector<std::size_t> planes;
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const std::string& plane = scene.planes[k].name;
    if (plane == name || plane.starts_with(name + ".")) planes.push_back(k);
  }
  return planes;
}

/// The number of the part where the names are one part of elements and a boundary with planes, in
/// either order; otherwise -1.
inline int part_before_planes(const Scene& scene, const std::vector<std::string>& names) {
  if (names.size() != 2) return -1;
  for (std::size_t k = 0; k < 2; ++k) {
    const int part = scene.part_number(names[k]);
    const std::string& other = names[1 - k];
    if (part < 0 || scene.part_number(other) >= 0 || planes_of(scene, other).empty()) continue;
    if (!scene.parts[static_cast<std::size_t>(part)].is_particles()) return part;
  }
  return -1;
}

/// Contact stands off from the nodes, wherever the middle of the shell lies: warns where that is
/// not the same [m].
void warn_of_offset(Scene& scene, const Keys& keys, int part, double offset);

}  // namespace gannet
