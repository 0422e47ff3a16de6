#include "mesh/volume_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shape_numbers.hpp"

namespace gannet {
namespace {

// Copies the quadrilaterals of a section to n + 1 layers and joins them to hexahedra.
template <class Place>
VolumeMesh extruded(const VolumeMesh& section, int n, Place&& place) {
  VolumeMesh mesh;
  const auto per_layer = static_cast<Index>(section.points.size());
  for (int k = 0; k <= n; ++k) {
    for (const Vec3& p : section.points) mesh.points.push_back(place(p, double(k) / n));
  }
  for (Index k = 0; k < n; ++k) {
    for (std::size_t c = 0; c < section.cells.size(); c += 4) {
      for (const Index layer : {k, k + 1}) {
        for (std::size_t a = 0; a < 4; ++a) {
          mesh.cells.push_back(layer * per_layer + section.cells[c + a]);
        }
      }
    }
  }
  return mesh;
}

// The core of a disc of radius 1: a square whose sides bulge.
Vec3 core_point(double u, double v) {
  constexpr double corner = 0.55;
  constexpr double bulge = 0.5;
  const Vec3 square(u, v, 0);
  const double r = square.norm();
  if (r == 0) return square;
  const double reach = std::max(std::abs(u), std::abs(v));
  // To the circle through the corners of the square, and half of that way.
  const Vec3 circle = square * (reach * std::numbers::sqrt2 / r);
  return corner / std::numbers::sqrt2 * ((1 - bulge) * square + bulge * circle);
}

// Point of the border of the core, k = 0 ... 4 n - 1 counter-clockwise from the lower left corner.
std::array<int, 2> border(int k, int n) {
  const int side = k / n;
  const int along = k % n;
  if (side == 0) return {along, 0};
  if (side == 1) return {n, along};
  if (side == 2) return {n - along, n};
  return {0, n - along};
}

// The unit disc: a core of n x n cells and `rings` around it.
VolumeMesh disc(int n, int rings) {
  VolumeMesh mesh = block_area(Vec3(-1, -1, 0), Vec3(1, 1, 0), {n, n});
  for (Vec3& p : mesh.points) p = core_point(p.x(), p.y());
  const Index around = 4 * n;
  const auto inner = static_cast<Index>(mesh.points.size());
  const auto number = [&](int ring, int k) -> Index {
    k %= around;
    if (ring > 0) return inner + (ring - 1) * around + k;
    const auto [i, j] = border(k, n);
    return j * (n + 1) + i;
  };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      const Vec3 from = mesh.points[static_cast<std::size_t>(number(0, k))];
      const double angle = std::numbers::pi * (2.0 * k / around - 0.75);
      const Vec3 to(std::cos(angle), std::sin(angle), 0);
      mesh.points.emplace_back(from + double(ring) / rings * (to - from));
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      for (const Index node :
           {number(ring, k + 1), number(ring, k), number(ring + 1, k), number(ring + 1, k + 1)}) {
        mesh.cells.push_back(node);
      }
    }
  }
  return mesh;
}

VolumeMesh block(const Keys& keys, int dimension) {
  if (!keys.has("from") || !keys.has("to")) return {};  // required: the reader has complained
  const Vec3 from = keys.vector("from");
  const Vec3 to = keys.vector("to");
  if (!box_is_open(keys, from, to, dimension)) return {};
  if (dimension == 2) {
    const auto n = counts<2>(keys, "elements");
    return n ? block_area(from, to, *n) : VolumeMesh{};
  }
  const auto n = counts<3>(keys, "elements");
  return n ? block_volume(from, to, *n) : VolumeMesh{};
}

/// The points under `corners`: `wanted` of them, or a complaint and none.
std::vector<Vec3> corners_of(const Keys& keys, std::size_t wanted) {
  std::vector<Vec3> corners = points_under(keys, "corners");
  if (corners.size() == wanted) return corners;
  keys.complain("corners",
                fmt::format("{} points are given; {} are wanted", corners.size(), wanted));
  return {};
}

VolumeMesh mapped(const Keys& keys, int dimension) {
  if (!keys.has("corners") || !keys.has("elements")) return {};
  const std::vector<Vec3> corners = corners_of(keys, dimension == 2 ? 4 : 8);
  if (corners.empty()) return {};
  VolumeMesh mesh;
  if (dimension == 2) {
    const auto n = counts<2>(keys, "elements");
    if (n) mesh = block_area(Vec3::Zero(), Vec3::Ones(), *n);
  } else {
    const auto n = counts<3>(keys, "elements");
    if (n) mesh = block_volume(Vec3::Zero(), Vec3::Ones(), *n);
  }
  for (Vec3& p : mesh.points) p = mapped_point(corners, p);
  return mesh;
}

