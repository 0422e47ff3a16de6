// Beams that yield: uniaxial stress of fibres over two sections of each element.
#pragma once

#include <span>
#include <vector>

#include "base/math.hpp"
#include "fe/beam_section.hpp"
#include "material/elastic_plastic.hpp"
#include "material/j2.hpp"

namespace gannet {

/// Uniaxial J2: isotropic hardening by a line, points or a power, kinematic hardening by a line;
/// with a rate, heat or failure what of them j2.hpp knows.
struct UniaxialLaw {
  double E = 0;                      ///< [Pa]
  double sigma_y = 0;                ///< [Pa]; 0: elastic at any stress
  double isotropic = 0;              ///< d Y/d eps_p of the line [Pa]
  double kinematic = 0;              ///< d alpha/d eps_p [Pa]
  std::vector<double> curve_strain;  ///< of the points, if any
  std::vector<double> curve_stress;  ///< [Pa]
  double power_factor = 0;           ///< B of B eps_p^n [Pa]
  double power = 1;                  ///< n
  bool full = false;                 ///< rate, heat or failure: Y and damage are those of j2
  J2Law j2{};
  /// Numbers that a fibre keeps.
  [[nodiscard]] std::size_t n_values() const { return full ? 4 : 2; }
  [[nodiscard]] bool fails() const { return full && j2.fails; }
  [[nodiscard]] bool yields() const { return sigma_y > 0; }
};

/// The law of a material that yields.
UniaxialLaw uniaxial_law(const ElasticPlastic& material);

/// Y at an accumulated plastic strain [Pa].
double yield_stress(const UniaxialLaw& law, double eps_p);

/// Plastic state of a fibre, in the order in which it is kept.
struct FibreState {
  double strain = 0;       ///< plastic strain, signed
  double accumulated = 0;  ///< eps_p
  double rise = 0;         ///< of the temperature [K]
  double damage = 0;       ///< 1 and more: it carries nothing any more
};

/// Stress at a total strain [Pa]; state goes on to it. With xi = E (strain - plastic) - alpha,
/// alpha = H_k plastic, a flow d where |xi| is above Y:
///   |xi| - (E + H_k) d = Y(eps_p + d),  solved to 1e-12 by Newton's method within its bracket.
/// With a full law Y(eps_p + d) is that of j2.hpp for a flow d within 1/inverse_dt [s], and
/// temperature and damage go on too; a fibre that fails drops its stress.
/// dissipated: gets what the flow took, (stress at its begin + at its end)/2 d [J/m^3].
double uniaxial_stress(const UniaxialLaw& law, double strain, FibreState& state, double& dissipated,
                       double inverse_dt = 0);

/// Stretch of an element [m] and what its ends have turned against its frame [rad].
struct BeamStrain {
  double u = 0;
  Vec3 theta_1 = Vec3::Zero();
  Vec3 theta_2 = Vec3::Zero();
};

/// What belongs to it in power: axial force [N], moments on the turns of the ends [N m].
struct BeamStress {
  double N = 0;
  Vec3 m_1 = Vec3::Zero();
  Vec3 m_2 = Vec3::Zero();
};

/// (a + b) . dq/2: work of forces over a step by trapezoids [J].
double work_of(const BeamStress& a, const BeamStress& b, const BeamStrain& from,
               const BeamStrain& to);

/// Moduli of an element that yields. phi_y, phi_z: 12 E I/(G A_s l^2) of bending about y and z.
struct YieldingBeam {
  const UniaxialLaw& law;
  const BeamSection& section;
  double G = 0;   ///< [Pa]
  double l0 = 0;  ///< [m]
  double phi_y = 0;
  double phi_z = 0;
};

/// Numbers that the fibres of one element keep: two states of each fibre, at s = -+1/sqrt(3).
inline std::size_t fibre_values(const BeamSection& section, const UniaxialLaw& law) {
  return 2 * law.n_values() * section.fibres.size();
}

/// What a step of an element's fibres comes to.
struct FibreStep {
  double inverse_dt = 0;  ///< in: of the step before the level [1/s]
  BeamStrain from;        ///< in: strain of n-1; used where fibres may fail
  double plastic = 0;     ///< plastic work [J]
  double eroded = 0;    ///< left with fibres that failed: what they held, and half the step's work
  bool broken = false;  ///< all fibres of one of the two sections have failed
};

/// Forces of an element whose fibres go from their states to a strain. At s in [-1, 1] along it
///   eps = u/l0 + z k_y - y k_z,  k_i = (theta_2i - theta_1i + 3 s (theta_1i + theta_2i)/(1 +
///   phi_i))/l0
/// and the forces are what does the same work, by Gauss's rule of two points: with elastic fibres
/// exactly those of BendingStiffness. Torsion, and shear with the share phi/(1 + phi) of the
/// turning alike, stay elastic.
BeamStress yielding_stress(const YieldingBeam& beam, const BeamStrain& strain,
                           std::span<double> states, FibreStep& step);

/// What fibres that had not failed held at n-1, and half the work of the step on them that ends
/// their stress: sum over them V (sigma^2/(2 E) + sigma d eps/2) [J]. states: of n-1.
double held_by_fibres(const YieldingBeam& beam, std::span<const double> states,
                      const BeamStrain& from, const BeamStrain& to);

/// The elastic part of the forces of such an element, torsion and shear.
BeamStress elastic_part(const YieldingBeam& beam, const BeamStrain& strain);

}  // namespace gannet
