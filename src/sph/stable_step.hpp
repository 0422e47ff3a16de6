// How large a step the particles allow, derived from the frequencies of their lattice.
#pragma once

#include "kernel/smoothing_kernel.hpp"

namespace gannet {

/// The largest frequency and damping rate that the pair passes give a lattice of particles.
struct LatticeLimits {
  double sound = 0;    ///< omega h / c: largest of all sound waves [-]
  double viscous = 0;  ///< lambda h / (alpha c): largest damping rate of the viscosity [-]
  int dimension = 3;   ///< d
  double laminar = 0;  ///< lambda h^2/nu: largest damping rate of laminar viscosity [-]; that of
                       ///< density diffusion, over delta c/h
};

/// The limits of a cubic lattice.
/// Linearised about rest, a wave v = e exp(i k.x) with V = m/rho0 has
///   omega(k) = c |sum_j V F(r_j) r_j sin(k.r_j)|
///   lambda(k, e) = alpha c h e . [sum_j V |F| r_j r_j^T (1 - cos k.r_j)/(r_j^2 + 0.01 h^2)] e
/// (all pairs are taken to approach, which bounds the viscosity that only acts on approach), with
/// laminar viscosity and with density diffusion
///   lambda(k) = 2 nu sum_j V |F| (1 - cos k.r_j),  2 delta c h sum_j V |F| (1 - cos k.r_j)
/// All are searched along the edge and the face and space diagonals of the lattice, up to its
/// shortest wave. dimension: 2 or 3; ratio: h/dx, > 0.
LatticeLimits lattice_limits(KernelType kernel, int dimension, double ratio);

/// Stable step of the step function [s].
/// The mode x'' = -omega^2 x - lambda x' with the damping evaluated at v(n-1/2) gives
///   z^2 - (2 - lambda dt - omega^2 dt^2) z + (1 - lambda dt) = 0,
/// whose roots leave the unit circle at z = -1: omega^2 dt^2 + 2 lambda dt = 4, so
///   dt = (2/omega) (sqrt(1 + xi^2) - xi),  xi = lambda/(2 omega).
/// Returned is dt = cfl (h/c) (sqrt(1 + xi^2) - xi), with omega = limits.sound c/h: cfl =
/// 2/limits.sound is the limit of the lattice. Damping of the density, evaluated with rho(n),
/// counts as that of the velocity: at z = -1 both together allow more than the sum of their rates
/// says. h: [m]; c: [m/s]; lambda: sum of all damping rates, see largest_damping() [1/s]; all > 0
/// (lambda may be 0).
double stable_step(const LatticeLimits& limits, double cfl, double h, double c, double lambda);

/// What damps particles, for the stable step.
struct Damping {
  double slope = 0;  ///< alpha c + 2 beta |mu|: slope of rho |Pi| over |mu| [m/s]
  double nu = 0;     ///< laminar kinematic viscosity [m^2/s]
  double central_nu =
      0;                 ///< that acts along the line of a pair, 2 (d + 2) times the sum of `slope`
  double diffusion = 0;  ///< delta c0 [m/s]
};

/// Sum of the largest damping rates [1/s] of a lattice.
///   lambda = limits.viscous (slope/h + 2 (d + 2) central_nu/h^2) + limits.laminar (nu/h^2 +
///   diffusion/h)
double largest_damping(const LatticeLimits& limits, double h, const Damping& damping);

}  // namespace gannet
