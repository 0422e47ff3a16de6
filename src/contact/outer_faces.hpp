// The outer faces of a part of solids, as contact sees them.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace gannet {

/// The faces that belong to one element only, as a part of surface cells whose normals point
/// outwards, in the order of their elements; and the element behind each.
struct OuterFaces {
  Part faces;  ///< quads of hexahedra, triangles of tetrahedra, lines of plane quadrilaterals
  std::vector<Index> element;
};

/// Finds the outer faces of a part of hexahedra, tetrahedra or plane quadrilaterals with corners in
/// the order of VTK. Throws nothing.
OuterFaces outer_faces(const Part& solid);

/// Volume of element e of a part of solids in the positions at hand [m^3], a hexahedron as the six
/// tetrahedra about one of its diagonals; of one unit of thickness for a plane quadrilateral.
double volume_of_cell(const Part& solid, const Nodes& nodes, Index e);

}  // namespace gannet
