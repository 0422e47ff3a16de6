// What all beams of a part share, and the bending stiffness that it gives an element.
#pragma once

#include "fe/beam_fibres.hpp"
#include "fe/beam_section.hpp"
#include "fe/stiffness_damping.hpp"

namespace gannet {

/// What all beams of a part share.
struct BeamLaw {
  BeamSection section;
  double E = 0;               ///< Young's modulus [Pa], > 0
  double G = 0;               ///< shear modulus [Pa], > 0
  double rho = 0;             ///< density [kg/m^3], > 0
  double rotary_inertia = 0;  ///< of a node about y, z over m I_y/A, m I_z/A; 0: rotary_ratios()
  double dt_factor = 0.9;     ///< share of the stable step that is voted for
  UniaxialLaw yield;          ///< of the fibres; elastic unless it yields
  StiffnessDamping damping;
};

/// 12 E I/(G A_s l^2); 0 where the section is stiff in shear.
inline double shear_ratio(const BeamLaw& law, double I, double A_s, double l) {
  return A_s > 0 ? 12 * law.E * I / (law.G * A_s * l * l) : 0;
}

/// Stiffness of an element against the rotations of its ends in one plane, and its part of it:
///   M_1 = k4 theta_1 + k2 theta_2,  M_2 = k2 theta_1 + k4 theta_2
struct BendingStiffness {
  double k4 = 0;  ///< E I/l0 (4 + phi)/(1 + phi) [N m]
  double k2 = 0;  ///< E I/l0 (2 - phi)/(1 + phi) [N m]
};

/// Of an element of length l0 [m], about the axis of I [m^4] with the area A_s [m^2] that carries
/// shear across it.
inline BendingStiffness bending_of(const BeamLaw& law, double I, double A_s, double l0) {
  const double phi = shear_ratio(law, I, A_s, l0);
  const double k = law.E * I / (l0 * (1 + phi));
  return {k * (4 + phi), k * (2 - phi)};
}

}  // namespace gannet
