// The point of a segment that is closest to a given point.
//
// The closest point is always x_cp = sum N_i x_i with sum N_i = 1, and the contact force acts
// along x - x_cp at x_cp: so the force on the particle and those on the corners, -N_i f, cancel,
// and so do their moments.
#pragma once

#include <array>
#include <cstdint>

#include "base/math.hpp"

namespace gannet {

/// Which feature of a segment a closest point lies on.
enum class Feature : std::uint8_t { inside, edge, corner };

/// A closest point.
struct Closest {
  std::array<double, 4> N{};  ///< weights of the corners; zero beyond the last corner
  Vec3 point = Vec3::Zero();  ///< sum N_i x_i [m]
  double distance2 = 0;       ///< |x - point|^2 [m^2]
  Feature feature = Feature::inside;
  int number = 0;  ///< of the edge (from corner `number` to the next) or of the corner
};

/// Closest point of the line segment from a to b. Its ends count as corners 0 and 1.
///   N_1 = clamp((x - a).(b - a) / |b - a|^2, 0, 1)
/// A segment without length gives a. [m]. Throws nothing.
Closest closest_on_line(const Vec3& x, const Vec3& a, const Vec3& b);

/// Closest point of a triangle: the foot of the perpendicular where it lies inside, else the
/// closest point of the three edges (the lowest edge where two are as near).
/// x: the point, p: three corners [m]. Throws nothing.
Closest closest_on_triangle(const Vec3& x, const Vec3* p);

/// Closest point of the bilinear patch X(xi, eta) = sum N_i(xi, eta) x_i,
/// N_i = (1 + xi xi_i)(1 + eta eta_i)/4. Where (x - X) . dX/dxi = (x - X) . dX/deta = 0 (Newton)
/// has its solution inside, that point; else the closest point of the four edges, which are
/// straight lines, the same for both patches that share one.
/// x: the point; p: four corners in order around the patch [m], moderately warped (one solution
/// near the patch). Throws nothing.
Closest closest_on_quad(const Vec3& x, const Vec3* p);

}  // namespace gannet
