// Rotary inertia of the nodes of beams, a tensor that turns with each node.
//
// The leapfrog knows one number a node, the largest principal moment I. Before the kick, the torque
// is replaced by the one that makes the leapfrog turn the node as its tensor J does: the spatial
// angular momentum
//   L(n-1/2) = A (J Omega + dt_old/2 (J Omega) x Omega),   A = A(n), Omega = A^T omega(n-1/2),
// goes to L(n+1/2) = L(n-1/2) + torque (dt_old + dt)/2, and omega(n+1/2) is the mean angular
// velocity of a free rotation with that (base/free_rotation.hpp). With the nodes' own update of
// their turns, L is kept to rounding where no torque acts. Nothing is kept from step to step.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "base/math.hpp"
#include "fe/beam.hpp"
#include "plan/plan.hpp"

namespace gannet {

/// Of the nodes of one block, in the axes of space at the start.
struct BeamInertia {
  std::vector<Mat3> of_elements;  ///< sums of the elements' halves [kg m^2]
  std::vector<double> number;     ///< what these are in the node table [kg m^2]
  std::vector<char> own;          ///< 0: the number of the node table holds for this one
  // For the numbers of the node table at hand:
  std::vector<double> added;  ///< what they have beyond `number`, of added mass and of ties
  std::vector<Mat3> J;        ///< of_elements, and `added` about all axes
  std::vector<Mat3> inverse;  ///< [1/(kg m^2)]
};

/// Sums up the tensors of the elements' halves (node_mass()). Nodes in `given`, ascending, whose
/// rotation a boundary prescribes, keep the number of the node table, so that their reactions are
/// those of the torques.
BeamInertia beam_inertia(const BeamBlock& block, const Nodes& nodes,
                         const std::vector<Index>& given);

/// Angular momentum of the spin of a node, the k-th of the block, at n-1/2 [kg m^2/s]. Needs the
/// turns of level n.
Vec3 spin_of(const BeamInertia& inertia, const BeamBlock& block, const Nodes& nodes, Index k,
             double dt_old);

/// Replaces the torques of nodes of the block, of those in `mine` (their places in it), as
/// described above. step: of the model that they advance in. Throws RunError where a rotation
/// cannot be found.
void turn_by_inertia(BeamInertia& inertia, const BeamBlock& block, std::span<const Index> mine,
                     Nodes& nodes, const Step& step);

/// What the kinetic energy of rotation at level n has beyond that of the leapfrog, after the kick:
///   sum 1/2 omega . (A J A^T - I) omega [J]
/// over the nodes in `mine`. step: of the model that they advance in.
double energy_of_inertia(const BeamInertia& inertia, const BeamBlock& block,
                         std::span<const Index> mine, const Nodes& nodes, const Step& step);

/// Adds it to the plans of all models that nodes of the block advance in (some may hang on what is
/// in a faster one) and its energy to the ledger, an entry `rotary_inertia` each.
void add_beam_inertia(Scene& scene, const BeamBlock& block, Models& models);

/// scene.store.get<BeamInertias>(); addresses never change.
struct BeamInertias {
  std::deque<BeamInertia> list;
};

}  // namespace gannet
