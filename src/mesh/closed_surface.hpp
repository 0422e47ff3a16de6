// Closed surfaces, and in the plane closed curves: what is inside, how far away they are, and the
// moments of the volume that they enclose.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"

namespace gannet {

/// Facets over points: triangles, or in the plane lines (the third corner is then -1). Points at
/// the same place are one point.
struct ClosedSurface {
  int dimension = 3;
  std::vector<Vec3> points;                  ///< [m]
  std::vector<std::array<Index, 3>> facets;  ///< corners; turned outwards by close_surface()
};

/// Adds the boundary of cells of `corners` points each to a surface that is not closed yet: cells
/// of a surface (lines in the plane; triangles or quadrilaterals in space) are that boundary, of
/// solids (quadrilaterals in the plane; hexahedra, and tetrahedra where `solid`, in the order of
/// VTK, in space) it is the faces that one cell alone has. Quadrilaterals become two triangles.
void add_boundary(const std::vector<Vec3>& points, const std::vector<Index>& connectivity,
                  int corners, bool solid, ClosedSurface& surface);

/// Joins points nearer than 1e-6 of the extent, turns all facets outwards (each piece by itself)
/// and returns ""; or says why the surface encloses nothing: an edge (in the plane a point) that
/// does not join exactly two facets, with its place.
std::string close_surface(ClosedSurface& surface);

/// Whether a point is inside, by the solid angle that the surface fills around it, Omega > 2 pi:
///   tan(Omega/2) = a.(b x c) / (|a||b||c| + a.b |c| + b.c |a| + c.a |b|)
/// per triangle, a, b, c from x to its corners (Van Oosterom and Strackee 1983, IEEE Trans. Biomed.
/// Eng. 30, 125-126, eq. 8); in the plane by the angle. Needs close_surface() and x not on the
/// surface.
bool contains(const ClosedSurface& surface, const Vec3& x);

/// Distance of a point from the nearest facet [m].
double distance(const ClosedSurface& surface, const Vec3& x);

/// Distance of a point from one facet [m].
double distance_to_facet(const ClosedSurface& surface, std::size_t facet, const Vec3& x);

/// The point of one facet that is nearest to x.
Vec3 nearest_on_facet(const ClosedSurface& surface, std::size_t facet, const Vec3& x);

/// Moments of the volume inside (in the plane: of the area, times 1 m).
struct VolumeMoments {
  double volume = 0;           ///< [m^3]
  Vec3 centre = Vec3::Zero();  ///< [m]
  Mat3 second = Mat3::Zero();  ///< integral of r r^T about the centre [m^5]
};

/// Exact for the facets: sums over the tetrahedra (triangles) between them and a point,
///   V = sum det/6,   int x = V (sum of corners)/4,   int x x^T = V/20 (sum x_a x_a^T + s s^T),
/// s the sum of the corners, from the point; 2, 3 and 12 stand for 6, 4 and 20 in the plane.
VolumeMoments volume_moments(const ClosedSurface& surface);

}  // namespace gannet
