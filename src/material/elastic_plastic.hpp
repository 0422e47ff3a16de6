// Isotropic elastic solids, plastic beyond a yield stress (J2, linear isotropic hardening): the
// card that a case names, and the constants that follow from it.
#pragma once

#include "base/keys.hpp"
#include "base/schema.hpp"
#include "material/plane_stress.hpp"
#include "material/solid_stress.hpp"

namespace gannet {

/// One elastic or elastic-plastic material.
struct ElasticPlastic {
  double rho = 0;      ///< density [kg/m^3], > 0
  double E = 0;        ///< Young's modulus [Pa], > 0
  double nu = 0;       ///< Poisson's ratio [-], -1 < nu < 0.5
  double sigma_y = 0;  ///< yield stress [Pa]; 0: elastic at any stress
  double H = 0;        ///< plastic modulus d sigma_y / d eps_p [Pa], >= 0
  [[nodiscard]] bool plastic() const { return sigma_y > 0; }
  [[nodiscard]] double G() const { return 0.5 * E / (1 + nu); }
};

/// The constants of the law in plane stress. Needs E > 0, -1 < nu < 1. Throws nothing.
PlaneStressLaw plane_stress_law(const ElasticPlastic& material);

/// The constants of the law in three dimensions. Needs E > 0, -1 < nu < 0.5. Throws nothing.
SolidLaw solid_law(const ElasticPlastic& material);

/// The keys of "materials.*" that belong to solids.
Schema elastic_plastic_schema();

/// The solid that a card describes: `density`, `young`, `poisson`, and `yield_stress` with
/// `hardening_modulus` where it can yield. Notes a mistake for each key that is missing.
/// Throws nothing.
ElasticPlastic read_elastic_plastic(const Keys& material);

}  // namespace gannet
