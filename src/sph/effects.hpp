// The effects of this room, for the table of effects.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// parts.NAME.sph: parts made of particles, their pair passes, equation of state and lists.
Effect sph_effect();

/// effects.rest: water where nothing happens is not computed. Stands right after `sph`, whose lists
/// it makes anew.
Effect rest_effect();

/// effects.viscosity: artificial viscosity, a term of the force pass.
Effect viscosity_effect();

/// effects.laminar_viscosity: viscosity of a Newtonian fluid, a term of the force pass.
Effect laminar_viscosity_effect();

/// effects.tensile_cure: repulsion of particles under tension, a term of the force pass.
Effect tensile_cure_effect();

/// effects.density_diffusion: evens out density between neighbours, a term of the rates pass.
Effect density_diffusion_effect();

/// effects.corrected_gradients: CSPM, terms of both passes.
Effect corrected_gradients_effect();

/// effects.free_surface: which particles lie at the free surface.
Effect free_surface_effect();

/// effects.shifting: particles drift apart where they are crowded.
Effect shifting_effect();

/// effects.renormalisation: densities become means of their surroundings every few steps.
Effect renormalisation_effect();

/// materials.*.void: how far the density of a fluid that cavitates may fall.
Effect cavities_effect();

/// effects.xsph: particles move with the local mean velocity.
Effect xsph_effect();

/// parts.NAME.wall, and boundaries.NAME.walls: dummy: walls of dummy particles. Stands after `sph`,
/// whose particles they are built around and whose passes they follow.
Effect walls_effect();

/// bodies.NAME.walls: dummy: such walls inside of rigid bodies. Stands after all that make parts,
/// and after the bodies: they move first.
Effect carried_walls_effect();

/// sea: waves that particles start in. Stands after `walls`, whose particles it carries.
Effect sea_effect();

/// The pressure of wall particles. Stands before `sph`: the pair pass for the force reads it.
Effect wall_pressure_effect();

/// boundaries.NAME.periodic: directions in which the domain of the particles repeats. Stands late
/// in the table: its copies come after everything else that moves particles in a stage, and its
/// adding back after everything else that adds forces.
Effect periodic_effect();

/// Planes across an axis mirror the water in front of them. Stands after `periodic`, which says
/// which directions repeat, and after the effects that make planes and their measures.
Effect mirror_walls_effect();

/// parts.NAME.fill.outside: no particles where bodies are. Stands after all that make parts.
Effect displaced_fill_effect();

/// probes.NAME.flow: water through a plane. Stands before `sph_probes`, which keeps its gauges.
Effect flow_probes_effect();

/// probes.NAME: pressure at a point, height of the surface, front of the water.
Effect sph_probes_effect();

}  // namespace gannet
