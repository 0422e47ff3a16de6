// Which particles of a lattice stand outside of a closed surface, and where those next to it stand.
//
// Taken out are as many as the surface encloses volume, the deepest ones: a cut at half a spacing
// off the surface would on the mean leave out half a layer too much, and the water that closes this
// gap sinks and stirs. A lattice that fits the surface, its first layer half a spacing off every
// face, is left as it is. Else the points of four layers spread out evenly (sph/crowd.hpp), against
// the cells inside of the surface as points of a finer lattice at rest, and against the lattice as
// it would go on beyond its ends, so that they keep their distance from free surfaces and other
// parts.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/closed_surface.hpp"

namespace gannet {

/// How far from a surface points matter to those that stand_outside() moves [m].
double reach_outside(const ClosedSurface& surface, double dx);

/// Moves points of a lattice next to a surface to where they stand outside of it, and returns 1 for
/// each point that stays, 0 for those whose place the surface takes. lattice: points [m], one a
/// cell of about dx^d; dx: their spacing [m], > 0. The same ones for any number of threads. Needs
/// close_surface().
std::vector<std::uint8_t> stand_outside(const ClosedSurface& surface, double dx,
                                        std::vector<Vec3>& lattice);

}  // namespace gannet
