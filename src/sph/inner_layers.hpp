// Where dummy particles stand inside of a closed surface.
//
// They start in a lattice over the box around the surface. Where that fits the surface, its first
// layer half a spacing below every face, it is kept. Else the points spread out evenly
// (sph/crowd.hpp), against the space outside as points of a finer lattice at rest.
#pragma once

#include <vector>

#include "mesh/closed_surface.hpp"

namespace gannet {

/// Points inside of a surface that start no deeper than n_layers dx below it, one for dx^d of its
/// volume; none where it is thinner than half a spacing. The same ones for any number of threads.
/// dx: spacing of the water [m], > 0. Needs close_surface().
std::vector<Vec3> inner_layers(const ClosedSurface& surface, double dx, int n_layers);

}  // namespace gannet
