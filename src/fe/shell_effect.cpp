// Shells as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mass_scaling.hpp"
#include "fe/shell.hpp"
#include "fe/shell_fibres.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {

std::vector<Key> own_keys() {
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
      {.name = "collapse",
       .kind = Kind::choice,
       .text = "what happens where an element has shrunk to nothing or turned inside out",
       .fallback = "stop",
       .choices = {"stop", "erode"}},
      {.name = "collapse_ratio",
       .text = "area over area at the start at which an element has collapsed",
       .fallback = "0.01",
       .limits = {.lowest = 0, .highest = 1, .lowest_open = true, .highest_open = true}},
      {.name = "offset",
       .unit = dim::length,
       .text = "distance of the middle of the shell from its nodes, along the normals",
       .fallback = "0"},
      {.name = "section_forces",
       .kind = Kind::flag,
       .text = "show membrane forces, bending moments and shear forces in VTK",
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

std::vector<Key> shell_keys() {
  std::vector<Key> keys = own_keys();
  for (Key& key : stiffness_damping_keys()) keys.push_back(std::move(key));
  return keys;
}

Schema schema() {
  return element_schema(
      "shell", "the part is made of 4-node shells, and of 3-node ones where it has triangles",
      shell_keys());
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, "shell")) {
    if (draft.dimension != 3) {
      part.complain("shell", "shells need three dimensions");
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
  section.offset = shell.number_or("offset", 0);
  section.damping = read_stiffness_damping(shell);
  section.smallest_ratio = shell.number_or("collapse_ratio", section.smallest_ratio);
  section.thickness_changes = shell.has("thickness_change") && shell.flag("thickness_change");
  section.warping = !shell.has("warping") || shell.flag("warping");
  section.dt_factor = shell.number_or("dt_factor", section.dt_factor);
  return section;
}

/// The blocks of a part, one for each kind of element it has, and what output shows of it, by cell.
struct ShellPart {
  std::string name;
  int part = -1;
  bool erodes = false;  ///< elements that have collapsed leave; else they stop the run
  std::vector<ShellBlock*> blocks;
  Array<double> thickness, stress, plastic, damage;
  std::vector<std::uint8_t> gone;  ///< per cell whether it has left; empty where none can
  Array<double> membrane_force, moment, shear_force;
};

/// Found by scene.store.
struct ShellParts {
  std::deque<ShellPart> list;
};

/// Copies numbers first, first + 1, ... of the `stride` that an element has in `from` to its cell.
void show_by_cell(const ShellBlock& block, const Array<double>& from, std::size_t stride,
                  std::size_t first, std::size_t components, Array<double>& to) {
  for (Index e = 0; e < block.n_elements; ++e) {
    const auto element = static_cast<std::size_t>(e);
    const auto cell = static_cast<std::size_t>(block.cell(e));
    for (std::size_t k = 0; k < components; ++k) {
      to[components * cell + k] = from[stride * element + first + k];
    }
  }
}

/// A field over the cells of a part that prepare() fills.
void add_shown(Scene& scene, const ShellPart& part, const char* name, const char* unit,
               const char* vtk, Array<double>& values, int components,
               std::function<void(ShellBlock&)> prepare) {
  const auto n_cells =
      static_cast<std::size_t>(scene.parts[static_cast<std::size_t>(part.part)].n_cells());
  values.assign(static_cast<std::size_t>(components) * n_cells, 0);
  Field field =
      plain_field(part.name + name, unit, vtk, Over::cells, values, components, GhostRule::none);
  field.owner = "shell";
  field.prepare = [&part, prepare] {
    for (ShellBlock* block : part.blocks) prepare(*block);
  };
  track_shown(scene, part.part, std::move(field));
}

void track_section_forces(Scene& scene, ShellPart& part) {
  const auto add = [&](const char* name, const char* unit, const char* vtk, Array<double>& values,
                       std::size_t first, std::size_t components) {
    add_shown(scene, part, name, unit, vtk, values, static_cast<int>(components),
              [&scene, &values, first, components](ShellBlock& block) {
                show_section_forces(block, scene.nodes.x);
                show_by_cell(block, block.forces_shown, 15, first, components, values);
              });
  };
  add(".membrane_force", "N/m", "MembraneForce", part.membrane_force, 0, 6);
  add(".bending_moment", "N", "BendingMoment", part.moment, 6, 6);
  add(".shear_force", "N/m", "ShearForce", part.shear_force, 12, 3);
}

void count_eroded(Scene& scene, const ShellPart& part) {
  scene.measures.push_back(
      {"shell." + part.name + ".eroded", "", {"value"}, [&part](double* n_out) {
         *n_out = 0;
         for (const ShellBlock* block : part.blocks) *n_out += n_eroded(*block);
       }});
}

/// The whole states for checkpoints; for output, what is derived from them when it is asked for.
void track(Scene& scene, ShellPart& part, bool section_forces) {
  for (ShellBlock* block : part.blocks) {
    const int n_values = block->layout.n_values();
    const char* name = block == part.blocks.front() ? ".state" : ".triangles.state";
    Field whole = element_field(part.name + name, "", part.part, block->state, n_values, 0,
                                n_values, [block] { return block->n_elements; });
    whole.owner = "shell";
    scene.fields.push_back(std::move(whole));
  }
  add_shown(scene, part, ".thickness", "m", "Thickness", part.thickness, 1,
            [&part](ShellBlock& block) {
              for (Index e = 0; e < block.n_elements; ++e) {
                part.thickness[static_cast<std::size_t>(block.cell(e))] =
                    block.value(e, block.layout.thickness());
              }
            });
  scene.fields.back().prepare();  // known from the start, and cheap
  add_shown(scene, part, ".stress", "Pa", "Stress", part.stress, 6,
            [&scene, &part](ShellBlock& block) {
              show_stress(block, scene.nodes.x);
              show_by_cell(block, block.stress_shown, 6, 0, 6, part.stress);
            });
  if (section_forces) track_section_forces(scene, part);
  if (part.erodes || part.blocks.front()->material.failure.given()) count_eroded(scene, part);
  if (!part.blocks.front()->material.plastic()) return;
  add_shown(scene, part, ".plastic_strain", "", "PlasticStrain", part.plastic, 1,
            [&part](ShellBlock& block) {
              show_plastic_strain(block);
              show_by_cell(block, block.plastic_shown, 1, 0, 1, part.plastic);
            });
  if (!part.blocks.front()->material.failure.given()) return;
  add_shown(scene, part, ".damage", "", "Damage", part.damage, 1, [&part](ShellBlock& block) {
    show_damage(block);
    show_by_cell(block, block.damage_shown, 1, 0, 1, part.damage);
  });
}

/// The cells of one kind out of those of a part: quadrilaterals, or triangles, which repeat their
/// last node.
struct Cells {
  std::vector<Index> number, connectivity;
  std::vector<Vec3> fibre;
};

Cells cells_of(const Part& part, const std::vector<Vec3>& fibre, bool triangles) {
  Cells cells;
  for (std::size_t k = 0; k < part.connectivity.size(); k += 4) {
    if ((part.connectivity[k + 2] == part.connectivity[k + 3]) != triangles) continue;
    cells.number.push_back(static_cast<Index>(k / 4));
    for (std::size_t a = 0; a < (triangles ? 3 : 4); ++a) {
      cells.connectivity.push_back(part.connectivity[k + a]);
      cells.fibre.push_back(fibre[k + a]);
    }
  }
  return cells;
}

/// Throws std::invalid_argument that names the first cell of the part without an area.
void require_areas(const Part& part, const Nodes& nodes) {
  for (Index c = 0; c < part.n_cells(); ++c) {
    const auto x = [&](Index a) {
      return xyz(nodes.x[static_cast<std::size_t>(part.connectivity[4 * c + a])]);
    };
    if ((x(2) - x(0)).cross(x(3) - x(1)).norm() > 0) continue;
    throw std::invalid_argument("element " + std::to_string(c + 1) + " has no area");
  }
}

/// What has no meaning where every cell is a triangle.
void refuse_for_triangles(const Keys& given, const ShellPart& shell) {
  if (shell.blocks.front()->section.kind != ShellKind::triangle) return;
  for (const char* key : {"hourglass", "warping"}) {
    if (given.given(key)) {
      given.complain(key,
                     "has no meaning: all cells of the part are triangles, which know the "
                     "surface around them and have no modes that they do not see");
    }
  }
}

/// Makes the blocks of a part. Throws std::invalid_argument as make_shell_block().
void make_blocks(Scene& scene, const ElasticPlastic& material, ShellSection section,
                 ShellPart& shell) {
  const Part& part = scene.parts[static_cast<std::size_t>(shell.part)];
  require_areas(part, scene.nodes);
  const std::vector<Vec3> fibre = fibres_of(part.connectivity, scene.nodes.x);
  for (const bool triangles : {false, true}) {
    const Cells cells = cells_of(part, fibre, triangles);
    if (cells.number.empty()) continue;
    if (triangles) section.kind = ShellKind::triangle;
    auto& blocks = scene.store.get<ShellBlocks>().list;
    blocks.push_back(make_shell_block(cells.connectivity, scene.nodes.x, material, section,
                                      shell_chunk, cells.fibre));
    ShellBlock& block = blocks.back();
    block.name = part.name;
    block.part = shell.part;
    block.cells = cells.number;
    add_shell_masses(block, scene.nodes);
    prepare_damping(block, scene.nodes);
    shell.blocks.push_back(&block);
  }
}

void scale_masses(const Keys& part, const ShellPart& shell, Scene& scene) {
  if (!part.has("mass_scaling")) return;
  std::vector<ScalableElements> blocks;
  for (ShellBlock* block : shell.blocks) {
    const int n_corners = block->n_corners();
    blocks.push_back(
        {.n_elements = block->n_elements,
         .n_corners = n_corners,
         .dt_factor = block->section.dt_factor,
         .bounds = bounds_of(*block, scene.nodes),
         .mass = [block](Index e) -> CornerMass {
           const double m = corner_mass(*block, e);
           return {m, corner_alpha(*block, e) * m};
         },
         .corner = [block, n_corners](Index e,
                                      int a) { return corner_of(block->corners, n_corners, e, a); },
         .cell = [block](Index e) { return block->cell(e); },
         .inverse_mass = &block->inverse_mass});
  }
  scale_masses(part, shell.part, scene, blocks);
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, "shell")) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    const Keys given = keys.map("shell");
    const ElasticPlastic material = read_but_rubber(root, given);
    const ShellSection section = read_section(given, material);
    ShellPart& shell = scene.store.get<ShellParts>().list.emplace_back();
    shell.name = part.name;
    shell.part = number;
    shell.erodes = given.has("collapse") && given.word("collapse") == "erode";
    try {
      make_blocks(scene, material, section, shell);
    } catch (const std::invalid_argument& e) {
      keys.complain("shell", e.what());
      scene.store.get<ShellParts>().list.pop_back();
      continue;
    }
    refuse_for_triangles(given, shell);
    scale_masses(keys, shell, scene);
    track(scene, shell, given.has("section_forces") && given.flag("section_forces"));
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    if (shell.erodes || material.failure.given())
      shell.gone.assign(static_cast<std::size_t>(part.n_cells()), 0);
    surfaces[static_cast<std::size_t>(number)] = {
        .thickness = section.thickness,
        .young = material.E,
        .offset = section.offset,
        .gone = shell.gone.empty() ? nullptr : &shell.gone};
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

/// The block whose elements allow the smallest step.
const ShellBlock& stiffest(const ShellPart& part) {
  return **std::min_element(
      part.blocks.begin(), part.blocks.end(),
      [](const ShellBlock* a, const ShellBlock* b) { return stable_step(*a) < stable_step(*b); });
}

/// Notes which cells have left, for those who push on them.
void mark_gone(ShellPart& part) {
  if (part.gone.empty()) return;
  for (const ShellBlock* block : part.blocks) {
    parallel_for(block->n_elements, node_chunk, [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) {
        const bool left = block->value(e, block->layout.thickness()) == 0;
        part.gone[static_cast<std::size_t>(block->cell(e))] = left ? 1 : 0;
      }
    });
  }
}

