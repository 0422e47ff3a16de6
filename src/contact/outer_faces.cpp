#include "contact/outer_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace gannet {

namespace {

using Face = std::array<int, 4>;

constexpr Face of_hexahedron[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                  {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr Face of_tetrahedron[] = {{0, 2, 1, 1}, {0, 1, 3, 3}, {1, 2, 3, 3}, {2, 0, 3, 3}};
/// Against the sense of the element: the normal of a line is on its left.
constexpr Face of_quadrilateral[] = {{1, 0, 0, 0}, {2, 1, 1, 1}, {3, 2, 2, 2}, {0, 3, 3, 3}};

std::span<const Face> faces_of(Cell cell) {
  if (cell == Cell::hexahedron) return of_hexahedron;
  if (cell == Cell::tetrahedron) return of_tetrahedron;
  return of_quadrilateral;
}

Cell cell_of_faces(Cell cell) {
  if (cell == Cell::hexahedron) return Cell::quad;
  return cell == Cell::tetrahedron ? Cell::triangle : Cell::line;
}

/// A face by its nodes in ascending order.
struct Candidate {
  std::array<Index, 4> key{-1, -1, -1, -1};
  std::size_t number = 0;  ///< elements after elements, faces within them
};

}  // namespace

OuterFaces outer_faces(const Part& solid) {
  const std::span<const Face> faces = faces_of(solid.cell);
  const auto n_nodes = static_cast<std::size_t>(nodes_per(solid.cell));
  OuterFaces outer;
  outer.faces.name = solid.name;
  outer.faces.nodes = solid.nodes;
  outer.faces.cell = cell_of_faces(solid.cell);
  const auto n_corners = static_cast<std::size_t>(nodes_per(outer.faces.cell));
  std::vector<Candidate> list;
  for (std::size_t e = 0; e * n_nodes < solid.connectivity.size(); ++e) {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      Candidate& c = list.emplace_back();
      c.number = e * faces.size() + k;
      for (std::size_t a = 0; a < n_corners; ++a) {
        c.key[a] = solid.connectivity[e * n_nodes + static_cast<std::size_t>(faces[k][a])];
      }
      std::sort(c.key.begin(), c.key.begin() + static_cast<std::ptrdiff_t>(n_corners));
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Candidate& a, const Candidate& b) { return a.key < b.key; });
  std::vector<std::size_t> alone;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool before = i > 0 && list[i - 1].key == list[i].key;
    const bool after = i + 1 < list.size() && list[i + 1].key == list[i].key;
    if (!before && !after) alone.push_back(list[i].number);
  }
  std::sort(alone.begin(), alone.end());
  for (const std::size_t number : alone) {
    const std::size_t e = number / faces.size();
    const Face& face = faces[number % faces.size()];
    for (std::size_t a = 0; a < n_corners; ++a) {
      outer.faces.connectivity.push_back(
          solid.connectivity[e * n_nodes + static_cast<std::size_t>(face[a])]);
    }
    outer.faces.cell_id.push_back(solid.cell_id[e]);
    outer.element.push_back(static_cast<Index>(e));
  }
  return outer;
}

double volume_of_cell(const Part& solid, const Nodes& nodes, Index e) {
  const auto n = static_cast<std::size_t>(nodes_per(solid.cell));
  std::array<Vec3, 8> p;
  for (std::size_t a = 0; a < n; ++a) {
    const Index node = solid.connectivity[static_cast<std::size_t>(e) * n + a];
    p[a] = xyz(nodes.x[static_cast<std::size_t>(node)]);
  }
  const auto six = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return (p[b] - p[a]).cross(p[c] - p[a]).dot(p[d] - p[a]);
  };
  if (solid.cell == Cell::quad) return 0.5 * (p[2] - p[0]).cross(p[3] - p[1]).z();
  if (solid.cell == Cell::tetrahedron) return six(0, 1, 2, 3) / 6;
  return (six(0, 1, 2, 6) + six(0, 2, 3, 6) + six(0, 3, 7, 6) + six(0, 7, 4, 6) + six(0, 4, 5, 6) +
          six(0, 5, 1, 6)) /
         6;
}

}  // namespace gannet
