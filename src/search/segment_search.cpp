#include "search/segment_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index point_chunk = 1024;

/// Where a segment is, grown by the reach: a box, and a slab along its mean plane, which is much
/// thinner than the box where the surface is inclined to the axes.
struct Slab {
  Vec3 lo, hi;
  Vec3 centre, normal;
  double half = 0;
  [[nodiscard]] bool contains(const Vec3& x) const {
    return (x.array() >= lo.array()).all() && (x.array() <= hi.array()).all() &&
           std::abs(normal.dot(x - centre)) <= half;
  }
};

Slab slab_of(const Corners& corners, std::span<const Line> points, double reach) {
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = xyz(points[static_cast<std::size_t>(corners[k])]);
  Slab s;
  s.lo = p[0].cwiseMin(p[1]).cwiseMin(p[2]).cwiseMin(p[3]).array() - reach;
  s.hi = p[0].cwiseMax(p[1]).cwiseMax(p[2]).cwiseMax(p[3]).array() + reach;
  s.centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  s.normal = (p[2] - p[0]).cross(p[3] - p[1]);  // zero for a line: its slab holds everything
  const double length = s.normal.norm();
  const double size2 = (s.hi - s.lo).squaredNorm();
  s.normal = length > 1e-12 * size2 ? Vec3(s.normal / length) : Vec3(Vec3::Zero());
  for (const Vec3& q : p) s.half = std::max(s.half, std::abs(s.normal.dot(q - s.centre)));
  s.half += reach;
  return s;
}

/// Uniform cells over the boxes of all segments; each cell lists the segments whose box meets it.
struct Grid {
  Vec3 lo, hi;
  double cell = 1;
  std::array<Index, 3> n{1, 1, 1};
  std::vector<Index> begin;
  std::vector<Index> segment;

  [[nodiscard]] std::array<Index, 3> at(const Vec3& x) const {
    std::array<Index, 3> i{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      i[c] = std::clamp(static_cast<Index>((x[k] - lo[k]) / cell), Index{0}, n[c] - 1);
    }
    return i;
  }
  [[nodiscard]] std::size_t number(Index i, Index j, Index k) const {
    return static_cast<std::size_t>((k * n[1] + j) * n[0] + i);
  }
  template <class F>
  void for_cells_of(const Slab& s, F&& f) const {
    const auto a = at(s.lo);
    const auto b = at(s.hi);
    for (Index k = a[2]; k <= b[2]; ++k) {
      for (Index j = a[1]; j <= b[1]; ++j) {
        for (Index i = a[0]; i <= b[0]; ++i) f(number(i, j, k));
      }
    }
  }
};

/// Cells of about the size of a box, but never many more cells than segments. False where corner
/// points are not finite; the guards will say which.
bool size_grid(const std::vector<Slab>& slabs, Grid& grid) {
  grid.lo = slabs[0].lo;
  grid.hi = slabs[0].hi;
  double sum = 0;
  for (const Slab& s : slabs) {
    grid.lo = grid.lo.cwiseMin(s.lo);
    grid.hi = grid.hi.cwiseMax(s.hi);
    sum += (s.hi - s.lo).maxCoeff();
  }
  const double most = 64.0 + 8.0 * static_cast<double>(slabs.size());
  grid.cell = sum / static_cast<double>(slabs.size());
  if (!(grid.hi - grid.lo).allFinite() || !std::isfinite(grid.cell)) return false;
  Vec3 n = ((grid.hi - grid.lo) / grid.cell).array().floor() + 1.0;
  while (n.prod() > most) {
    grid.cell *= 1.25;
    n = ((grid.hi - grid.lo) / grid.cell).array().floor() + 1.0;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    grid.n[c] = static_cast<Index>(n[static_cast<Eigen::Index>(c)]);
  }
  return true;
}

Grid make_grid(const std::vector<Slab>& slabs) {
  Grid grid;
  if (!size_grid(slabs, grid)) {
    grid.lo.setConstant(1);  // an empty box: nothing is in it
    grid.hi.setConstant(-1);
    return grid;
  }
  const std::size_t n_cells = grid.number(0, 0, grid.n[2]);
  grid.begin.assign(n_cells + 1, 0);
  for (const Slab& s : slabs) grid.for_cells_of(s, [&](std::size_t c) { ++grid.begin[c + 1]; });
  std::partial_sum(grid.begin.begin(), grid.begin.end(), grid.begin.begin());
  grid.segment.resize(static_cast<std::size_t>(grid.begin[n_cells]));
  std::vector<Index> next(grid.begin.begin(), grid.begin.end() - 1);
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    grid.for_cells_of(slabs[i], [&](std::size_t c) {
      grid.segment[static_cast<std::size_t>(next[c]++)] = static_cast<Index>(i);
    });
  }
  return grid;
}

