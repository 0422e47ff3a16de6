// The effect `kernel contact`: contacts.NAME of `type: kernel` between particles and the nodes of a
// part of elements.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact/effects.hpp"
#include "contact/kernel_contact.hpp"
#include "contact/kernel_start.hpp"
#include "contact/part_kinds.hpp"
#include "plan/model_of_part.hpp"
#include "scene/particle_material.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {
namespace kernel_contacts {

Schema schema() {
  return {{"contacts.*",
           {.name = "exponent",
            .kind = Kind::integer,
            .text = "of type kernel: power of the kernel in the potential of contact, 2 unless "
                    "said; larger ones begin later and rise faster",
            .limits = Limits{1, 8}}}};
}

constexpr int usual_exponent = 2;

template <class T>
T entry_of(const std::vector<T>& of_part, int part) {
  const auto p = static_cast<std::size_t>(part);
  return p < of_part.size() ? of_part[p] : T{};
}

std::vector<Keys> kernel_contacts(const Keys& root) {
  std::vector<Keys> list;
  if (!root.has("contacts")) return list;
  for (const std::string& name : root.map("contacts").names()) {
    const Keys keys = root.map("contacts").map(name);
    if (is_kernel_contact(keys)) list.push_back(keys);
  }
  return list;
}

void complain_of_keys(const Keys& root) {
  if (!root.has("contacts")) return;
  for (const std::string& name : root.map("contacts").names()) {
    const Keys keys = root.map("contacts").map(name);
    if (!is_kernel_contact(keys)) {
      if (keys.given("exponent")) keys.complain("exponent", "goes with 'type: kernel'");
      continue;
    }
    for (const char* key :
         {"friction", "damping", "thickness", "both_ways", "pressure_per_depth"}) {
      if (!keys.given(key)) continue;
      keys.complain(key,
                    "has no meaning beside 'type: kernel', whose force is the gradient of a "
                    "potential between particles and nodes");
    }
  }
}

/// The two parts of a contact, particles first; {-1, -1} after a complaint.
std::array<int, 2> parts_of(const Keys& keys, const Scene& scene) {
  constexpr std::array<int, 2> none{-1, -1};
  const std::vector<std::string>& names = keys.words("between");
  if (names.size() != 2) {
    keys.complain("between", fmt::format("{} names; two are wanted", names.size()));
    return none;
  }
  std::array<int, 2> parts{};
  for (std::size_t k = 0; k < 2; ++k) {
    parts[k] = scene.part_number(names[k]);
    if (parts[k] < 0) {
      keys.complain("between", fmt::format("there is no part '{}'; kernel contact is between a "
                                           "part of particles and one of elements",
                                           names[k]));
      return none;
    }
  }
  const auto part = [&](std::size_t k) -> const Part& {
    return scene.parts[static_cast<std::size_t>(parts[k])];
  };
  if (!part(0).is_particles()) std::swap(parts[0], parts[1]);
  if (part(0).kind == "sph" && has_surface(part(1))) return parts;
  keys.complain("between",
                fmt::format("'{}' ({}) and '{}' ({}): kernel contact is between a part "
                            "of water and one of shells, solids or a rigid surface; two "
                            "parts of water are one water, and meet by its own pressure",
                            names[0], part(0).name == names[0] ? part(0).kind : part(1).kind,
                            names[1], part(0).name == names[0] ? part(1).kind : part(0).kind));
  return none;
}

void state(const Keys& root, Scene& scene) {
  complain_of_keys(root);
  for (const Keys& keys : kernel_contacts(root)) {
    const std::array<int, 2> parts = parts_of(keys, scene);
    if (parts[0] < 0) continue;
    make_kernel_contact(scene, keys.name(), parts[0], parts[1]).where = keys.where();
  }
}

/// Nodes further apart than particles leave gaps between them.
bool fine_enough(const Keys& keys, const Scene& scene, const KernelContact& c, double dp) {
  const double longest = longest_edge(scene.nodes, c.surface);
  if (longest <= dp * (1 + 1e-6)) return true;
  keys.complain(
      "between",
      fmt::format("nodes of '{}' are up to {:.4g} m apart, and particles {:.4g} m: "
                  "kernel contact wants nodes no further apart than particles; take "
                  "smaller elements, or 'type: node_to_segment'",
                  scene.parts[static_cast<std::size_t>(c.surface_part)].name, longest, dp));
  return false;
}

/// The nodes are those of the outer faces of solids at the start, and nothing tells which of them
/// are bare once elements leave. Parts of solids that may do so count them.
bool stays_whole(const Keys& keys, const Scene& scene, const KernelContact& c) {
  const std::string& part = scene.parts[static_cast<std::size_t>(c.surface_part)].name;
  const auto counts = [&](const Measure& m) { return m.name == "solid." + part + ".eroded"; };
  if (std::none_of(scene.measures.begin(), scene.measures.end(), counts)) return true;
  keys.complain(
      "between",
      fmt::format("elements of '{}' may leave (failure of its material, or collapse: erode), and "
                  "kernel contact would go on pushing at the nodes of its faces of the start: take "
                  "neither, or shells",
                  part));
  return false;
}

void set_law(const Keys& keys, Scene& scene, KernelContact& c, const ParticleMaterial& water) {
  const auto data = entry_of(scene.store.get<SurfaceData>().of_part, c.surface_part);
  const Part& part = scene.parts[static_cast<std::size_t>(c.surface_part)];
  const bool shell = part.kind != "solid" && data.thickness > 0;
  if (shell) c.surface.gone = data.gone;
  c.V_particle = std::pow(water.spacing, scene.dimension);
  take_volumes(c, scene.nodes, shell ? data.thickness : water.spacing);
  const int n = keys.has("exponent") ? static_cast<int>(keys.number("exponent")) : usual_exponent;
  c.law = make_kernel_law(water.kernel, water.spacing, n);
  c.law.K = keys.number("stiffness") *
            standard_K(c.law, water.spacing, c.thickness, water.rho0, water.c0);
}

/// A fill that begins at the nodes, as it may at a wall, is shot off by their potential.
void warn_of_start(const Keys& keys, Scene& scene, const KernelStart& start, double dp, double c0) {
  if (start.count == 0) return;
  scene.warnings.push_back(fmt::format(
      "{}: {}: {} particles start within reach of the nodes, the nearest {:.4g} m too near: its "
      "potential is worth {:.3g} m/s ({:.2g} c0) and throws it off at t = 0. Let the first row "
      "stand {:.4g} m ({:.2f} spacings) off the nodes: begin the fill half a spacing less off them",
      keys.where().text(), keys.path(), start.count, start.depth, start.speed, start.speed / c0,
      start.stand_off, start.stand_off / dp));
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<KernelContacts>()) return;
  for (KernelContact& c : scene.store.get<KernelContacts>().list) {
    const Keys keys = root.map("contacts").map(c.name);
    const auto water = entry_of(scene.store.get<ParticleMaterials>().of_part, c.particle_part);
    if (!fine_enough(keys, scene, c, water.spacing) || !stays_whole(keys, scene, c)) continue;
    set_law(keys, scene, c, water);
    Model& model = models.of_node(scene.particles.begin);
    const Model& of_surface = model_of_part(scene, models, c.surface_part);
    if (&model != &of_surface) {
      keys.complain("type", fmt::format("kernel contact is for what advances in one model, and the "
                                        "surface advances in '{}', the particles in '{}': name "
                                        "them in one model, or take 'type: node_to_segment'",
                                        of_surface.name, model.name));
      continue;
    }
    warn_of_start(keys, scene, look_at_start(scene, c, water.rho0, water.c0), water.spacing,
                  water.c0);
    add_kernel_contact(scene, c, model, models.ledger);
  }
}

std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (!scene.store.has<KernelContacts>()) return list;
  for (const KernelContact& c : scene.store.get<KernelContacts>().list) {
    const Keys keys = root.map("contacts").map(c.name);
    if (!keys.given("exponent")) {
      list.push_back({keys.path() + ".exponent", fmt::format("{}", c.law.n),
                      "smooth along nodes that are as far apart as particles"});
    }
    list.push_back({keys.path() + ".stiffness",
                    fmt::format("K = {:.4g} Pa/m^{}", c.law.K, c.law.kernel.dimension),
                    fmt::format("with nodes that stand for a layer of {:.4g} m: half of rho0 c0^2 "
                                "at half a spacing",
                                c.thickness)});
  }
  return list;
}

}  // namespace kernel_contacts
}  // namespace

Effect kernel_contacts_effect() {
  return {.name = "kernel contact",
          .schema = kernel_contacts::schema,
          .state = kernel_contacts::state,
          .operations = kernel_contacts::operations,
          .choices = kernel_contacts::choices};
}

}  // namespace gannet
