#include "mesh/line_shapes.hpp"

#include "mesh/mesh_keys.hpp"
#include "mesh/shape_numbers.hpp"

namespace gannet {
namespace {

/// The corners under `points`, each at another place than the one before it.
std::vector<Vec3> corners_of(const Keys& keys) {
  std::vector<Vec3> corners = points_under(keys, "points");
  for (std::size_t k = 1; k < corners.size(); ++k) {
    if ((corners[k] - corners[k - 1]).norm() > 0) continue;
    keys.complain(keys.value("points").children[k], "is the same point as the one before it");
    return {};
  }
  if (corners.size() < 2) {
    keys.complain("points", "a line needs two points or more: [[x, y, z], [x, y, z]]");
    return {};
  }
  return corners;
}

/// The number of elements of each leg; a single number stands for all.
std::vector<int> elements_of(const Keys& keys, std::size_t n_legs) {
  const std::vector<double>& given = keys.numbers("elements");
  if (given.size() != 1 && given.size() != n_legs) {
    keys.complain("elements", fmt::format("{} numbers are given; one, or one for each of the {} "
                                          "legs, are wanted",
                                          given.size(), n_legs));
    return {};
  }
  std::vector<int> n;
  for (std::size_t k = 0; k < n_legs; ++k) {
    const double number = given[given.size() == 1 ? 0 : k];
    if (number < 1 || number > most_cells || number != std::floor(number)) {
      keys.complain("elements", fmt::format("{:g} is not a number of elements; whole numbers from "
                                            "1 on are wanted",
                                            number));
      return {};
    }
    n.push_back(static_cast<int>(number));
  }
  return n;
}

LineMesh line(const Keys& keys) {
  const auto n = counts<1>(keys, "elements");
  if (!n || !keys.has("from") || !keys.has("to")) return {};  // the reader has complained
  const Vec3 ends[] = {keys.vector("from"), keys.vector("to")};
  if (!((ends[1] - ends[0]).norm() > 0)) {
    keys.complain("to", "is the same point as 'from'");
    return {};
  }
  return polyline_mesh(ends, *n);
}

LineMesh polyline(const Keys& keys) {
  if (!keys.has("points") || !keys.has("elements")) return {};
  const std::vector<Vec3> corners = corners_of(keys);
  if (corners.empty()) return {};
  const std::vector<int> n = elements_of(keys, corners.size() - 1);
  return n.empty() ? LineMesh{} : polyline_mesh(corners, n);
}

}  // namespace

LineMesh polyline_mesh(std::span<const Vec3> corners, std::span<const int> n) {
  LineMesh mesh;
  mesh.points.push_back(corners[0]);
  for (std::size_t leg = 0; leg < n.size(); ++leg) {
    for (int i = 1; i <= n[leg]; ++i) {
      const double s = double(i) / n[leg];
      mesh.points.emplace_back((1 - s) * corners[leg] + s * corners[leg + 1]);
      const auto last = static_cast<Index>(mesh.points.size()) - 1;
      mesh.cells.insert(mesh.cells.end(), {last - 1, last});
    }
  }
  return mesh;
}

std::vector<Key> line_shape_keys() {
  return {{.name = "line",
           .kind = Kind::map,
           .text = "a straight line of beams or of a cable",
           .keys = {place_key("from", "its first end", true),
                    place_key("to", "its other end", true), elements_key("number of elements")}},
          {.name = "polyline",
           .kind = Kind::map,
           .text = "straight legs of beams or of a cable",
           .keys = {{.name = "points",
                     .kind = Kind::any,
                     .text = "the points that it leads through, [[x, y, z], ...]",
                     .required = true},
                    elements_key("number of elements of each leg; one number for all")}}};
}

bool is_line_shape(const Keys& shape) { return shape.has("line") || shape.has("polyline"); }

LineMesh line_mesh(const Keys& part) {
  if (part.has("shape") && part.has("mesh")) {
    part.complain("mesh", "stands beside 'shape'; a part has one of them");
    return {};
  }
  if (part.has("mesh")) return file_lines(part.map("mesh"));
  if (!part.has("shape") || !is_line_shape(part.map("shape"))) {
    part.mistakes().add(part.where(), part.path() +
                                          ": its line is missing; a 'shape' (line or polyline) or "
                                          "a 'mesh' is wanted");
    return {};
  }
  const Keys shape = part.map("shape");
  if (shape.names().size() != 1) {
    shape.mistakes().add(shape.where(), fmt::format("{}: {} shapes are named; a part has one",
                                                    shape.path(), shape.names().size()));
    return {};
  }
  return shape.has("line") ? line(shape.map("line")) : polyline(shape.map("polyline"));
}

}  // namespace gannet
