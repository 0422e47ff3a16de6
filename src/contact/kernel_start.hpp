// Particles that start where the potential of kernel contact pushes already.
#pragma once

#include "contact/kernel_contact.hpp"

namespace gannet {

/// What of a contact is wrong before the first step.
struct KernelStart {
  double stand_off = 0;  ///< height above its nodes where it begins to push [m]
  Index count = 0;       ///< particles nearer than that by more than a twentieth of a spacing
  double depth = 0;      ///< by how much the nearest of them is too near [m]
  double speed = 0;      ///< that its energy is worth, (2 E/m)^(1/2), its surface held [m/s]
};

/// Looks at the places of now. A particle of mass rho0 V_i has the energy E = sum_j V_i V_j phi,
/// and stands as high as it would above a plane of nodes that gave it this energy,
/// height_of_energy(): a measure that needs no sides and no segments, and falls with the distance
/// throughout, as the force does not. It begins to push where the force of the plane is 1 % of
/// rho0 c0^2 V_i/dp. Needs the law and the volumes of the contact. Sets the contact's
/// numbers of overlaps, and leaves a list behind that the first search makes anew.
KernelStart look_at_start(Scene& scene, KernelContact& contact, double rho0, double c0);

}  // namespace gannet
