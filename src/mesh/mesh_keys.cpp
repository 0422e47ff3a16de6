#include "mesh/mesh_keys.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "mesh/msh_file.hpp"
#include "mesh/shapes.hpp"

namespace gannet {
namespace {

struct FileUnit {
  std::string_view name;
  double metres;
};
constexpr std::array file_units = {FileUnit{"m", 1}, FileUnit{"cm", 0.01}, FileUnit{"mm", 0.001},
                                   FileUnit{"in", 0.0254}, FileUnit{"ft", 0.3048}};

Key mesh_key() {
  std::vector<std::string> units;
  for (const FileUnit& unit : file_units) units.emplace_back(unit.name);
  return {
      .name = "mesh",
      .kind = Kind::map,
      .text = "a surface, a volume of solids, or lines of beams or cables, from a file",
      .keys = {
          {.name = "file",
           .kind = Kind::path,
           .text = "a gmsh file (.msh 4.1 or 2.2, ASCII)",
           .required = true},
          {.name = "unit",
           .kind = Kind::choice,
           .text = "unit of the lengths in the file",
           .fallback = "m",
           .choices = units},
          {.name = "group",
           .kind = Kind::text,
           .text = "name of the physical surface, volume or curve to take; all cells unless said"},
          {.name = "move",
           .kind = Kind::vector,
           .unit = dim::length,
           .text = "vector by which the mesh is moved"}}};
}

Key fill_key() {
  const auto corner = [](const char* name, const char* text) {
    return Key{
        .name = name, .kind = Kind::vector, .unit = dim::length, .text = text, .required = true};
  };
  return {.name = "fill",
          .kind = Kind::map,
          .text = "the region that is filled with particles",
          .keys = {{.name = "box",
                    .kind = Kind::map,
                    .text = "a box along the axes",
                    .keys = {corner("from", "corner with the smallest coordinates"),
                             corner("to", "corner with the largest coordinates")}},
                   {.name = "ellipsoid",
                    .kind = Kind::map,
                    .text = "an ellipsoid along the axes; in a plane case an ellipse",
                    .keys = {corner("centre", "its middle"),
                             corner("radii", "its half axes along x, y and z")}},
                   {.name = "cylinder",
                    .kind = Kind::map,
                    .text = "a round cylinder along an axis",
                    .keys = {corner("from", "middle of one end"),
                             corner("to", "middle of the other end"),
                             {.name = "radius",
                              .unit = dim::length,
                              .text = "its radius",
                              .required = true,
                              .limits = positive()}}},
                   {.name = "jitter",
                    .text = "largest random offset of a particle, as a part of its cell",
                    .limits = {0, 0.5, false, true}},
                   {.name = "seed",
                    .kind = Kind::integer,
                    .text = "another number gives other random offsets; 0 unless said",
                    .limits = at_least(0)}}};
}

std::string group_of(const Keys& keys) { return keys.has("group") ? keys.word("group") : ""; }

/// Brings points from the unit of the file to their place [m].
void place_points(const Keys& keys, std::vector<Vec3>& points) {
  const std::string unit = keys.has("unit") ? keys.word("unit") : "m";
  double metres = 1;
  for (const FileUnit& known : file_units) {
    if (known.name == unit) metres = known.metres;
  }
  const Vec3 move = keys.has("move") ? keys.vector("move") : Vec3::Zero();
  for (Vec3& x : points) x = metres * x + move;
}

SurfaceMesh file_surface(const Keys& keys) {
  if (!keys.has("file")) return {};  // required: the reader has complained
  SurfaceMesh mesh = read_msh(keys.word("file"), group_of(keys), keys.mistakes());
  place_points(keys, mesh.points);
  return mesh;
}

VolumeMesh file_volume(const Keys& keys, int dimension) {
  if (dimension == 2) {
    SurfaceMesh surface = file_surface(keys);
    for (std::size_t c = 0; c < surface.quads.size(); c += 4) {
      if (surface.quads[c + 2] != surface.quads[c + 3]) continue;
      keys.complain("file",
                    "holds triangles; solids of a plane case are quadrilaterals (gmsh: "
                    "Recombine)");
      return {};
    }
    return {std::move(surface.points), std::move(surface.quads), 4};
  }
  if (!keys.has("file")) return {};
  VolumeMesh mesh = read_msh_volume(keys.word("file"), group_of(keys), keys.mistakes());
  place_points(keys, mesh.points);
  return mesh;
}

}  // namespace

Schema mesh_schema() {
  const Key shape{
      .name = "shape", .kind = Kind::map, .text = "a surface of elements", .keys = shape_keys()};
  return {{"parts.*", shape}, {"parts.*", mesh_key()}, {"parts.*", fill_key()}};
}

LineMesh file_lines(const Keys& keys) {
  if (!keys.has("file")) return {};
  LineMesh mesh = read_msh_lines(keys.word("file"), group_of(keys), keys.mistakes());
  place_points(keys, mesh.points);
  return mesh;
}

VolumeMesh volume_mesh(const Keys& part, int dimension) {
  const bool shape = part.has("shape");
  if (shape && part.has("mesh")) {
    part.complain("mesh", "stands beside 'shape'; a part has one of them");
    return {};
  }
  if (part.has("mesh")) return file_volume(part.map("mesh"), dimension);
  if (shape && is_volume_shape(part.map("shape"))) {
    return shape_volume(part.map("shape"), dimension);
  }
  part.mistakes().add(part.where(),
                      part.path() +
                          ": its volume is missing; a 'shape' (block, mapped or rod) or "
                          "a 'mesh' is wanted");
  return {};
}

SurfaceMesh surface_mesh(const Keys& part) {
  const bool shape = part.has("shape");
  const bool file = part.has("mesh");
  if (shape && file) {
    part.complain("mesh", "stands beside 'shape'; a part has one of them");
    return {};
  }
  if (shape) return shape_surface(part.map("shape"));
  if (file) return file_surface(part.map("mesh"));
  part.mistakes().add(part.where(), part.path() +
                                        ": its surface is missing; a 'shape' or a 'mesh' "
                                        "is wanted");
  return {};
}

}  // namespace gannet
