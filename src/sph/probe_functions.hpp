// What a gauge in the water reads, from the particles around it.
#pragma once

#include "base/math.hpp"
#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Pressure at a point [Pa], the normalised kernel sum over particles and images within 2 h:
///   p(x) = sum_j V_j p_j W(|x - x_j|) / sum_j V_j W(|x - x_j|),  V_j = m/rho_j
/// Zero where no particle is that near: a dry gauge. Pressures are as the equation of state gives
/// them: p0 is what a particle at rho0 has. x: 3 [m].
double pressure_at(const SphState& sph, const Scene& scene, const Vec3& x);

/// Volume fraction of the water at a point [-]: sum_j V_j W(|x - x_j|); 1 inside, 1/2 at a plane
/// surface, 0 outside.
double volume_fraction_at(const SphState& sph, const Scene& scene, const Vec3& x);

/// Height of the surface along a column: the largest s for which the volume fraction at
/// foot + s up passes 1/2, to 1e-6 h. Found by going down from the highest particle near the
/// column in steps of h/4, then by bisection; drops narrower than that may be missed.
/// foot: 3 [m], any point of the column; up: 3, of length 1.
/// Returns a quiet NaN where there is no water on the column.
double surface_height_on(const SphState& sph, const Scene& scene, const Vec3& foot, const Vec3& up);

/// Largest coordinate along an axis (0, 1, 2) that a particle of a part has [m]; quiet NaN where
/// the part has none.
double front_of_part(const Scene& scene, int part, int axis);

}  // namespace gannet
