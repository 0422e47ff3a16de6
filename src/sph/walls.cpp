// The effect `walls`: dummy particles (Adami, Hu and Adams 2012, J. Comput. Phys. 231, 7057). A
// part may be a wall, and planes may be backed by layers of such particles. They are particles as
// all others: sorted, listed, packed, sources of both pair passes. Their velocity is given by the
// case, their pressure follows from the fluid near them (sph/wall_pass.hpp), and the force of the
// fluid on them is the reaction to what they do to it, pair by pair.
//
// Energy. The two pair passes are adjoint: over fluid and wall together,
//   sum_f f_f . v_f + sum_f m (p/rho^2) drho/dt = -sum_w f_w . v_w - sum_w m (p_w/rho_w^2)
//   drho_w/dt
// for the pressure terms, wall particles seeing the fluid alone. Fluid stores its compression; a
// wall does not, its density is made anew from p_w. What the fluid loses to it that way is the
// ledger's entry "wall"; the work of the motion of a wall is external, entry "wall motion".
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/wave_keys.hpp"
#include "sph/carried_walls.hpp"
#include "sph/effects.hpp"
#include "sph/wall_keys.hpp"
#include "sph/wall_parts.hpp"
#include "sph/wall_state.hpp"

namespace gannet {

namespace {

/// A table of `factor`: what a wall has moved is its integral, exactly.
TimeTable read_factor(const Keys& wall) {
  const Function& factor = wall.function("factor");
  if (factor.formula) {
    wall.complain("factor", "a wall moves by a table, [[0 s, 0], [1 ms, 1]], and not by a formula");
    return {};
  }
  if (factor.constant()) return {{0}, {factor.factor}};
  TimeTable table = factor.table;
  for (double& y : table.y) y *= factor.factor;
  return table;
}

WallMotion read_motion(const Keys& wall) {
  WallMotion motion;
  if (wall.has("velocity")) motion.velocity = wall.vector("velocity");
  if (wall.has("angular_velocity")) motion.omega = wall.vector("angular_velocity");
  if (wall.has("centre")) motion.centre = wall.vector("centre");
  if (wall.has("factor")) motion.factor = read_factor(wall);
  return motion;
}

/// In a plane case nothing may leave the plane.
void require_plane_motion(const Keys& wall, const WallMotion& motion) {
  if (motion.velocity.z() != 0) wall.complain("velocity", "a plane case lies in x and y");
  if (motion.omega.x() != 0 || motion.omega.y() != 0) {
    wall.complain("angular_velocity", "a plane case turns about z alone");
  }
}

void read_walls(const Keys& root, const Scene& scene, Walls& walls) {
  for (const std::string& name : names_of_parts_with(root, "wall")) {
    const int part = scene.part_number(name);
    if (part < 0) continue;
    const Keys keys = root.map("parts").map(name).map("wall");
    Wall wall{.part = part,
              .fluid = scene.part_number(fluid_of(root, keys)),
              .name = name,
              .where = scene.parts[static_cast<std::size_t>(part)].where};
    wall.slips = keys.word("slip") == "free";
    wall.motion = read_motion(keys);
    if (scene.dimension == 2) require_plane_motion(keys, wall.motion);
    if (keys.has("motion") && root.has("sea")) {
      const WaveField field = read_wave_field(root, scene.dimension);
      if (field.depth > 0) wall.waves = std::make_shared<WaveField>(field);
    }
    if (keys.has("motion") && (wall.motion.moves() || keys.has("factor"))) {
      keys.complain("motion", "moves the wall alone: no velocity, angular_velocity or factor");
    }
    walls.list.push_back(std::move(wall));
  }
  read_carried_walls(root, scene, walls);
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const int part = plane.behind == Behind::dummy ? scene.part_number(plane.name) : -1;
    if (part < 0) continue;
    walls.list.push_back({.part = part,
                          .fluid = scene.part_number(names_of_parts_with(root, "sph").front()),
                          .name = plane.name,
                          .where = plane.where,
                          .slips = plane.slips,
                          .plane = static_cast<int>(k)});
  }
}

void track(Scene& scene, Field field) {
  field.owner = "walls";
  scene.fields.push_back(std::move(field));
}

void make_state(const Keys& root, Scene& scene) {
  Walls read;
  read_walls(root, scene, read);
  if (read.list.empty()) return;
  Walls& walls = scene.store.get<Walls>();
  walls = std::move(read);
  auto& sph = scene.store.get<SphState>();
  walls.of_part.assign(scene.parts.size(), -1);
  for (std::size_t w = 0; w < walls.list.size(); ++w) {
    const auto part = static_cast<std::size_t>(walls.list[w].part);
    walls.of_part[part] = static_cast<int>(w);
    sph.eos[part] = sph.eos[static_cast<std::size_t>(walls.list[w].fluid)];
  }
  const auto n = static_cast<std::size_t>(scene.particles.size());
  for (Array<Line>* array : {&walls.f_before, &walls.f, &walls.reaction}) array->assign(n, {});
  walls.p_rho2.assign(n, 0);
  walls.drho_dt.assign(n, 0);
  const Over over = Over::particles;
  if (std::ranges::any_of(walls.list, [](const Wall& w) { return w.waves != nullptr; })) {
    walls.rest_place.assign(n, {});
    track(scene,
          line_field("wall rest place", "m", "", over, walls.rest_place, 0, 3, GhostRule::none));
  }
  track(scene,
        plain_field("wall p/rho^2", "m^5/(kg s^2)", "", over, walls.p_rho2, 1, GhostRule::none));
  track(scene,
        plain_field("wall drho_dt", "kg/(m^3 s)", "", over, walls.drho_dt, 1, GhostRule::none));
  for (Index k = 0; k < scene.particles.size(); ++k) {
    const Wall* wall = walls.of(scene, k);
    if (wall == nullptr) continue;
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    sph.rho[k] = eos_of(sph, scene, k).rho0;
    sph.p[k] = eos_of(sph, scene, k).p0;
    const Vec3 x = xyz(scene.nodes.x[i]);
    if (wall->on_body) continue;
    if (wall->waves) set_xyz(walls.rest_place[k], rest_place_of(*wall->waves, x, 0));
    set_xyz(scene.nodes.v[i], velocity_at_start(*wall, scene, x));
  }
}

bool has_walls(const Scene& scene) { return scene.store.has<Walls>(); }

/// Work of the forces on a wall along the path of its particles at level n [J]; nothing yet for the
/// half step after it where its body has still to go it.
Work work_on(const Scene& scene, const Wall& wall, const Array<Line>& force, const Step& step) {
  Work work = sum_over_awake(scene, wall.part, [&](Index k) -> Work {
    return work_along(work_path(scene.nodes, scene.particles.begin + k, step), xyz(force[k]));
  });
  if (wall.link != nullptr) work[1] = 0;
  return work;
}

void add_measures(Scene& scene, const Wall& wall) {
  const std::vector<std::string> components{"x", "y", "z"};
  const auto add = [&](const char* what, auto value) {
    scene.measures.push_back(
        {"wall." + wall.name + "." + what, "N", components, [&wall, value](double* out) {
           const Vec3 f = value(wall);
           for (int d = 0; d < 3; ++d) out[d] = f[d];
         }});
  };
  add("force", [](const Wall& w) { return w.force; });
  add("pressure_force", [](const Wall& w) -> Vec3 { return w.force - w.viscous_force; });
  add("viscous_force", [](const Wall& w) { return w.viscous_force; });
}

/// The entry for what the motion of a wall takes; none where a body pays for it.
LedgerEntry* entry_of_motion(const Wall& wall, Ledger& ledger) {
  if (wall.on_body) return nullptr;
  LedgerEntry& motion = ledger.entry("wall motion", wall.name);
  motion.external = true;
  return &motion;
}

void add_energy(Walls& walls, const SphState& sph, Scene& scene, Models& models, Plan& plan) {
  for (Wall& wall : walls.list) {
    LedgerEntry& stored = models.ledger.entry("wall", wall.name);
    LedgerEntry* motion = entry_of_motion(wall, models.ledger);
    plan.add({.name = "work of wall " + wall.name,
              .reason = asked_for_at(wall.where),
              .stage = Stage::look,
              .reads = {"v", "f"},
              .run = [&, motion](const Step& step) {
                // The half step after the level is added when its rate is known.
                stored.add_work({0.5 * step.dt_old * wall_power(walls, sph, scene, wall), 0});
                if (motion == nullptr) return;
                motion->add_work(work_on(scene, wall, walls.reaction, step));
              }});
    plan.add({.name = "energy that wall " + wall.name + " takes",
              .reason = asked_for_at(wall.where),
              .stage = Stage::rates,
              .run = [&](const Step& step) {
                stored.pending = 0.5 * step.dt * wall_power(walls, sph, scene, wall);
              }});
  }
}

/// What the terms of the force take out of the motion of a wall: it may drag the fluid along.
void add_work_of_terms(Walls& walls, Scene& scene, Models& models, Plan& plan) {
  for (const WallTerm& term : walls.terms) {
    for (const Wall& wall : walls.list) {
      LedgerEntry& entry = models.ledger.entry(term.entry, wall.name);
      plan.add(
          {.name = fmt::format("work of {} on wall {}", term.entry, wall.name),
           .reason = asked_for_at(wall.where),
           .stage = Stage::look,
           .reads = {"v", "f"},
           .run = [&](const Step& step) { entry.add_work(-work_on(scene, wall, term.f, step)); }});
    }
  }
}

void add_operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!has_walls(scene)) return;
  auto& walls = scene.store.get<Walls>();
  auto& sph = scene.store.get<SphState>();
  Plan& plan = models.of_node(scene.particles.begin).plan;
  make_terms(walls, sph);
  sph.restless.resize(scene.parts.size());
  for (const Wall& wall : walls.list) {
    sph.restless[static_cast<std::size_t>(wall.part)] = moves(wall, scene);
  }
  const std::string reason = asked_for_at(walls.list.front().where);
  plan.add({.name = "force on walls",
            .reason = reason,
            .stage = Stage::accelerate,
            .reads = {"x", "v", "rho", "p"},
            .writes = {"f"},
            .run = [&](const Step&) { set_wall_force(walls, sph, scene); }});
  add_gathering(walls, sph, scene, plan);
  plan.add({.name = "motion of walls",
            .reason = reason,
            .stage = Stage::kick,
            .reads = {"planes"},
            .writes = {"v", "f"},
            .run = [&](const Step& step) { kick_walls(walls, scene, step); }});
  plan.add({.name = "density rate of walls",
            .reason = reason,
            .stage = Stage::rates,
            .reads = {"x", "v", "rho"},
            .writes = {"wall drho_dt", "X"},
            .owns = {"wall drho_dt"},
            .run = [&](const Step&) { set_wall_rates(walls, sph, scene); }});
  add_energy(walls, sph, scene, models, plan);
  add_work_of_terms(walls, scene, models, plan);
  for (const Wall& wall : walls.list) add_measures(scene, wall);
}

void add_pressure(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!has_walls(scene)) return;
  auto& walls = scene.store.get<Walls>();
  auto& sph = scene.store.get<SphState>();
  models.of_node(scene.particles.begin)
      .plan.add({.name = "pressure of walls",
                 .reason = asked_for_at(walls.list.front().where),
                 .stage = Stage::force,
                 .reads = {"x", "v", "rho", "p"},
                 .writes = {"rho", "p"},
                 .owns = {"wall p/rho^2"},
                 .run = [&](const Step& step) { set_wall_pressure(walls, sph, scene, step); }});
}

}  // namespace

Effect walls_effect() {
  return {.name = "walls",
          .schema = wall_schema,
          .parts = add_wall_parts,
          .state = make_state,
          .operations = add_operations};
}

Effect wall_pressure_effect() { return {.name = "wall pressure", .operations = add_pressure}; }

}  // namespace gannet
