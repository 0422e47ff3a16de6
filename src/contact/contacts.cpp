// The effect `contacts`: what the case file says of contacts, and which contacts follow from it.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <vector>

#include "contact/effects.hpp"
#include "contact/node_to_segment.hpp"
#include "contact/part_kinds.hpp"
#include "plan/model_of_part.hpp"
#include "scene/particle_material.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace contacts {

/// The share of E t that a penalty may have: a spring on a node is then softer than the shell's
/// own membrane (about E t), and does not decide its time step.
constexpr double share_of_membrane = 0.1;

Schema schema() {
  const std::string path = "contacts.*";
  Key between{.name = "between",
              .kind = Kind::names,
              .text =
                  "two parts: particles and shells, or both of elements; or a part of "
                  "elements and a boundary's planes",
              .required = true};
  Key type{.name = "type",
           .kind = Kind::choice,
           .text =
               "node_to_segment: a penalty normal to surfaces; kernel: a potential between "
               "particles and nodes",
           .fallback = "node_to_segment",
           .choices = {"node_to_segment", "kernel"}};
  Key friction{.name = "friction",
               .text = "coefficient of Coulomb friction",
               .fallback = "0",
               .limits = at_least(0)};
  Key thickness{.name = "thickness",
                .unit = dim::length,
                .text =
                    "distance from the mid-surface at which contact begins; by default half "
                    "the shell's thickness and half the particle spacing",
                .limits = positive()};
  Key stiffness{.name = "stiffness",
                .text = "factor on the penalty stiffness rho0 c0^2 dx, or on the K of type kernel",
                .fallback = "1",
                .limits = positive()};
  Key damping{.name = "damping",
              .text = "damping of the approach, as a share of critical; elastic for 0",
              .fallback = "0",
              .limits = Limits{0, 1}};
  return {{path, between},   {path, type},      {path, friction},
          {path, thickness}, {path, stiffness}, {path, damping}};
}

/// What stands on the two sides of a contact of particles, by part number.
struct Sides {
  int particles = -1;
  int surface = -1;
  [[nodiscard]] bool complete() const { return surface >= 0 && particles >= 0; }
};

/// Contact knows neither the faces of solids nor lines in space yet.
bool is_surface(const Part& part) {
  for (const char* kind : {"solid", "cable", "beam"}) {
    if (part.kind == kind) return false;
  }
  return part.cell == Cell::line || part.cell == Cell::triangle || part.cell == Cell::quad;
}

std::string names_of_parts(const Scene& scene) {
  std::string names;
  for (const Part& p : scene.parts) names += (names.empty() ? "" : ", ") + p.name;
  return names;
}

void take_side(const Scene& scene, int part, Sides& sides) {
  const Part& p = scene.parts[static_cast<std::size_t>(part)];
  if (p.is_particles()) sides.particles = part;
  if (is_surface(p)) sides.surface = part;
}

Sides sides_of(const Keys& keys, const Scene& scene) {
  Sides sides;
  const std::vector<std::string>& names = keys.words("between");
  if (names.size() != 2) {
    keys.complain("between", fmt::format("{} names; two are wanted", names.size()));
    return sides;
  }
  bool known = true;
  for (const std::string& name : names) {
    const int part = scene.part_number(name);
    if (part >= 0) {
      take_side(scene, part, sides);
    } else if (planes_of(scene, name).empty()) {
      known = false;
      keys.complain("between", fmt::format("there is no part '{}'; parts are: {}", name,
                                           names_of_parts(scene)));
    }
  }
  const bool others = element_parts(scene, names)[0] >= 0 ||
                      part_before_planes(scene, names) >= 0;  // see part_contacts.cpp
  if (known && !others && !sides.complete()) {
    keys.complain("between",
                  fmt::format("[{}, {}] are not a part of particles and one of shells, nor a part "
                              "of elements and a boundary with planes (particles meet all planes "
                              "without being told), nor two parts of elements",
                              names[0], names[1]));
  }
  return sides;
}

