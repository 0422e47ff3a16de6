// What a step does with particles, whatever the case: the two pair passes, density and pressure,
// lists, energies.
#pragma once

#include <string>

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Adds the operations of all particles to their model's plan, and makes the first lists. Which
/// terms the pair passes have is known by now: sph.terms, and which arrays of results there are.
/// reason: where the case asks for particles. watch_sound_speed: whether the flow is held against
/// the speed of sound.
void add_particle_operations(SphState& sph, Scene& scene, Models& models, const std::string& reason,
                             bool watch_sound_speed);

/// Packs particles and ghosts, with their pressures, for pair_force.
void pack_for_force(SphState& sph, const Scene& scene);

/// The sums of renormalised densities at the present positions and densities, ghosts included:
/// sum m W, sum m/rho W, one entry an owned particle. A rates pass of its own.
void sum_shepard(SphState& sph, const Scene& scene, double* sum_mW, double* sum_VW);

}  // namespace gannet
