// Shells as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/shell.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {

std::vector<Key> shell_keys() {
  const std::vector<Key> hourglass{
      {.name = "type",
       .kind = Kind::choice,
       .text = "stiffness: an elastic force that remembers; viscous: a damping force",
       .fallback = "stiffness",
       .choices = {"stiffness", "viscous"}},
      {.name = "coefficient",
       .text = "strength of the hourglass control, customarily 0.01 to 0.05",
       .fallback = "0.03",
       .limits = between(0, 0.15)}};
  return {
      {.name = "material",
       .kind = Kind::reference,
       .text = "solid that the shell is made of",
       .required = true,
       .refers_to = "materials"},
      {.name = "thickness",
       .unit = dim::length,
       .text = "thickness of the shell",
       .required = true,
       .limits = positive()},
      {.name = "points",
       .kind = Kind::integer,
       .text = "points through the thickness; unless said 5, or 3 where the solid is elastic",
       .limits = between(1, max_shell_points)},
      {.name = "formulation",
       .kind = Kind::choice,
       .text = "belytschko_lin_tsay: one point in the plane, fast, with hourglass control; "
               "fully_integrated: 2 x 2 points and assumed shear, accurate",
       .fallback = "belytschko_lin_tsay",
       .choices = {"belytschko_lin_tsay", "fully_integrated"}},
      {.name = "hourglass",
       .kind = Kind::map,
       .text = "control of the modes that one point of integration does not see",
       .keys = hourglass},
      {.name = "thickness_change",
       .kind = Kind::flag,
       .text = "the thickness follows the stretching of the shell",
       .fallback = "no"},
      {.name = "warping",
       .kind = Kind::flag,
       .text = "elements whose corners lie in no plane bend as they should (warping correction)",
       .fallback = "yes"},
      {.name = "dt_factor",
       .text = "share of the stable step of the elements that is used",
       .fallback = "0.9",
       .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

Schema schema() {
  return element_schema("shell", "the part is made of 4-node shells", shell_keys());
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, "shell")) {
    if (draft.dimension != 3) {
      part.complain("shell", "4-node shells need three dimensions");
      continue;
    }
    const SurfaceMesh mesh = surface_mesh(part);
    if (mesh.empty()) continue;  // the mesh has complained
    PartDraft p = element_draft(part, "shell", Cell::quad, true);
    set_mesh(part, mesh.points, mesh.quads, p);
    draft.parts.push_back(std::move(p));
  }
}

ShellSection read_section(const Keys& shell, const ElasticPlastic& material) {
  ShellSection section;
  section.thickness = shell.number("thickness");
  if (shell.has("formulation") && shell.word("formulation") == "fully_integrated") {
    section.kind = ShellKind::quad;
    for (const char* key : {"hourglass", "warping"}) {
      if (shell.given(key)) {
        shell.complain(key, "has no meaning where shells are fully integrated");
      }
    }
  }
  section.points = shell.has("points") ? shell.integer("points") : (material.plastic() ? 5 : 3);
  if (shell.has("hourglass")) {
    const Keys hourglass = shell.map("hourglass");
    if (hourglass.has("type") && hourglass.word("type") == "viscous") {
      section.hourglass = HourglassForm::viscous;
    }
    section.hourglass_coefficient =
        hourglass.number_or("coefficient", section.hourglass_coefficient);
  }
  section.thickness_changes = shell.has("thickness_change") && shell.flag("thickness_change");
  section.warping = !shell.has("warping") || shell.flag("warping");
  section.dt_factor = shell.number_or("dt_factor", section.dt_factor);
  return section;
}

/// Numbers of the state of a block, from `first` on.
Field state_field(const std::string& name, const std::string& unit, ShellBlock& block, int first,
                  int components) {
  Field field = element_field(name, unit, block.part, block.state, block.layout.n_values(), first,
                              components, [&block] { return block.n_elements; });
  field.owner = "shell";
  return field;
}

/// The whole state for checkpoints; for output, what is derived from it when it is asked for.
void track(Scene& scene, ShellBlock& block) {
  scene.fields.push_back(state_field(block.name + ".state", "", block, 0, block.layout.n_values()));
  Field thickness = state_field(block.name + ".thickness", "m", block, block.layout.thickness(), 1);
  thickness.vtk = "Thickness";
  thickness.checkpoint = false;
  scene.fields.push_back(std::move(thickness));
  const auto n = static_cast<std::size_t>(block.n_elements);
  block.stress_shown.assign(6 * n, 0);
  Field stress = plain_field(block.name + ".stress", "Pa", "Stress", Over::cells,
                             block.stress_shown, 6, GhostRule::none);
  stress.prepare = [&scene, &block] { show_stress(block, scene.nodes.x); };
  stress.owner = "shell";
  track_shown(scene, block.part, std::move(stress));
  if (!block.material.plastic()) return;
  block.plastic_shown.assign(n, 0);
  Field eps_p = plain_field(block.name + ".plastic_strain", "", "PlasticStrain", Over::cells,
                            block.plastic_shown, 1, GhostRule::none);
  eps_p.prepare = [&block] { show_plastic_strain(block); };
  eps_p.owner = "shell";
  track_shown(scene, block.part, std::move(eps_p));
  if (!block.material.failure.given()) return;
  block.damage_shown.assign(n, 0);
  Field damage = plain_field(block.name + ".damage", "", "Damage", Over::cells, block.damage_shown,
                             1, GhostRule::none);
  damage.prepare = [&block] { show_damage(block); };
  damage.owner = "shell";
  track_shown(scene, block.part, std::move(damage));
  scene.measures.push_back(
      {"shell." + block.name + ".eroded", "", {"value"}, [&block](double* n_out) {
         *n_out = n_eroded(block);
       }});
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, "shell")) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    const ElasticPlastic material = read_but_rubber(root, keys.map("shell"));
    const ShellSection section = read_section(keys.map("shell"), material);
    auto& blocks = scene.store.get<ShellBlocks>().list;
    try {
      blocks.push_back(make_shell_block(part.connectivity, scene.nodes.x, material, section));
    } catch (const std::invalid_argument& e) {
      keys.complain("shell", e.what());
      continue;
    }
    ShellBlock& block = blocks.back();
    block.name = part.name;
    block.part = number;
    add_shell_masses(block, scene.nodes);
    track(scene, block);
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    surfaces[static_cast<std::size_t>(number)] = {section.thickness, material.E};
  }
}

