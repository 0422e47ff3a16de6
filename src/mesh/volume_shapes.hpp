// Volumes that a case describes with a few numbers, as meshes of solids.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/keys.hpp"
#include "base/math.hpp"

namespace gannet {

/// A volume (or, in a plane case, an area) of cells over its own points.
struct VolumeMesh {
  std::vector<Vec3> points;  ///< [m]
  std::vector<Index> cells;  ///< nodes_per_cell indices into points a cell, in the order of VTK
  int nodes_per_cell = 8;    ///< 8: hexahedra, 4: tetrahedra; quadrilaterals of a plane case
  [[nodiscard]] bool empty() const { return cells.empty(); }
};

/// A box of n[0] x n[1] x n[2] hexahedra between two corners. from < to: 3 [m]; n >= 1. Throws
/// nothing.
VolumeMesh block_volume(const Vec3& from, const Vec3& to, std::array<int, 3> n);

/// A rectangle of n[0] x n[1] quadrilaterals between two corners, in the plane of the first. from <
/// to in x and y [m]; n >= 1. Throws nothing.
VolumeMesh block_area(const Vec3& from, const Vec3& to, std::array<int, 2> n);

/// The point (xi, eta, zeta) in [0, 1]^3 of a map between corners, linear along each of them:
/// eight in the order of VTK, or four of a plane (zeta has no meaning).
Vec3 mapped_point(std::span<const Vec3> corners, const Vec3& p);

/// A round bar of hexahedra: over the section a core of n[0] x n[0] cells within n[1] rings, n[2]
/// layers along it. The corners of the core lie on the diagonals at 0.55 of the radius; its sides
/// bulge halfway to the circle, so that no corner of a cell comes near 180 degrees.
/// from, to: middles of the ends [m]; radius > 0 [m]; n >= 1. Throws nothing.
VolumeMesh rod_volume(const Vec3& from, const Vec3& to, double radius, std::array<int, 3> n);

/// Six tetrahedra for each hexahedron: cones from its corner of the smallest number over the three
/// faces that do not have it, each cut along the diagonal from its own smallest corner. So
/// hexahedra that share a face cut it alike. Throws nothing; an empty mesh stays empty.
VolumeMesh tetrahedra_of(const VolumeMesh& hexahedra);

/// Keys of these shapes, under `shape` of a part.
std::vector<Key> volume_shape_keys();

/// Whether the map `shape` names one of them.
bool is_volume_shape(const Keys& shape);

/// The volume of the map `shape` of a part, which names one of them; dimension: 2 or 3, of the
/// case. Notes every mistake that it finds in the case's list and then returns an empty mesh.
/// Throws nothing else.
VolumeMesh shape_volume(const Keys& shape, int dimension);

}  // namespace gannet
