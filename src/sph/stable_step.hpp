// How large a step the particles allow, derived from the frequencies of their lattice.
#pragma once

namespace gannet {

/// The largest frequency and damping rate that the pair passes give a lattice of particles.
struct LatticeLimits {
  double sound = 0;    ///< omega h / c: largest of all sound waves [-]
  double viscous = 0;  ///< lambda h / (alpha c): largest damping rate of the viscosity [-]
};

/// The limits of a cubic lattice with the cubic spline.
/// Linearised about rest, a wave v = e exp(i k.x) with V = m/rho0 has
///   omega(k) = c |sum_j V F(r_j) r_j sin(k.r_j)|
///   lambda(k, e) = alpha c h e . [sum_j V |F| r_j r_j^T (1 - cos k.r_j)/(r_j^2 + 0.01 h^2)] e
/// (all pairs are taken to approach, which bounds the viscosity that only acts on approach). Both
/// are searched along the edge and the face and space diagonals of the lattice, up to its shortest
/// wave. dimension: 2 or 3; ratio: h/dx, > 0.
LatticeLimits lattice_limits(int dimension, double ratio);

/// Stable step of the step function [s].
/// The mode x'' = -omega^2 x - lambda x' with the damping evaluated at v(n-1/2) gives
///   z^2 - (2 - lambda dt - omega^2 dt^2) z + (1 - lambda dt) = 0,
/// whose roots leave the unit circle at z = -1: omega^2 dt^2 + 2 lambda dt = 4, so
///   dt = (2/omega) (sqrt(1 + xi^2) - xi),  xi = lambda/(2 omega).
/// Returned is dt = cfl (h/c) (sqrt(1 + xi^2) - xi), with omega = limits.sound c/h and
/// lambda = limits.viscous a/h: cfl = 2/limits.sound is the limit of the lattice.
/// h: [m]; c: [m/s]; a: alpha c + 2 beta |mu| [m/s], the slope of rho |Pi| over |mu|; all > 0
/// (a may be 0).
double stable_step(const LatticeLimits& limits, double cfl, double h, double c, double a);

}  // namespace gannet
