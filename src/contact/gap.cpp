#include "contact/gap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index gap_chunk = 128;

/// Below this share of the contact distance, x - x_cp says nothing about direction.
constexpr double on_surface = 1e-9;

/// A place of a point, and the segment that is nearest to it there.
struct NearestImage {
  Vec3 x = Vec3::Zero();
  Nearest nearest;
};

/// The nearest segment over the images of a point, which stand together among the candidates; of
/// those that are as near the first.
NearestImage nearest_image(const Surface& surface, const SegmentCandidates& candidates, Index row,
                           const Vec3& x, double near, const PointImages& images) {
  const Index end = candidates.begin[row + 1];
  const auto point = static_cast<std::size_t>(candidates.point[row]);
  const Vec3 unwrapped = image_near(images.periods, x, xyz(images.x_search[point]) + images.moved);
  NearestImage found{.x = x, .nearest = {}};
  Index from = candidates.begin[row];
  while (from < end) {
    const Eigen::Vector3i k = candidates.image[from];
    Index to = from + 1;
    while (to < end && candidates.image[to] == k) ++to;
    const Vec3 there = image_of(images.periods, unwrapped, k);
    const Nearest nearest = nearest_segment(
        surface, {&candidates.segment[from], static_cast<std::size_t>(to - from)}, there, near);
    if (nearest.segment >= 0) {
      found = {there, nearest};
      near = std::sqrt(nearest.closest.distance2);
    }
    from = to;
  }
  return found;
}

NearestImage nearest_of_row(const Surface& surface, const SegmentCandidates& candidates, Index row,
                            const Vec3& x, double near, const PointImages& images) {
  if (!candidates.image.empty()) {
    return nearest_image(surface, candidates, row, x, near, images);
  }
  const Index from = candidates.begin[row];
  const std::span<const Index> of_row(&candidates.segment[from],
                                      static_cast<std::size_t>(candidates.begin[row + 1] - from));
  return {x, nearest_segment(surface, of_row, x, near)};
}

}  // namespace

Nearest nearest_segment(const Surface& surface, std::span<const Index> candidates, const Vec3& x,
                        double near) {
  Nearest nearest;
  double best = near;
  double best2 = near * near;
  for (const Index s : candidates) {
    if (has_left(surface, s)) continue;
    const SegmentPlace& place = surface.place[static_cast<std::size_t>(s)];
    const Vec3 r = x - place.centre;
    const double apart = place.radius + best;
    if (r.squaredNorm() > apart * apart) continue;
    const Closest c = closest_on_segment(surface, s, x);
    if (!(c.distance2 < best2)) continue;
    best2 = c.distance2;
    best = std::sqrt(best2);
    nearest = {s, c};
  }
  return nearest;
}

Gap gap_of(const Surface& surface, const Nearest& nearest, const Vec3& x, const GapRange& range,
           std::int32_t& side) {
  Gap gap;
  if (nearest.segment < 0) {
    side = 0;
    return gap;
  }
  gap.segment = nearest.segment;
  gap.N = nearest.closest.N;
  const Vec3 r = x - nearest.closest.point;
  const Vec3 n = side_normal(surface, nearest.segment, nearest.closest);
  const Index sheet = surface.segments[static_cast<std::size_t>(nearest.segment)].sheet + 1;
  const std::int32_t here = r.dot(n) < 0 ? -sheet : sheet;
  const double D = std::sqrt(nearest.closest.distance2);
  const bool touches_surface = D <= on_surface * range.contact;
  const bool remembers = side == -here || (touches_surface && side != 0);
  if (!remembers || (on_rim(surface, nearest.segment, nearest.closest) && !touches_surface)) {
    side = here;
  }
  const double s = side == here ? 1 : -1;
  gap.normal = touches_surface ? Vec3(n.normalized() * (side < 0 ? -1 : 1)) : Vec3(r * (s / D));
  gap.penetration = range.contact - s * D;
  return gap;
}

Overlaps find_gaps(const Surface& surface, const SegmentCandidates& candidates,
                   std::span<const Line> x, const GapRange& range, bool first,
                   const GapMemory& memory, std::span<Gap> gaps, const PointImages& images) {
  const auto rows = [&](Index begin, Index end) {
    Overlaps found;
    for (Index r = begin; r < end; ++r) {
      const auto i = static_cast<std::size_t>(candidates.point[r]);
      const NearestImage at = nearest_of_row(surface, candidates, r, xyz(x[i]), range.near, images);
      Gap gap = gap_of(surface, at.nearest, at.x, range, memory.side[i]);
      const double inside = std::max(0.0, gap.penetration);
      if (first && inside > 1e-9 * range.contact) {
        memory.offset[i] = inside;
        ++found.count;
        found.largest = std::max(found.largest, inside);
      }
      if (memory.offset[i] > 0) {
        memory.offset[i] = std::min(memory.offset[i], inside);
        gap.penetration -= memory.offset[i];
      }
      gaps[static_cast<std::size_t>(r)] = gap;
    }
    return found;
  };
  return parallel_reduce(candidates.n_rows(), gap_chunk, Overlaps{}, rows,
                         [](const Overlaps& a, const Overlaps& b) {
                           return Overlaps{a.count + b.count, std::max(a.largest, b.largest)};
                         });
}

}  // namespace gannet
