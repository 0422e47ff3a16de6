// Mass, centre and inertia of rigid bodies.
#pragma once

#include <vector>

#include "base/math.hpp"
#include "mesh/closed_surface.hpp"
#include "scene/scene.hpp"

namespace gannet {

struct BodyMass {
  double mass = 0;              ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre, along the axes of space [kg m^2]
};

/// Of point masses at the nodes, sum m (r^2 1 - r r^T). All zero where they have no mass.
BodyMass mass_of_nodes(const Nodes& nodes, const std::vector<Index>& members);

/// Of the volume inside a closed surface at a density [kg/m^3]: rho (tr(S) 1 - S), S the second
/// moment (`volume_moments()`).
BodyMass mass_inside(const ClosedSurface& surface, double density);

/// The body together with point masses at the nodes: about the centre of both.
BodyMass with_nodes(const BodyMass& body, const Nodes& nodes, const std::vector<Index>& members);

/// For a plane case: only the inertia about z counts; the others are set to it, as nothing can turn
/// the body about them.
void flatten(BodyMass& body);

/// The least principal inertia [kg m^2]; above rounding where the body resists every rotation.
double least_inertia(const BodyMass& body);

}  // namespace gannet
