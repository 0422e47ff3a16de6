#include "mesh/shapes.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "mesh/line_shapes.hpp"
#include "mesh/shape_numbers.hpp"
#include "mesh/volume_shapes.hpp"

namespace gannet {
namespace {

// The lengths > 0 under `key`, [m].
template <std::size_t N>
std::optional<std::array<double, N>> lengths(const Keys& keys, std::string_view key) {
  if (!keys.has(key)) return {};
  const std::vector<double>& given = keys.numbers(key);
  if (given.size() != N) {
    keys.complain(key, fmt::format("{} lengths are given; {} are wanted", given.size(), N));
    return {};
  }
  std::array<double, N> length{};
  for (std::size_t k = 0; k < N; ++k) {
    if (!(given[k] > 0)) {
      keys.complain(key, fmt::format("{:g} m is not a length; it must be > 0", given[k]));
      return {};
    }
    length[k] = given[k];
  }
  return length;
}

// The surface with each quadrilateral cut along its diagonal 1-3, where the keys ask for it.
SurfaceMesh cut_if_asked(const Keys& keys, SurfaceMesh mesh) {
  if (!keys.has("triangles") || !keys.flag("triangles")) return mesh;
  std::vector<Index> cells;
  for (std::size_t k = 0; k < mesh.quads.size(); k += 4) {
    for (const std::size_t a : {0, 1, 2, 2, 0, 2, 3, 3}) cells.push_back(mesh.quads[k + a]);
  }
  mesh.quads = std::move(cells);
  return mesh;
}

SurfaceMesh plate(const Keys& keys) {
  const auto size = lengths<2>(keys, "size");
  const auto n = counts<2>(keys, "elements");
  if (keys.given("centre") && keys.given("lowest_point")) {
    keys.complain("lowest_point", "stands beside 'centre'; one of them places the plate");
    return {};
  }
  if (!size || !n) return {};
  const double tilt = keys.number_or("tilt", 0);
  const Vec3 along = (*size)[0] * Vec3(std::cos(tilt), 0, std::sin(tilt));
  const Vec3 across(0, (*size)[1], 0);
  Vec3 centre = keys.has("centre") ? keys.vector("centre") : Vec3::Zero();
  if (keys.has("lowest_point")) {
    centre = keys.vector("lowest_point") + (tilt < 0 ? Vec3(-0.5 * along) : Vec3(0.5 * along));
  }
  return cut_if_asked(keys, parallelogram(centre - 0.5 * (along + across), along, across, *n));
}

SurfaceMesh plane(const Keys& keys) {
  const auto n = counts<2>(keys, "elements");
  if (!n || !keys.has("corner") || !keys.has("along") || !keys.has("across")) return {};
  const Vec3 along = keys.vector("along");
  const Vec3 across = keys.vector("across");
  // 1e-6: a smaller angle between the edges leaves no element that could carry anything.
  if (!(along.cross(across).norm() > 1e-6 * along.norm() * across.norm())) {
    keys.complain("across",
                  "has the direction of 'along' (or one of them is zero), so that they "
                  "span no area");
    return {};
  }
  return cut_if_asked(keys, parallelogram(keys.vector("corner"), along, across, *n));
}

SurfaceMesh wedge(const Keys& keys) {
  const auto n = counts<2>(keys, "elements");
  if (!n || !keys.has("deadrise") || !keys.has("half_breadth") || !keys.has("length")) return {};
  const Vec3 keel = keys.has("lowest_point") ? keys.vector("lowest_point") : Vec3::Zero();
  return wedge_surface(keel, keys.number("deadrise"),
                       {keys.number("half_breadth"), keys.number("length")}, *n);
}

SurfaceMesh box(const Keys& keys) {
  const auto n = counts<3>(keys, "elements");
  if (!n || !keys.has("from") || !keys.has("to")) return {};
  const Vec3 from = keys.vector("from");
  const Vec3 to = keys.vector("to");
  if (!box_is_open(keys, from, to, 3)) return {};
  return box_surface(from, to, *n);
}

Key angle(const std::string& name, const std::string& text, bool required) {
  constexpr double right = 0.5 * std::numbers::pi;
  return {.name = name,
          .unit = dim::angle,
          .text = text,
          .required = required,
          .limits = {-right, right, true, true}};
}

// The points of a lattice in a box, numbered in the order in which they are first asked for.
class BoxPoints {
 public:
  BoxPoints(const Vec3& from, const Vec3& to, std::array<int, 3> n) : from_(from), to_(to), n_(n) {
    const auto points_along = [&](std::size_t k) { return static_cast<std::size_t>(n[k]) + 1; };
    number_.assign(points_along(0) * points_along(1) * points_along(2), -1);
  }

  Index operator()(const std::array<Index, 3>& place) {
    std::size_t slot = 0;
    Vec3 part;
    for (std::size_t k = 0; k < 3; ++k) {
      slot = slot * (static_cast<std::size_t>(n_[k]) + 1) + static_cast<std::size_t>(place[k]);
      part[static_cast<Eigen::Index>(k)] = double(place[k]) / n_[k];
    }
    if (number_[slot] < 0) {
      number_[slot] = static_cast<Index>(points_.size());
      points_.emplace_back(from_ + part.cwiseProduct(to_ - from_));
    }
    return number_[slot];
  }

  [[nodiscard]] const std::array<int, 3>& n() const { return n_; }
  [[nodiscard]] const std::vector<Vec3>& made() const { return points_; }

