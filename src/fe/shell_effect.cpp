// Shells as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fe/effects.hpp"
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
  return {{.name = "material",
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
           .text = "element",
           .fallback = "belytschko_lin_tsay",
           .choices = {"belytschko_lin_tsay"}},
          {.name = "hourglass",
           .kind = Kind::map,
           .text = "control of the modes that one point of integration does not see",
           .keys = hourglass},
          {.name = "thickness_change",
           .kind = Kind::flag,
           .text = "the thickness follows the stretching of the shell",
           .fallback = "no"},
          {.name = "dt_factor",
           .text = "share of the stable step of the elements that is used",
           .fallback = "0.9",
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

Schema schema() {
  Schema s = elastic_plastic_schema();
  for (const SchemaEntry& entry : mesh_schema()) s.push_back(entry);
  s.push_back({"parts.*",
               {.name = "shell",
                .kind = Kind::map,
                .text = "the part is made of 4-node shells",
                .keys = shell_keys()}});
  s.push_back({"parts.*", initial_velocity_key()});
  return s;
}

/// The parts that are made of shells, in file order.
std::vector<Keys> shell_parts(const Keys& root) {
  std::vector<Keys> parts;
  if (!root.has("parts")) return parts;
  for (const std::string& name : root.map("parts").names()) {
    const Keys part = root.map("parts").map(name);
    if (part.has("shell")) parts.push_back(part);
  }
  return parts;
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : shell_parts(root)) {
    if (draft.dimension != 3) {
      part.complain("shell", "4-node shells need three dimensions");
      continue;
    }
    const SurfaceMesh mesh = surface_mesh(part);
    if (mesh.empty()) continue;  // the mesh has complained
    PartDraft p;
    p.name = part.name();
    p.kind = "shell";
    p.material = part.map("shell").word("material");
    p.where = part.where();
    p.rotations = true;
    p.cell = Cell::quad;
    p.points = mesh.points;
    p.connectivity = mesh.quads;
    p.velocity = initial_velocity(part, p.points);
    draft.parts.push_back(std::move(p));
  }
}

ShellSection read_section(const Keys& shell, const ElasticPlastic& material) {
  ShellSection section;
  section.thickness = shell.number("thickness");
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
  section.dt_factor = shell.number_or("dt_factor", section.dt_factor);
  return section;
}

/// Numbers first, first + 1, ... of the elements as a tracked field of the part.
Field state_field(const std::string& name, const std::string& unit, ShellBlock& block, int first,
                  int components) {
  const std::ptrdiff_t lane = sizeof(double);
  return {.name = name,
          .unit = unit,
          .over = Over::cells,
          .part = block.part,
          .components = components,
          .layout = {.block_stride = block.layout.n_values() * 8 * lane,
                     .entry_stride = lane,
                     .component_stride = 8 * lane,
                     .lanes = 8},
          .owner = "shell",
          .base =
              [&block, first, lane] {
                return reinterpret_cast<std::byte*>(block.state.data()) + first * 8 * lane;
              },
          .count = [&block] { return block.n_elements; }};
}

/// The whole state for checkpoints; for output, what is derived from it when it is asked for.
void track(Scene& scene, ShellBlock& block) {
  scene.fields.push_back(state_field(block.name + ".state", "", block, 0, block.layout.n_values()));
  Field thickness = state_field(block.name + ".thickness", "m", block, block.layout.thickness(), 1);
  thickness.vtk = "Thickness";
  thickness.checkpoint = false;
  scene.fields.push_back(std::move(thickness));
  const auto track_shown = [&](Field field) {
    field.part = block.part;
    field.owner = "shell";
    field.checkpoint = false;
    field.resize = nullptr;
    scene.fields.push_back(std::move(field));
  };
  const auto n = static_cast<std::size_t>(block.n_elements);
  block.stress_shown.assign(6 * n, 0);
  Field stress = plain_field(block.name + ".stress", "Pa", "Stress", Over::cells,
                             block.stress_shown, 6, GhostRule::none);
  stress.prepare = [&scene, &block] { show_stress(block, scene.nodes.x); };
  track_shown(std::move(stress));
  if (!block.material.plastic()) return;
  block.plastic_shown.assign(n, 0);
  Field eps_p = plain_field(block.name + ".plastic_strain", "", "PlasticStrain", Over::cells,
                            block.plastic_shown, 1, GhostRule::none);
  eps_p.prepare = [&block] { show_plastic_strain(block); };
  track_shown(std::move(eps_p));
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : shell_parts(root)) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    const ElasticPlastic material = read_elastic_plastic(root.map("materials").map(part.material));
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

/// "panel: element 1207 at (0.1, 0.2, 0)"
std::string text_of_element(const Scene& scene, const ShellBlock& block, Index element) {
  if (element < 0) return block.name;
  const Part& part = scene.parts[static_cast<std::size_t>(block.part)];
  const auto e = static_cast<std::size_t>(element);
  Vec3 centre = Vec3::Zero();
  for (std::size_t a = 0; a < 4; ++a) {
    centre += 0.25 * xyz(scene.nodes.x[static_cast<std::size_t>(part.connectivity[4 * e + a])]);
  }
  return fmt::format("{}: element {} at ({:.4g}, {:.4g}, {:.4g})", block.name, part.cell_id[e],
                     centre.x(), centre.y(), centre.z());
}

std::vector<Vote> smallest_votes(const Scene& scene, const ShellBlock& block, std::size_t n) {
  std::vector<Vote> votes;
  for (const ElementStep& s : smallest_steps(block, scene.nodes, n)) {
    votes.push_back({s.dt, text_of_element(scene, block, s.element)});
  }
  return votes;
}

/// Points through the thickness, where the case leaves them open.
std::vector<Choice> choices(const Keys& root, Scene&) {
  std::vector<Choice> list;
  for (const Keys& part : shell_parts(root)) {
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
    LedgerEntry* internal = &models.ledger.entry("internal", block.name);
    LedgerEntry* hourglass = &models.ledger.entry("hourglass", block.name);
    LedgerEntry* plastic = nullptr;
    if (block.material.plastic()) {
      plastic = &models.ledger.entry("plastic", block.name);
      plastic->within_other = true;
    }
    const auto pass = [&scene, &block, internal, hourglass, plastic](const Step& step) {
      const ShellWork work = shell_pass(block, scene.nodes, step.dt_old);
      internal->value += work.internal;
      hourglass->value += work.hourglass;
      if (plastic != nullptr) plastic->value += work.plastic;
    };
    models.of_part(scene, block.part)
        .plan.add({.name = "shell " + block.name,
                   .reason = asked_for_at(root.map("parts").map(block.name).where("shell")),
                   .stage = Stage::force,
                   .reads = {"x", "v", "omega"},
                   .writes = {"f", "torque"},
                   .owns = {block.name + ".state"},
                   .run = pass,
                   .stable_dt = [&block] { return stable_step(block); },
                   .limited_by = [&scene,
                                  &block] { return text_of_element(scene, block, block.limiting); },
                   .smallest = [&scene, &block](
                                   std::size_t n) { return smallest_votes(scene, block, n); }});
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
