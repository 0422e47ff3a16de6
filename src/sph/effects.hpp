// The effects of this room, for the table of effects.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// parts.NAME.sph: parts made of particles, their pair passes, equation of state and lists.
Effect sph_effect();

/// effects.viscosity: artificial viscosity, a term of the force pass.
Effect viscosity_effect();

/// effects.xsph: particles move with the local mean velocity.
Effect xsph_effect();

/// boundaries.NAME.periodic: directions in which the domain of the particles repeats. Stands late
/// in the table: its copies come after everything else that moves particles in a stage, and its
/// adding back after everything else that adds forces.
Effect periodic_effect();

/// Planes across an axis mirror the water in front of them. Stands after `periodic`, which says
/// which directions repeat, and after the effects that make planes and their measures.
Effect mirror_walls_effect();

/// probes.NAME: pressure at a point, height of the surface, front of the water.
Effect sph_probes_effect();

}  // namespace gannet