 private:
  Vec3 from_;
  Vec3 to_;
  std::array<int, 3> n_;
  std::vector<Index> number_;
  std::vector<Vec3> points_;
};

using Offset = std::array<Index, 2>;
constexpr std::array face_corners = {Offset{0, 0}, Offset{1, 0}, Offset{1, 1}, Offset{0, 1}};

// The cells of the face of the box that is normal to `axis`, at its near or far end.
void add_face(std::vector<Index>& quads, BoxPoints& points, std::size_t axis, bool far) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const std::array<int, 3>& n = points.n();
  for (Index j = 0; j < n[v]; ++j) {
    for (Index i = 0; i < n[u]; ++i) {
      std::array<Index, 3> place{};
      place[axis] = far ? n[axis] : 0;
      // u x v is the direction of the axis: counted that way round, the far face looks outwards.
      for (const auto& [di, dj] : face_corners) {
        place[u] = i + (far ? di : dj);
        place[v] = j + (far ? dj : di);
        quads.push_back(points(place));
      }
    }
  }
}

}  // namespace

SurfaceMesh parallelogram(const Vec3& corner, const Vec3& along, const Vec3& across,
                          std::array<int, 2> n) {
  SurfaceMesh mesh;
  for (int j = 0; j <= n[1]; ++j) {
    for (int i = 0; i <= n[0]; ++i) {
      mesh.points.emplace_back(corner + double(i) / n[0] * along + double(j) / n[1] * across);
    }
  }
  const Index row = n[0] + 1;
  for (Index j = 0; j < n[1]; ++j) {
    for (Index i = 0; i < n[0]; ++i) {
      const Index p = j * row + i;
      mesh.quads.insert(mesh.quads.end(), {p, p + 1, p + 1 + row, p + row});
    }
  }
  return mesh;
}

SurfaceMesh wedge_surface(const Vec3& keel, double deadrise, std::array<double, 2> breadth_length,
                          std::array<int, 2> n) {
  const auto [half_breadth, length] = breadth_length;
  SurfaceMesh mesh =
      parallelogram(Vec3(-half_breadth, -0.5 * length, 0), Vec3(2 * half_breadth, 0, 0),
                    Vec3(0, length, 0), {2 * n[0], n[1]});
  for (Vec3& x : mesh.points) {
    x.z() = std::abs(x.x()) * std::tan(deadrise);
    x += keel;
  }
  return mesh;
}

SurfaceMesh box_surface(const Vec3& from, const Vec3& to, std::array<int, 3> n) {
  BoxPoints points(from, to, n);
  SurfaceMesh mesh;
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const bool far : {false, true}) add_face(mesh.quads, points, axis, far);
  }
  mesh.points = points.made();
  return mesh;
}

std::vector<Key> shape_keys() {
  const Key triangles{.name = "triangles",
                      .kind = Kind::flag,
                      .text = "each element is cut into two triangles",
                      .fallback = "no"};
  const Key size{.name = "size",
                 .kind = Kind::numbers,
                 .unit = dim::length,
                 .text = "lengths of the edges, along x (before the tilt) and y",
                 .required = true};
  std::vector<Key> keys{
      {.name = "plate",
       .kind = Kind::map,
       .text = "a rectangle, tilted about the y axis",
       .keys = {size, elements_key("number of elements along the two edges"), triangles,
                angle("tilt", "angle by which the edge at larger x is raised (deadrise)", false),
                place_key("centre", "centre of the plate; the origin unless something is said"),
                place_key("lowest_point",
                          "middle of the lowest edge (of that at smaller x without a "
                          "tilt), in place of the centre")}},
      {.name = "plane",
       .kind = Kind::map,
       .text = "a parallelogram anywhere",
       .keys = {place_key("corner", "the corner where both edges begin", true),
                place_key("along", "the first edge, as a vector", true),
                place_key("across", "the second edge, as a vector", true),
                elements_key("number of elements along the two edges"), triangles}},
      {.name = "wedge",
       .kind = Kind::map,
       .text = "two plates that meet at a keel along y",
       .keys = {angle("deadrise", "angle of both plates from the horizontal", true),
                length_key("half_breadth",
                           "horizontal distance from the keel to either outer edge"),
                length_key("length", "length of the keel"),
                elements_key("number of elements from keel to edge, and along the keel"),
                place_key("lowest_point", "middle of the keel; the origin unless said")}},
      {.name = "box",
       .kind = Kind::map,
       .text = "the six faces of a box, normals outwards",
       .keys = {place_key("from", "corner with the smallest coordinates", true),
                place_key("to", "corner with the largest coordinates", true),
                elements_key("number of elements along x, y and z")}},
  };
  for (Key& key : volume_shape_keys()) keys.push_back(std::move(key));
  for (Key& key : line_shape_keys()) keys.push_back(std::move(key));
  return keys;
}

SurfaceMesh shape_surface(const Keys& shape) {
  const std::vector<std::string> names = shape.names();
  if (names.size() != 1) {
    shape.mistakes().add(
        shape.where(),
        shape.path() + (names.empty()
                            ? ": no shape is named; one of plate, plane, wedge, box is wanted"
                            : fmt::format(": {} shapes are named; a part has one", names.size())));
    return {};
  }
  if (is_volume_shape(shape)) {
    shape.complain(names[0], "is a volume; a surface is wanted: plate, plane, wedge or box");
    return {};
  }
  if (is_line_shape(shape)) {
    shape.complain(names[0], "is a line; a surface is wanted: plate, plane, wedge or box");
    return {};
  }
  const Keys keys = shape.map(names[0]);
  if (names[0] == "plate") return plate(keys);
  if (names[0] == "plane") return plane(keys);
  if (names[0] == "wedge") return wedge(keys);
  if (names[0] == "box") return box(keys);
  return {};  // an unknown shape: the reader has complained
}

}  // namespace gannet
