#include "contact/gap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index row_chunk = 128;

/// Below this share of the contact distance, x - x_cp says nothing about direction.
constexpr double on_surface = 1e-9;

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
                   const GapMemory& memory, std::span<Gap> gaps) {
  const auto rows = [&](Index begin, Index end) {
    Overlaps found;
    for (Index r = begin; r < end; ++r) {
      const auto i = static_cast<std::size_t>(candidates.point[r]);
      const Index from = candidates.begin[r];
      const std::span<const Index> of_row(&candidates.segment[from],
                                          static_cast<std::size_t>(candidates.begin[r + 1] - from));
      const Vec3 p = xyz(x[i]);
      Gap gap = gap_of(surface, nearest_segment(surface, of_row, p, range.near), p, range,
                       memory.side[i]);
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
  return parallel_reduce(candidates.n_rows(), row_chunk, Overlaps{}, rows,
                         [](const Overlaps& a, const Overlaps& b) {
                           return Overlaps{a.count + b.count, std::max(a.largest, b.largest)};
                         });
}

}  // namespace gannet