/// Calls f(keys, sides) for each contact of this type that is well described.
template <class F>
void for_contacts(const Keys& root, const Scene& scene, F&& f) {
  if (!root.has("contacts")) return;
  const Keys contacts = root.map("contacts");
  for (const std::string& name : contacts.names()) {
    const Keys keys = contacts.map(name);
    if (is_kernel_contact(keys)) continue;
    const Sides sides = sides_of(keys, scene);
    if (sides.complete()) f(keys, sides);
  }
}

void state(const Keys& root, Scene& scene) {
  for_contacts(root, scene, [&](const Keys& keys, const Sides& sides) {
    NodeToSegment& c = make_node_to_segment(scene, keys.name(), sides.particles, sides.surface,
                                            keys.number("friction") > 0);
    c.where = keys.where();
  });
}

template <class T>
T entry_of(const std::vector<T>& of_part, int part) {
  const auto p = static_cast<std::size_t>(part);
  return p < of_part.size() ? of_part[p] : T{};
}

/// Distances and law of a contact from what its two parts are made of.
void set_law(Scene& scene, const Keys& keys, NodeToSegment& c) {
  const auto water = entry_of(scene.store.get<ParticleMaterials>().of_part, c.particle_part);
  const auto shell = entry_of(scene.store.get<SurfaceData>().of_part, c.surface_part);
  const bool rigid = scene.parts[static_cast<std::size_t>(c.surface_part)].rigid;
  assert(water.spacing > 0 && water.c0 > 0);
  assert(rigid || (shell.thickness > 0 && shell.young > 0));
  const double d = keys.number_or("thickness", 0.5 * (shell.thickness + water.spacing));
  if (!keys.has("thickness")) warn_of_offset(scene, keys, c.surface_part, shell.offset);
  c.range = GapRange::of(d);
  c.surface.gone = shell.gone;
  const double rate = water.c0 / water.spacing;
  c.law.rate2 = keys.number("stiffness") * rate * rate;
  c.law.stiffest = rigid ? std::numeric_limits<double>::infinity()
                         : share_of_membrane * shell.young * shell.thickness;
  c.law.friction = keys.number("friction");
  c.law.damping = keys.number("damping");
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!root.has("contacts")) return;
  const Keys contacts = root.map("contacts");
  for (NodeToSegment& c : scene.store.get<NodeToSegments>().list) {
    const Keys keys = contacts.map(c.name);
    set_law(scene, keys, c);
    const Model& water = models.of_node(scene.particles.begin);
    const Model& surface = model_of_part(scene, models, c.surface_part);
    if (models.rank(surface) < models.rank(water)) {
      keys.complain("between",
                    fmt::format("the surface advances in model '{}', slower than that of the "
                                "particles, '{}': particles touch what is in their model or in a "
                                "faster one",
                                surface.name, water.name));
      continue;
    }
    add_node_to_segment(scene, c, models);
  }
}

/// Contact distances, where the case leaves them open.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  const auto add = [&](const std::string& name, double distance, const char* rule) {
    const Keys keys = root.map("contacts").map(name);
    if (keys.given("thickness")) return;
    list.push_back({keys.path() + ".thickness", fmt::format("{:.4g} m", distance), rule});
  };
  for (const NodeToSegment& c : scene.store.get<NodeToSegments>().list) {
    add(c.name, c.range.contact, "half the shell's thickness and half the particle spacing");
  }
  return list;
}

}  // namespace contacts
}  // namespace

void warn_of_offset(Scene& scene, const Keys& keys, int part, double offset) {
  if (offset == 0) return;
  const std::string& name = scene.parts[static_cast<std::size_t>(part)].name;
  scene.warnings.push_back(fmt::format(
      "{}: {} keeps its distance from the nodes of '{}', and the middle of that shell lies {:g} m "
      "beside them (offset); say what you want by 'thickness'",
      keys.where().text(), keys.path(), name, offset));
}

Effect contacts_effect() {
  return {.name = "contacts",
          .schema = contacts::schema,
          .state = contacts::state,
          .operations = contacts::operations,
          .choices = contacts::choices};
}

}  // namespace gannet
