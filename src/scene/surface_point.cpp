#include "scene/surface_point.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace gannet {

namespace {

using Weights = std::array<double, 3>;

/// Share of b in the point of the segment a b that is nearest to x.
double share_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0 ? std::clamp((x - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

/// Weights of the corners in the point of a triangle that is nearest to x: the foot of x where that
/// lies inside, else a point of one of the edges.
Weights weights_on_triangle(const std::array<Vec3, 3>& p, const Vec3& x) {
  const Vec3 area = (p[1] - p[0]).cross(p[2] - p[0]);
  if (area.squaredNorm() > 0) {
    Weights w{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& b = p[(k + 1) % 3];
      const Vec3& c = p[(k + 2) % 3];
      w[k] = area.dot((c - b).cross(x - b)) / area.squaredNorm();
    }
    if (std::ranges::min(w) >= 0) return w;
  }
  Weights best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double share = share_on_segment(p[k], p[next], x);
    const double off = (x - (1 - share) * p[k] - share * p[next]).squaredNorm();
    if (!(off < least)) continue;
    least = off;
    best = {};
    best[k] = 1 - share;
    best[next] = share;
  }
  return best;
}

SurfacePoint on_cell(const Nodes& nodes, std::span<const Index> corners, const Vec3& x) {
  SurfacePoint point;
  point.n = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), point.node.begin());
  if (point.n == 2) {
    const double share = share_on_segment(xyz(nodes.x[corners[0]]), xyz(nodes.x[corners[1]]), x);
    point.weight = {1 - share, share, 0};
  } else {
    point.weight = weights_on_triangle(
        {xyz(nodes.x[corners[0]]), xyz(nodes.x[corners[1]]), xyz(nodes.x[corners[2]])}, x);
  }
  return point;
}

}  // namespace

SurfacePoint nearest_on_part(const Scene& scene, int part, const Vec3& x) {
  const Part& p = scene.parts[static_cast<std::size_t>(part)];
  SurfacePoint best;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](std::initializer_list<Index> corners) {
    const SurfacePoint point = on_cell(scene.nodes, {corners.begin(), corners.size()}, x);
    const double off = (x - place_of(point, scene.nodes)).squaredNorm();
    if (!(off < least)) return;
    least = off;
    best = point;
  };
  const Index* c = p.connectivity.data();
  for (Index k = 0; k < p.n_cells(); ++k, c += nodes_per(p.cell)) {
    if (p.cell == Cell::line) look({c[0], c[1]});
    if (p.cell == Cell::triangle || p.cell == Cell::quad) look({c[0], c[1], c[2]});
    if (p.cell == Cell::quad) look({c[0], c[2], c[3]});
  }
  if (best.n > 0) {
    best.height = (x - place_of(best, scene.nodes)).dot(normal_of(best, scene.nodes));
  }
  return best;
}

Vec3 place_of(const SurfacePoint& point, const Nodes& nodes) {
  Vec3 x = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.n); ++k) {
    x += point.weight[k] * xyz(nodes.x[point.node[k]]);
  }
  return x;
}

Vec3 normal_of(const SurfacePoint& point, const Nodes& nodes) {
  const Vec3 a = xyz(nodes.x[point.node[0]]);
  const Vec3 b = xyz(nodes.x[point.node[1]]);
  const Vec3 normal = point.n == 2 ? Vec3(a.y() - b.y(), b.x() - a.x(), 0)
                                   : Vec3((b - a).cross(xyz(nodes.x[point.node[2]]) - a));
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
}

}  // namespace gannet
