// Points beside a closed surface that spread out evenly, as a packed crowd does:
//   x_i -= dx^2 sum_j V_j grad W_ij,   no nearer to the surface than dx/2
// The sum counts the other points (V = dx^d), and what stands for the space on the other side of
// the surface (points of a finer lattice at rest), so that points next to the surface feel no pull
// towards it. W is a Wendland C2 kernel with h = 1.3 dx: with a cubic spline, which hardly parts
// what is close, they stay 0.6 dx apart.
#pragma once

#include <vector>

#include "kernel/smoothing_kernel.hpp"
#include "mesh/closed_surface.hpp"

namespace gannet {

struct Crowd {
  const ClosedSurface* surface = nullptr;
  double dx = 0;  ///< distance that points keep to each other [m]
  SmoothingKernel kernel;
  std::vector<Vec3> x;    ///< all points: those that move, then those that stay [m]
  std::vector<double> V;  ///< [m^3]; in the plane [m^2]
  std::size_t n_moving = 0;
  std::vector<std::vector<std::size_t>> facets;  ///< that a moving point may come near
  std::vector<std::vector<std::size_t>> near;    ///< points around each of those that move
};

/// A crowd without points, with the kernel that it takes.
Crowd crowd_beside(const ClosedSurface& surface, double dx);

/// Finds the facets that moving points may come near, from their distances to the surface [m].
/// distances: one for each moving point.
void find_facets(Crowd& crowd, const std::vector<double>& distances);

/// Moves the moving points until they rest, at most 300 times; each stays on its side of the
/// surface. The same places for any number of threads. Needs find_facets().
void spread_out(Crowd& crowd);

}  // namespace gannet
