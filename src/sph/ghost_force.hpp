// The force that ghosts put on the water in front of them, and so the force of the water on the
// wall that they stand for.
#pragma once

#include <span>

#include "base/math.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Sums over the owned particles [N].
struct GhostForce {
  Vec3 total = Vec3::Zero();    ///< of pressure and all other terms of pairs
  Vec3 viscous = Vec3::Zero();  ///< of its viscous terms, part of the total
};

/// What the ghosts of some kinds added to f in the force pass of this step: the same pass over the
/// pairs of owned particles and these ghosts alone. Costs what these pairs cost, and once after
/// lists were made one look through them.
/// Corrected gradients have no force of one particle on another; their part is left out.
/// chosen: one entry for each of halo.kinds, 0 for those left out. Between the force and the rates
/// stage the particles are taken as that pass saw them; else they are packed anew as they stand.
/// The same for any number of threads.
GhostForce force_of_ghosts(SphState& sph, Scene& scene, std::span<const char> chosen);

}  // namespace gannet
