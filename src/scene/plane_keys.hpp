// Planes as a case writes them: boundaries.NAME: {planes: {x: [from, to], ...}} across the axes,
// and boundaries.NAME: {plane: {point, normal}} in any direction.
#pragma once

#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The keys of boundaries.* that describe planes.
Schema plane_schema();

/// All planes of a case, in file order: "basin.x_min", "basin.x_max", ... of `planes`, "ramp" of
/// `plane`. Notes mistakes at their places and leaves those planes out. Throws nothing.
std::vector<Plane> read_planes(const Keys& root);

}  // namespace gannet