/// Calls f(segment) for every segment whose slab holds x, in order of segments.
template <class F>
void for_slabs_at(const Grid& grid, const std::vector<Slab>& slabs, const Vec3& x, F&& f) {
  if ((x.array() < grid.lo.array()).any() || (x.array() > grid.hi.array()).any()) return;
  const auto i = grid.at(x);
  const std::size_t c = grid.number(i[0], i[1], i[2]);
  for (Index k = grid.begin[c]; k < grid.begin[c + 1]; ++k) {
    const Index s = grid.segment[static_cast<std::size_t>(k)];
    if (slabs[static_cast<std::size_t>(s)].contains(x)) f(s);
  }
}

/// Calls f(segment, k) for the images x + k L of a point that are in slabs, image by image.
template <class F>
void for_slabs_at(const SegmentSearch& what, const Grid& grid, const std::vector<Slab>& slabs,
                  const Vec3& x, F&& f) {
  if (!what.periods.any()) {
    return for_slabs_at(grid, slabs, x, [&](Index s) { f(s, Eigen::Vector3i(0, 0, 0)); });
  }
  if (!(grid.lo.array() <= grid.hi.array()).all()) return;
  for_images_in(what.periods, x, grid.lo, grid.hi, [&](const Eigen::Vector3i& k) {
    for_slabs_at(grid, slabs, image_of(what.periods, x, k), [&](Index s) { f(s, k); });
  });
}

/// From the number of segments of every point to the rows of those that have any.
void make_rows(const std::vector<Index>& count, SegmentCandidates& list) {
  list.point.clear();
  list.begin.assign(1, 0);
  for (std::size_t p = 0; p < count.size(); ++p) {
    if (count[p] == 0) continue;
    list.point.push_back(static_cast<Index>(p));
    list.begin.push_back(list.begin.back() + count[p]);
  }
  list.segment.resize(static_cast<std::size_t>(list.begin.back()));
}

}  // namespace

void find_candidates(const SegmentSearch& what, SegmentCandidates& candidates) {
  const auto n = static_cast<Index>(what.points.size());
  std::vector<Index> count(what.points.size(), 0);
  if (what.segments.empty()) return make_rows(count, candidates);
  std::vector<Slab> slabs(what.segments.size());
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    slabs[s] = slab_of(what.segments[s], what.corner_points, what.reach);
  }
  const Grid grid = make_grid(slabs);
  parallel_for(n, point_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto p = static_cast<std::size_t>(i);
      if (!what.group.empty() && what.group[p] != what.wanted_group) continue;
      for_slabs_at(what, grid, slabs, xyz(what.points[p]),
                   [&](Index, const Eigen::Vector3i&) { ++count[p]; });
    }
  });
  make_rows(count, candidates);
  candidates.image.resize(what.periods.any() ? candidates.segment.size() : 0);
  parallel_for(candidates.n_rows(), point_chunk, [&](Index begin, Index end) {
    for (Index r = begin; r < end; ++r) {
      auto next = static_cast<std::size_t>(candidates.begin[r]);
      const auto p = static_cast<std::size_t>(candidates.point[r]);
      for_slabs_at(what, grid, slabs, xyz(what.points[p]), [&](Index s, const Eigen::Vector3i& k) {
        if (!candidates.image.empty()) candidates.image[next] = k;
        candidates.segment[next++] = s;
      });
    }
  });
}

void order_rows(SegmentCandidates& candidates) {
  if (std::is_sorted(candidates.point.begin(), candidates.point.end())) return;
  std::vector<Index> order(candidates.point.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return candidates.point[a] < candidates.point[b]; });
  const SegmentCandidates old = candidates;
  Index next = 0;
  for (std::size_t r = 0; r < order.size(); ++r) {
    const Index from = order[r];
    candidates.point[r] = old.point[from];
    candidates.begin[r] = next;
    for (Index k = old.begin[from]; k < old.begin[from + 1]; ++k) {
      if (!old.image.empty()) candidates.image[next] = old.image[k];
      candidates.segment[next++] = old.segment[k];
    }
  }
}

Vec3 mean_displacement(std::span<const Line> y, std::span<const Line> y0) {
  Vec3 u = Vec3::Zero();
  for (std::size_t j = 0; j < y.size(); ++j) u += xyz(y[j]) - xyz(y0[j]);
  if (!y.empty()) u /= static_cast<double>(y.size());
  return u;
}

double relative_displacement(std::span<const Line> x, std::span<const Line> x0,
                             std::span<const Line> y, std::span<const Line> y0,
                             const Periods& periods) {
  const Vec3 u = mean_displacement(y, y0);
  const bool repeats = periods.any();
  double corners = 0;
  for (std::size_t j = 0; j < y.size(); ++j) {
    corners = std::max(corners, (xyz(y[j]) - xyz(y0[j]) - u).squaredNorm());
  }
  const double points = parallel_reduce(
      static_cast<Index>(x.size()), node_chunk, 0.0,
      [&](Index begin, Index end) {
        double most = 0;
        for (Index i = begin; i < end; ++i) {
          const auto p = static_cast<std::size_t>(i);
          Vec3 moved = xyz(x[p]) - xyz(x0[p]) - u;
          if (repeats) moved = image_near(periods, moved, Vec3::Zero());
          most = std::max(most, moved.squaredNorm());
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  return std::sqrt(points) + std::sqrt(corners);
}

}  // namespace gannet