/// Points through the thickness, where the case leaves them open.
std::vector<Choice> choices(const Keys& root, Scene&) {
  std::vector<Choice> list;
  for (const Keys& part : parts_with(root, "shell")) {
    const Keys shell = part.map("shell");
    if (shell.has("points")) continue;
    const bool plastic =
        read_elastic_plastic(root.map("materials").map(shell.word("material"))).plastic();
    list.push_back({shell.path() + ".points", plastic ? "5" : "3",
                    fmt::format("5 points where the material may yield, else 3; '{}' {}",
                                shell.word("material"), plastic ? "may" : "may not")});
  }
  return list;
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<ShellBlocks>()) return;
  for (ShellBlock& block : scene.store.get<ShellBlocks>().list) {
    ElementPart part{.kind = "shell",
                     .part = block.part,
                     .reads = {"x", "v", "omega"},
                     .writes = {"f", "torque"},
                     .plastic = block.material.plastic(),
                     .hourglass = block.section.kind == ShellKind::one_point,
                     .eroded = block.material.failure.given()};
    part.pass = [&scene, &block](const Step& step) {
      return shell_pass(block, scene.nodes, step.dt_old);
    };
    part.stable_dt = [&block] { return stable_step(block); };
    part.limiting = [&block] { return block.limiting; };
    part.smallest = [&scene, &block](std::size_t n) {
      return smallest_steps(block, scene.nodes, n);
    };
    add_element_operation(root, scene, models, std::move(part));
  }
}

}  // namespace

Effect shell_effect() {
  return {.name = "shell",
          .schema = schema,
          .parts = add_parts,
          .state = state,
          .operations = operations,
          .choices = choices};
}

}  // namespace gannet
