// The surface of a part as contact sees it: segments with consistent normals, who their
// neighbours are, and where they are now.
#pragma once

#include <array>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"
#include "contact/closest_point.hpp"
#include "scene/scene.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// One segment: what does not change during a run, but for neighbours that leave.
struct Segment {
  Corners corner{};   ///< entries of Surface::node; unused ones repeat the last
  int n_corners = 0;  ///< 2: line, 3: triangle, 4: quad
  /// Segment across edge k (across corner k for a line); -1 at the rim and at junctions.
  std::array<Index, 4> neighbour{-1, -1, -1, -1};
  Index sheet = 0;  ///< segments joined by plain edges have the same number
};

/// Where a segment is at this level.
struct SegmentPlace {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 normal = Vec3::Zero();  ///< unit normal of the mean plane
  double radius = 0;           ///< of a sphere about the centre that holds it [m]
};

struct Surface {
  /// Per segment whether its element has left; nullptr where none can. See ShellSurface::gone.
  const std::vector<std::uint8_t>* gone = nullptr;
  std::vector<std::uint8_t> left;  ///< those of them whose edges have become a rim
  Array<Index> node;               ///< scene node of each surface node, ascending
  Array<std::int64_t> cell_id;     ///< stable number of each segment's cell
  std::vector<Segment> segments;
  std::vector<Corners> corners;      ///< Segment::corner once more, for the search
  std::vector<std::uint8_t> at_rim;  ///< per surface node: an end of a rim or junction
  Array<Line> x;                     ///< positions at this level [m]
  std::vector<SegmentPlace> place;   ///< per segment
  std::vector<Vec3> node_normal;     ///< sum of the unit normals around a node
  [[nodiscard]] Index n_nodes() const { return static_cast<Index>(node.size()); }
};

/// The surface over the cells of a part (lines, triangles or quads; a quad that repeats a corner
/// is a triangle). Segments that meet in pairs are turned so that their normals point to the same
/// side; where three or more meet, and at the rim, a sheet ends.
Surface make_surface(const Part& part);

/// Takes positions from the node table and finds places and normals. Where elements have left, the
/// edges around them become a rim.
void update_surface(const Nodes& nodes, Surface& surface);

/// True where the element of a segment has left.
inline bool has_left(const Surface& surface, Index segment) {
  return !surface.left.empty() && surface.left[static_cast<std::size_t>(segment)] != 0;
}

/// Closest point of one segment.
Closest closest_on_segment(const Surface& surface, Index segment, const Vec3& x);

/// A vector that tells the side of a point: positive dot product with x - x_cp on the positive
/// side. Of the segment inside; of both segments at an edge; of all around at a corner. Not unit.
Vec3 side_normal(const Surface& surface, Index segment, const Closest& closest);

/// True where the closest point is on the rim: a point there may be beyond the rim and may pass
/// around it.
bool on_rim(const Surface& surface, Index segment, const Closest& closest);

}  // namespace gannet
