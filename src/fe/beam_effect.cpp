// Beams as a part of a case: keys, drafts, state and operations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fe/beam.hpp"
#include "fe/beam_inertia.hpp"
#include "fe/beam_mass.hpp"
#include "fe/beam_releases.hpp"
#include "fe/beam_shown.hpp"
#include "fe/beam_turns.hpp"
#include "fe/effects.hpp"
#include "fe/element_part.hpp"
#include "fe/mass_scaling.hpp"
#include "material/elastic_plastic.hpp"
#include "mesh/line_shapes.hpp"
#include "mesh/mesh_keys.hpp"
#include "scene/node_set.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace beam {

std::vector<Key> own_keys() {
  return {{.name = "material",
           .kind = Kind::reference,
           .text = "solid that the beams are made of; where it yields, its fibres do",
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
           .text = "rotary inertia of nodes about the axes across over that of the section; unless "
                   "said the least one, from 1 on, with which rotations do not limit the step",
           .limits = positive()},
          {.name = "dt_factor",
           .text = "share of the stable step of the elements that is used",
           .fallback = "0.9",
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

/// releases.NAME: {nodes, axes}
Key releases_key() {
  Key one{.name = "*",
          .kind = Kind::map,
          .text = "a hinge: moments at these nodes that vanish",
          .keys = {node_set_key("nodes", true),
                   {.name = "axes",
                    .kind = Kind::names,
                    .text = "axes of the section: x along the beam, y, z across",
                    .required = true,
                    .choices = {"x", "y", "z"}}}};
  return {.name = "releases",
          .kind = Kind::map,
          .text =
              "hinges: of the elements that meet at a node all but the last are released there, "
              "and the only one at the end of a line",
          .keys = {one}};
}

std::vector<Key> beam_keys() {
  std::vector<Key> keys = own_keys();
  for (Key& key : stiffness_damping_keys()) keys.push_back(std::move(key));
  keys.push_back(releases_key());
  return keys;
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

/// The law of the fibres.
UniaxialLaw read_yield(const Keys& beam, const ElasticPlastic& material, const BeamSection& section,
                       Scene& scene) {
  if (!material.plastic()) return {};
  if (!section.fibres.empty()) return uniaxial_law(material);
  if (section.A > 0) {
    scene.warnings.push_back(fmt::format(
        "{}: a section without a shape stays elastic, whatever the yield stress of '{}'",
        beam.path(), beam.word("material")));
  }
  return {};
}

BeamLaw read_law(const Keys& root, const Keys& beam, Scene& scene) {
  const ElasticPlastic material = read_but_rubber(root, beam);
  const BeamSection section = read_beam_section(beam.map("section"));
  return {.section = section,
          .E = material.E,
          .G = material.G(),
          .rho = material.rho,
          .rotary_inertia = beam.number_or("rotary_inertia", 0),
          .dt_factor = beam.number("dt_factor"),
          .yield = read_yield(beam, material, section, scene),
          .damping = read_stiffness_damping(beam)};
}

/// Releases the ends that the case names.
void read_releases(const Keys& beam, const Scene& scene, BeamBlock& block) {
  if (!beam.has("releases")) return;
  const Keys releases = beam.map("releases");
  for (const std::string& name : releases.names()) {
    const Keys one = releases.map(name);
    if (!one.has("nodes") || !one.has("axes")) continue;  // the reader has complained
    unsigned axes = 0;
    for (const std::string& axis : one.words("axes")) {
      axes |= axis == "x" ? 1U : (axis == "y" ? 2U : 4U);
    }
    for (const Index node : select_nodes(one.map("nodes"), scene)) {
      if (release(block, node, axes)) continue;
      one.complain("nodes", "names nodes of another part");
      break;
    }
  }
}

/// What a pass takes from the level before is tracked; section forces are shown.
void track(Scene& scene, BeamBlock& block) {
  const auto add = [&](Field field) {
    field.owner = "beam";
    scene.fields.push_back(std::move(field));
  };
  add(line_field(block.name + ".turned", "", "", Over::scene, block.turned, 0, 4, GhostRule::none));
  add(plain_field(block.name + ".energy", "J", "", Over::scene, block.energy, 1, GhostRule::none));
  const auto per_element = [&](const char* name, Array<double>& values, std::size_t n) {
    if (values.empty()) return;
    add(plain_field(block.name + name, "", "", Over::scene, values, static_cast<int>(n),
                    GhostRule::none));
  };
  per_element(".fibres", block.fibres, fibre_values(block.law.section, block.law.yield));
  per_element(".gone", block.gone, 1);
  per_element(".last", block.last, 14);
  per_element(".damping", block.damping_last, 14);
  if (block.law.yield.yields()) {
    show_plastic_strain(block);
    Field shown = plain_field(block.name + ".plastic_strain", "", "PlasticStrain", Over::cells,
                              block.plastic_shown, 1, GhostRule::none);
    shown.owner = "beam";
    shown.prepare = [&block] { show_plastic_strain(block); };
    track_shown(scene, block.part, std::move(shown));
  }
  if (!block.gone.empty()) {
    show_damage(block);
    Field shown = plain_field(block.name + ".damage", "", "Damage", Over::cells, block.damage_shown,
                              1, GhostRule::none);
    shown.owner = "beam";
    shown.prepare = [&block] { show_damage(block); };
    track_shown(scene, block.part, std::move(shown));
    scene.measures.push_back({"beam." + block.name + ".eroded", "", {"value"}, [&block](double* n) {
                                *n = static_cast<double>(
                                    std::count(block.gone.begin(), block.gone.end(), 1.0));
                              }});
  }
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
        return {own.m, own.largest()};
      },
      .corner = [&](Index e, int a) { return block.ends[static_cast<std::size_t>(2 * e + a)]; },
      .cell = [](Index e) { return e; },
      .inverse_mass = &block.inverse_mass};
  scale_masses(part, block.part, scene, {&elements, 1});
}

/// Outer radius of the round tube of the same area and mean second moment [m]:
/// I = A (R^2 + r^2)/4 and A = pi (R^2 - r^2) give R^2 = 2 I/A + A/(2 pi).
double radius_of(const BeamSection& section) {
  constexpr double pi = 3.14159265358979323846;
  const double I = 0.5 * (section.I_y + section.I_z);
  return std::sqrt(2 * I / section.A + section.A / (2 * pi));
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
    prepare_damping(block);
    read_releases(beam, scene, block);
    scale_masses(keys, block, scene);
    track(scene, block);
    auto& surfaces = scene.store.get<SurfaceData>().of_part;
    surfaces.resize(std::max(surfaces.size(), scene.parts.size()));
    surfaces[static_cast<std::size_t>(number)].thickness = 2 * radius_of(law.section);
    surfaces[static_cast<std::size_t>(number)].axial = law.E * law.section.A;
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<BeamBlocks>()) return;
  for (BeamBlock& block : scene.store.get<BeamBlocks>().list) {
    ElementPart part{.kind = "beam",
                     .part = block.part,
                     .reads = {"x", "omega"},
                     .writes = {"f", "torque"},
                     .plastic = block.law.yield.yields(),
                     .damping = block.law.damping.given(),
                     .eroded = block.law.yield.fails()};
    part.pass = [&scene, &block](const Step& step) {
      return beam_pass(block, scene.nodes, step.dt_old);
    };
    part.stable_dt = [&block] { return stable_step(block); };
    part.limiting = [&block] { return block.limiting; };
    add_element_operation(root, scene, models, std::move(part));
    add_turns_elsewhere(scene, block, models);
    if (!scene.parts[static_cast<std::size_t>(block.part)].rigid) {
      add_beam_inertia(scene, block, models);
    }
  }
}

}  // namespace beam
}  // namespace

Effect beam_effect() {
  return {.name = "beam",
          .schema = beam::schema,
          .parts = beam::add_parts,
          .state = beam::state,
          .operations = beam::operations};
}

}  // namespace gannet
