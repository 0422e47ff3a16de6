#include "contact/part_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/parallel.hpp"
#include "contact/part_planes.hpp"
#include "contact/part_search.hpp"

namespace gannet {

namespace {

constexpr Index row_chunk = 128;

/// Overlaps at the start below this share of the size of the elements are rounding.
constexpr double touching = 1e-9;

/// What a node faces least, as a share of the areas around it.
constexpr double least_facing = 0.1;

ContactInput input_of(const Scene& scene, const PartContact& c, const PartDirection& d,
                      const Step& step) {
  ContactInput in;
  in.nodes = &scene.nodes;
  in.surface = &c.sides[d.segments].surface;
  in.candidates = &d.candidates;
  in.gaps = d.gaps;
  in.dt_old = step.dt_old;
  in.followers = c.followers;
  in.point_node = c.sides[d.points].surface.node;
  in.stiffness = d.stiffness;
  return in;
}

/// Sum of N_i a_i over the corners of a gap's segment.
double at_foot(const Surface& surface, const Gap& gap, const std::vector<double>& a) {
  const Segment& g = surface.segments[static_cast<std::size_t>(gap.segment)];
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(g.n_corners); ++k) {
    if (gap.N[k] != 0) sum += gap.N[k] * a[static_cast<std::size_t>(g.corner[k])];
  }
  return sum;
}

/// Gap of the point of row r, less what it started with.
Gap gap_of_row(PartContact& c, PartDirection& d, Index r, bool first, Overlaps& found) {
  const auto i = static_cast<std::size_t>(d.candidates.point[r]);
  const PartSide& segments = c.sides[d.segments];
  const Index from = d.candidates.begin[r];
  const std::span<const Index> of_row(&d.candidates.segment[from],
                                      static_cast<std::size_t>(d.candidates.begin[r + 1] - from));
  const Vec3 x = xyz(c.sides[d.points].surface.x[i]);
  const Nearest nearest = nearest_segment(segments.surface, of_row, x, d.range.near);
  Gap gap = segments.solid
                ? gap_of_solid(segments.surface, nearest, x, d.range.contact, segments.depth)
                : gap_of(segments.surface, nearest, x, d.range, d.side[i]);
  const double inside = std::max(0.0, gap.penetration);
  if (first && inside > touching * std::max(segments.depth, d.range.contact)) {
    d.offset[i] = inside;
    ++found.count;
    found.largest = std::max(found.largest, inside);
  }
  if (d.offset[i] > 0) {
    d.offset[i] = std::min(d.offset[i], inside);
    gap.penetration -= d.offset[i];
  }
  return gap;
}

/// Gaps and stiffnesses of all rows.
Overlaps find_part_gaps(PartContact& c, PartDirection& d, bool first) {
  return parallel_reduce(
      d.candidates.n_rows(), row_chunk, Overlaps{},
      [&](Index begin, Index end) {
        Overlaps found;
        for (Index r = begin; r < end; ++r) {
          const auto row = static_cast<std::size_t>(r);
          const Gap gap = gap_of_row(c, d, r, first, found);
          d.gaps[row] = gap;
          d.stiffness[row] =
              pair_stiffness(c.sides[d.points], c.sides[d.segments],
                             static_cast<std::size_t>(d.candidates.point[r]), gap, c.factor);
        }
        return found;
      },
      [](const Overlaps& a, const Overlaps& b) {
        return Overlaps{a.count + b.count, std::max(a.largest, b.largest)};
      });
}

/// Adds the rows of all near pairs to what meets at their nodes, k g_i sum g_j with g = 1 for the
/// point and N for the corners, j over those that forces move.
void add_meeting(const Scene& scene, const PartContact& c, const PartDirection& d,
                 PartMeeting& all) {
  const auto moves = [&](Index node) {
    return scene.nodes.v[static_cast<std::size_t>(node)].w > 0 || c.followers->leader_of(node) >= 0;
  };
  const auto add = [&](Index node, double k) {
    if (moves(node)) add_stiffness(all, node, k);
  };
  const Surface& surface = c.sides[d.segments].surface;
  for (std::size_t r = 0; r < d.gaps.size(); ++r) {
    const Gap& gap = d.gaps[r];
    if (gap.segment < 0) continue;
    const Index point =
        c.sides[d.points].surface.node[static_cast<std::size_t>(d.candidates.point[r])];
    const Segment& g = surface.segments[static_cast<std::size_t>(gap.segment)];
    const auto n_corners = static_cast<std::size_t>(g.n_corners);
    const auto corner = [&](std::size_t k) {
      return surface.node[static_cast<std::size_t>(g.corner[k])];
    };
    double moving = moves(point) ? 1 : 0;
    for (std::size_t k = 0; k < n_corners; ++k) {
      if (moves(corner(k))) moving += gap.N[k];
    }
    add(point, d.stiffness[r] * moving);
    for (std::size_t k = 0; k < n_corners; ++k) {
      add(corner(k), d.stiffness[r] * gap.N[k] * moving);
    }
  }
}

/// Clears what met at the last level.
void begin_level(const Scene& scene, PartMeeting& all) {
  all.stiffness.resize(scene.nodes.x.size(), 0);
  for (const Index i : all.touched) all.stiffness[static_cast<std::size_t>(i)] = 0;
  all.touched.clear();
  all.near.clear();
}

}  // namespace