/// Stops the run at an element that has collapsed, with its name.
[[noreturn]] void stop_at_collapsed(const Scene& scene, const ShellBlock& block, const Step& step) {
  throw RunError(RunFailure{
      fmt::format("an element has collapsed: its area is {:.3g} of that at the start",
                  block.area_ratio),
      text_of_element(scene, block.part, block.cell(block.smallest)),
      fmt::format("at t = {:.6g} s, step {}; the limit is parts.{}.shell.collapse_ratio = {:g}",
                  step.t, step.n, block.name, block.section.smallest_ratio),
      "let such elements go (collapse: erode), take a finer mesh where it is crushed, or look for "
      "a "
      "load or contact that is too stiff"});
}

ElementWork pass_over_part(ShellPart& part, Scene& scene, const Step& step) {
  ElementWork sum;
  for (ShellBlock* block : part.blocks) {
    const ElementWork work = shell_pass(*block, scene.nodes, step.dt_old);
    if (block->area_ratio <= block->section.smallest_ratio) {
      if (!part.erodes) stop_at_collapsed(scene, *block, step);
      erode_collapsed(*block, scene.nodes.x);
    }
    sum.internal += work.internal;
    sum.plastic += work.plastic;
    sum.hourglass += work.hourglass;
    sum.damping += work.damping;
    sum.eroded += work.eroded;
  }
  mark_gone(part);
  return sum;
}

