// bodies.NAME.walls: dummy: layers of wall particles inside of the closed surface of a rigid body.
#include <fmt/format.h>

#include <algorithm>

#include "scene/draft_surface.hpp"
#include "scene/tracked_values.hpp"
#include "sph/carried_walls.hpp"
#include "sph/effects.hpp"
#include "sph/inner_layers.hpp"
#include "sph/linked_walls.hpp"
#include "sph/wall_parts.hpp"

namespace gannet {

namespace {
namespace carried_walls {

Schema schema() {
  return {{"bodies.*",
           {.name = "walls",
            .kind = Kind::choice,
            .text = "what stands inside of its surface for water outside: dummy (particles) or "
                    "contact, nothing but the penalty of contacts",
            .fallback = "contact",
            .choices = {"dummy", "contact"}}},
          {"bodies.*",
           {.name = "slip",
            .kind = Kind::choice,
            .text = "whether viscous water slides along it: free, or none; of dummy walls",
            .fallback = "free",
            .choices = {"free", "none"}}}};
}

/// Name of the part that the particles are: no part of a case can be called so.
std::string part_name(const std::string& body) { return "walls." + body; }

std::vector<Keys> walled_bodies(const Keys& root) {
  std::vector<Keys> list;
  if (!root.has("bodies")) return list;
  for (const std::string& name : root.map("bodies").names()) {
    const Keys keys = root.map("bodies").map(name);
    if (keys.word("walls") == "dummy") list.push_back(keys);
  }
  return list;
}

void complain_of_slip(const Keys& root) {
  if (!root.has("bodies")) return;
  for (const std::string& name : root.map("bodies").names()) {
    const Keys keys = root.map("bodies").map(name);
    if (keys.word("walls") != "dummy" && keys.given("slip")) {
      keys.complain("slip",
                    "has no meaning: only walls of dummy particles have one (walls: dummy)");
    }
  }
}

void add_parts(const Keys& root, Draft& draft) {
  complain_of_slip(root);
  for (const Keys& keys : walled_bodies(root)) {
    const std::vector<std::string> fluids = names_of_parts_with(root, "sph");
    if (fluids.empty()) {
      keys.complain("walls", "dummy particles need a fluid, and no part is made of 'sph'");
      continue;
    }
    if (!keys.has("parts")) continue;
    const ClosedSurface surface = closed_surface_of(draft, keys.words("parts"), keys, "walls");
    if (surface.facets.empty()) continue;
    const Keys sph = root.map("parts").map(fluids.front()).map("sph");
    PartDraft part{.name = part_name(keys.name()),
                   .kind = "wall",
                   .material = sph.word("material"),
                   .where = keys.where("walls"),
                   .points = inner_layers(surface, sph.number("spacing"),
                                          n_wall_layers(sph, draft.dimension))};
    if (part.points.empty()) {
      keys.complain("walls", "no dummy particle has room inside of the surface of the body");
      continue;
    }
    draft.parts.push_back(std::move(part));
  }
}

/// Where particles of bodies stand before any of them is wrapped into a periodic domain: what
/// put_on_body() makes their arms from [m].
void note_places(Walls& walls, const Scene& scene) {
  for (Index k = 0; k < scene.particles.size(); ++k) {
    const Wall* wall = walls.of(scene, k);
    if (wall == nullptr || !wall->on_body) continue;
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    set_xyz(walls.arm[k], xyz(scene.nodes.x[i]));
  }
}

void state(const Keys& /*root*/, Scene& scene) {
  if (!scene.store.has<Walls>()) return;
  auto& walls = scene.store.get<Walls>();
  for (Wall& wall : walls.list) {
    if (!wall.on_body) continue;
    if (walls.arm.empty()) {
      walls.arm.assign(static_cast<std::size_t>(scene.particles.size()), {});
      note_places(walls, scene);
      Field arm =
          line_field("wall arm", "m", "", Over::particles, walls.arm, 0, 3, GhostRule::none);
      arm.owner = "walls";
      scene.fields.push_back(std::move(arm));
    }
    track_values(scene, "walls", "walls." + wall.name + ".a", "m/s^2", 3,
                 [&wall] { return wall.a.data(); });
    track_values(scene, "walls", "walls." + wall.name + ".alpha", "rad/s^2", 3,
                 [&wall] { return wall.alpha.data(); });
  }
}

/// Puts the particles of a wall on its body, which is made by now: arms, velocities, no mass.
void put_on_body(Walls& walls, Scene& scene, Wall& wall) {
  Carrier& carrier = *wall.carrier;
  const auto c = static_cast<std::size_t>(carrier.node);
  const Vec3 centre = xyz(scene.nodes.x[c]);
  const Vec3 v = xyz(scene.nodes.v[c]);
  const Vec3 omega = xyz(scene.nodes.omega[c]);
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (scene.particle_part[k] != wall.part) continue;
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    const Vec3 r = xyz(walls.arm[k]) - centre;
    set_xyz(walls.arm[k], carrier.q.conjugate() * r);
    const Vec3 its = v + omega.cross(r);
    scene.nodes.v[i] = {its.x(), its.y(), its.z(), 0};
    scene.nodes.x[i].w = 0;
  }
}

void add_moment(Scene& scene, const Wall& wall) {
  scene.measures.push_back(
      {"wall." + wall.name + ".moment", "N m", {"x", "y", "z"}, [&wall](double* out) {
         for (int d = 0; d < 3; ++d) out[d] = wall.moment[d];
       }});
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (walled_bodies(root).empty() || !scene.store.has<Walls>()) return;
  auto& walls = scene.store.get<Walls>();
  auto& carriers = scene.store.get<Carriers>();
  Model& model = models.of_node(scene.particles.begin);
  for (Wall& wall : walls.list) {
    Carrier* carrier = wall.on_body ? carriers.find(wall.name) : nullptr;
    if (carrier == nullptr) continue;
    const Keys keys = root.map("bodies").map(wall.name);
    Model& of_body = models.of_node(carrier->node);
    if (models.rank(of_body) < models.rank(model)) {
      keys.complain("walls", fmt::format("dummy particles advance with the water, in model '{}', "
                                         "and the body in the slower '{}': list the model of the "
                                         "water first, or name the body's parts in it",
                                         model.name, of_body.name));
      continue;
    }
    wall.carrier = carrier;
    put_on_body(walls, scene, wall);
    add_moment(scene, wall);
    if (&of_body != &model) link_wall(walls, scene, models, wall, model, of_body);
  }
  const std::string reason = asked_for_at(walled_bodies(root).front().where("walls"));
  model.plan.add({.name = "motion of walls on bodies",
                  .reason = reason,
                  .stage = Stage::kick,
                  .reads = {"q"},
                  .writes = {"v", "f"},
                  .run = [&](const Step& step) { kick_carried_walls(walls, scene, step); }});
  model.plan.add({.name = "release walls on bodies",
                  .reason = reason,
                  .stage = Stage::half_drift,
                  .run = [&](const Step&) {
                    for_wall_particles(walls, scene, [&](Index k, const Wall& wall) {
                      if (wall.carrier == nullptr) return;
                      scene.nodes.v[static_cast<std::size_t>(scene.particles.begin + k)].w = 0;
                    });
                  }});
}

}  // namespace carried_walls
}  // namespace

void read_carried_walls(const Keys& root, const Scene& scene, Walls& walls) {
  for (const Keys& keys : carried_walls::walled_bodies(root)) {
    const int part = scene.part_number(carried_walls::part_name(keys.name()));
    if (part < 0) continue;
    const std::string fluid = names_of_parts_with(root, "sph").front();
    walls.list.push_back(
        {.part = part,
         .fluid = scene.part_number(fluid),
         .name = keys.name(),
         .where = keys.where("walls"),
         .slips = keys.word("slip") == "free",
         .on_body = true,
         .n_layers = n_wall_layers(root.map("parts").map(fluid).map("sph"), scene.dimension)});
  }
}

Effect carried_walls_effect() {
  return {.name = "walls on bodies",
          .schema = carried_walls::schema,
          .parts = carried_walls::add_parts,
          .state = carried_walls::state,
          .operations = carried_walls::operations};
}

}  // namespace gannet
