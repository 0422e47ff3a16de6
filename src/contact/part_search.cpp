#include "contact/part_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gannet {

namespace {

/// A node faces a segment where the cosine of their normals is below this.
constexpr double facing_cosine = -0.1;

/// Longest time without a look [steps].
constexpr double longest_wait = 1000;

/// The least by which two parts are taken to close in a step, as a share of their smallest element:
/// nodes of elements move much less in a step that is stable.
constexpr double least_advance = 0.1;

struct Box {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = -lo;
};

void take_positions(const Nodes& nodes, Surface& surface) {
  for (std::size_t i = 0; i < surface.node.size(); ++i) {
    surface.x[i] = nodes.x[static_cast<std::size_t>(surface.node[i])];
  }
}

Box box_of(const Surface& surface) {
  Box box;
  for (const Line& x : surface.x) {
    box.lo = box.lo.cwiseMin(xyz(x));
    box.hi = box.hi.cwiseMax(xyz(x));
  }
  return box;
}

/// Distance of two boxes [m]; NaN places count as near, for the guards to find.
double apart(const Box& a, const Box& b) {
  const Vec3 gap = (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(Vec3::Zero());
  const double d = gap.norm();
  return std::isfinite(d) ? d : 0;
}

/// Largest speed of the nodes of both parts against the first of the second [m/s].
double speed_of(const Nodes& nodes, const PartContact& c) {
  const Vec3 v0 = xyz(nodes.v[static_cast<std::size_t>(c.sides[1].surface.node[0])]);
  double v2 = 0;
  for (const PartSide& side : c.sides) {
    for (const Index i : side.surface.node) {
      v2 = std::max(v2, (xyz(nodes.v[static_cast<std::size_t>(i)]) - v0).squaredNorm());
    }
  }
  return std::sqrt(v2);
}

double size_of(const PartContact& c) { return std::min(c.sides[0].depth, c.sides[1].depth); }

double reach_of(const PartContact& c) {
  double reach = 0;
  for (const PartDirection& d : c.directions) reach = std::max(reach, d.range.near);
  return reach;
}

/// Takes pairs out of a list, and rows that are empty then.
template <class Keep>
void filter(SegmentCandidates& list, Keep&& keep) {
  SegmentCandidates kept;
  kept.begin.assign(1, 0);
  for (std::size_t r = 0; r < list.point.size(); ++r) {
    for (Index k = list.begin[r]; k < list.begin[r + 1]; ++k) {
      const Index s = list.segment[static_cast<std::size_t>(k)];
      if (keep(list.point[r], s)) kept.segment.push_back(s);
    }
    const auto n = static_cast<Index>(kept.segment.size());
    if (n == kept.begin.back()) continue;
    kept.point.push_back(list.point[r]);
    kept.begin.push_back(n);
  }
  list = std::move(kept);
}

void keep_facing(const PartSide& points, const PartSide& segments, SegmentCandidates& list) {
  std::vector<double> area;
  std::vector<Vec3> facing;
  find_areas(points.surface, points.x_search, area, facing);
  filter(list, [&](Index i, Index s) {
    const Vec3 n =
        area_vector(segments.surface.segments[static_cast<std::size_t>(s)], segments.x_search);
    const Vec3& p = facing[static_cast<std::size_t>(i)];
    return p.dot(n) < facing_cosine * p.norm() * n.norm();
  });
}

void size_rows(const PartContact& c, PartDirection& d) {
  const auto n = static_cast<std::size_t>(d.candidates.n_rows());
  d.gaps.assign(n, Gap{});
  d.stiffness.assign(n, 0);
  d.point_path.resize(n);
  d.forces.normal.resize(n);
  d.forces.total.resize(n);
  if (c.law.friction > 0) d.forces.friction.resize(n);
  if (c.law.damping > 0) d.forces.damping.resize(n);
}

/// Nodes that have no row remember nothing.
void forget_far(PartDirection& d) {
  std::size_t row = 0;
  for (std::size_t i = 0; i < d.side.size(); ++i) {
    if (row < d.candidates.point.size() && d.candidates.point[row] == static_cast<Index>(i)) {
      ++row;
      continue;
    }
    d.side[i] = 0;
    d.offset[i] = 0;
    if (!d.tangential.empty()) d.tangential[i] = {};
  }
}

/// No list for as many steps as the parts need to come near, which it returns.
double wait_for(PartContact& c, double gap, double speed, const Step& step) {
  const double per_step = std::max(4 * speed * step.dt_old, least_advance * size_of(c));
  c.numbers[0] = -1;
  for (PartDirection& d : c.directions) {
    d.candidates.point.clear();
    d.candidates.begin.assign(1, 0);
    d.candidates.segment.clear();
    size_rows(c, d);
    forget_far(d);
  }
  return std::min(longest_wait, std::floor(gap / per_step));
}

/// Whether the lists that are there hold everything near.
bool list_holds(const PartContact& c) {
  const PartSide& a = c.sides[0];
  const PartSide& b = c.sides[1];
  return c.numbers[0] >= 0 &&
         relative_displacement(a.surface.x, a.x_search, b.surface.x, b.x_search) <= c.numbers[0];
}

bool has_rows(const PartContact& c) {
  return std::any_of(c.directions.begin(), c.directions.end(),
                     [](const PartDirection& d) { return d.candidates.n_rows() > 0; });
}

/// New lists, or a time to wait.
double look_again(const Scene& scene, PartContact& c, const Step& step) {
  const double speed = speed_of(scene.nodes, c);
  const double unit = std::max(0.5 * size_of(c), c.directions[0].range.contact);
  const double skin = std::clamp(8 * step.dt_old * speed, 0.2 * unit, 3 * unit);
  const double gap = apart(box_of(c.sides[0].surface), box_of(c.sides[1].surface));
  const double reach = reach_of(c) + skin;
  if (gap > reach) return wait_for(c, gap - reach, speed, step);
  for (PartSide& side : c.sides) side.x_search = side.surface.x;
  c.numbers[0] = skin;
  make_part_lists(c);
  for (PartDirection& d : c.directions) forget_far(d);
  return 0;
}

}  // namespace

void make_part_lists(PartContact& c) {
  for (PartDirection& d : c.directions) {
    const PartSide& points = c.sides[d.points];
    const PartSide& segments = c.sides[d.segments];
    find_candidates({.points = points.x_search,
                     .group = {},
                     .wanted_group = 0,
                     .corner_points = segments.x_search,
                     .segments = segments.surface.corners,
                     .reach = d.range.near + c.numbers[0]},
                    d.candidates);
    if (points.solid && segments.solid) keep_facing(points, segments, d.candidates);
    size_rows(c, d);
  }
}

bool look_for_pairs(const Scene& scene, PartContact& c, const Step& step, double& wait) {
  for (PartSide& side : c.sides) take_positions(scene.nodes, side.surface);
  if (!list_holds(c)) wait = look_again(scene, c, step);
  if (!has_rows(c)) return false;
  for (PartSide& side : c.sides) update_side(scene.nodes, side);
  return true;
}

}  // namespace gannet