std::vector<ElementStep> smallest_steps_of_part(const ShellPart& part, const Nodes& nodes,
                                                std::size_t n) {
  std::vector<ElementStep> steps;
  for (const ShellBlock* block : part.blocks) {
    for (const ElementStep& s : smallest_steps(*block, nodes, n)) {
      steps.push_back({s.dt, block->cell(s.element)});
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const ElementStep& a, const ElementStep& b) { return a.dt < b.dt; });
  steps.resize(std::min(n, steps.size()));
  return steps;
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<ShellParts>()) return;
  for (ShellPart& shell : scene.store.get<ShellParts>().list) {
    const ShellBlock& first = *shell.blocks.front();
    ElementPart part{.kind = "shell",
                     .part = shell.part,
                     .reads = {"x", "v", "omega"},
                     .writes = {"f", "torque"},
                     .plastic = first.material.plastic(),
                     .hourglass = first.section.kind == ShellKind::one_point,
                     .damping = first.section.damping.given(),
                     .eroded = first.material.failure.given()};
    part.pass = [&scene, &shell](const Step& step) { return pass_over_part(shell, scene, step); };
    part.stable_dt = [&shell] { return stable_step(stiffest(shell)); };
    part.limiting = [&shell] {
      const ShellBlock& block = stiffest(shell);
      return block.cell(block.limiting);
    };
    part.smallest = [&scene, &shell](std::size_t n) {
      return smallest_steps_of_part(shell, scene.nodes, n);
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
