// parts.NAME.rigid_surface: a surface (in the plane a line) that does not deform. A body of
// `bodies` carries it, or it stays where it is.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace rigid_surface {

constexpr const char* kind = "rigid_surface";

Schema schema() {
  return element_schema(
      kind, "the part is a surface that does not deform; in the plane a line",
      {{.name = "thickness",
        .unit = dim::length,
        .text = "contact keeps half of it, and half the particle spacing, off the nodes",
        .fallback = "0 mm",
        .limits = at_least(0)},
       {.name = "mass_per_area",
        .unit = dim::mass / dim::area,
        .text = "of a skin with mass; a body can also be given its mass as a whole",
        .limits = positive()}});
}

/// Makes one point of the first and the last where they are at the same place.
void close_line(LineMesh& mesh) {
  const double length = (mesh.points[1] - mesh.points[0]).norm();
  if (mesh.points.size() < 4) return;
  if ((mesh.points.back() - mesh.points.front()).norm() > 1e-6 * length) return;
  mesh.points.pop_back();
  const auto last = static_cast<Index>(mesh.points.size());
  for (Index& i : mesh.cells) i = i == last ? 0 : i;
}

void move_and_add(const Keys& part, std::vector<Vec3> points, std::vector<Index> cells, Cell cell,
                  Draft& draft) {
  PartDraft p = element_draft(part, kind, cell, false);
  set_mesh(part, std::move(points), std::move(cells), p);
  if (cell == Cell::line) {
    LineMesh line{std::move(p.points), std::move(p.connectivity)};
    close_line(line);
    p.points = std::move(line.points);
    p.connectivity = std::move(line.cells);
  }
  draft.parts.push_back(std::move(p));
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, kind)) {
    if (part.given("initial_velocity")) {
      part.complain("initial_velocity",
                    "has no meaning: a rigid surface moves with its body alone");
    }
    if (draft.dimension == 2) {
      LineMesh mesh = line_mesh(part);
      if (!mesh.empty()) {
        move_and_add(part, std::move(mesh.points), std::move(mesh.cells), Cell::line, draft);
      }
      continue;
    }
    SurfaceMesh mesh = surface_mesh(part);
    if (!mesh.empty()) {
      move_and_add(part, std::move(mesh.points), std::move(mesh.quads), Cell::quad, draft);
    }
  }
}

/// Area of a cell (times 1 m in the plane) [m^2]; a triangle repeats its last corner.
double area_of(const Part& part, const Nodes& nodes, std::size_t first) {
  const auto x = [&](std::size_t corner) {
    return xyz(nodes.x[static_cast<std::size_t>(part.connectivity[first + corner])]);
  };
  if (part.cell == Cell::line) return (x(1) - x(0)).norm();
  return 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
}

/// Spreads the mass of each cell evenly over its corners, of a triangle over its three.
void add_masses(const Part& part, double mass_per_area, Nodes& nodes) {
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  for (std::size_t first = 0; first < part.connectivity.size(); first += n) {
    const bool triangle = n == 4 && part.connectivity[first + 2] == part.connectivity[first + 3];
    const std::size_t corners = triangle ? 3 : n;
    const double share = mass_per_area * area_of(part, nodes, first) / static_cast<double>(corners);
    for (std::size_t a = 0; a < corners; ++a) {
      nodes.x[static_cast<std::size_t>(part.connectivity[first + a])].w += share;
    }
  }
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, kind)) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    Part& part = scene.parts[static_cast<std::size_t>(number)];
    part.rigid = true;
    const Keys given = keys.map(kind);
    if (given.has("mass_per_area")) {
      add_masses(part, given.number("mass_per_area"), scene.nodes);
    }
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    surfaces[static_cast<std::size_t>(number)].thickness = given.number("thickness");
  }
}

/// A surface with mass that no body carries would fall like dust.
void operations(const Keys& root, Scene& scene, Models&) {
  if (!root.mistakes().empty()) return;  // a body that was not made has its reasons
  for (const Keys& keys : parts_with(root, kind)) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Index first = scene.parts[static_cast<std::size_t>(number)].nodes.begin;
    if (scene.nodes.v[static_cast<std::size_t>(first)].w == 0) continue;
    keys.map(kind).complain("mass_per_area", "has no meaning: no body carries the part");
  }
}

/// It brings no operation by which that could be told.
Presence presence(const Keys& root, Scene&) {
  const std::vector<Keys> parts = parts_with(root, kind);
  if (parts.empty()) return {Presence::State::off, fmt::format("no part has the key {}", kind)};
  return {Presence::State::on,
          parts.front().path() + "." + kind + " at " + parts.front().where(kind).text()};
}

}  // namespace rigid_surface
}  // namespace

Effect rigid_surface_effect() {
  return {.name = rigid_surface::kind,
          .schema = rigid_surface::schema,
          .parts = rigid_surface::add_parts,
          .state = rigid_surface::state,
          .operations = rigid_surface::operations,
          .presence = rigid_surface::presence};
}

}  // namespace gannet
