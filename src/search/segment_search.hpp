// Which points are near which segments of a surface: the broad search that contacts share.
//
// A list is made once and used for many steps. It holds every pair whose distance was at most
// `reach` when it was made, so it stays complete for distances up to reach - skin for as long as
// points and segments have moved by less than the skin against each other. The list is a function
// of the positions alone, with rows in order of the points and segments in order within a row, so
// that a list made again from the same positions is the same list.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/array.hpp"
#include "base/math.hpp"
#include "scene/periods.hpp"

namespace gannet {

/// Corners of a segment, 2 to 4 indices of corner points; the last is repeated to fill four.
using Corners = std::array<Index, 4>;

/// For every point near the surface, the segments that it may touch (compressed rows).
struct SegmentCandidates {
  Array<Index> point;    ///< one a row, ascending
  Array<Index> begin;    ///< rows + 1: segments of row r are [begin[r], begin[r + 1])
  Array<Index> segment;  ///< ascending within a row, image by image
  /// Whole periods that the point is shifted by to be near the segment, one a segment; empty where
  /// nothing repeats.
  Array<Eigen::Vector3i> image;
  [[nodiscard]] Index n_rows() const { return static_cast<Index>(point.size()); }
};

/// What to search among.
struct SegmentSearch {
  std::span<const Line> points;
  std::span<const Index> group;  ///< of each point; empty: all points belong
  Index wanted_group = 0;        ///< points of other groups are passed over
  std::span<const Line> corner_points;
  std::span<const Corners> segments;
  double reach = 0;   ///< largest distance of a pair [m], > 0
  Periods periods{};  ///< points repeat with these, segments do not
};

/// Finds all pairs of a point and a segment (the hull of its corners) that are nearer than
/// `reach`; some pairs a little further apart are in the list too. Segments lie in a uniform grid
/// of cells over their boxes, so the cost is that of looking once at every point, and of the pairs
/// near touching. Where points repeat, all their images are looked at that are near the surface.
/// Throws nothing.
void find_candidates(const SegmentSearch& what, SegmentCandidates& candidates);

/// Puts rows back in ascending order of their points after these were renumbered; the result is
/// what find_candidates would give for the same positions under the new numbers.
void order_rows(SegmentCandidates& candidates);

/// How far points and corner points have moved since a list was made, for a common translation
/// taken off both [m]: the list is complete while the sum is at most the skin.
///   max_i |x_i - x_i^0 - u| + max_j |y_j - y_j^0 - u|,   u = mean_j (y_j - y_j^0)
/// x, x0: points now and then; y, y0: corner points now and then, same sizes. Where points repeat,
/// x_i is the image that is nearest to x_i^0 + u.
double relative_displacement(std::span<const Line> x, std::span<const Line> x0,
                             std::span<const Line> y, std::span<const Line> y0,
                             const Periods& periods = {});

/// The common translation u of it [m]; zero without corner points.
Vec3 mean_displacement(std::span<const Line> y, std::span<const Line> y0);

}  // namespace gannet
