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
#include "contact/planes.hpp"
#include "plan/model_of_part.hpp"
#include "scene/particle_material.hpp"
#include "scene/surface_data.hpp"

namespace gannet {

namespace {

/// The share of E t that a penalty may have: a spring on a node is then softer than the shell's
/// own membrane (about E t), and does not decide its time step.
constexpr double share_of_membrane = 0.1;

Schema schema() {
  const std::string path = "contacts.*";
  Key between{.name = "between",
              .kind = Kind::names,
              .text =
                  "two parts: particles and shells, or both of elements; or a shell and a "
                  "boundary's planes",
              .required = true};
  Key type{.name = "type",
           .kind = Kind::choice,
           .text = "how contact is found",
           .fallback = "node_to_segment",
           .choices = {"node_to_segment"}};
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
                .text = "factor on the penalty stiffness rho0 c0^2 dx",
                .fallback = "1",
                .limits = positive()};
  Key damping{.name = "damping",
              .text = "damping of the approach, as a share of critical; elastic for 0",
              .fallback = "0",
              .limits = Limits{0, 1}};
  return {{path, between},   {path, type},      {path, friction},
          {path, thickness}, {path, stiffness}, {path, damping}};
}

/// What stands on the two sides of a contact, by part number; the planes of a boundary instead of
/// particles where `planes` is not empty.
struct Sides {
  int particles = -1;
  int surface = -1;
  std::vector<Plane> planes;
  [[nodiscard]] bool complete() const {
    return surface >= 0 && (particles >= 0 || !planes.empty());
  }
};

/// Contact knows neither the faces of solids nor lines in space yet.
bool is_surface(const Part& part) {
  for (const char* kind : {"solid", "cable", "beam"}) {
    if (part.kind == kind) return false;
  }
  return part.cell == Cell::line || part.cell == Cell::triangle || part.cell == Cell::quad;
}

/// Planes named NAME or NAME.something: those of the boundary NAME.
std::vector<Plane> planes_of(const Scene& scene, const std::string& name) {
  std::vector<Plane> planes;
  for (const Plane& p : scene.planes) {
    if (p.name == name || p.name.starts_with(name + ".")) planes.push_back(p);
  }
  return planes;
}

std::string names_of_parts(const Scene& scene) {
  std::string names;
  for (const Part& p : scene.parts) names += (names.empty() ? "" : ", ") + p.name;
  return names;
}

void take_side(const Keys& keys, const Scene& scene, const std::string& name, Sides& sides) {
  const int part = scene.part_number(name);
  if (part < 0) {
    sides.planes = planes_of(scene, name);
    if (!sides.planes.empty()) return;
    keys.complain("between",
                  fmt::format("there is no part '{}'; parts are: {}", name, names_of_parts(scene)));
    return;
  }
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
  for (const std::string& name : names) take_side(keys, scene, name, sides);
  const bool known = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return scene.part_number(name) >= 0 || !planes_of(scene, name).empty();
  });
  const bool elements = element_parts(scene, names)[0] >= 0;  // see part_contacts.cpp
  if (known && !elements && !sides.complete()) {
    keys.complain("between",
                  fmt::format("[{}, {}] are not a part of particles and one of shells, nor a part "
                              "of shells and a boundary with planes (particles meet all planes "
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
    if (keys.word("type") != "node_to_segment") continue;
    const Sides sides = sides_of(keys, scene);
    if (sides.complete()) f(keys, sides);
  }
}

void make_nodes_on_planes(Scene& scene, const Keys& keys, const Sides& sides) {
  if (keys.number("friction") > 0 || keys.number("damping") > 0) {
    keys.complain("between", "contact with planes knows neither friction nor damping yet");
  }
  NodesOnPlanes& c = scene.store.get<NodesOnPlanesList>().list.emplace_back();
  c.name = keys.name();
  c.where = keys.where();
  c.part = sides.surface;
  c.planes = sides.planes;
  c.sums.resize(c.planes.size());
  const Range nodes = scene.parts[static_cast<std::size_t>(sides.surface)].nodes;
  c.offset.assign(c.planes.size() * static_cast<std::size_t>(nodes.size()), 0);
  c.begun.assign(1, 0);
  const std::string prefix = "contact." + c.name + ".";
  for (Field f :
       {plain_field(prefix + "offset", "m", "", Over::scene, c.offset, 1, GhostRule::none),
        plain_field(prefix + "begun", "1", "", Over::scene, c.begun, 1, GhostRule::none)}) {
    f.owner = "contact " + c.name;
    scene.fields.push_back(f);
  }
  scene.measures.push_back({prefix + "force", "N", {"x", "y", "z"}, [&c](double* out) {
                              Vec3 sum = Vec3::Zero();
                              for (const PlaneSums& s : c.sums) sum -= s.force;
                              for (int k = 0; k < 3; ++k) out[k] = sum[k];
                            }});
  // Offsets shrink as nodes move out: at the first level they are the penetrations of the start.
  scene.measures.push_back(
      {prefix + "overlaps", "1", {"value"}, [&c](double* out) {
         *out = static_cast<double>(
             std::count_if(c.offset.begin(), c.offset.end(), [](double d) { return d > 0; }));
       }});
  scene.measures.push_back({prefix + "overlap_depth", "m", {"value"}, [&c](double* out) {
                              *out = c.offset.empty()
                                         ? 0
                                         : *std::max_element(c.offset.begin(), c.offset.end());
                            }});
}

void state(const Keys& root, Scene& scene) {
  for_contacts(root, scene, [&](const Keys& keys, const Sides& sides) {
    if (!sides.planes.empty()) return make_nodes_on_planes(scene, keys, sides);
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

/// Contact stands off from the nodes, wherever the middle of the shell lies.
void warn_of_offset(Scene& scene, const Keys& keys, int part, double offset) {
  if (offset == 0) return;
  const std::string& name = scene.parts[static_cast<std::size_t>(part)].name;
  scene.warnings.push_back(fmt::format(
      "{}: {} keeps its distance from the nodes of '{}', and the middle of that shell lies {:g} m "
      "beside them (offset); say what you want by 'thickness'",
      keys.where().text(), keys.path(), name, offset));
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

void add_nodes_on_planes(const Keys& keys, NodesOnPlanes& c, Scene& scene, Models& models) {
  const auto shell = entry_of(scene.store.get<SurfaceData>().of_part, c.part);
  c.law.distance = keys.number_or("thickness", 0.5 * shell.thickness);
  if (!keys.has("thickness")) warn_of_offset(scene, keys, c.part, shell.offset);
  c.law.fixed = keys.number("stiffness") * share_of_membrane * shell.young * shell.thickness;
  double rate2 = 0;
  const Range nodes = scene.parts[static_cast<std::size_t>(c.part)].nodes;
  for (Index i = nodes.begin; i < nodes.end; ++i) {
    const double m = scene.nodes.x[static_cast<std::size_t>(i)].w;
    if (m > 0) rate2 = std::max(rate2, c.law.fixed / m);
  }
  bool moves = false;
  for (const Plane& plane : c.planes) {
    moves = moves || plane.moves;
    for (std::size_t k = 0; k < scene.planes.size(); ++k) {
      if (scene.planes[k].name == plane.name) c.numbers.push_back(k);
    }
  }
  Model& model = model_of_part(scene, models, c.part);
  Operation op;
  op.name = "contact " + c.name;
  op.reason = asked_for_at(c.where);
  op.reads = {"x"};
  op.writes = {"f"};
  op.run = [&scene, &c](const Step&) {
    follow_planes(scene, c);
    nodes_on_planes(scene, c);
  };
  op.stable_dt = [dt = plane_step(rate2)] { return dt; };
  model.plan.add(std::move(op));
  LedgerEntry* entry = &models.ledger.entry("contact", c.name);
  LedgerEntry* put_in = moves ? &models.ledger.entry("moving plane", c.name) : nullptr;
  if (moves) put_in->external = true;
  Operation look;
  look.name = "contact " + c.name + ": work";
  look.reason = asked_for_at(c.where);
  look.stage = Stage::look;
  look.run = [&scene, &c, entry, put_in](const Step& step) {
    follow_planes(scene, c);
    const PlaneSums sums = work_of_planes(scene, c, step);
    entry->add_work(sums.put_in - sums.work);
    if (put_in != nullptr) put_in->add_work(sums.put_in);
  };
  model.plan.add(std::move(look));
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
  for (NodesOnPlanes& c : scene.store.get<NodesOnPlanesList>().list) {
    const Part& part = scene.parts[static_cast<std::size_t>(c.part)];
    if (part.rigid) {
      contacts.map(c.name).complain(
          "between", fmt::format("part '{}' is rigid; contact of rigid parts with planes is not "
                                 "built yet",
                                 part.name));
      continue;
    }
    add_nodes_on_planes(contacts.map(c.name), c, scene, models);
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
  for (const NodesOnPlanes& c : scene.store.get<NodesOnPlanesList>().list) {
    add(c.name, c.law.distance, "half the shell's thickness");
  }
  return list;
}

}  // namespace

Effect contacts_effect() {
  return {.name = "contacts",
          .schema = schema,
          .state = state,
          .operations = operations,
          .choices = choices};
}

}  // namespace gannet
