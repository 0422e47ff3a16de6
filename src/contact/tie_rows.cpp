#include "contact/tie_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/closest_point.hpp"
#include "contact/outer_faces.hpp"

namespace gannet {

namespace {

constexpr double no_weight = 1e-9;

/// A segment with a sphere around it, so that most need no closer look.
struct Bounded {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

Vec3 place_of(const Scene& scene, Index node) {
  return xyz(scene.nodes.x[static_cast<std::size_t>(node)]);
}

int n_corners(const Corners& c) { return c[3] != c[2] ? 4 : (c[2] != c[1] ? 3 : 2); }

Bounded bound(const Scene& scene, const Corners& corners) {
  Bounded b;
  const auto n = static_cast<std::size_t>(n_corners(corners));
  for (std::size_t k = 0; k < n; ++k) b.centre += place_of(scene, corners[k]) / double(n);
  for (std::size_t k = 0; k < n; ++k) {
    b.radius = std::max(b.radius, (place_of(scene, corners[k]) - b.centre).norm());
  }
  return b;
}

Closest closest_on(const Scene& scene, const Corners& corners, const Vec3& x) {
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = place_of(scene, corners[k]);
  switch (n_corners(corners)) {
    case 2:
      return closest_on_line(x, p[0], p[1]);
    case 3:
      return closest_on_triangle(x, p.data());
    default:
      return closest_on_quad(x, p.data());
  }
}

TiedNode row_of(Index node, const Corners& corners, const Closest& closest) {
  TiedNode row{.node = node};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(closest.N[k] > no_weight)) continue;
    row.corner[static_cast<std::size_t>(row.n)] = corners[k];
    row.N[static_cast<std::size_t>(row.n++)] = closest.N[k];
    sum += closest.N[k];
  }
  for (double& N : row.N) N /= sum;
  return row;
}

double longest_side(const Scene& scene, const Corners& corners) {
  const auto n = static_cast<std::size_t>(n_corners(corners));
  double longest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    longest = std::max(
        longest, (place_of(scene, corners[(k + 1) % n]) - place_of(scene, corners[k])).norm());
  }
  return longest;
}

}  // namespace

std::vector<Corners> tie_segments(const Part& part) {
  const Part faces = part.kind == "solid" ? outer_faces(part).faces : part;
  const auto n = static_cast<std::size_t>(nodes_per(faces.cell));
  std::vector<Corners> segments;
  if (n < 2 || n > 4) return segments;
  for (std::size_t first = 0; first < faces.connectivity.size(); first += n) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = faces.connectivity[first + std::min(k, n - 1)];
    }
    segments.push_back(corners);
  }
  return segments;
}

TieRows find_tie_rows(const Scene& scene, const std::vector<Index>& nodes,
                      const std::vector<Corners>& segments) {
  std::vector<Bounded> bounds;
  for (const Corners& corners : segments) bounds.push_back(bound(scene, corners));
  TieRows found;
  for (const Index node : nodes) {
    const Vec3 x = place_of(scene, node);
    Closest best;
    best.distance2 = std::numeric_limits<double>::infinity();
    std::size_t segment = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const double least = (x - bounds[s].centre).norm() - bounds[s].radius;
      if (least > 0 && least * least >= best.distance2) continue;
      const Closest closest = closest_on(scene, segments[s], x);
      if (!(closest.distance2 < best.distance2)) continue;
      best = closest;
      segment = s;
    }
    found.rows.push_back(row_of(node, segments[segment], best));
    const double distance = std::sqrt(best.distance2);
    if (distance < found.farthest) continue;
    found.farthest = distance;
    found.size_there = longest_side(scene, segments[segment]);
    found.row_there = found.rows.size() - 1;
  }
  return found;
}

}  // namespace gannet
