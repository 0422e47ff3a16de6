// Shells as a part of a case: drafts, state and operations.
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
#include "fe/shell_keys.hpp"
#include "fe/shell_part.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace shell {

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
    const ShellSection section = read_shell_section(given, material);
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
    track_shells(scene, shell, given.has("section_forces") && given.flag("section_forces"));
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

}  // namespace shell
}  // namespace

Effect shell_effect() {
  return {.name = "shell",
          .schema = shell::schema,
          .parts = shell::add_parts,
          .state = shell::state,
          .operations = shell::operations,
          .choices = shell::choices};
}

}  // namespace gannet
