// Gaps: for every point near a surface, its closest segment, the side it is on, and how far it
// has come closer than the contact distance.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "base/array.hpp"
#include "base/math.hpp"
#include "contact/surface.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// A point and the segment that it takes.
struct Gap {
  Index segment = -1;          ///< -1: none within the near distance
  std::array<double, 4> N{};   ///< weights of the segment's corners at the closest point
  Vec3 normal = Vec3::Zero();  ///< direction in which the point is pushed; along x - x_cp
  double penetration = 0;      ///< d - g with the signed gap g [m]; pushed where it is positive
};

/// What a point remembers between steps: entries of tracked particle fields.
struct GapMemory {
  /// 0: not near; +(sheet + 1) or -(sheet + 1): the side of that sheet that it is on.
  std::span<std::int32_t> side;
  /// Penetration that it started with and that causes no force [m]; shrinks as it moves out.
  std::span<double> offset;
};

/// Contact distance d, and the distance within which a point has a side.
struct GapRange {
  double contact = 0;  ///< d [m]
  double near = 0;     ///< >= d [m]
  [[nodiscard]] static GapRange of(double d) { return {d, 1.25 * d}; }
};

/// Overlaps that were there when the run began.
struct Overlaps {
  Index count = 0;
  double largest = 0;  ///< [m]
};

/// The closest segment of point x among candidates, ties to the lowest; segment -1 where none is
/// nearer than `near` [m].
struct Nearest {
  Index segment = -1;
  Closest closest;
};
Nearest nearest_segment(const Surface& surface, std::span<const Index> candidates, const Vec3& x,
                        double near);

/// One point's gap. With D = |x - x_cp| and s = +1, or -1 where the point stands beyond the
/// mid-surface from the side that it remembers,
///   g = s D,   normal = s (x - x_cp)/D,   penetration = d - g,
/// so that a point that passed the mid-surface within a step is pushed back where it came from.
/// At the rim the side is not remembered: a point may pass around. side: see GapMemory.
Gap gap_of(const Surface& surface, const Nearest& nearest, const Vec3& x, const GapRange& range,
           std::int32_t& side);

/// Where the points that a list of candidates was made from stood, of points that repeat.
struct PointImages {
  Periods periods{};
  std::span<const Line> x_search{};  ///< of each point, when the list was made [m]
  Vec3 moved = Vec3::Zero();         ///< mean_displacement() of the surface since then [m]
};

/// Gaps of all rows of `candidates`: gaps[r] is that of point candidates.point[r].
/// x: positions of all points [m]. With `first`, penetrations become offsets, and are counted;
/// later penetration = max(0, d - g) - offset, where offset <- min(offset, max(0, d - g)).
/// Of a point that repeats, the image counts that is nearest to the surface: a point is wrapped to
/// the other side of its domain at any time, and its candidates are those of where it would be
/// without, the image nearest to x_search + moved.
Overlaps find_gaps(const Surface& surface, const SegmentCandidates& candidates,
                   std::span<const Line> x, const GapRange& range, bool first,
                   const GapMemory& memory, std::span<Gap> gaps, const PointImages& images = {});

}  // namespace gannet
