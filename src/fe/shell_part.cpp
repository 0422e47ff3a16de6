#include "fe/shell_part.hpp"

#include <functional>
#include <utility>

#include "fe/element_part.hpp"
#include "fe/shell_shown.hpp"

namespace gannet {

namespace {

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

}  // namespace

void track_shells(Scene& scene, ShellPart& part, bool section_forces) {
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

}  // namespace gannet
