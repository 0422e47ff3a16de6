#include "fe/shell_fibres.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gannet {

namespace {

using Corners = std::array<std::size_t, 4>;

/// A surface of quadrilaterals on the way to its fibres.
struct Surface {
  std::vector<Corners> element;
  std::vector<Vec3> normal;                  ///< of the elements
  std::vector<Vec3> warp;                    ///< h at the corners, 4 an element
  std::vector<std::vector<std::size_t>> at;  ///< corners 4 e + a at each node
  std::vector<bool> edge;                    ///< nodes at an edge of a smooth surface
  [[nodiscard]] bool smooth(std::size_t e, std::size_t f) const {
    return normal[e].dot(normal[f]) > std::cos(smooth_angle);
  }
};

/// Normals at the corners of the paraboloid x = x0 + b xi + c eta + d xi eta, less that at its
/// middle; zero at the corners of a triangle.
void add_warp(Surface& s, const std::array<Vec3, 4>& x) {
  constexpr std::array<double, 4> xi{-1, 1, 1, -1};
  constexpr std::array<double, 4> eta{-1, -1, 1, 1};
  const Vec3 b = 0.25 * ((x[1] - x[0]) + (x[2] - x[3]));
  const Vec3 c = 0.25 * ((x[3] - x[0]) + (x[2] - x[1]));
  const Vec3 d = 0.25 * ((x[0] - x[1]) + (x[2] - x[3]));
  const Vec3 middle = b.cross(c).normalized();
  s.normal.push_back(middle);
  const bool triangle = (x[2] - x[3]).isZero(0);
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 n = (b + eta[a] * d).cross(c + xi[a] * d);
    s.warp.push_back(triangle ? Vec3(Vec3::Zero()) : Vec3(n.normalized() - middle));
  }
}

Surface surface_of(std::span<const Index> connectivity, std::span<const Line> x) {
  Surface s;
  s.at.resize(x.size());
  for (std::size_t k = 0; k < connectivity.size(); k += 4) {
    Corners nodes{};
    std::array<Vec3, 4> place;
    for (std::size_t a = 0; a < 4; ++a) {
      nodes[a] = static_cast<std::size_t>(connectivity[k + a]);
      place[a] = xyz(x[nodes[a]]);
      if (a == 0 || nodes[a] != nodes[a - 1]) s.at[nodes[a]].push_back(k + a);
    }
    s.element.push_back(nodes);
    add_warp(s, place);
  }
  return s;
}

/// Marks the nodes on edges that are not shared by two elements of a smooth surface.
void find_edges(Surface& s) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> sides;
  for (std::size_t e = 0; e < s.element.size(); ++e) {
    for (std::size_t a = 0; a < 4; ++a) {
      const auto [i, j] = std::minmax(s.element[e][a], s.element[e][(a + 1) % 4]);
      if (i != j) sides[{i, j}].push_back(e);
    }
  }
  s.edge.assign(s.at.size(), false);
  for (const auto& [nodes, elements] : sides) {
    if (elements.size() == 2 && s.smooth(elements[0], elements[1])) continue;
    s.edge[nodes.first] = true;
    s.edge[nodes.second] = true;
  }
}

/// Sum of f(corner) over the corners at the node of corner k whose elements go on smoothly there.
template <class F>
Vec3 sum_at(const Surface& s, std::size_t k, F&& f) {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t other : s.at[s.element[k / 4][k % 4]]) {
    if (s.smooth(k / 4, other / 4)) sum += f(other);
  }
  return sum;
}

}  // namespace

std::vector<Vec3> fibres_of(std::span<const Index> connectivity, std::span<const Line> x) {
  Surface s = surface_of(connectivity, x);
  find_edges(s);
  const auto on_edge = [&](std::size_t k) { return s.edge[s.element[k / 4][k % 4]]; };
  const auto opposite = [](std::size_t k) { return 4 * (k / 4) + (k + 2) % 4; };
  std::vector<Vec3> fibre;
  for (std::size_t k = 0; k < connectivity.size(); ++k) {
    fibre.push_back(
        sum_at(s, k, [&](std::size_t other) { return s.normal[other / 4]; }).normalized());
  }
  const std::vector<Vec3> mean = fibre;
  for (std::size_t k = 0; k < connectivity.size(); ++k) {
    if (!on_edge(k)) continue;
    const Vec3 told = sum_at(s, k, [&](std::size_t other) {
      const std::size_t across = opposite(other);
      if (on_edge(across)) return Vec3(Vec3::Zero());
      const Vec3 n = s.normal[other / 4];
      const Vec3 off = mean[across] - n - s.warp[across];
      return Vec3(n + s.warp[other] - off);
    });
    fibre[k] = told.isZero(0) ? (s.normal[k / 4] + s.warp[k]).normalized() : told.normalized();
  }
  return fibre;
}

}  // namespace gannet
