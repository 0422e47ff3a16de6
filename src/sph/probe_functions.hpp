// What a gauge in the water reads, from the particles around it.
#pragma once

#include "base/math.hpp"
#include "scene/scene.hpp"
#include "sph/particle_boxes.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Pressure at a point [Pa], the normalised kernel sum over particles, those of walls
/// too, and images within the kernel's reach of what still water with their pressure would have
/// there:
///   p(x) = sum_j V_j W(|x - x_j|) (p_j + rho_j g . (x - x_j)) / sum_j V_j W(|x - x_j|),  V_j =
///   m/rho_j
/// (for an image, x_j in the head is the place of its source), so that it is right for water at
/// rest at walls and surfaces too, where the neighbours stand on one side; but no lower than p0, or
/// than the mean of p_j where that is lower. Zero where no fluid is that near: a dry gauge.
/// Pressures are as the equation of state gives them: p0 is what a particle at rho0 has. x: 3 [m].
/// Costs a look at the boxes and at the particles of those nearby.
double pressure_at(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                   const Vec3& x);

/// Volume fraction of the water at a point [-]: sum_j V_j W(|x - x_j|); 1 inside, 1/2 at a plane
/// surface, 0 outside.
double volume_fraction_at(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                          const Vec3& x);

/// A gauge on a thin surface that water may touch on either side.
struct WettedPoint {
  Vec3 foot = Vec3::Zero();     ///< on the mid-surface [m]
  Vec3 normal = Vec3::UnitZ();  ///< of length 1
  double distance = 0;          ///< from the foot to where particles that touch are held [m]
  double side = 0;              ///< 1, -1: in or against the normal; 0: where more water is
};

/// Pressure of the water that touches a surface [Pa]: as pressure_at(), at foot +- distance normal,
/// from the particles on that side of the surface alone.
double pressure_beside(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                       const WettedPoint& at);

/// Height of the surface along a column: the largest s for which the volume fraction at
/// foot + s up passes 1/2, to 1e-6 h. Found by going down from the highest particle near the
/// column in steps of h/4, then by bisection; drops narrower than that may be missed.
/// foot: 3 [m], any point of the column; up: 3, of length 1, along an axis.
/// Returns a quiet NaN where there is no water on the column.
double surface_height_on(const SphState& sph, const Scene& scene, const ParticleBoxes& boxes,
                         const Vec3& foot, const Vec3& up);

/// Largest coordinate along an axis (0, 1, 2) that a particle of a part has [m]; quiet NaN where
/// the part has none.
double front_of_part(const Scene& scene, int part, int axis);

}  // namespace gannet
