// Reads the cells of a gmsh file.
#pragma once

#include <string>

#include "base/keys.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/mesh_keys.hpp"
#include "mesh/volume_shapes.hpp"

namespace gannet {

/// The quadrilaterals and triangles of a gmsh file (.msh 4.1 or 2.2, ASCII, first order).
/// group: name of a physical surface whose cells are wanted; "" takes all cells. Points are those
/// that the cells use, in the order in which the cells name them, in the units of the file.
/// A mistake in the file is noted in `mistakes` with its line, and an empty mesh is returned.
/// Throws nothing.
SurfaceMesh read_msh(const std::string& file, const std::string& group, Mistakes& mistakes);

/// The tetrahedra or the hexahedra of a gmsh file, as read_msh(); group: of a physical volume. Both
/// in one group are a mistake.
VolumeMesh read_msh_volume(const std::string& file, const std::string& group, Mistakes& mistakes);

/// The lines of a gmsh file, as read_msh(); group: of a physical curve. They may meet and branch as
/// they like.
LineMesh read_msh_lines(const std::string& file, const std::string& group, Mistakes& mistakes);

}  // namespace gannet
