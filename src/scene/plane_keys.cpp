#include "scene/plane_keys.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

namespace gannet {

namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

/// Walls across one axis: [lower, upper] or the lower one.
void add_walls(const Keys& planes, int axis, const std::string& name, std::vector<Plane>& list) {
  const char* key = axes[static_cast<std::size_t>(axis)];
  const std::vector<double>& at = planes.numbers(key);
  if (at.empty() || at.size() > 2) {
    planes.complain(key, fmt::format("{} numbers; one (the lower wall) or two (lower, upper) are "
                                     "wanted",
                                     at.size()));
    return;
  }
  if (at.size() == 2 && !(at[0] < at[1])) {
    planes.complain(key, fmt::format("the lower wall ({} m) must lie below the upper one ({} m)",
                                     at[0], at[1]));
    return;
  }
  for (std::size_t side = 0; side < at.size(); ++side) {
    Plane plane;
    plane.name = fmt::format("{}.{}_{}", name, key, side == 0 ? "min" : "max");
    plane.point[axis] = at[side];
    plane.normal = Vec3::Zero();
    plane.normal[axis] = side == 0 ? 1 : -1;
    plane.where = planes.where(key);
    list.push_back(plane);
  }
}

void add_plane(const Keys& keys, const std::string& name, std::vector<Plane>& list) {
  const Vec3 normal = keys.vector("normal");
  if (!(normal.norm() > 0)) {
    keys.complain("normal", "a normal needs a length above 0");
    return;
  }
  list.push_back({name, keys.vector("point"), normal.normalized(), keys.where()});
}

/// What the boundary says of all its planes.
void set_walls(const Keys& boundary, std::vector<Plane>& list, std::size_t first) {
  for (const char* key : {"walls", "slip"}) {
    if (boundary.has(key) && first == list.size()) {
      boundary.complain(key, "says how planes act; there is no 'planes' or 'plane' here");
      return;
    }
  }
  const std::string walls = boundary.has("walls") ? boundary.word("walls") : "mirror";
  const bool slips = !boundary.has("slip") || boundary.word("slip") == "free";
  if (!slips && walls == "contact") {
    boundary.complain("slip", "water slides along contact; say walls: mirror, or dummy");
  }
  for (std::size_t k = first; k < list.size(); ++k) {
    list[k].behind = walls == "dummy"    ? Behind::dummy
                     : walls == "mirror" ? Behind::mirror
                                         : Behind::nothing;
    list[k].slips = slips;
  }
}

void add_boundary(const Keys& boundary, std::vector<Plane>& list) {
  if (boundary.has("plane")) add_plane(boundary.map("plane"), boundary.name(), list);
  if (!boundary.has("planes")) return;
  const Keys planes = boundary.map("planes");
  for (int axis = 0; axis < 3; ++axis) {
    if (planes.has(axes[static_cast<std::size_t>(axis)])) {
      add_walls(planes, axis, boundary.name(), list);
    }
  }
}

}  // namespace

Schema plane_schema() {
  Key planes{.name = "planes",
             .kind = Kind::map,
             .text = "walls across the axes: [lower, upper], or the lower one alone"};
  for (const char* axis : axes) {
    planes.keys.push_back({.name = axis,
                           .kind = Kind::numbers,
                           .unit = dim::length,
                           .text = "where the walls across this axis stand"});
  }
  Key plane{.name = "plane", .kind = Kind::map, .text = "one wall in any direction"};
  plane.keys = {Key{.name = "point",
                    .kind = Kind::vector,
                    .unit = dim::length,
                    .text = "a point of the wall",
                    .required = true},
                Key{.name = "normal",
                    .kind = Kind::vector,
                    .text = "points to the side of the material, of any length",
                    .required = true}};
  const Key walls{.name = "walls",
                  .kind = Kind::choice,
                  .text =
                      "what stands behind the planes for particles: mirror images (across an "
                      "axis only), layers of dummy particles, or contact alone",
                  .choices = {"mirror", "dummy", "contact"}};
  const Key slip{
      .name = "slip",
      .kind = Kind::choice,
      .text =
          "whether viscous water slides along the planes: free, or none (not with walls: "
          "contact)",
      .choices = {"free", "none"}};
  Schema schema;
  for (const Key& key : {planes, plane, walls, slip}) schema.push_back({"boundaries.*", key});
  return schema;
}

std::vector<Plane> read_planes(const Keys& root) {
  std::vector<Plane> list;
  if (!root.has("boundaries")) return list;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    const std::size_t first = list.size();
    add_boundary(boundaries.map(name), list);
    set_walls(boundaries.map(name), list, first);
  }
  return list;
}

}  // namespace gannet
