// The law of kernel contact: a potential between two small volumes that follows from the smoothing
// kernel, and what of it a plane of nodes does to a particle.
#pragma once

#include <array>

#include "kernel/smoothing_kernel.hpp"

namespace gannet {

/// Kernel contact between volumes V_i and V_j at a distance r: energy V_i V_j phi(r),
///   phi = K (W(r)/W(dp))^n
/// so that the force on i, minus its gradient, is
///   f_i = -V_i V_j K n W^(n-1)/W(dp)^n grad_i W
/// which pushes i away from j, with W the kernel of the particles and dp their spacing. f_j = -f_i,
/// along the line between them: momentum and angular momentum are kept to rounding, and the energy
/// is a function of the places. De Vuyst, Vignjevic and Campbell 2005, Int. J. Impact Eng. 31,
/// 1054, as given in the slides "Modelling transient fluid loading on flexible structures" (there
/// without the sign of the force).
struct KernelLaw {
  static constexpr int n_bins = 128;
  SmoothingKernel kernel;
  int n = 2;        ///< exponent, at least 1
  double K = 0;     ///< [Pa/m^dimension]
  double W_dp = 0;  ///< W(dp) [1/m^dimension]
  /// Over equal bins of r within the reach the largest of |phi''| and |phi'/r| in the bin, for K =
  /// 1 [1/m^2]: no eigenvalue of the second gradient of phi is larger.
  std::array<double, n_bins> stiffness{};

  /// phi(r) [Pa/m^dimension]; r: [m], >= 0.
  [[nodiscard]] double potential(double r) const;
  /// s with f_i = V_i V_j s (x_i - x_j) [Pa/m^(dimension + 2)], finite at r = 0.
  [[nodiscard]] double force_by_distance(double r) const;
  /// The bound of the stiffness from the table, times K [Pa/m^(dimension + 2)].
  [[nodiscard]] double stiffness_at(double r) const;
};

/// A law with its table, for K = 1. dp: spacing of the particles [m]; n: 1 to 8. Throws nothing.
KernelLaw make_kernel_law(const SmoothingKernel& kernel, double dp, int n);

/// Force of an infinite plane of nodes that stand for a layer of thickness t on a particle of
/// volume V at the height z above it,
///   f = -V t d/dz int phi dA
/// in the plane per unit of depth. V: [m^dimension]; t, z: [m]. Needs z >= 0.
double force_of_plane(const KernelLaw& law, double V, double t, double z);

/// Energy of a particle there, V t int phi dA; falls with z. Units and needs as above. [J]
double energy_of_plane(const KernelLaw& law, double V, double t, double z);

/// The greatest height above such a plane at which its force is as large as `force` [m]; 0 where it
/// never is. force: [N], above 0 (in the plane per unit of depth).
double height_of_force(const KernelLaw& law, double V, double t, double force);

/// The height above such a plane at which a particle has that energy [m], 0 where it has none as
/// large. energy: above 0, as of energy_of_plane().
double height_of_energy(const KernelLaw& law, double V, double t, double energy);

/// The K with which such a plane holds a particle at half a spacing with the force that penalty
/// contact has at the surface itself, its largest: 1/2 rho0 c0^2 dp^2 (dp in the plane case).
double standard_K(const KernelLaw& law, double dp, double t, double rho0, double c0);

}  // namespace gannet
