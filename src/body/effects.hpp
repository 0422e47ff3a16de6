// The effects of this room, for the table of effects.
#pragma once

#include "plan/effect.hpp"

namespace gannet {

/// loads.gravity: [gx, gy, gz]
Effect gravity_effect();

/// boundaries.NAME.planes and boundaries.NAME.plane: rigid walls, data of the scene.
Effect planes_effect();

/// boundaries.NAME.motion: the planes of the boundary move.
Effect plane_motion_effect();

/// boundaries.NAME: {nodes, fix, velocity, angular_velocity, factor}: prescribed motion.
Effect prescribed_motion_effect();

/// loads.NAME.pressure: follower pressure on the cells of a surface.
Effect pressure_effect();

/// loads.NAME.acceleration: a force by mass that depends on place and time.
Effect acceleration_effect();

/// loads.NAME.force: a total force spread evenly over a set of nodes.
Effect nodal_force_effect();

/// boundaries.NAME.sponge: velocity of particles is damped in a box. Stands after `leapfrog`, whose
/// kick it corrects, and before what prescribes the motion of particles.
Effect sponge_effect();

/// effects.relaxation: velocity of particles is damped at the start of a run. Stands where `sponge`
/// does.
Effect relaxation_effect();

/// effects.element_relaxation: dynamic relaxation of the parts of elements. Stands where `sponge`
/// does.
Effect element_relaxation_effect();

/// parts.NAME.damping: in proportion to mass, of one part of elements. Stands where `sponge` does.
Effect part_damping_effect();

/// bodies.NAME: {parts, mass, motion, ...}: parts that move as one rigid body. Stands after the
/// effects that make parts of elements.
Effect rigid_bodies_effect();

/// bodies.NAME.rigid: parts that are rigid for a time. Stands before `ties`, which look at what
/// they tie to.
Effect rigid_phases_effect();

/// Their motion. Stands after all that kicks, damps or holds nodes, and after mass scaling.
Effect rigid_phase_motion_effect();

/// probes.NAME.wall_force: force on a wall or a part, split into pressure and viscosity.
Effect wall_force_effect();

/// probes.NAME: displacement and velocity of nodes, force of a contact or a boundary.
Effect probes_effect();

}  // namespace gannet
