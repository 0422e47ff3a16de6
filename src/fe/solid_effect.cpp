// Solids as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mass_scaling.hpp"
#include "fe/solid.hpp"
#include "mesh/mesh_keys.hpp"
#include "mesh/volume_shapes.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace solid {

std::vector<Key> own_keys() {
  const std::vector<Key> hourglass{
      {.name = "type",
       .kind = Kind::choice,
       .text = "stiffness: an elastic force that remembers; viscous: a damping force; unless said "
               "viscous where the solid may yield",
       .choices = {"stiffness", "viscous"}},
      {.name = "coefficient",
       .text = "strength of the hourglass control over the stiffness of the element",
       .fallback = "0.05",
       .limits = between(0, 0.3)}};
  const std::vector<Key> viscosity{{.name = "linear",
                                    .text = "linear coefficient of the bulk viscosity",
                                    .fallback = "0.06",
                                    .limits = between(0, 1)},
                                   {.name = "quadratic",
                                    .text = "quadratic coefficient of the bulk viscosity",
                                    .fallback = "1.5",
                                    .limits = between(0, 10)}};
  return {{.name = "material",
           .kind = Kind::reference,
           .text = "solid that the part is made of",
           .required = true,
           .refers_to = "materials"},
          {.name = "formulation",
           .kind = Kind::choice,
           .text = "one_point: fast, with hourglass control; eight_points: a mean dilatation, for "
                   "bending and nearly incompressible solids; tetrahedra: six for each brick, with "
                   "the dilatation of their nodes",
           .fallback = "one_point",
           .choices = {"one_point", "eight_points", "tetrahedra"}},
          {.name = "hourglass",
           .kind = Kind::map,
           .text = "control of the modes that one point of integration does not see",
           .keys = hourglass},
          {.name = "bulk_viscosity",
           .kind = Kind::map,
           .text = "viscous pressure that carries shocks over a few elements",
           .keys = viscosity},
          {.name = "collapse",
           .kind = Kind::choice,
           .text = "what happens where an element has shrunk to nothing or turned inside out",
           .fallback = "stop",
           .choices = {"stop", "erode"}},
          {.name = "collapse_ratio",
           .text = "volume over volume at the start at which an element has collapsed",
           .fallback = "0.01",
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true, .highest_open = true}},
          {.name = "dt_factor",
           .text = "share of the stable step of the elements that is used",
           .fallback = "0.9",
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

std::vector<Key> solid_keys() {
  std::vector<Key> keys = own_keys();
  for (Key& key : stiffness_damping_keys()) keys.push_back(std::move(key));
  return keys;
}

Schema schema() {
  return element_schema("solid", "the part is made of solid elements", solid_keys());
}

bool has_formulation(const Keys& solid, const char* name) {
  return solid.has("formulation") && solid.word("formulation") == name;
}

/// The cells of a part; bricks are cut into tetrahedra where these are asked for.
VolumeMesh mesh_of(const Keys& part, int dimension) {
  const Keys solid = part.map("solid");
  const bool tetrahedra = has_formulation(solid, "tetrahedra");
  if (tetrahedra && dimension == 2) {
    solid.complain("formulation", "tetrahedra need three dimensions");
    return {};
  }
  VolumeMesh mesh = volume_mesh(part, dimension);
  if (mesh.nodes_per_cell == 8) return tetrahedra ? tetrahedra_of(mesh) : mesh;
  if (dimension == 3 && has_formulation(solid, "eight_points")) {
    solid.complain("formulation", "is one of bricks, and the mesh is of tetrahedra");
    return {};
  }
  return mesh;
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, "solid")) {
    const VolumeMesh mesh = mesh_of(part, draft.dimension);
    if (mesh.empty()) continue;  // the mesh has complained
    const Cell of_four = draft.dimension == 2 ? Cell::quad : Cell::tetrahedron;
    PartDraft p =
        element_draft(part, "solid", mesh.nodes_per_cell == 4 ? of_four : Cell::hexahedron, false);
    set_mesh(part, mesh.points, mesh.cells, p);
    draft.parts.push_back(std::move(p));
  }
}

