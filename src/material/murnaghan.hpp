// Murnaghan's equation of state for a nearly incompressible fluid, without temperature: all of it
// are functions of the density at one point. With gamma = 1 it is the linear one,
// p = p0 + c0^2 (rho - rho0). Below the pressure of cavitation the fluid holds no more tension.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

#include "base/keys.hpp"
#include "base/schema.hpp"

namespace gannet {

/// The constants of one fluid.
struct Murnaghan {
  double rho0 = 1000;  ///< density at p0 [kg/m^3], > 0
  double gamma = 7;    ///< exponent [-], >= 1
  double p0 = 0;       ///< pressure at rho0 [Pa]
  double B = 0;        ///< stiffness rho0 c0^2 / gamma [Pa], > 0
  double p_min = -std::numeric_limits<double>::infinity();  ///< cavitation [Pa], <= p0
  /// Density at p_min [kg/m^3]: below it p = p_min. 0 where nothing is cut.
  double rho_min = 0;
  /// What a density that falls is held at [kg/m^3], below rho_min; 0 where it may fall freely.
  double rho_void = 0;
};

/// s^gamma by multiplication for gamma = 7 (water), and 1, by std::pow otherwise. s > 0.
inline double power_gamma(double s, double gamma) {
  if (gamma == 1) return s;
  if (gamma != 7) return std::pow(s, gamma);
  const double s3 = s * s * s;
  return s3 * s3 * s;
}

/// Pressure [Pa] at density rho [kg/m^3].
///   p = p0 + B [(rho/rho0)^gamma - 1], at least p_min
/// Needs rho > 0. Throws nothing. Monaghan 1994, J. Comput. Phys. 110, uses gamma = 7 for water.
inline double pressure(const Murnaghan& eos, double rho) {
  if (rho < eos.rho_min) return eos.p_min;
  return eos.p0 + eos.B * (power_gamma(rho / eos.rho0, eos.gamma) - 1);
}

/// Density [kg/m^3] at pressure p [Pa]: the inverse of pressure().
///   rho = rho0 [1 + (p - p0)/B]^(1/gamma)
/// Needs p > p0 - B, below which the fluid has no density. Throws nothing.
inline double density(const Murnaghan& eos, double p) {
  assert(p > eos.p0 - eos.B);
  return eos.rho0 * std::pow(1 + (p - eos.p0) / eos.B, 1 / eos.gamma);
}

/// Speed of sound [m/s] at density rho [kg/m^3].
///   c^2 = dp/drho = (gamma B / rho0) (rho/rho0)^(gamma - 1)
/// Needs rho > 0. Throws nothing.
inline double sound_speed(const Murnaghan& eos, double rho) {
  const double s = rho / eos.rho0;
  return std::sqrt(eos.gamma * eos.B / eos.rho0 * power_gamma(s, eos.gamma) / s);
}

/// Internal energy per mass [J/kg] at density rho [kg/m^3], zero at rho0: the work of compression.
///   e = int_rho0^rho p/r^2 dr
///     = [(p0 - B)(1 - 1/s) + B (s^(gamma-1) - 1)/(gamma - 1)] / rho0,  s = rho/rho0
/// (for gamma = 1 the last term is B ln s); below rho_min it goes on with the constant p_min,
///   e = e(rho_min) + p_min (1/rho_min - 1/rho).
/// Needs rho > 0. Throws nothing.
inline double internal_energy(const Murnaghan& eos, double rho) {
  if (rho < eos.rho_min) {
    const double at_cut = internal_energy(eos, eos.rho_min);
    return at_cut + eos.p_min * (1 / eos.rho_min - 1 / rho);
  }
  const double s = rho / eos.rho0;
  const double stiff = eos.gamma == 1
                           ? eos.B * std::log(s)
                           : eos.B * (power_gamma(s, eos.gamma) / s - 1) / (eos.gamma - 1);
  return ((eos.p0 - eos.B) * (1 - 1 / s) + stiff) / eos.rho0;
}

/// Enthalpy per mass [J/kg] relative to that at rho0: in a fluid at rest in gravity g,
/// enthalpy - g . x is the same everywhere.
///   w = int_rho0^rho (dp/dr)/r dr = gamma B/(rho0 (gamma - 1)) (s^(gamma-1) - 1),  s = rho/rho0
/// (for gamma = 1: B/rho0 ln s). Needs rho > 0. Throws nothing.
inline double enthalpy(const Murnaghan& eos, double rho) {
  const double s = rho / eos.rho0;
  if (eos.gamma == 1) return eos.B / eos.rho0 * std::log(s);
  return eos.gamma * eos.B / (eos.rho0 * (eos.gamma - 1)) * (power_gamma(s, eos.gamma) / s - 1);
}

/// Cuts the pressure off at p_min [Pa], which must lie in (p0 - B, p0].
void cut_pressure(Murnaghan& eos, double p_min);

/// Stiffness B [Pa] that gives the speed of sound c0 [m/s] at rho0.
///   B = rho0 c0^2 / gamma
/// Needs rho0 > 0, gamma >= 1, c0 > 0. Throws nothing.
inline double stiffness(double rho0, double gamma, double c0) { return rho0 * c0 * c0 / gamma; }

/// The keys of "materials.*" that belong to this equation of state.
Schema murnaghan_schema();

/// The equation of state that a material card describes: `eos` (linear: gamma = 1), `density`,
/// `gamma`, `p0`, `cavitation` and B from `bulk` (B itself), `bulk_modulus` (gamma B), `c0`, or
/// from c0 = 10 times the largest expected speed where `c0: auto`. largest_speed: the largest speed
/// that the scene itself suggests [m/s]; the card's `expected_speed` counts where it is larger.
/// Notes a mistake where more than one of `bulk`, `bulk_modulus` and a number for `c0` are given,
/// or no speed is known. Throws nothing.
Murnaghan read_murnaghan(const Keys& material, double largest_speed);

}  // namespace gannet
