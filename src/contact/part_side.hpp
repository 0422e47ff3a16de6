// One of the two parts of a contact between parts of elements: its nodes, its surface, and how
// stiff a penalty it can bear.
#pragma once

#include <vector>

#include "base/array.hpp"
#include "contact/surface.hpp"
#include "scene/scene.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

struct PartSide {
  int part = -1;
  bool solid = false;    ///< its surface has an inside
  bool line = false;     ///< cables or beams: nodes, and no surface that others could meet
  double thickness = 0;  ///< of the part, by half of which contact stands off [m]
  double depth = 0;      ///< smallest size of an element behind its surface [m]
  Surface surface;
  /// Per surface node the penalty per area and penetration [Pa/m]: the mean over the segments
  /// around it of (K + 4/3 G) A/V (solids) or 0.2 E t/A (shells); infinite where the part is rigid.
  std::vector<double> kappa;
  std::vector<double> area;  ///< per surface node: share of the areas around it now [m^2]
  std::vector<Vec3> facing;  ///< the same with the normals of the segments [m^2]
  Array<Line> x_search;      ///< tracked: positions when the list was made [m]
};

/// The side of a contact that a part of solids, shells, cables or beams or a rigid surface is. A
/// node of a line of elements of length L counts for an area L^2, and kappa = 0.1 EA/L^3.
/// data: of that part; elastic: by its elements also where it is rigid, for what meets planes.
/// Needs the positions of the start in the node table.
PartSide make_part_side(const Scene& scene, int part, const ShellSurface& data,
                        bool elastic = false);

/// Takes positions from the node table; finds places, normals and areas.
void update_side(const Nodes& nodes, PartSide& side);

/// Normal times area of a segment, corner points at x [m^2]; of a line of unit thickness within the
/// plane, to its left.
Vec3 area_vector(const Segment& segment, const Array<Line>& x);

/// Areas and facing vectors of all surface nodes from the positions x of the surface nodes [m].
void find_areas(const Surface& surface, const Array<Line>& x, std::vector<double>& area,
                std::vector<Vec3>& facing);

}  // namespace gannet