/// Whether its elements have modes that they do not see.
bool has_hourglass(const Keys& solid, Cell cell) {
  return !has_formulation(solid, "eight_points") && cell != Cell::tetrahedron;
}

/// Unless said: viscous where the solid may yield, since an elastic force does not flow with it.
bool resists_viscously(const Keys& solid, const ElasticPlastic& material) {
  if (solid.has("hourglass") && solid.map("hourglass").has("type")) {
    return solid.map("hourglass").word("type") == "viscous";
  }
  return material.plastic();
}

SolidShape shape_of(Cell cell) {
  if (cell == Cell::quad) return SolidShape::quadrilateral;
  return cell == Cell::tetrahedron ? SolidShape::tetrahedron : SolidShape::brick;
}

SolidSection read_section(const Keys& solid, const ElasticPlastic& material, Cell cell) {
  SolidSection section;
  section.shape = shape_of(cell);
  section.viscous_hourglass = resists_viscously(solid, material);
  if (has_formulation(solid, "eight_points")) section.points = 8;
  if (!has_hourglass(solid, cell) && solid.given("hourglass")) {
    solid.complain("hourglass",
                   "has no meaning: these elements have no modes that they do not see");
  }
  if (cell == Cell::tetrahedron && material.hyperelastic()) {
    solid.complain("material", "is rubber, which tetrahedra do not know yet");
  }
  if (solid.has("hourglass")) {
    const Keys hourglass = solid.map("hourglass");
    section.hourglass_coefficient =
        hourglass.number_or("coefficient", section.hourglass_coefficient);
  }
  if (solid.has("bulk_viscosity")) {
    const Keys viscosity = solid.map("bulk_viscosity");
    section.linear_viscosity = viscosity.number_or("linear", section.linear_viscosity);
    section.quadratic_viscosity = viscosity.number_or("quadratic", section.quadratic_viscosity);
  }
  section.damping = read_stiffness_damping(solid);
  section.smallest_ratio = solid.number_or("collapse_ratio", section.smallest_ratio);
  section.dt_factor = solid.number_or("dt_factor", section.dt_factor);
  return section;
}

/// The whole state for checkpoints; for output, what is derived from it when it is asked for.
void track(Scene& scene, SolidBlock& block) {
  Field whole =
      element_field(block.name + ".state", "", block.part, block.state, block.layout.n_values(), 0,
                    block.layout.n_values(), [&block] { return block.n_elements; });
  whole.owner = "solid";
  scene.fields.push_back(std::move(whole));
  const auto show = [&](const char* name, const char* unit, const char* vtk, Array<double>& shown,
                        int components) {
    Field field =
        plain_field(block.name + name, unit, vtk, Over::cells, shown, components, GhostRule::none);
    field.owner = "solid";
    field.prepare = [&block] { show_state(block); };
    track_shown(scene, block.part, std::move(field));
  };
  show_state(block);
  show(".stress", "Pa", "Stress", block.stress_shown, 6);
  if (block.layout.plastic()) {
    show(".plastic_strain", "", "PlasticStrain", block.plastic_shown, 1);
  }
  if (!block.damage_shown.empty()) show(".damage", "", "Damage", block.damage_shown, 1);
}

/// The number of elements that have left, for histories.
void add_measures(Scene& scene, const SolidBlock& block) {
  if (!block.erodes && !block.material.failure.given()) return;
  scene.measures.push_back({"solid." + block.name + ".eroded", "", {"value"}, [&block](double* n) {
                              *n = n_eroded(block);
                            }});
}

void scale_masses(const Keys& part, SolidBlock& block, Scene& scene) {
  if (!part.has("mass_scaling")) return;
  const int n_corners = block.layout.n_corners();
  ScalableElements elements{
      .n_elements = block.n_elements,
      .n_corners = n_corners,
      .dt_factor = block.section.dt_factor,
      .bounds = bounds_of(block, scene.nodes),
      .mass = [&](Index e) -> CornerMass {
        return {corner_mass(block, e), 0};
      },
      .corner = [&, n_corners](Index e,
                               int a) { return corner_of(block.corners, n_corners, e, a); },
      .cell = [](Index e) { return e; },
      .inverse_mass = &block.inverse_mass};
  scale_masses(part, block.part, scene, {&elements, 1});
}

