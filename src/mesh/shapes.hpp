// Surfaces that a case describes with a few numbers.
#pragma once

#include <array>

#include "base/keys.hpp"
#include "mesh/mesh_keys.hpp"

namespace gannet {

/// A parallelogram of n[0] x n[1] quadrilaterals, point (i, j) at
///   corner + i/n[0] along + j/n[1] across,
/// i running fastest; cells are counted the same way, their normal is along x across.
/// corner, along, across: 3 [m]; n >= 1. Throws nothing.
SurfaceMesh parallelogram(const Vec3& corner, const Vec3& along, const Vec3& across,
                          std::array<int, 2> n);

/// Two rectangles that rise by the angle deadrise from a keel along y, as one mesh with
/// 2 n[0] x n[1] cells, from the chine at -x to that at +x, all normals with a part along +z.
///   x = keel + (s, t, |s| tan(deadrise)),  |s| <= half_breadth,  |t| <= length/2
/// keel: 3 [m], its middle; half_breadth, length: [m], > 0; deadrise: [rad], in (-pi/2, pi/2).
SurfaceMesh wedge_surface(const Vec3& keel, double deadrise, std::array<double, 2> breadth_length,
                          std::array<int, 2> n);

/// The six faces of the box between two corners, n[0] x n[1] x n[2] cells along its edges, joined
/// at edges and corners; normals point outwards. from < to: 3 [m]; n >= 1. Throws nothing.
SurfaceMesh box_surface(const Vec3& from, const Vec3& to, std::array<int, 3> n);

/// Keys of the shapes, under `shape` of a part.
std::vector<Key> shape_keys();

/// The surface that the map `shape` of a part asks for; empty after a mistake, which is noted.
SurfaceMesh shape_surface(const Keys& shape);

}  // namespace gannet
