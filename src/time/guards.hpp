// Guards: what stops a run that goes wrong, with what, where, when, why and what to try.
#pragma once

#include "plan/effect.hpp"
#include "time/energy_balance.hpp"

namespace gannet {

/// Limits of the guards; keys under effects.guards.
struct GuardLimits {
  double energy_error = 0.2;        ///< |imbalance| over the scale of the energy balance
  double smallest_dt_ratio = 1e-4;  ///< step over the first step
  double largest_speed = 0;         ///< [m/s]; 0: no limit but finite
  double density_range = 0.5;       ///< |rho/rho_start_mean - 1| of a particle
};

/// What the guards keep between steps; the energy balance is tracked in checkpoints.
struct GuardState {
  GuardLimits limits;
  EnergyBalance balance;
  Array<double> record;     ///< start held, largest total, imbalance, started, first dt,
                            ///< scale (tracked)
  double least_energy = 0;  ///< below it all energies are rounding, and no balance is held [J]
};

/// The effect "guards". Adds, at the end of look of the fastest model, "energy balance" (each step
/// at which levels coincide) and, unless effects.guards is off, "guards" (finite and bounded node
/// motion, density range, step collapse, energy error). A guard that trips throws RunError.
Effect guards_effect();

}  // namespace gannet