/// K + 4/3 G, for what a contact may put on the surface [Pa]; of rubber at the start.
double held_modulus(const ElasticPlastic& material) {
  const double bulk =
      material.hyperelastic() ? material.rubber.bulk : material.E / (3 * (1 - 2 * material.nu));
  return bulk + 4.0 / 3 * material.G();
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, "solid")) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    const ElasticPlastic material = read_elastic_plastic(root.map("materials").map(part.material));
    const Keys solid = keys.map("solid");
    auto& list = scene.store.get<SolidBlocks>().list;
    try {
      list.push_back(make_solid_block(part.connectivity, scene.nodes.x, material,
                                      read_section(solid, material, part.cell)));
    } catch (const std::invalid_argument& e) {
      keys.complain("solid", e.what());
      continue;
    }
    SolidBlock& block = list.back();
    block.erodes = solid.has("collapse") && solid.word("collapse") == "erode";
    block.name = part.name;
    block.part = number;
    add_solid_masses(block, scene.nodes);
    prepare_damping(block, scene.nodes);
    scale_masses(keys, block, scene);
    track(scene, block);
    add_measures(scene, block);
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    surfaces[static_cast<std::size_t>(number)].modulus = held_modulus(material);
  }
}

/// Stops the run at an element that has collapsed, with its name.
[[noreturn]] void stop_at_collapsed(const Scene& scene, const SolidBlock& block, const Step& step) {
  throw RunError(RunFailure{
      fmt::format("an element has collapsed: its volume is {:.3g} of that at the start",
                  block.volume_ratio),
      text_of_element(scene, block.part, block.smallest),
      fmt::format("at t = {:.6g} s, step {}; the limit is parts.{}.solid.collapse_ratio = {:g}",
                  step.t, step.n, block.name, block.section.smallest_ratio),
      "let such elements go (collapse: erode), take a finer mesh where it is crushed, or look for "
      "a "
      "load or contact that is too stiff"});
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<SolidBlocks>()) return;
  for (SolidBlock& block : scene.store.get<SolidBlocks>().list) {
    ElementPart part{.kind = "solid",
                     .part = block.part,
                     .plastic = block.material.plastic(),
                     .hourglass = block.layout.n_points == 1 && !block.layout.tetrahedra(),
                     .viscous = true,
                     .damping = block.section.damping.given(),
                     .eroded = block.material.failure.given()};
    part.pass = [&scene, &block](const Step& step) {
      const ElementWork work = solid_pass(block, scene.nodes, step.dt_old);
      if (block.volume_ratio <= block.section.smallest_ratio) {
        if (!block.erodes) stop_at_collapsed(scene, block, step);
        erode_collapsed(block, scene.nodes.x);
      }
      return work;
    };
    part.stable_dt = [&block] { return stable_step(block); };
    part.limiting = [&block] { return block.limiting; };
    add_element_operation(root, scene, models, std::move(part));
  }
}

/// Hourglass control, where the case leaves it open.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  for (const Keys& part : parts_with(root, "solid")) {
    const Keys solid = part.map("solid");
    const int number = scene.part_number(part.name());
    if (number < 0) continue;
    if (!has_hourglass(solid, scene.parts[static_cast<std::size_t>(number)].cell)) continue;
    if (solid.has("hourglass") && solid.map("hourglass").has("type")) continue;
    const std::string name = solid.word("material");
    const bool plastic = read_elastic_plastic(root.map("materials").map(name)).plastic();
    list.push_back({solid.path() + ".hourglass.type", plastic ? "viscous" : "stiffness",
                    fmt::format("viscous where the material may yield, else stiffness; '{}' {}",
                                name, plastic ? "may" : "may not")});
  }
  return list;
}

}  // namespace solid
}  // namespace

Effect solid_effect() {
  return {.name = "solid",
          .schema = solid::schema,
          .parts = solid::add_parts,
          .state = solid::state,
          .operations = solid::operations,
          .choices = solid::choices};
}

}  // namespace gannet
