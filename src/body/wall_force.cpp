// The effect `wall_force`: what the water does to a wall or a part, split into pressure and
// viscosity. Whoever makes a force measures it under NAME.force, and what part of it comes from
// viscosity or friction under NAME.viscous_force where there is any; here they are added up.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "body/effects.hpp"

namespace gannet {

namespace {
namespace wall_force {

Schema schema() {
  return {
      {"probes.*",
       {.name = "wall_force",
        .kind = Kind::text,
        .text =
            "force on a wall (a boundary with planes, one of its planes: basin.z_min, a part of "
            "wall "
            "particles, or a body with dummy walls) or on a part of shells, split into pressure "
            "and viscosity"}}};
}

bool is_of_kind(const Scene& scene, const std::string& name, const char* kind) {
  const int part = scene.part_number(name);
  return part >= 0 && scene.parts[static_cast<std::size_t>(part)].kind == kind;
}

/// Names of what measures the force on a wall or a part: "plane.basin.z_min", and the dummy
/// particles behind it, "wall.basin.z_min"; "contact.slam".
std::vector<std::string> sources_of(const Keys& root, const Scene& scene, const std::string& name) {
  std::vector<std::string> sources;
  for (const Plane& plane : scene.planes) {
    const bool meant = plane.name == name || plane.name.starts_with(name + ".");
    if (!meant) continue;
    sources.push_back("plane." + plane.name);
    if (is_of_kind(scene, plane.name, "wall")) sources.push_back("wall." + plane.name);
  }
  if (sources.empty() && is_of_kind(scene, name, "wall")) sources.push_back("wall." + name);
  if (!sources.empty()) return sources;
  if (is_of_kind(scene, "walls." + name, "wall")) sources.push_back("wall." + name);  // of a body
  if (scene.part_number(name) < 0 || !root.has("contacts")) return sources;
  const Keys contacts = root.map("contacts");
  for (const std::string& contact : contacts.names()) {
    const std::vector<std::string>& sides = contacts.map(contact).words("between");
    if (std::ranges::find(sides, name) != sides.end()) sources.push_back("contact." + contact);
  }
  return sources;
}

void complain(const Keys& probe, const Scene& scene, const std::string& name) {
  const int part = scene.part_number(name);
  if (is_of_kind(scene, name, "sph")) {
    probe.complain("wall_force", fmt::format("'{}' is made of particles; the force on a wall or "
                                             "on a part of shells is measured",
                                             name));
  } else if (part >= 0) {
    probe.complain("wall_force", fmt::format("no contact acts on part '{}'", name));
  } else {
    std::string known;
    for (const Plane& p : scene.planes) known += (known.empty() ? "" : ", ") + p.name;
    for (const Part& p : scene.parts) {
      if (p.kind != "sph") known += (known.empty() ? "" : ", ") + p.name;
    }
    probe.complain("wall_force", fmt::format("there is no wall or part '{}'; there are: {}", name,
                                             known.empty() ? "none" : known));
  }
}

/// Sum of the measures SOURCE.suffix that there are; returns how many.
int sum_of(const Scene& scene, const std::vector<std::string>& sources, const char* suffix,
           Vec3& sum) {
  sum = Vec3::Zero();
  int found = 0;
  for (const Measure& m : scene.measures) {
    const bool meant = std::ranges::any_of(
        sources, [&](const std::string& source) { return m.name == source + suffix; });
    if (!meant) continue;
    Vec3 value = Vec3::Zero();
    m.sample(value.data());
    sum += value;
    ++found;
  }
  return found;
}

void operations(const Keys& root, Scene& scene, Models&) {
  if (!root.has("probes")) return;
  const Keys probes = root.map("probes");
  for (const std::string& probe_name : probes.names()) {
    const Keys probe = probes.map(probe_name);
    if (!probe.has("wall_force")) continue;
    const std::string name = probe.word("wall_force");
    const std::vector<std::string> sources = sources_of(root, scene, name);
    if (sources.empty() || is_of_kind(scene, name, "sph")) {
      complain(probe, scene, name);
      continue;
    }
    scene.measures.push_back(
        {.name = "probe." + probe_name,
         .unit = "N",
         .components = {"pressure x", "pressure y", "pressure z", "viscous x", "viscous y",
                        "viscous z", "total x", "total y", "total z"},
         .sample = [&scene, sources](double* to) {
           Vec3 total;
           Vec3 viscous;
           if (sum_of(scene, sources, ".force", total) == 0) {
             total.setConstant(std::numeric_limits<double>::quiet_NaN());
           }
           sum_of(scene, sources, ".viscous_force", viscous);
           for (int d = 0; d < 3; ++d) {
             to[d] = total[d] - viscous[d];
             to[3 + d] = viscous[d];
             to[6 + d] = total[d];
           }
         }});
  }
}

}  // namespace wall_force
}  // namespace

Effect wall_force_effect() {
  return {.name = "wall_force", .schema = wall_force::schema, .operations = wall_force::operations};
}

}  // namespace gannet
