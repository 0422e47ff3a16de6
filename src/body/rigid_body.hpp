// Rigid bodies. A body is one node of the table: its centre of mass, which the leapfrog moves as
// any other node. Its members are nodes without mass that follow; what acts on them is gathered to
// the centre in the stage accelerate, when the whole force is known. Rotation is the body's own:
//
//   kick    L(n+1/2) = L(n-1/2) + torque (dt_old + dt)/2              spatial angular momentum
//           q(n) -> q(n+1): free rotation with L held fixed, by the implicit midpoint rule
//           members: v = (x(n+1) - x(n))/dt, the chord that half drift and drift walk along
//   look    kinetic energy of rotation at level n
//   drift   members exactly from q(n+1), so that a body never deforms
//
// Free rotation keeps L and the kinetic energy exactly (base/free_rotation.hpp).
//
// Given motion. Some components of the velocity of the centre and of the mean angular velocity in
// space may follow functions of time. The force and couple that this takes are found in the kick,
// and stay in the force on the centre and in L, so that energies need no exception.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "base/free_rotation.hpp"
#include "base/function.hpp"
#include "plan/plan.hpp"
#include "scene/carrier.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What is given of a body's motion. Components 0..2 are velocities of the centre along x, y, z
/// [m/s], 3..5 angular velocities about them [rad/s].
struct BodyMotion {
  unsigned mask = 0;  ///< bit d: component d is given
  std::array<Function, 6> rate;
  double held_until = 0;  ///< it stands still up to this time [s]
  [[nodiscard]] bool any() const { return mask != 0 || held_until > 0; }
};

/// What a rigid body is made from. Positions and velocities are those of the nodes now.
struct RigidBodyInput {
  std::string name;
  Location where;
  Index node = -1;              ///< becomes the centre of mass; a node with rotations
  std::vector<Index> members;   ///< nodes that move with it, without `node` itself
  double mass = 0;              ///< [kg]
  Mat3 inertia = Mat3::Zero();  ///< about the centre, in the frame of the body now [kg m^2]
  Quaternion q = Quaternion::Identity();  ///< from the frame of the body to space
  Vec3 omega = Vec3::Zero();              ///< angular velocity in space [rad/s]
  BodyMotion motion{};                    ///< free where nothing is given
};

struct RigidBody {
  std::string name;
  Location where;
  Index node = -1;
  std::vector<Index> members;
  std::vector<Vec3> arms;  ///< of the members from the centre, in the frame of the body [m]
  Mat3 inertia;            ///< in the frame of the body [kg m^2]
  Mat3 inverse_inertia;
  BodyMotion motion;
  Carrier* carrier = nullptr;  ///< what others see of it
  // State, tracked:
  Eigen::Vector4d q;  ///< quaternion x, y, z, w at level n (n+1 after drift)
  Vec3 L;             ///< spatial angular momentum at n-1/2 (n+1/2 after the kick) [kg m^2/s]
  // Within a step:
  unsigned given = 0;             ///< what of `motion` holds in this step
  Vec3 force = Vec3::Zero();      ///< of all that acts, weight too, at level n [N]
  Vec3 moment = Vec3::Zero();     ///< the same about the centre [N m]
  Vec3 reaction = Vec3::Zero();   ///< force that the given motion takes [N]
  Vec3 couple = Vec3::Zero();     ///< couple that it takes [N m]
  Vec3 torque = Vec3::Zero();     ///< moment + couple [N m]
  Vec3 omega_old = Vec3::Zero();  ///< mean angular velocity of the step before the level [rad/s]
  Quaternion q_next = Quaternion::Identity();  ///< at n+1, from the kick on
  double dt_kick = 0;                          ///< (dt_old + dt)/2 of the last kick [s]
};

/// All bodies of a scene: scene.store.get<RigidBodies>().
struct RigidBodies {
  std::deque<RigidBody> list;
};

/// Rotation over dt [s] where the components d of the mean angular velocity with bit d of mask are
/// wanted[d] [rad/s], and the others follow from L, of which the given components do not count.
/// With A = R(q) and Omega the mean angular velocity in the frame of the body, the midpoint rule
/// says
///   L = A (I Omega - dt/2 (I Omega) x Omega),
/// three equations for what is not given of L and of A Omega, solved by Newton's method. `wanted`
/// is lengthened by tan(theta/2)/(theta/2), theta = |wanted| dt, so that a rotation that is given
/// as a whole turns by theta exactly. L receives the angular momentum of the result in the
/// components that are given. inertia: in the frame of the body [kg m^2]. Throws nothing.
FreeRotation rotate_guided(const Quaternion& q, const Mat3& inertia, unsigned mask,
                           const Vec3& wanted, double dt, Vec3& L);

/// Makes a body of existing nodes: gives its node mass and velocity, takes mass and inertia from
/// the members (f does not move them any more), sets velocities and keeps the arms. Tracks q and L
/// as fields over the scene, "NAME.q" and "NAME.L", and notes in Followers whom the members follow,
/// in Carriers how it moves.
/// To be called after finish_masses(). Needs mass > 0 and a symmetric, positive definite inertia.
RigidBody& make_rigid_body(Scene& scene, const RigidBodyInput& input);

/// Adds the operations of the body to the plan of a model, which must hold its node and members;
/// after any link that pushes members.
/// The work of a force on a member is seen by work_path() as on any node: from the kick to the
/// look the member's 1/m is 1 and its f its mean acceleration, from half drift on it is 0 again.
/// The force and couple of a given motion, and their work as an external entry of the ledger,
/// "prescribed motion", are kept. Votes dt |omega| <= 0.2.
void add_rigid_body_operations(Scene& scene, Model& model, Ledger& ledger, RigidBody& body);

/// Kinetic energy of rotation at level n, after the kick [J]: with L(n) = L(n+1/2) - torque dt/2,
/// 1/2 Pi . I^-1 Pi, Pi = R(q)^T L(n).
double rotation_energy(const RigidBody& body, double dt);

/// Angular velocity in space at level n, after the kick [rad/s].
Vec3 angular_velocity_at_level(const RigidBody& body, double dt);

}  // namespace gannet
