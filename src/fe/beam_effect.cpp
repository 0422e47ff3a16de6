// Beams as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "fe/beam.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mass_scaling.hpp"
#include "material/elastic_plastic.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/mesh_keys.hpp"

namespace gannet {

namespace {

std::vector<Key> beam_keys() {
  return {{.name = "material",
           .kind = Kind::reference,
           .text = "solid that the beams are made of; they stay elastic",
           .required = true,
           .refers_to = "materials"},
          {.name = "section",
           .kind = Kind::map,
           .text = "shape of the section, about its own axes y and z",
           .required = true,
           .keys = beam_section_keys()},
          {.name = "up",
           .kind = Kind::vector,
           .text = "direction near which z of the section lies; unless said the z axis, and x for "
                   "elements along that"},
          {.name = "rotary_inertia",
           .text = "rotary inertia of nodes over m max(I)/A; unless said the least one, from 1 on, "
                   "with which rotations do not limit the step",
           .limits = positive()},
          {.name = "dt_factor",
           .text = "share of the stable step of the elements that is used",
           .fallback = "0.9",
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

Schema schema() {
  return element_schema("beam", "the part is a line of beam elements", beam_keys());
}

void add_parts(const Keys& root, Draft& draft) {
  for (const Keys& part : parts_with(root, "beam")) {
    if (draft.dimension != 3) {
      part.complain("beam", "beams need three dimensions");
      continue;
    }
    const LineMesh mesh = line_mesh(part);
    if (mesh.empty()) continue;  // the mesh has complained
    PartDraft p = element_draft(part, "beam", Cell::line, true);
    set_mesh(part, mesh.points, mesh.cells, p);
    draft.parts.push_back(std::move(p));
  }
}

BeamLaw read_law(const Keys& root, const Keys& beam, Scene& scene) {
  const ElasticPlastic material = read_but_rubber(root, beam);
  if (material.plastic()) {
    scene.warnings.push_back(
        fmt::format("{}: beams stay elastic; the yield stress of '{}' is not "
                    "looked at",
                    beam.path(), beam.word("material")));
  }
  return {.section = read_beam_section(beam.map("section")),
          .E = material.E,
          .G = material.G(),
          .rho = material.rho,
          .rotary_inertia = beam.number_or("rotary_inertia", 0),
          .dt_factor = beam.number("dt_factor")};
}

/// What a pass takes from the level before is tracked; section forces are shown.
void track(Scene& scene, BeamBlock& block) {
  const auto add = [&](Field field) {
    field.owner = "beam";
    scene.fields.push_back(std::move(field));
  };
  add(line_field(block.name + ".turned", "", "", Over::scene, block.turned, 0, 4, GhostRule::none));
  add(plain_field(block.name + ".energy", "J", "", Over::scene, block.energy, 1, GhostRule::none));
  Field forces = plain_field(block.name + ".forces", "N, N m", "SectionForces", Over::cells,
                             block.forces, 6, GhostRule::none);
  forces.owner = "beam";
  track_shown(scene, block.part, std::move(forces));
}

void scale_masses(const Keys& part, BeamBlock& block, Scene& scene) {
  if (!part.has("mass_scaling")) return;
  ScalableElements elements{
      .n_elements = block.n_elements(),
      .n_corners = 2,
      .dt_factor = block.law.dt_factor,
      .bounds = bounds_of(block),
      .mass = [&](Index e) -> CornerMass {
        const BeamNodeMass own = node_mass(block, e);
        return {own.m, own.I};
      },
      .corner = [&](Index e, int a) { return block.ends[static_cast<std::size_t>(2 * e + a)]; },
      .cell = [](Index e) { return e; },
      .inverse_mass = &block.inverse_mass};
  scale_masses(part, block.part, scene, {&elements, 1});
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : parts_with(root, "beam")) {
    const int number = scene.part_number(keys.name());
    if (number < 0) continue;
    const Keys beam = keys.map("beam");
    const BeamLaw law = read_law(root, beam, scene);
    if (!(law.section.A > 0)) continue;  // the section has complained
    const Vec3 up = beam.has("up") ? beam.vector("up") : Vec3::Zero();
    const Part& part = scene.parts[static_cast<std::size_t>(number)];
    auto& list = scene.store.get<BeamBlocks>().list;
    try {
      list.push_back(make_beam_block(part.connectivity, part.nodes, scene.nodes.x, law, up));
    } catch (const std::invalid_argument& e) {
      beam.complain(beam.has("up") ? "up" : "", e.what());
      continue;
    }
    BeamBlock& block = list.back();
    block.name = part.name;
    block.part = number;
    add_beam_masses(block, scene.nodes);
    scale_masses(keys, block, scene);
    track(scene, block);
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<BeamBlocks>()) return;
  for (BeamBlock& block : scene.store.get<BeamBlocks>().list) {
    ElementPart part{
        .kind = "beam", .part = block.part, .reads = {"x", "omega"}, .writes = {"f", "torque"}};
    part.pass = [&scene, &block](const Step& step) {
      return beam_pass(block, scene.nodes, step.dt_old);
    };
    part.stable_dt = [&block] { return stable_step(block); };
    part.limiting = [&block] { return block.limiting; };
    add_element_operation(root, scene, models, std::move(part));
  }
}

}  // namespace

Effect beam_effect() {
  return {.name = "beam",
          .schema = schema,
          .parts = add_parts,
          .state = state,
          .operations = operations};
}

}  // namespace gannet
