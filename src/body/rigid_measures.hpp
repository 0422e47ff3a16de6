// What a rigid body can be asked for.
#pragma once

#include <string>

#include "body/rigid_body.hpp"

namespace gannet {

/// Angles of rotations about x, then y, then z, all axes of space, that bring the body from its
/// start to q: roll, pitch, yaw [rad], R = Rz(yaw) Ry(pitch) Rx(roll). Roll and yaw are not told
/// apart at a pitch of 90 degrees.
Vec3 roll_pitch_yaw(const Eigen::Vector4d& q);

/// Adds the measures "body.NAME.position", "velocity", "angles" (roll, pitch, yaw), "quaternion",
/// "angular_velocity", "force", "moment" (of all that acts, weight too, about the centre) and
/// "reaction", "reaction_moment" (what a given motion takes), all at level n.
void add_body_measures(Scene& scene, const Model& model, const RigidBody& body);

/// Adds one measure of that name with all of them but the quaternion; in a plane case what there
/// is of them in a plane.
void add_body_probe(Scene& scene, const Model& model, const RigidBody& body,
                    const std::string& name);

}  // namespace gannet