Gap gap_of_solid(const Surface& surface, const Nearest& nearest, const Vec3& x, double d,
                 double depth) {
  Gap gap;
  if (nearest.segment < 0) return gap;
  gap.segment = nearest.segment;
  gap.N = nearest.closest.N;
  const Vec3 r = x - nearest.closest.point;
  const Vec3 n = side_normal(surface, nearest.segment, nearest.closest);
  const double D = std::sqrt(nearest.closest.distance2);
  const double s = r.dot(n) < 0 ? -1 : 1;
  gap.normal = D <= touching * depth ? Vec3(n.normalized()) : Vec3(r * (s / D));
  gap.penetration = d - s * D;
  return gap;
}

double pair_stiffness(const PartSide& points, const PartSide& segments, std::size_t i,
                      const Gap& gap, double factor) {
  if (gap.segment < 0) return 0;
  double area = points.area[i];
  if (points.solid) area = std::max(least_facing * area, -points.facing[i].dot(gap.normal));
  const double of_face = at_foot(segments.surface, gap, segments.kappa);
  const double kappa =
      std::isinf(of_face) ? 2 * points.kappa[i] : 1 / (1 / points.kappa[i] + 1 / of_face);
  return factor * kappa * std::min(area, at_foot(segments.surface, gap, segments.area));
}

void add_stiffness(PartMeeting& meeting, Index node, double k) {
  if (!(k > 0)) return;
  double& sum = meeting.stiffness[static_cast<std::size_t>(node)];
  if (sum == 0) meeting.touched.push_back(node);
  sum += k;
}

void part_contact_pass(Scene& scene, PartContact& c, const Step& step, PartMeeting& meeting) {
  const bool first = c.numbers[1] == 0;
  c.numbers[1] = 1;
  const bool near = look_for_pairs(scene, c, step, scene.store.get<PartContacts>().waits[c.number]);
  if (near) meeting.near.push_back(&c);
  for (PartDirection& d : c.directions) {
    d.scattered = {};
    if (!near || d.candidates.n_rows() == 0) continue;
    const Overlaps overlaps = find_part_gaps(c, d, first);
    if (first) {
      c.numbers[2] += static_cast<double>(overlaps.count);
      c.numbers[3] = std::max(c.numbers[3], overlaps.largest);
    }
    const ContactInput in = input_of(scene, c, d, step);
    contact_forces(in, c.law, d.tangential, d.forces);
    d.scattered = scatter_forces(in, c.law, d.forces, scene.nodes, d.node_stiffness);
    add_meeting(scene, c, d, meeting);
  }
}

void part_contacts_pass(Scene& scene, PartMeeting& meeting, const Step& step) {
  begin_level(scene, meeting);
  Array<double>& waits = scene.store.get<PartContacts>().waits;
  for (std::size_t k = 0; k < meeting.contacts.size(); ++k) {
    double& wait = waits[meeting.numbers[k]];
    if (wait > 0) {
      wait -= 1;
      continue;
    }
    part_contact_pass(scene, *meeting.contacts[k], step, meeting);
  }
  for (PartOnPlanes* c : meeting.on_planes) part_on_planes_pass(scene, *c, step, meeting);
}

ContactRate rate_of(const Nodes& nodes, const Followers& followers, const PartMeeting& meeting) {
  ContactRate rate{meeting.rate2, -1};
  std::map<Index, double> bodies;  // by leader
  for (const Index node : meeting.touched) {
    const auto i = static_cast<std::size_t>(node);
    const Index leader = followers.leader_of(node);
    if (leader >= 0) {
      bodies[leader] += meeting.stiffness[i] * followers.inverse_mass[i];
      continue;
    }
    const double omega2 = meeting.stiffness[i] * nodes.v[i].w;
    if (omega2 > rate.omega2) rate = {omega2, node};
  }
  for (const auto& [leader, omega2] : bodies) {
    if (omega2 > rate.omega2) rate = {omega2, leader};
  }
  return rate;
}

}  // namespace gannet
