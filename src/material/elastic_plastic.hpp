// Isotropic solids, elastic or plastic beyond a yield stress (J2): the card that a case names, and
// the constants that follow from it. Those with linear isotropic hardening have fast laws of their
// own (plane_stress.hpp, solid_stress.hpp); all others share that of j2.hpp.
#pragma once

#include <vector>

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "material/hyperelastic.hpp"
#include "material/j2.hpp"

namespace gannet {

/// Growth of the yield stress by heat that has no time to leave.
struct AdiabaticHeating {
  double specific_heat = 0;  ///< c [J/(kg K)]; 0: none
  double fraction = 0.9;     ///< beta: of the plastic work that becomes heat
  double range = 1;          ///< T_melt - T_room [K], > 0
  double power = 1;          ///< m
};

/// When a point carries no more: eps_f as in j2.hpp.
struct Failure {
  double strain[5] = {};  ///< D1 ... D5; all 0: never
  double rate = 1;        ///< rate_0 of D4 [1/s]
  [[nodiscard]] bool given() const { return strain[0] != 0 || strain[1] != 0; }
};

/// One elastic or elastic-plastic material.
struct ElasticPlastic {
  double rho = 0;                    ///< density [kg/m^3], > 0
  double E = 0;                      ///< Young's modulus [Pa], > 0
  double nu = 0;                     ///< Poisson's ratio [-], -1 < nu < 0.5
  double sigma_y = 0;                ///< yield stress [Pa]; 0: elastic at any stress
  double H = 0;                      ///< plastic modulus d sigma_y / d eps_p [Pa], >= 0
  double kinematic_fraction = 0;     ///< of H that moves the yield surface instead
  std::vector<double> curve_strain;  ///< plastic strains of a hardening curve, from 0, rising
  std::vector<double> curve_stress;  ///< true stresses there [Pa], not falling; the first: sigma_y
  double power_factor = 0;           ///< B of sigma_y + B eps_p^n [Pa]
  double power = 1;                  ///< n
  RateLaw rate_law = RateLaw::none;
  double rate = 1;        ///< D or rate_0 [1/s]
  double rate_power = 0;  ///< 1/p or C [-]
  AdiabaticHeating heating;
  Failure failure;
  HyperelasticLaw rubber;  ///< where its bulk is above 0; E and nu are those at the start then
  [[nodiscard]] bool plastic() const { return sigma_y > 0; }
  [[nodiscard]] bool hyperelastic() const { return rubber.bulk > 0; }
  /// More than linear isotropic hardening: the law of j2.hpp.
  [[nodiscard]] bool general() const {
    return plastic() && (kinematic_fraction > 0 || !curve_strain.empty() || power_factor > 0 ||
                         rate_law != RateLaw::none || heating.specific_heat > 0 || failure.given());
  }
  [[nodiscard]] PointLaw point_law() const {
    if (hyperelastic()) return PointLaw::hyperelastic;
    if (!plastic()) return PointLaw::elastic;
    return general() ? PointLaw::general : PointLaw::linear_hardening;
  }
  [[nodiscard]] double G() const { return 0.5 * E / (1 + nu); }
};

/// The constants of the law in plane stress. Needs E > 0, -1 < nu < 1. Throws nothing.
PlaneStressLaw plane_stress_law(const ElasticPlastic& material);

/// The constants of the law in three dimensions. Needs E > 0, -1 < nu < 0.5. Throws nothing.
SolidLaw solid_law(const ElasticPlastic& material);

/// The constants of the law of j2.hpp. Needs plastic(), as many strains as stresses, at most
/// max_hardening_points of them. Throws nothing.
J2Law j2_law(const ElasticPlastic& material);

/// The keys of "materials.*" that belong to solids.
Schema elastic_plastic_schema();

/// The solid that a card describes: `density`; of rubber `neo_hookean`, `mooney_rivlin` or `yeoh`;
/// of all others `young`, `poisson`, and where it can yield either `yield_stress` with
/// `hardening_modulus` and `kinematic_fraction`, a `hardening_curve` or `johnson_cook`; beside them
/// `cowper_symonds` and `failure`. Notes a mistake for each key that is missing or does not go with
/// the others. Throws nothing.
ElasticPlastic read_elastic_plastic(const Keys& material);

/// As read_elastic_plastic() of the material of that name, for elements that know no deformation
/// since the start: notes a mistake at part.material where it is rubber.
ElasticPlastic read_but_rubber(const Keys& root, const Keys& part);

}  // namespace gannet
