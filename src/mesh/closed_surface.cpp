#include "mesh/closed_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace gannet {

namespace {

using Facet = std::array<Index, 3>;
using Edge = std::array<Index, 2>;

/// Faces of the cells, by their corners; -1 behind a face of three.
const std::vector<std::array<int, 4>> hexahedron_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
const std::vector<std::array<int, 4>> tetrahedron_faces{
    {0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
const std::vector<std::array<int, 4>> quad_sides{
    {0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}};
const std::vector<std::array<int, 4>> whole_cell[5] = {
    {}, {}, {{0, 1, -1, -1}}, {{0, 1, 2, -1}}, {{0, 1, 2, 3}}};

const std::vector<std::array<int, 4>>& faces_of(int dimension, int corners, bool solid) {
  if (!solid) return whole_cell[corners];
  if (dimension == 2) return quad_sides;
  return corners == 8 ? hexahedron_faces : tetrahedron_faces;
}

/// A face in the numbers of points, without corners that repeat.
std::vector<Index> face_points(const Index* cell, const std::array<int, 4>& face) {
  std::vector<Index> points;
  for (const int corner : face) {
    if (corner < 0) continue;
    const Index p = cell[corner];
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
  return points;
}

/// Numbers of the points after those at one place have become one.
std::vector<Index> joined(const std::vector<Vec3>& points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto x = [&](Index i) -> const Vec3& { return points[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return x(a).x() < x(b).x(); });
  Vec3 low = points.front();
  Vec3 high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double near = 1e-6 * (high - low).maxCoeff();
  std::vector<Index> number(points.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k) {
    Index& mine = number[static_cast<std::size_t>(order[k])];
    for (std::size_t l = k; l-- > 0 && mine < 0 && x(order[k]).x() - x(order[l]).x() <= near;) {
      if ((x(order[k]) - x(order[l])).norm() <= near) {
        mine = number[static_cast<std::size_t>(order[l])];
      }
    }
    if (mine < 0) mine = order[k];
  }
  return number;
}

/// Edge e of a facet in the direction in which the facet passes it; in the plane the end e.
Edge edge_of(const ClosedSurface& s, const Facet& f, std::size_t e) {
  if (s.dimension == 2) return {f[e], -1};
  return {f[e], f[(e + 1) % 3]};
}

std::size_t n_edges(const ClosedSurface& s) { return s.dimension == 2 ? 2 : 3; }

struct Use {
  Index facet;
  std::size_t edge;
};

using Edges = std::map<Edge, std::vector<Use>>;

Edges edges_of(const ClosedSurface& s) {
  Edges edges;
  for (std::size_t k = 0; k < s.facets.size(); ++k) {
    for (std::size_t e = 0; e < n_edges(s); ++e) {
      Edge edge = edge_of(s, s.facets[k], e);
      std::sort(edge.begin(), edge.end());
      edges[edge].push_back({static_cast<Index>(k), e});
    }
  }
  return edges;
}

/// Whether two facets that share an edge (a point) pass it the same way, and so look to different
/// sides.
bool opposed(const ClosedSurface& s, const Use& a, const Use& b) {
  if (s.dimension == 2) return a.edge == b.edge;
  return edge_of(s, s.facets[static_cast<std::size_t>(a.facet)], a.edge) ==
         edge_of(s, s.facets[static_cast<std::size_t>(b.facet)], b.edge);
}

void turn(ClosedSurface& s, Facet& f) { std::swap(f[0], f[s.dimension == 2 ? 1 : 2]); }

double signed_volume(const ClosedSurface& s, const Facet& f, const Vec3& origin) {
  const auto r = [&](std::size_t c) -> Vec3 {
    return s.points[static_cast<std::size_t>(f[c])] - origin;
  };
  if (s.dimension == 2) return 0.5 * r(0).cross(r(1)).z();
  return r(0).dot(r(1).cross(r(2))) / 6;
}

/// Turns the facets that hang together with the first alike, and all of them outwards.
void turn_piece(ClosedSurface& s, const std::vector<std::vector<std::pair<Index, bool>>>& next,
                Index first, std::vector<char>& seen) {
  std::vector<Index> piece{first};
  std::vector<char> turned(s.facets.size(), 0);
  seen[static_cast<std::size_t>(first)] = 1;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const auto here = static_cast<std::size_t>(piece[k]);
    for (const auto& [other, against] : next[here]) {
      const auto there = static_cast<std::size_t>(other);
      if (seen[there] != 0) continue;
      seen[there] = 1;
      turned[there] = static_cast<char>(turned[here] != static_cast<char>(against));
      piece.push_back(other);
    }
  }
  const Vec3 origin =
      s.points[static_cast<std::size_t>(s.facets[static_cast<std::size_t>(first)][0])];
  double volume = 0;
  for (const Index k : piece) {
    Facet& f = s.facets[static_cast<std::size_t>(k)];
    if (turned[static_cast<std::size_t>(k)] != 0) turn(s, f);
    volume += signed_volume(s, f, origin);
  }
  if (volume >= 0) return;
  for (const Index k : piece) turn(s, s.facets[static_cast<std::size_t>(k)]);
}

void turn_outwards(ClosedSurface& s, const Edges& edges) {
  std::vector<std::vector<std::pair<Index, bool>>> next(s.facets.size());
  for (const auto& [edge, uses] : edges) {
    const bool against = opposed(s, uses[0], uses[1]);
    next[static_cast<std::size_t>(uses[0].facet)].emplace_back(uses[1].facet, against);
    next[static_cast<std::size_t>(uses[1].facet)].emplace_back(uses[0].facet, against);
  }
  std::vector<char> seen(s.facets.size(), 0);
  for (std::size_t k = 0; k < s.facets.size(); ++k) {
    if (seen[k] == 0) turn_piece(s, next, static_cast<Index>(k), seen);
  }
}

/// The point of the segment from a to b that is nearest to the origin.
Vec3 nearest_on_segment(const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  return a + std::clamp(-a.dot(d) / d.squaredNorm(), 0.0, 1.0) * d;
}

/// The same on a triangle: below the origin where that is above its inside, else on its edges.
Vec3 nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const auto above = [&](const Vec3& p, const Vec3& q) { return n.dot((q - p).cross(-p)) >= 0; };
  if (above(a, b) && above(b, c) && above(c, a)) return n.dot(a) / n.squaredNorm() * n;
  Vec3 nearest = nearest_on_segment(a, b);
  for (const Vec3& p : {nearest_on_segment(b, c), nearest_on_segment(c, a)}) {
    if (p.squaredNorm() < nearest.squaredNorm()) nearest = p;
  }
  return nearest;
}

/// The point of a facet that is nearest to x, from x.
Vec3 towards_facet(const ClosedSurface& surface, const Facet& f, const Vec3& x) {
  const auto r = [&](std::size_t c) -> Vec3 {
    return surface.points[static_cast<std::size_t>(f[c])] - x;
  };
  if (surface.dimension == 2) return nearest_on_segment(r(0), r(1));
  return nearest_on_triangle(r(0), r(1), r(2));
}

/// Angle that a facet fills around x, as a share of all.
double share_around(const ClosedSurface& s, const Facet& f, const Vec3& x) {
  const auto r = [&](std::size_t c) -> Vec3 {
    return s.points[static_cast<std::size_t>(f[c])] - x;
  };
  const Vec3 a = r(0);
  const Vec3 b = r(1);
  constexpr double pi = std::numbers::pi;
  if (s.dimension == 2) return std::atan2(a.cross(b).z(), a.dot(b)) / (2 * pi);
  const Vec3 c = r(2);
  const double na = a.norm();
  const double nb = b.norm();
  const double nc = c.norm();
  const double below = na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb;
  return std::atan2(a.dot(b.cross(c)), below) / (2 * pi);
}

}  // namespace

void add_boundary(const std::vector<Vec3>& points, const std::vector<Index>& connectivity,
                  int corners, bool solid, ClosedSurface& surface) {
  const auto offset = static_cast<Index>(surface.points.size());
  surface.points.insert(surface.points.end(), points.begin(), points.end());
  std::map<std::vector<Index>, std::pair<std::vector<Index>, int>> faces;
  const auto n = static_cast<std::size_t>(corners);
  for (std::size_t first = 0; first + n <= connectivity.size(); first += n) {
    for (const auto& face : faces_of(surface.dimension, corners, solid)) {
      const std::vector<Index> on = face_points(connectivity.data() + first, face);
      std::vector<Index> key = on;
      std::sort(key.begin(), key.end());
      auto& entry = faces[key];
      entry.first = on;
      ++entry.second;
    }
  }
  for (const auto& [key, face] : faces) {
    if (solid && face.second > 1) continue;
    const std::vector<Index>& p = face.first;
    if (surface.dimension == 2) {
      if (p.size() == 2) surface.facets.push_back({p[0] + offset, p[1] + offset, -1});
      continue;
    }
    for (std::size_t k = 2; k < p.size(); ++k) {
      surface.facets.push_back({p[0] + offset, p[k - 1] + offset, p[k] + offset});
    }
  }
}

std::string close_surface(ClosedSurface& s) {
  if (s.facets.empty()) return "has no faces that could enclose anything";
  const std::vector<Index> number = joined(s.points);
  for (Facet& f : s.facets) {
    for (Index& corner : f) {
      if (corner >= 0) corner = number[static_cast<std::size_t>(corner)];
    }
  }
  const Edges edges = edges_of(s);
  for (const auto& [edge, uses] : edges) {
    if (uses.size() == 2) continue;
    const Index p = s.dimension == 2 ? edge[1] : edge[0];
    const Vec3& x = s.points[static_cast<std::size_t>(p)];
    return fmt::format(
        "is not closed: {} at ({:.6g}, {:.6g}, {:.6g}) m belongs to {} {} in place "
        "of two",
        s.dimension == 2 ? "the end" : "an edge", x.x(), x.y(), x.z(), uses.size(),
        s.dimension == 2 ? "lines" : "faces");
  }
  turn_outwards(s, edges);
  return "";
}

bool contains(const ClosedSurface& surface, const Vec3& x) {
  double share = 0;
  for (const Facet& f : surface.facets) share += share_around(surface, f, x);
  return share > 0.5;
}

double distance(const ClosedSurface& surface, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& f : surface.facets) {
    least = std::min(least, towards_facet(surface, f, x).squaredNorm());
  }
  return std::sqrt(least);
}

