// Sections of beams: what a shape of the section means for stiffness and mass.
#pragma once

#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"

namespace gannet {

/// A point of a section that stands for the area A [m^2] around it, y, z [m].
struct BeamFibre {
  double y = 0;
  double z = 0;
  double A = 0;
};

/// A section about its centre; y and z are its principal axes.
struct BeamSection {
  double A = 0;    ///< area [m^2], > 0
  double I_y = 0;  ///< integral of z^2, for bending along z [m^4], > 0
  double I_z = 0;  ///< integral of y^2, for bending along y [m^4], > 0
  double J = 0;    ///< torsion constant of Saint-Venant [m^4], > 0
  double A_y = 0;  ///< area that carries shear along y, kappa A [m^2]; 0: stiff in shear
  double A_z = 0;  ///< along z [m^2]; 0: stiff in shear
  /// Points whose sums of A, A y^2, A z^2 are those of the section, for beams that yield: none
  /// where the section has no shape.
  std::vector<BeamFibre> fibres;
};

/// b along y, h along z [m].
///   J = a t^3/3 (1 - 192 t/(pi^5 a) sum_{n odd} tanh(n pi a/(2 t))/n^5),  t <= a the two sides;
/// kappa = 5/6. The torsion of a bar of rectangular section after Saint-Venant, e.g. Timoshenko and
/// Goodier, Theory of Elasticity.
BeamSection rectangle_section(double b, double h);

/// Full circle of diameter d [m].
BeamSection round_section(double d);

/// Circular tube of outer diameter d and wall t <= d/2 [m]; kappa after Cowper 1966 (J. Appl. Mech.
/// 33, 335-340) at nu = 0.3: 0.53 for a thin wall, 0.886 for the full circle.
BeamSection tube_section(double d, double t);

/// Rectangular tube, outer sides b along y and h along z, wall t < b/2, h/2 [m]; J after Bredt
/// (thin walls), shear carried by the walls along it.
BeamSection box_section(double b, double h, double t);

/// I of overall width b along y and height h along z, flange thickness f < h/2 and web thickness w
/// < b [m]: two flanges and a web without fillets. J after thin walls, sum s t^3/3; shear along z
/// by the web, w (h - f), and along y by the flanges, 5/6 of their area (Young & Budynas, Roark's
/// Formulas for Stress and Strain).
BeamSection i_section(double b, double h, double f, double w);

/// The keys of the map `section`.
std::vector<Key> beam_section_keys();

/// The section that the map asks for. Notes every mistake and then returns one without area.
BeamSection read_beam_section(const Keys& section);

}  // namespace gannet
