// Stress over strain of a material: one element is led along a path of strain, so that what answers
// is the code that runs in every case.
#pragma once

#include <vector>

#include "material/elastic_plastic.hpp"

namespace gannet {

/// How the element is strained. x is stretched, or sheared along y.
enum class StrainPath {
  uniaxial,         ///< sides free
  biaxial,          ///< y as x, z free
  plane,            ///< y held, z free
  uniaxial_strain,  ///< y and z held
  shear             ///< simple shear: x moves by gamma y
};

/// One level of a curve. Strain and stress are true ones (logarithmic; Cauchy) along x, or gamma
/// and sigma_xy in shear.
struct CurvePoint {
  double strain = 0;
  double stress = 0;          ///< [Pa]
  double nominal = 0;         ///< force per area at the start [Pa]
  double plastic_strain = 0;  ///< eps_p [-]
  double heating = 0;         ///< T - T_room [K]
  double damage = 0;          ///< 1: failed
};

/// What is asked for.
struct CurvePlan {
  StrainPath path = StrainPath::uniaxial;
  std::vector<double> to{0.2};  ///< strains where the path ends or turns round
  double rate = 1;              ///< of the strain [1/s], > 0
  int steps = 400;              ///< between two turns, > 0
  bool shell = false;           ///< a shell, in plane stress; else a solid
};

/// The curve from strain 0 on; it ends where the point fails. Needs rate > 0, steps > 0 and no
/// rubber in a shell. Throws std::runtime_error where free sides find no equilibrium.
std::vector<CurvePoint> material_curve(const ElasticPlastic& material, const CurvePlan& plan);

}  // namespace gannet