double distance_to_facet(const ClosedSurface& surface, std::size_t facet, const Vec3& x) {
  return towards_facet(surface, surface.facets[facet], x).norm();
}

Vec3 nearest_on_facet(const ClosedSurface& surface, std::size_t facet, const Vec3& x) {
  return x + towards_facet(surface, surface.facets[facet], x);
}

VolumeMoments volume_moments(const ClosedSurface& surface) {
  VolumeMoments m;
  const int d = surface.dimension;
  const Vec3 origin = surface.points[static_cast<std::size_t>(surface.facets[0][0])];
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const Facet& f : surface.facets) {
    const double v = signed_volume(surface, f, origin);
    Vec3 sum = Vec3::Zero();
    Mat3 squares = Mat3::Zero();
    for (int c = 0; c < d; ++c) {
      const Vec3 r =
          surface.points[static_cast<std::size_t>(f[static_cast<std::size_t>(c)])] - origin;
      sum += r;
      squares += r * r.transpose();
    }
    m.volume += v;
    first += v / (d + 1) * sum;
    second += v / ((d + 1) * (d + 2)) * (squares + sum * sum.transpose());
  }
  const Vec3 centre = first / m.volume;
  m.centre = origin + centre;
  m.second = second - m.volume * centre * centre.transpose();
  return m;
}

}  // namespace gannet
