// bodies.NAME.rigid: parts of shells or solids that move as one rigid body until something touches
// them or until a given time, and deform then; and back. What they do is body/rigid_phase.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "body/effects.hpp"
#include "body/rigid_phase.hpp"
#include "body/rigid_times.hpp"
#include "plan/model_of_part.hpp"
#include "scene/bonds.hpp"
#include "scene/given_rotations.hpp"
#include "scene/given_velocities.hpp"

namespace gannet {

namespace {
namespace rigid_phases {

Schema schema() {
  Key rigid{.name = "rigid",
            .kind = Kind::map,
            .text = "for how long it is rigid: until_contact, or a map; without this key for good",
            .choices = {"until_contact"}};
  rigid.keys = {
      {.name = "until", .unit = dim::time, .text = "it deforms from then on", .limits = positive()},
      {.name = "until_contact",
       .kind = Kind::flag,
       .text = "it deforms as soon as something touches it",
       .fallback = "no"},
      {.name = "again_from",
       .unit = dim::time,
       .text = "it is rigid again from then on, in the shape that it has",
       .limits = positive()}};
  return {{"bodies.*", rigid}};
}

/// What a body is for a time; false after a complaint.
bool read_times(const Keys& keys, RigidTimes& times) {
  if (keys.word("rigid") == "until_contact") {
    times.until_contact = true;
    return true;
  }
  const Keys rigid = keys.map("rigid");
  times.until_contact = rigid.flag("until_contact");
  times.until = rigid.number_or("until", times.until);
  times.again_from = rigid.number_or("again_from", times.again_from);
  if (!times.until_contact && !rigid.has("until")) {
    keys.complain("rigid", "wants to know until when: until_contact, or until: 10 ms");
    return false;
  }
  if (rigid.has("again_from") && rigid.has("until") && times.again_from <= times.until) {
    rigid.complain("again_from", "comes before the body deforms; a time after 'until' is wanted");
    return false;
  }
  return true;
}

/// The keys that are for bodies that are rigid for good.
bool has_other_keys(const Keys& keys) {
  bool others = false;
  for (const char* key : {"mass", "centre", "inertia", "density", "motion", "held_until", "slip"}) {
    if (!keys.given(key)) continue;
    keys.complain(key,
                  "goes with bodies that are rigid for good; with 'rigid' the mass is that of "
                  "the parts, and forces move it");
    others = true;
  }
  if (keys.word("walls") == "dummy") {
    keys.complain("walls", "dummy particles keep to a shape for good; with 'rigid' use a contact");
    others = true;
  }
  return others;
}

/// The numbers of its parts; empty after a complaint.
std::vector<int> parts_of(const Keys& root, const Keys& keys, const Scene& scene) {
  std::vector<int> parts;
  for (const std::string& name : keys.words("parts")) {
    const int number = scene.part_number(name);
    const Part* part = number < 0 ? nullptr : &scene.parts[static_cast<std::size_t>(number)];
    if (number >= 0 && std::ranges::find(parts, number) != parts.end()) {
      keys.complain("parts", fmt::format("'{}' is named twice", name));
      return {};
    }
    const bool good = part != nullptr && (part->kind == "shell" || part->kind == "solid");
    const bool taken = std::ranges::any_of(scene.groups, [&](const PartGroup& group) {
      return std::ranges::find(group.parts, number) != group.parts.end();
    });
    if (!good || taken) {
      keys.complain("parts",
                    taken && good
                        ? fmt::format("part '{}' belongs to another body already", name)
                        : fmt::format("'{}' is no part of shells or solids, and only these "
                                      "are rigid for a time",
                                      name));
      return {};
    }
    if (root.map("parts").map(name).given("initial_velocity")) {
      root.map("parts").map(name).complain(
          "initial_velocity",
          fmt::format("the part belongs to body '{}'; say its velocity there", keys.name()));
    }
    parts.push_back(number);
  }
  return parts;
}

void state(const Keys& root, Scene& scene) {
  for (const Keys& keys : bodies_rigid_for_a_time(root)) {
    RigidTimes times;
    if (has_other_keys(keys) || !read_times(keys, times)) continue;
    const std::vector<int> parts = parts_of(root, keys, scene);
    if (parts.empty()) continue;
    scene.groups.push_back(PartGroup{.name = keys.name(), .parts = parts});
    RigidPhase& phase = scene.store.get<RigidPhases>().list.emplace_back();
    phase.name = keys.name();
    phase.where = keys.where("rigid");
    phase.times = times;
    for (const int p : parts) {
      const Range& nodes = scene.parts[static_cast<std::size_t>(p)].nodes;
      for (Index i = nodes.begin; i < nodes.end; ++i) phase.nodes.push_back(i);
    }
    std::ranges::sort(phase.nodes);
  }
}

/// The contacts of its parts with what is not of the body: two parts of it may lie against each
/// other all along.
std::vector<std::string> contacts_of(const Keys& root, const Keys& body) {
  std::vector<std::string> names;
  if (!root.has("contacts")) return names;
  const std::vector<std::string>& parts = body.words("parts");
  const auto mine = [&](const std::string& side) {
    return std::ranges::find(parts, side) != parts.end();
  };
  for (const std::string& name : root.map("contacts").names()) {
    const std::vector<std::string>& sides = root.map("contacts").map(name).words("between");
    if (std::ranges::any_of(sides, mine) && !std::ranges::all_of(sides, mine)) {
      names.push_back(name);
    }
  }
  return names;
}

/// Why its nodes cannot be moved as one; "" where they can.
std::string trouble_with(const Keys& root, const Scene& scene, Models& models,
                         const RigidPhase& phase) {
  const auto mine = [&](Index node) { return std::ranges::binary_search(phase.nodes, node); };
  if (!scene.group(phase.name)->nodes.empty()) return "nodes are tied to it";
  if (const Bonds* bonds = scene.store.find<Bonds>()) {
    for (const Bond& bond : bonds->list) {
      if (std::ranges::any_of(bond.nodes, mine)) return fmt::format("'{}' ties it", bond.name);
    }
  }
  if (const auto* given = scene.store.find<GivenVelocities>()) {
    for (const auto& [node, mask] : given->masks) {
      if (mask != 0 && mine(node)) return "a boundary holds nodes of it";
    }
  }
  if (const auto* given = scene.store.find<GivenRotations>()) {
    if (std::ranges::any_of(given->nodes, mine)) return "a boundary holds rotations of its nodes";
  }
  if (root.has("probes")) {
    for (const std::string& name : root.map("probes").names()) {
      if (root.map("probes").map(name).word("body") == phase.name) {
        return fmt::format(
            "probe '{}' asks for a body that is rigid for good; name nodes of its "
            "parts",
            name);
      }
    }
  }
  const Model* model = &models.of_node(phase.nodes.front());
  for (const Index node : phase.nodes) {
    if (&models.of_node(node) != model) return "its parts advance in two models";
  }
  return "";
}

/// Gives its nodes the start that the case gives the body.
void start(const Keys& keys, Scene& scene, const RigidPhase& phase) {
  const Vec3 V = keys.has("velocity") ? keys.vector("velocity") : Vec3(Vec3::Zero());
  const Vec3 omega =
      keys.has("angular_velocity") ? keys.vector("angular_velocity") : Vec3(Vec3::Zero());
  const Vec3 c = mass_centre(scene.nodes, phase.nodes).x;
  for (const Index node : phase.nodes) {
    const auto i = static_cast<std::size_t>(node);
    set_xyz(scene.nodes.v[i], V + omega.cross(xyz(scene.nodes.x[i]) - c));
    if (scene.nodes.rotating.contains(node)) set_xyz(scene.nodes.omega[i], omega);
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<RigidPhases>()) return;
  for (RigidPhase& phase : scene.store.get<RigidPhases>().list) {
    const Keys keys = root.map("bodies").map(phase.name);
    const std::string trouble = trouble_with(root, scene, models, phase);
    if (!trouble.empty()) {
      keys.complain("rigid", "for a time is for parts that nothing else holds, and " + trouble);
      continue;
    }
    phase.contacts = contacts_of(root, keys);
    if (phase.times.until_contact && phase.contacts.empty()) {
      keys.complain("rigid",
                    "until_contact, but no contact is between a part of it and what is not");
      continue;
    }
    start(keys, scene, phase);
    make_rigid_phase(scene, phase);
    add_rigid_phase(scene, phase, models.of_node(phase.nodes.front()), models.ledger);
    scene.measures.push_back({"body." + phase.name + ".rigid", "1", {"value"}, [&](double* out) {
                                *out = phase.is_rigid() ? 1 : 0;
                              }});
    scene.measures.push_back(
        {"body." + phase.name + ".position", "m", {"x", "y", "z"}, [&](double* out) {
           const Vec3 x = mass_centre(scene.nodes, phase.nodes).x;
           for (int d = 0; d < 3; ++d) out[d] = x[d];
         }});
  }
}

}  // namespace rigid_phases
}  // namespace

std::vector<Keys> bodies_rigid_for_a_time(const Keys& root) {
  std::vector<Keys> list;
  if (!root.has("bodies")) return list;
  for (const std::string& name : root.map("bodies").names()) {
    const Keys keys = root.map("bodies").map(name);
    if (keys.given("rigid")) list.push_back(keys);
  }
  return list;
}

Effect rigid_phases_effect() {
  return {.name = "rigid for a time", .schema = rigid_phases::schema, .state = rigid_phases::state};
}

Effect rigid_phase_motion_effect() {
  return {.name = "motion of what is rigid for a time", .operations = rigid_phases::operations};
}

}  // namespace gannet
