// Small models of solids for tests.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "base/isa.hpp"
#include "base/math.hpp"
#include "scene/scene.hpp"

namespace gannet::testing {

/// Cells with a node table over their points.
struct Solid {
  std::vector<Index> cells;
  Nodes nodes;
};

inline Solid solid_of(const std::vector<Vec3>& points, std::vector<Index> cells) {
  Solid s;
  s.cells = std::move(cells);
  s.nodes.n_owned = static_cast<Index>(points.size());
  for (auto* lines : {&s.nodes.x, &s.nodes.v, &s.nodes.f}) lines->assign(points.size(), {});
  for (std::size_t i = 0; i < points.size(); ++i) set_xyz(s.nodes.x[i], points[i]);
  return s;
}

/// n[0] x n[1] x n[2] hexahedra; the point of grid position (i, j, k) is place(i, j, k).
template <class F>
Solid bricks(std::array<int, 3> n, F&& place) {
  std::vector<Vec3> points;
  std::vector<Index> cells;
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) points.push_back(place(i, j, k));
    }
  }
  const Index row = n[0] + 1;
  const Index layer = row * (n[1] + 1);
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const Index a = k * layer + j * row + i;
        for (const Index b : {a, a + layer}) {
          for (const Index node : {b, b + 1, b + row + 1, b + row}) cells.push_back(node);
        }
      }
    }
  }
  return solid_of(points, std::move(cells));
}

/// The instruction sets that can be run here.
inline std::vector<Isa> sets() {
  std::vector<Isa> all{Isa::avx2};
  if (isa() == Isa::avx512) all.push_back(Isa::avx512);
  return all;
}

}  // namespace gannet::testing
