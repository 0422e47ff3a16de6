#include "sph/wall_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/fill.hpp"
#include "scene/plane_keys.hpp"
#include "sph/sph_state.hpp"
#include "sph/wall_points.hpp"

namespace gannet {

namespace {

/// The planes that dummy particles are asked for behind.
std::vector<Plane> backed_planes(const Keys& root) {
  std::vector<Plane> planes = read_planes(root);
  std::erase_if(planes, [](const Plane& plane) { return plane.behind != Behind::dummy; });
  return planes;
}

/// Directions that repeat, and their ends.
void read_periods(const Keys& root, WallRegion& region) {
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("periodic")) continue;
    const Keys periodic = boundaries.map(name).map("periodic");
    for (int d = 0; d < region.dimension; ++d) {
      const std::string axis(1, static_cast<char>('x' + d));
      if (!periodic.has(axis) || periodic.numbers(axis).size() != 2) continue;
      region.periodic[static_cast<std::size_t>(d)] = true;
      region.low[d] = periodic.numbers(axis)[0];
      region.high[d] = periodic.numbers(axis)[1];
    }
  }
}

/// The region that walls of planes are built around: what the case says, or the box of the fluid,
/// widened by half of itself on each side in whole spacings.
WallRegion region_of(const Keys& root, const Draft& draft) {
  const Keys sph = root.map("parts").map(names_of_parts_with(root, "sph").front()).map("sph");
  WallRegion region;
  region.dimension = draft.dimension;
  region.dx = sph.number("spacing");
  region.n_layers = n_wall_layers(sph, draft.dimension);
  Eigen::AlignedBox3d box;
  for (const PartDraft& part : draft.parts) {
    if (part.kind != "sph") continue;
    for (const Vec3& x : part.points) box.extend(x);
  }
  if (box.isEmpty()) return region;
  for (int d = 0; d < draft.dimension; ++d) {
    const double half = 0.5 * (box.sizes()[d] + region.dx);
    const double more = region.dx * std::max<double>(region.n_layers, std::ceil(half / region.dx));
    region.low[d] = box.min()[d] - 0.5 * region.dx - more;
    region.high[d] = box.max()[d] + 0.5 * region.dx + more;
  }
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("extent")) continue;
    const Keys extent = boundaries.map(name).map("extent");
    const Vec3 from = extent.vector("from");
    const Vec3 to = extent.vector("to");
    for (int d = 0; d < draft.dimension; ++d) {
      if (!(from[d] < to[d])) {
        extent.complain("to", "each coordinate must be greater than that of 'from'");
        break;
      }
      region.low[d] = from[d];
      region.high[d] = to[d];
    }
  }
  read_periods(root, region);
  return region;
}

void add_backed_planes(const Keys& root, Draft& draft) {
  const std::vector<Plane> planes = backed_planes(root);
  if (planes.empty()) return;
  const std::vector<std::string> fluids = names_of_parts_with(root, "sph");
  if (fluids.empty()) {
    root.mistakes().add(
        planes.front().where,
        "dummy particles behind a plane need a fluid, and no part is made of 'sph'");
    return;
  }
  const std::string material = root.map("parts").map(fluids.front()).map("sph").word("material");
  const auto points = points_behind(planes, region_of(root, draft));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    PartDraft part{.name = planes[k].name,
                   .kind = "wall",
                   .material = material,
                   .where = planes[k].where,
                   .points = points[k]};
    if (std::ranges::find(draft.parts, part.name, &PartDraft::name) != draft.parts.end()) {
      root.mistakes().add(part.where,
                          fmt::format("the dummy particles of '{0}' make a part of that "
                                      "name, and there is a part '{0}' already",
                                      part.name));
    }
    if (!part.points.empty()) draft.parts.push_back(std::move(part));
  }
}

}  // namespace

std::vector<std::string> names_of_parts_with(const Keys& root, const char* key) {
  std::vector<std::string> names;
  if (!root.has("parts")) return names;
  const Keys parts = root.map("parts");
  for (const std::string& name : parts.names()) {
    if (parts.map(name).has(key)) names.push_back(name);
  }
  return names;
}

std::string named_fluid(const Keys& root, const Keys& wall) {
  if (wall.has("like")) return wall.word("like");
  const std::vector<std::string> fluids = names_of_parts_with(root, "sph");
  return fluids.empty() ? "" : fluids.front();
}

std::string fluid_of(const Keys& root, const Keys& wall) {
  const std::vector<std::string> fluids = names_of_parts_with(root, "sph");
  if (fluids.empty()) {
    wall.complain("", "a wall of particles needs a fluid, and no part is made of 'sph'");
    return "";
  }
  const std::string like = named_fluid(root, wall);
  if (std::ranges::find(fluids, like) == fluids.end()) {
    wall.complain("like", fmt::format("'{}' is not made of 'sph'", like));
    return "";
  }
  return like;
}

int n_wall_layers(const Keys& sph, int dimension) {
  const KernelType kernel = kernel_named(sph.word("kernel"));
  const double ratio = sph.number_or("smoothing_ratio", usual_smoothing_ratio(kernel, dimension));
  return static_cast<int>(std::ceil(support(kernel) * ratio - 1e-9));
}

void add_wall_parts(const Keys& root, Draft& draft) {
  for (const std::string& name : names_of_parts_with(root, "wall")) {
    const Keys part = root.map("parts").map(name);
    const std::string like = fluid_of(root, part.map("wall"));
    if (like.empty()) continue;
    if (part.has("map")) part.complain("map", "moves the points of elements, not those of a fill");
    if (!part.has("fill")) {
      part.complain("fill", "missing; a wall needs a region to fill: fill: {box: {from, to}}");
      continue;
    }
    const Keys sph = root.map("parts").map(like).map("sph");
    draft.parts.push_back({.name = name,
                           .kind = "wall",
                           .material = sph.word("material"),
                           .where = part.where(),
                           .points = fill_points(part, sph.number("spacing"), draft.dimension)});
  }
  add_backed_planes(root, draft);
}

}  // namespace gannet
