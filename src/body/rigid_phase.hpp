// Parts of elements that move as one rigid body for a time: until something touches them or until a
// given time, and perhaps from a later time on again.
//
// Nodes keep their masses, and elements are computed all along: in rigid motion they do not strain.
// While the parts are rigid, the free kick of the leapfrog is followed by a projection onto rigid
// motion,
//   V = sum m v / M,   L(n+1/2) = L(n-1/2) + (sum (x - c) x f + sum torque) (dt_old + dt)/2
//   q(n) -> q(n+1): free rotation with L held fixed, as of any rigid body
//   v_i = V + (R(n+1) - R(n)) arm_i/dt,   f_i += m_i (v_i - v_i free)/((dt_old + dt)/2)
// and f then holds what really acted, so that energies need no exception. The step after release
// has no projection: nodes go on with the velocities that they have, free of stress, and get the
// spin that makes their angular momentum that of the body. Locked, the parts take over momentum and
// angular momentum of the nodes; the energy of their motion against each other is lost, and their
// stress stays as it is. The work of the projection is the ledger's `locking`; the kinetic energy
// of a level at which it gives a jump of velocity is that of neither side, which the entry makes up
// for.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// When parts are rigid.
struct RigidTimes {
  double until = std::numeric_limits<double>::infinity();  ///< [s]
  bool until_contact = false;  ///< or when something touches them, before `again_from`
  double again_from = std::numeric_limits<double>::infinity();  ///< [s]; not before their release
};

struct RigidPhase {
  std::string name;
  Location where;
  std::vector<Index> nodes;  ///< all of them, rising
  RigidTimes times;
  std::vector<std::string> contacts;  ///< names of contacts with what is not of these parts

  // Tracked
  Array<double> phase;    ///< 0 rigid, 1 deformable, 2 rigid again
  Array<double> q;        ///< quaternion x, y, z, w at level n (n+1 after the kick)
  Array<double> L;        ///< angular momentum about the centre at n-1/2 [kg m^2/s]
  Array<double> inertia;  ///< in the frame of the body, row by row [kg m^2]
  Array<double> arms;     ///< of the nodes in that frame, three a node [m]

  // Within a step
  std::vector<Vec3> force;   ///< of the projection on each node [N]
  std::vector<Vec3> couple;  ///< likewise [N m], of nodes with rotations
  bool switched = false;     ///< at this level
  [[nodiscard]] bool is_rigid() const { return phase[0] != 1; }
};

/// All of them: scene.store.get<RigidPhases>().
struct RigidPhases {
  std::deque<RigidPhase> list;
};

/// Sum m, sum m x/M and sum m v/M of nodes.
struct MassCentre {
  double m = 0;           ///< [kg]
  Vec3 x = Vec3::Zero();  ///< [m]
  Vec3 v = Vec3::Zero();  ///< [m/s]
};
MassCentre mass_centre(const Nodes& nodes, const std::vector<Index>& list);

/// Angular momentum of nodes about a moving point, sum m (x - c) x (v - V) + sum I omega
/// [kg m^2/s].
Vec3 spin_about(const Nodes& nodes, const std::vector<Index>& list, const MassCentre& centre);

/// Inertia of nodes about a point, sum m (r^2 - r r^T) + sum I [kg m^2], in the axes of space.
Mat3 inertia_about(const Nodes& nodes, const std::vector<Index>& list, const Vec3& centre);

/// Makes the parts rigid in their places at hand, with the momenta of their nodes.
void lock(RigidPhase& phase, const Nodes& nodes);

/// Sizes and tracks the state of a phase that is rigid at the start. Needs the masses of all nodes.
void make_rigid_phase(Scene& scene, RigidPhase& phase);

/// Adds its operations to the model that holds its nodes, and its entry to the ledger.
void add_rigid_phase(Scene& scene, RigidPhase& phase, Model& model, Ledger& ledger);

}  // namespace gannet
