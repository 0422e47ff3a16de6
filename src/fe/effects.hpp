// The effects of this room, for the table of effects.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// parts.NAME.shell: {material, thickness, points, hourglass, ...}: parts made of 4-node shells
/// over the surface that the part's `shape` or `mesh` gives. Also brings the keys of solids under
/// "materials.*".
Effect shell_effect();

/// parts.NAME.solid: {material, hourglass, bulk_viscosity, ...}: parts made of 8-node solids over
/// the volume that the part's `shape` gives. Also brings the keys of solids under "materials.*".
Effect solid_effect();

/// parts.NAME.cable: {EA, mass_per_length, tension_only, ...}: parts made of two-node elements
/// under axial force over the line that the part's `shape` gives.
Effect cable_effect();

/// moorings.NAME: {from, to, length, EA, water, bed, ...}: lines of cable elements that start at
/// rest as elastic catenaries, in water and on a sea bed.
Effect moorings_effect();

/// parts.NAME.beam: {material, section, up, ...}: parts made of two-node beams over the line that
/// the part's `shape` gives.
Effect beam_effect();

/// parts.NAME.mass_scaling: {step, ceiling}: mass for elements that limit the step. What was added
/// is the elements' own business (scale_masses() in fe/mass_scaling.hpp); this brings the keys, the
/// entry of the ledger and what `explain` says.
Effect mass_scaling_effect();

/// parts.NAME.rigid_surface: surfaces that do not deform. Stands after `rigid bodies`, which
/// carries them.
Effect rigid_surface_effect();

}  // namespace gannet