VolumeMesh rod(const Keys& keys, int dimension) {
  if (dimension == 2) {
    keys.mistakes().add(keys.where(), keys.path() + ": a round bar needs three dimensions");
    return {};
  }
  const auto n = counts<3>(keys, "elements");
  if (!n || !keys.has("from") || !keys.has("to") || !keys.has("radius")) return {};
  const Vec3 from = keys.vector("from");
  const Vec3 to = keys.vector("to");
  if (!((to - from).norm() > 0)) {
    keys.complain("to", "is the same point as 'from'");
    return {};
  }
  return rod_volume(from, to, keys.number("radius"), *n);
}

}  // namespace

Vec3 mapped_point(std::span<const Vec3> corners, const Vec3& p) {
  const auto face = [&](std::size_t first) -> Vec3 {
    const Vec3* c = &corners[first];
    return (1 - p.y()) * ((1 - p.x()) * c[0] + p.x() * c[1]) +
           p.y() * ((1 - p.x()) * c[3] + p.x() * c[2]);
  };
  if (corners.size() == 4) return face(0);
  return (1 - p.z()) * face(0) + p.z() * face(4);
}

VolumeMesh block_area(const Vec3& from, const Vec3& to, std::array<int, 2> n) {
  VolumeMesh mesh;
  mesh.nodes_per_cell = 4;
  for (int j = 0; j <= n[1]; ++j) {
    for (int i = 0; i <= n[0]; ++i) {
      mesh.points.emplace_back(from.x() + (to.x() - from.x()) * i / n[0],
                               from.y() + (to.y() - from.y()) * j / n[1], from.z());
    }
  }
  const Index row = n[0] + 1;
  for (Index j = 0; j < n[1]; ++j) {
    for (Index i = 0; i < n[0]; ++i) {
      const Index p = j * row + i;
      mesh.cells.insert(mesh.cells.end(), {p, p + 1, p + 1 + row, p + row});
    }
  }
  return mesh;
}

VolumeMesh block_volume(const Vec3& from, const Vec3& to, std::array<int, 3> n) {
  return extruded(block_area(from, to, {n[0], n[1]}), n[2], [&](const Vec3& p, double s) {
    return Vec3(p.x(), p.y(), p.z() + s * (to.z() - from.z()));
  });
}

VolumeMesh rod_volume(const Vec3& from, const Vec3& to, double radius, std::array<int, 3> n) {
  const Vec3 axis = to - from;
  const Mat3 turn = Quaternion::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  return extruded(disc(n[0], n[1]), n[2], [&](const Vec3& p, double s) {
    return Vec3(from + s * axis + radius * (turn * p));
  });
}

VolumeMesh tetrahedra_of(const VolumeMesh& hexahedra) {
  // Counter-clockwise seen from inside, so that a cone over a triangle of one has a volume above 0.
  constexpr int faces[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                               {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  VolumeMesh mesh{.points = hexahedra.points, .nodes_per_cell = 4};
  for (std::size_t c = 0; c + 8 <= hexahedra.cells.size(); c += 8) {
    const Index* corner = &hexahedra.cells[c];
    const Index top = *std::min_element(corner, corner + 8);
    for (const auto& face : faces) {
      Index f[4];
      for (int k = 0; k < 4; ++k) f[k] = corner[face[k]];
      if (std::find(f, f + 4, top) != f + 4) continue;
      std::rotate(f, std::min_element(f, f + 4), f + 4);
      mesh.cells.insert(mesh.cells.end(), {f[0], f[1], f[2], top, f[0], f[2], f[3], top});
    }
  }
  return mesh;
}

std::vector<Key> volume_shape_keys() {
  return {
      {.name = "block",
       .kind = Kind::map,
       .text = "a box of solids; a rectangle in a plane case",
       .keys = {place_key("from", "corner with the smallest coordinates", true),
                place_key("to", "corner with the largest coordinates", true),
                elements_key("number of elements along x, y and z (x, y in a plane case)")}},
      {.name = "mapped",
       .kind = Kind::map,
       .text = "a box of solids between eight points; in a plane case between four",
       .keys = {{.name = "corners",
                 .kind = Kind::any,
                 .text = "the lower face counter-clockwise, seen from above, then the upper one",
                 .required = true},
                elements_key("number of elements from corner 1 to 2, 1 to 4 and 1 to 5")}},
      {.name = "rod",
       .kind = Kind::map,
       .text = "a round bar of solids",
       .keys = {place_key("from", "middle of one end", true),
                place_key("to", "middle of the other end", true),
                length_key("radius", "its radius"),
                elements_key("number of elements along a side of the square core, of rings "
                             "around it, and along the bar")}}};
}

bool is_volume_shape(const Keys& shape) {
  return shape.has("block") || shape.has("mapped") || shape.has("rod");
}

VolumeMesh shape_volume(const Keys& shape, int dimension) {
  if (shape.names().size() != 1) {
    shape.mistakes().add(shape.where(), fmt::format("{}: {} shapes are named; a part has one",
                                                    shape.path(), shape.names().size()));
    return {};
  }
  if (shape.has("block")) return block(shape.map("block"), dimension);
  if (shape.has("mapped")) return mapped(shape.map("mapped"), dimension);
  return rod(shape.map("rod"), dimension);
}

}  // namespace gannet
