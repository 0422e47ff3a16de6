// What a case says about the geometry of a part: `shape`, `mesh` (surfaces) and `fill` (particles).
#pragma once

#include <vector>

#include "base/array.hpp"
#include "base/keys.hpp"
#include "base/math.hpp"
#include "base/schema.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/volume_shapes.hpp"

namespace gannet {

/// A surface of quadrilaterals over its own points; every point belongs to a cell.
struct SurfaceMesh {
  std::vector<Vec3> points;  ///< [m]
  std::vector<Index> quads;  ///< 4 indices into points a cell; a triangle repeats its last node
  [[nodiscard]] bool empty() const { return quads.empty(); }
};

/// The keys `shape`, `mesh` and `fill` of "parts.*".
Schema mesh_schema();

/// The volume that the part asks for under `shape` (block, mapped, rod) or `mesh` (a file): in a
/// plane case (dimension 2) quadrilaterals. Mistakes as of surface_mesh(). Throws nothing else.
VolumeMesh volume_mesh(const Keys& part, int dimension);

/// The surface that the part asks for under `shape` (plate, plane, wedge, box) or `mesh` (a file).
/// Notes every mistake that it finds (also those of a mesh file, at their line in it) in the
/// case's list and then returns an empty mesh. Throws nothing else.
SurfaceMesh surface_mesh(const Keys& part);

/// The lines of the file that a map `mesh` names. Mistakes as of surface_mesh().
LineMesh file_lines(const Keys& mesh);

}  // namespace gannet
