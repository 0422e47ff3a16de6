#include "contact/part_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contact/outer_faces.hpp"
#include "contact/part_kinds.hpp"

namespace gannet {

namespace {

/// Shares of the stiffness of an element that a penalty may have.
constexpr double share_of_solid = 1;
constexpr double share_of_shell = 0.2;
constexpr double share_of_line = 0.1;

/// Penalty per area that each segment can bear [Pa/m], and the size of what is behind it [m].
struct Bearing {
  double kappa = 0;
  double size = 0;
};

Bearing bearing_of(const ShellSurface& data, bool rigid, double area, double volume) {
  const double size = volume > 0 ? volume / area : std::sqrt(area);
  if (rigid) return {std::numeric_limits<double>::infinity(), size};
  if (volume > 0) return {share_of_solid * data.modulus * area / volume, size};
  return {share_of_shell * data.young * data.thickness / area, size};
}

/// Means over the segments around each node.
void spread(const std::vector<Bearing>& bearing, PartSide& side) {
  std::vector<int> count(side.surface.node.size(), 0);
  side.kappa.assign(side.surface.node.size(), 0);
  for (std::size_t s = 0; s < bearing.size(); ++s) {
    const Segment& g = side.surface.segments[s];
    for (std::size_t k = 0; k < static_cast<std::size_t>(g.n_corners); ++k) {
      const auto node = static_cast<std::size_t>(g.corner[k]);
      side.kappa[node] += bearing[s].kappa;
      ++count[node];
    }
  }
  for (std::size_t i = 0; i < count.size(); ++i) side.kappa[i] /= std::max(1, count[i]);
}

/// A surface of nodes alone.
Surface nodes_alone(const Part& part) {
  Surface surface;
  surface.node.assign(part.connectivity.begin(), part.connectivity.end());
  std::sort(surface.node.begin(), surface.node.end());
  surface.node.erase(std::unique(surface.node.begin(), surface.node.end()), surface.node.end());
  surface.x.resize(surface.node.size());
  surface.node_normal.resize(surface.node.size());
  surface.at_rim.resize(surface.node.size());
  return surface;
}

PartSide make_line_side(const Scene& scene, int number, const ShellSurface& data, bool rigid) {
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  PartSide side;
  side.part = number;
  side.line = true;
  side.thickness = data.thickness;
  side.surface = nodes_alone(part);
  double length = 0;
  for (std::size_t i = 0; i + 1 < part.connectivity.size(); i += 2) {
    length += (xyz(scene.nodes.x[static_cast<std::size_t>(part.connectivity[i + 1])]) -
               xyz(scene.nodes.x[static_cast<std::size_t>(part.connectivity[i])]))
                  .norm();
  }
  const double L = length / static_cast<double>(part.n_cells());
  const double k = rigid ? std::numeric_limits<double>::infinity() : share_of_line * data.axial / L;
  side.depth = L;
  side.kappa.assign(side.surface.node.size(), k / (L * L));
  side.area.assign(side.surface.node.size(), L * L);
  side.facing.assign(side.surface.node.size(), Vec3::Zero());
  side.x_search.resize(side.surface.node.size());
  return side;
}

}  // namespace

Vec3 area_vector(const Segment& g, const Array<Line>& x) {
  const auto at = [&](std::size_t k) { return xyz(x[static_cast<std::size_t>(g.corner[k])]); };
  if (g.n_corners == 2) return {at(0).y() - at(1).y(), at(1).x() - at(0).x(), 0};
  if (g.n_corners == 3) return 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1));
}

PartSide make_part_side(const Scene& scene, int number, const ShellSurface& data, bool elastic) {
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  const bool rigid = part.rigid && !elastic;
  if (is_line(part)) return make_line_side(scene, number, data, rigid);
  PartSide side;
  side.part = number;
  side.solid = part.kind == "solid";
  side.thickness = data.thickness;
  OuterFaces outer;
  if (side.solid) outer = outer_faces(part);
  side.surface = make_surface(side.solid ? outer.faces : part);
  side.surface.gone = side.solid ? nullptr : data.gone;
  update_side(scene.nodes, side);
  std::vector<Bearing> bearing;
  side.depth = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < side.surface.segments.size(); ++s) {
    const double area = area_vector(side.surface.segments[s], side.surface.x).norm();
    const double volume = side.solid ? volume_of_cell(part, scene.nodes, outer.element[s]) : 0;
    bearing.push_back(bearing_of(data, rigid, area, volume));
    side.depth = std::min(side.depth, bearing.back().size);
  }
  spread(bearing, side);
  side.x_search.resize(side.surface.node.size());
  return side;
}

void find_areas(const Surface& surface, const Array<Line>& x, std::vector<double>& area,
                std::vector<Vec3>& facing) {
  area.assign(surface.node.size(), 0);
  facing.assign(surface.node.size(), Vec3::Zero());
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    if (has_left(surface, static_cast<Index>(s))) continue;
    const Segment& g = surface.segments[s];
    const Vec3 share = area_vector(g, x) / g.n_corners;
    const double size = share.norm();
    for (std::size_t k = 0; k < static_cast<std::size_t>(g.n_corners); ++k) {
      const auto node = static_cast<std::size_t>(g.corner[k]);
      area[node] += size;
      facing[node] += share;
    }
  }
}

void update_side(const Nodes& nodes, PartSide& side) {
  update_surface(nodes, side.surface);
  if (side.line) return;
  find_areas(side.surface, side.surface.x, side.area, side.facing);
}

}  // namespace gannet
