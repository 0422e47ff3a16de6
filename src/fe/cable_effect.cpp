// Cables and trusses as a part of a case: keys, drafts, state and operations.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fe/cable_part.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mass_scaling.hpp"
#include "fe/truss.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace cable {

constexpr double pi = 3.14159265358979323846;

Schema schema() {
  return element_schema("cable", "the part is a line of cable or truss elements", cable_keys());
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, "cable")) {
    const LineMesh mesh = line_mesh(part);
    if (mesh.empty()) continue;  // the mesh has complained
    PartDraft p = element_draft(part, "cable", Cell::line, false);
    set_mesh(part, mesh.points, mesh.cells, p);
    draft.parts.push_back(std::move(p));
  }
}

void scale_masses(const Keys& part, TrussBlock& block, Scene& scene) {
  if (!part.has("mass_scaling")) return;
  ScalableElements elements{
      .n_elements = block.n_elements(),
      .n_corners = 2,
      .dt_factor = block.dt_factor,
      .bounds = bounds_of(block, scene.nodes),
      .mass = [&](Index e) -> CornerMass {
        return {0.5 * block.mu * block.value(e, truss_l0), 0};
      },
      .corner = [&](Index e, int a) { return block.ends[static_cast<std::size_t>(2 * e + a)]; },
      .cell = [](Index e) { return e; },
      .inverse_mass = &block.inverse_mass};
  scale_masses(part, block.part, scene, {&elements, 1});
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, "cable")) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    TrussBlock made;
    if (!read_cable(root, keys.map("cable"), made)) continue;
    TrussBlock& block = scene.store.get<TrussBlocks>().list.emplace_back(std::move(made));
    block.name = part.name;
    block.part = number;
    block.ends = part.connectivity;
    try {
      rest_at_present_length(block, scene.nodes);
    } catch (const std::invalid_argument& e) {
      keys.complain("cable", e.what());
      continue;
    }
    add_truss_masses(block, scene.nodes);
    scale_masses(keys, block, scene);
    track_cable(scene, block, "cable");
    add_cable_measures(scene, block);
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    ShellSurface& data = surfaces[static_cast<std::size_t>(number)];
    data.axial = block.EA;
    const Keys cable = keys.map("cable");
    if (cable.has("area")) data.thickness = 2 * std::sqrt(cable.number("area") / pi);
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<TrussBlocks>()) return;
  for (TrussBlock& block : scene.store.get<TrussBlocks>().list) {
    add_cable_operation(root, scene, models, block, "");
  }
}

}  // namespace cable
}  // namespace

Effect cable_effect() {
  return {.name = "cable",
          .schema = cable::schema,
          .parts = cable::add_parts,
          .state = cable::state,
          .operations = cable::operations};
}

}  // namespace gannet
