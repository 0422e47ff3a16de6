// The effect `contacts of parts`: contacts.NAME between two parts of elements.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contact/effects.hpp"
#include "contact/part_contact.hpp"
#include "contact/part_kinds.hpp"
#include "contact/part_planes.hpp"
#include "plan/model_of_part.hpp"
#include "plan/model_planes.hpp"

namespace gannet {

namespace {
namespace part_contacts {

Schema schema() {
  return {{"contacts.*",
           {.name = "both_ways",
            .kind = Kind::flag,
            .text = "between parts of elements: the nodes of each part against the surface of the "
                    "other, on unless said; off: those of the first against the second"}},
          {"contacts.*",
           {.name = "pressure_per_depth",
            .unit = dim::pressure / dim::length,
            .text = "of a part of elements on planes, in place of what its elements can bear; a "
                    "rigid surface needs it",
            .limits = positive()}}};
}

ShellSurface data_of(Scene& scene, int part) {
  const auto& all = scene.store.get<SurfaceData>().of_part;
  const auto p = static_cast<std::size_t>(part);
  return p < all.size() ? all[p] : ShellSurface{};
}

/// False after a complaint.
bool parts_can_meet(const Keys& keys, Scene& scene, std::array<int, 2> parts) {
  const Part& a = scene.parts[static_cast<std::size_t>(parts[0])];
  const Part& b = scene.parts[static_cast<std::size_t>(parts[1])];
  if (parts[0] == parts[1]) {
    keys.complain(
        "between",
        fmt::format("'{}' stands twice; contact of a part with itself is not built yet", a.name));
    return false;
  }
  if (is_line(a) && is_line(b)) {
    keys.complain("between", fmt::format("parts '{}' ({}) and '{}' ({}) have no surface; parts of "
                                         "shells, solids and rigid surfaces have one",
                                         a.name, a.kind, b.name, b.kind));
    return false;
  }
  for (const int p : parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(p)];
    if (!is_line(part) || part.rigid || data_of(scene, p).axial > 0) continue;
    keys.complain("between", fmt::format("'{}' is a mooring line, which knows its own bed only; "
                                         "contact of it with parts is not built yet",
                                         part.name));
    return false;
  }
  if (a.rigid && b.rigid) {
    keys.complain("between", fmt::format("parts '{}' and '{}' are both rigid, and their contact "
                                         "has no stiffness to go by; it is not built yet",
                                         a.name, b.name));
    return false;
  }
  return true;
}

/// Nothing stands between two surfaces without an inside where they have no thickness.
void complain_of_no_distance(const Keys& keys, const PartContact& c) {
  if (c.directions[0].range.contact > 0 || (c.sides[0].solid && c.sides[1].solid)) return;
  if (c.directions.size() == 1 && c.sides[c.directions[0].segments].solid) return;
  keys.complain("between", "neither part has a thickness; say by 'thickness' where contact begins");
}

void complain_of_depth(const Keys& keys) {
  if (!keys.given("pressure_per_depth")) return;
  keys.complain("pressure_per_depth",
                "has no meaning: it is for a part of elements and a boundary with planes");
}

/// Notes what of a mooring line or a surface without a stiffness cannot meet planes; true: it can.
bool can_meet_planes(const Keys& keys, const Part& part, const ShellSurface& data) {
  if (keys.given("pressure_per_depth")) return true;
  if (is_line(part) && !(data.axial > 0)) {
    keys.complain("between",
                  fmt::format("'{}' is a mooring line, which knows its own bed only", part.name));
    return false;
  }
  if (part.kind == "rigid_surface") {
    keys.complain("between", fmt::format("'{}' has no material whose stiffness contact could go "
                                         "by; say the pressure for a depth of penetration, "
                                         "'pressure_per_depth: 1 GPa/m'",
                                         part.name));
    return false;
  }
  return true;
}

/// Of the two keys that say how stiff contact is, one holds.
void complain_of_factor(const Keys& keys) {
  if (!keys.given("pressure_per_depth") || !keys.given("stiffness")) return;
  keys.complain("stiffness",
                "has no meaning beside 'pressure_per_depth', which takes the place of the penalty "
                "that it multiplies");
}

void meet_planes(const Keys& keys, Scene& scene, int part) {
  const ShellSurface data = data_of(scene, part);
  if (!can_meet_planes(keys, scene.parts[static_cast<std::size_t>(part)], data)) return;
  complain_of_factor(keys);
  const std::vector<std::string>& names = keys.words("between");
  const bool first = scene.part_number(names[0]) == part;
  PartOnPlanes& c =
      make_part_on_planes(scene, keys.name(), part, data, planes_of(scene, names[first ? 1 : 0]),
                          keys.number("friction") > 0);
  c.where = keys.where();
  c.factor = keys.number("stiffness");
  if (keys.has("pressure_per_depth")) c.kappa = keys.number("pressure_per_depth");
  c.law.friction = keys.number("friction");
  c.law.damping = keys.number("damping");
  c.distance = keys.number_or("thickness", 0.5 * data.thickness);
  if (!keys.has("thickness")) warn_of_offset(scene, keys, part, data.offset);
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("contacts")) return;
  const Keys contacts = root.map("contacts");
  for (const std::string& name : contacts.names()) {
    const Keys keys = contacts.map(name);
    if (is_kernel_contact(keys)) continue;
    const std::array<int, 2> parts = element_parts(scene, keys.words("between"));
    if (parts[0] < 0) {
      if (keys.given("both_ways")) {
        keys.complain("both_ways", "has no meaning: only two parts of elements can meet both ways");
      }
      const int part = part_before_planes(scene, keys.words("between"));
      if (part >= 0) {
        meet_planes(keys, scene, part);
      } else {
        complain_of_depth(keys);
      }
      continue;
    }
    complain_of_depth(keys);
    if (!parts_can_meet(keys, scene, parts)) continue;
    const bool lines = is_line(scene.parts[static_cast<std::size_t>(parts[0])]) ||
                       is_line(scene.parts[static_cast<std::size_t>(parts[1])]);
    if (lines && keys.given("both_ways")) {
      keys.complain("both_ways", "has no meaning: cables and beams have no surface to be met");
    }
    const bool both = lines || !keys.has("both_ways") || keys.flag("both_ways");
    PartContact& c =
        make_part_contact(scene, name, parts, {data_of(scene, parts[0]), data_of(scene, parts[1])},
                          both, keys.number("friction") > 0);
    c.where = keys.where();
    c.factor = keys.number("stiffness");
    c.law.friction = keys.number("friction");
    c.law.damping = keys.number("damping");
    set_distance(c,
                 keys.number_or("thickness", 0.5 * (c.sides[0].thickness + c.sides[1].thickness)));
    complain_of_no_distance(keys, c);
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  const bool planes = scene.store.has<PartsOnPlanes>();
  if (!planes && !scene.store.has<PartContacts>()) return;
  auto& all = scene.store.get<PartContacts>();
  for (PartContact& c : all.list) {
    const Keys keys = root.map("contacts").map(c.name);
    Model& model = model_of_part(scene, models, c.sides[0].part);
    if (&model != &model_of_part(scene, models, c.sides[1].part)) {
      keys.complain("between",
                    "the two parts advance in different models, with steps of their own; contact "
                    "of elements across models is not built yet");
      continue;
    }
    add_part_contact(scene, c, model, models.ledger);
  }
  if (planes) {
    for (PartOnPlanes& c : scene.store.get<PartsOnPlanes>().list) {
      Model& model = model_of_part(scene, models, c.side.part);
      c.seen = &planes_seen_by(scene, model);
      add_part_on_planes(scene, c, all.meetings[&model], models.ledger);
    }
  }
  for (auto& [model, meeting] : all.meetings) {
    add_part_contact_operations(scene, meeting, *model);
  }
}

/// Contact distances and directions, where the case leaves them open.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (scene.store.has<PartsOnPlanes>()) {
    for (const PartOnPlanes& c : scene.store.get<PartsOnPlanes>().list) {
      const Keys keys = root.map("contacts").map(c.name);
      if (keys.given("thickness")) continue;
      list.push_back({keys.path() + ".thickness", fmt::format("{:.4g} m", c.distance),
                      "half the thickness of the part; solids have none"});
    }
  }
  if (!scene.store.has<PartContacts>()) return list;
  for (const PartContact& c : scene.store.get<PartContacts>().list) {
    const Keys keys = root.map("contacts").map(c.name);
    if (!keys.given("thickness")) {
      list.push_back({keys.path() + ".thickness",
                      fmt::format("{:.4g} m", c.directions[0].range.contact),
                      "half the thicknesses of both parts; solids have none"});
    }
    const bool lines = c.sides[0].line || c.sides[1].line;
    if (!lines && !keys.given("both_ways")) {
      list.push_back({keys.path() + ".both_ways", "on",
                      "the nodes of each part against the surface of the other"});
    }
  }
  return list;
}

}  // namespace part_contacts
}  // namespace

Effect part_contacts_effect() {
  return {.name = "contacts of parts",
          .schema = part_contacts::schema,
          .state = part_contacts::state,
          .operations = part_contacts::operations,
          .choices = part_contacts::choices};
}

}  // namespace gannet
