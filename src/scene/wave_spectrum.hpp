// Waves of a sea state: components of a spectrum, with phases that a seed decides.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/wave_field.hpp"

namespace gannet {

/// A sea state by its significant height and peak period.
struct SeaState {
  double height = 0;   ///< H_s = 4 sqrt(m0) [m]
  double period = 0;   ///< T_p = 2 pi/omega_p [s]
  double gamma = 3.3;  ///< peak enhancement: 1 is Pierson and Moskowitz's spectrum [-]
  int n = 60;          ///< components, where nothing repeats
  std::uint64_t seed = 1;
  double shortest = 0;  ///< shorter waves are left out [m]
  double repeat = 0;    ///< length after which the sea repeats; 0: it does not [m]
  Vec3 along = Vec3::UnitX();
};

/// The shape of the JONSWAP spectrum, not scaled:
///   S = omega^-5 exp(-5/4 (omega_p/omega)^4) gamma^r,
///   r = exp(-(omega - omega_p)^2/(2 sigma^2 omega_p^2)), sigma = 0.07 up to omega_p, 0.09 above
/// omega, omega_p > 0 [rad/s]. Hasselmann et al. 1973, Dtsch. Hydrogr. Z. Suppl. A8(12).
double jonswap_shape(double omega, double omega_p, double gamma);

/// Components with a_i^2/2 = S(omega_i) d omega_i, scaled so that sum a_i^2/2 = H_s^2/16. Between
/// omega_p/2 and 3 omega_p: all waves that fit into `repeat`, k_i = 2 pi i/repeat, or n evenly
/// spaced omega_i. Empty where no wave lies there. depth [m], g [m/s^2].
std::vector<WaveComponent> components_of(const SeaState& sea, double depth, double g);

/// k > 0 of omega^2 = g k tanh kd, by Newton's method [1/m].
double wave_number(double omega, double depth, double g);

}  // namespace gannet
