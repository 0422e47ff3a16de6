// Fibres: the directions through the thickness that the elements around a node have in common.
#pragma once

#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"

namespace gannet {

/// Elements whose normals differ by less than this are one smooth surface [rad].
inline constexpr double smooth_angle = 30 * 0.017453292519943295;

/// Unit fibres of the corners of quadrilaterals (4 corners an element, also of a triangle that
/// repeats its last node), as the start of a shell without stress.
/// Within a smooth surface the fibre of a node is the mean of the normals of its elements. At an
/// edge of the surface the elements lie on one side only; there each takes what its opposite corner
/// tells: with h the normal at a corner of the hyperbolic paraboloid through the four corners, less
/// the normal e3 of the element, and r what a fibre is off e3 + h,
///   r at a corner = -r at the opposite corner,
/// exact to first order in the curvature.
/// connectivity: node numbers; x: positions of the nodes [m]. Needs elements with an area.
std::vector<Vec3> fibres_of(std::span<const Index> connectivity, std::span<const Line> x);

}  // namespace gannet
