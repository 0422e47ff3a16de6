// Prescribed motion: some components of velocity of a set of nodes follow the case and not the
// forces. The force that this takes is kept, so that the motion's work and the reaction are known.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "base/function.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What one boundary prescribes. Components 0..2 are velocities along x, y, z [m/s], 3..5 angular
/// velocities about them [rad/s].
struct PrescribedMotion {
  std::string name;
  Location where;
  std::vector<Index> nodes;
  std::vector<std::uint8_t> mask;  ///< a node's prescribed components: bit d for component d
  std::array<Function, 6> rate;    ///< velocity of component d in time
  Array<Line> reaction;            ///< force on a node in the last kick [N]; w unused
  Array<Line> couple;              ///< moment on it [N m]; w unused
};

/// All prescribed motions of a scene: scene.store.get<PrescribedMotions>().
struct PrescribedMotions {
  std::deque<PrescribedMotion> list;
};

/// Kick of the prescribed components of nodes[k], k of `entries`, after the free kick:
///   R = (v_wanted - v) / (1/m (dt_old + dt)/2),  f += R,  v = v_wanted
/// and likewise for rotations with I and torque. v_wanted is the mean of the rate over
/// [t, t + dt], so that a node's path is the integral of its velocity whatever the steps. With R
/// in f, velocity_at_level() and work_path() hold for these nodes too. Needs m > 0 (and I > 0).
void kick_prescribed(PrescribedMotion& motion, const std::vector<Index>& entries, Nodes& nodes,
                     const Step& step);

/// Work of the reactions along the path of level n, rotations included [J]:
///   sum R . (v(n-1/2) dt_old + v(n+1/2) dt)/2
Work work_of_reactions(const PrescribedMotion& motion, const std::vector<Index>& entries,
                       const Nodes& nodes, const Step& step);

/// Sum of the reactions on the nodes at level n [N].
Vec3 reaction_force(const PrescribedMotion& motion);

/// Moment of the reactions about the origin, couples included [N m]: sum x x R + C.
Vec3 reaction_moment(const PrescribedMotion& motion, const Nodes& nodes);

/// Gives the prescribed components their velocity at time t [s].
void set_velocities(const PrescribedMotion& motion, Nodes& nodes, double t);

/// Adds kick, work and the measures "boundary.NAME.force", "boundary.NAME.moment" of one motion.
void add_prescribed_motion(PrescribedMotion& motion, Scene& scene, Models& models);

/// The path of a node in turning at level n [rad], as work_path() for translations.
WorkPath rotation_path(const Nodes& nodes, Index i, const Step& step);

}  // namespace gannet
