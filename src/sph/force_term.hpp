// What the terms of the force pass share: an array of their part of the force, and the account of
// its work.
#pragma once

#include <string>

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Makes room for a term's force on every particle [N] and tracks it as the field `name`, owned by
/// the effect `owner`. Every force pass stores it before look reads it.
void make_force_term(Array<Line>& force, const std::string& name, const std::string& owner,
                     Scene& scene);

/// Adds the operation that measures what a term takes out of the motion: the entry `entry` of each
/// part made of particles collects -sum f_term . dx along the path of level n.
void add_work_of_term(const Array<Line>& force, const std::string& entry, const std::string& field,
                      const std::string& reason, Scene& scene, Models& models);

/// Sum over the particles of a part of m p/rho^2 D dt [J], with rho halfway through the step that
/// has just been made: the compression energy that the part D of the density rate brought in.
double energy_of_rate(const SphState& sph, const Array<double>& rate, const Scene& scene, int part,
                      double dt);

/// Whether the case has the key effects.NAME for particles; notes a mistake where it has, and no
/// part is made of them.
bool particles_asked_for(const Keys& root, const char* name, const Scene& scene);

}  // namespace gannet
