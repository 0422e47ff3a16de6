// Where dummy particles stand inside of a closed surface.
//
// They start in a lattice over the box around the surface. Where that fits the surface, its first
// layer half a spacing below every face, it is kept. Else the points spread out evenly, as a packed
// crowd does:
//   x_i -= dx^2 sum_j V_j grad W_ij,   no nearer to the surface than dx/2
// The sum counts the other points inside (V = dx^d), and the space outside as points of a finer
// lattice at rest (V = (dx/2)^d): so points next to the surface feel no pull towards it. W is a
// Wendland C2 kernel with h = 1.3 dx: with a cubic spline, which hardly parts what is close, they
// stay 0.6 dx apart.
#pragma once

#include <vector>

#include "mesh/closed_surface.hpp"

namespace gannet {

/// Points inside of a surface that start no deeper than n_layers dx below it, one for dx^d of its
/// volume; none where it is thinner than half a spacing. The same ones for any number of threads.
/// dx: spacing of the water [m], > 0. Needs close_surface().
std::vector<Vec3> inner_layers(const ClosedSurface& surface, double dx, int n_layers);

}  // namespace gannet
