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

#include "mesh/fill.hpp"
#include "scene/plane_keys.hpp"
#include "scene/wave_keys.hpp"
#include "sph/effects.hpp"
#include "sph/wall_keys.hpp"
#include "sph/wall_points.hpp"
#include "sph/wall_state.hpp"

namespace gannet {

namespace {

/// Names of the parts under a key ("sph", "wall"), in file order.
std::vector<std::string> parts_with(const Keys& root, const char* key) {
  std::vector<std::string> names;
  if (!root.has("parts")) return names;
  const Keys parts = root.map("parts");
  for (const std::string& name : parts.names()) {
    if (parts.map(name).has(key)) names.push_back(name);
  }
  return names;
}

/// The planes that dummy particles are asked for behind.
std::vector<Plane> backed_planes(const Keys& root) {
  std::vector<Plane> planes = read_planes(root);
  std::erase_if(planes, [](const Plane& plane) { return plane.behind != Behind::dummy; });
  return planes;
}

/// The fluid that a wall goes with; "" after a complaint.
std::string fluid_of(const Keys& root, const Keys& wall) {
  const std::vector<std::string> fluids = parts_with(root, "sph");
  if (fluids.empty()) {
    wall.complain("", "a wall of particles needs a fluid, and no part is made of 'sph'");
    return "";
  }
  const std::string like = wall.has("like") ? wall.word("like") : fluids.front();
  if (std::ranges::find(fluids, like) == fluids.end()) {
    wall.complain("like", fmt::format("'{}' is not made of 'sph'", like));
    return "";
  }
  return like;
}

/// Directions that repeat, and their ends.
void read_periods(const Keys& root, WallRegion& region) {
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("periodic")) continue;
    const Keys periodic = boundaries.map(name).map("periodic");
    for (int d = 0; d < region.dimension; ++d) {
      const std::string axis(1, static_cast<char>('x' + d));
      if (!periodic.has(axis) || periodic.numbers(axis).size() != 2) continue;
      region.periodic[static_cast<std::size_t>(d)] = true;
      region.low[d] = periodic.numbers(axis)[0];
      region.high[d] = periodic.numbers(axis)[1];
    }
  }
}

/// The region that walls of planes are built around: what the case says, or the box of the fluid,
/// widened by half of itself on each side in whole spacings.
WallRegion region_of(const Keys& root, const Draft& draft) {
  const Keys sph = root.map("parts").map(parts_with(root, "sph").front()).map("sph");
  WallRegion region;
  region.dimension = draft.dimension;
  region.dx = sph.number("spacing");
  const KernelType kernel = kernel_named(sph.word("kernel"));
  const double ratio =
      sph.number_or("smoothing_ratio", usual_smoothing_ratio(kernel, draft.dimension));
  region.n_layers = static_cast<int>(std::ceil(support(kernel) * ratio - 1e-9));
  Eigen::AlignedBox3d box;
  for (const PartDraft& part : draft.parts) {
    if (part.kind != "sph") continue;
    for (const Vec3& x : part.points) box.extend(x);
  }
  if (box.isEmpty()) return region;
  for (int d = 0; d < draft.dimension; ++d) {
    const double half = 0.5 * (box.sizes()[d] + region.dx);
    const double more = region.dx * std::max<double>(region.n_layers, std::ceil(half / region.dx));
    region.low[d] = box.min()[d] - 0.5 * region.dx - more;
    region.high[d] = box.max()[d] + 0.5 * region.dx + more;
  }
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    if (!boundaries.map(name).has("extent")) continue;
    const Keys extent = boundaries.map(name).map("extent");
    const Vec3 from = extent.vector("from");
    const Vec3 to = extent.vector("to");
    for (int d = 0; d < draft.dimension; ++d) {
      if (!(from[d] < to[d])) {
        extent.complain("to", "each coordinate must be greater than that of 'from'");
        break;
      }
      region.low[d] = from[d];
      region.high[d] = to[d];
    }
  }
  read_periods(root, region);
  return region;
}

void add_backed_planes(const Keys& root, Draft& draft) {
  const std::vector<Plane> planes = backed_planes(root);
  if (planes.empty()) return;
  const std::vector<std::string> fluids = parts_with(root, "sph");
  if (fluids.empty()) {
    root.mistakes().add(
        planes.front().where,
        "dummy particles behind a plane need a fluid, and no part is made of 'sph'");
    return;
  }
  const std::string material = root.map("parts").map(fluids.front()).map("sph").word("material");
  const auto points = points_behind(planes, region_of(root, draft));
  for (std::size_t k = 0; k < planes.size(); ++k) {
    PartDraft part{.name = planes[k].name,
                   .kind = "wall",
                   .material = material,
                   .where = planes[k].where,
                   .points = points[k]};
    if (std::ranges::find(draft.parts, part.name, &PartDraft::name) != draft.parts.end()) {
      root.mistakes().add(part.where,
                          fmt::format("the dummy particles of '{0}' make a part of that "
                                      "name, and there is a part '{0}' already",
                                      part.name));
    }
    if (!part.points.empty()) draft.parts.push_back(std::move(part));
  }
}

void add_parts(const Keys& root, Draft& draft) {
  for (const std::string& name : parts_with(root, "wall")) {
    const Keys part = root.map("parts").map(name);
    const std::string like = fluid_of(root, part.map("wall"));
    if (like.empty()) continue;
    if (part.has("map")) part.complain("map", "moves the points of elements, not those of a fill");
    if (!part.has("fill")) {
      part.complain("fill", "missing; a wall needs a region to fill: fill: {box: {from, to}}");
      continue;
    }
    const Keys sph = root.map("parts").map(like).map("sph");
    draft.parts.push_back({.name = name,
                           .kind = "wall",
                           .material = sph.word("material"),
                           .where = part.where(),
                           .points = fill_points(part, sph.number("spacing"), draft.dimension)});
  }
  add_backed_planes(root, draft);
}

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
  for (const std::string& name : parts_with(root, "wall")) {
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
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Plane& plane = scene.planes[k];
    const int part = plane.behind == Behind::dummy ? scene.part_number(plane.name) : -1;
    if (part < 0) continue;
    walls.list.push_back({.part = part,
                          .fluid = scene.part_number(parts_with(root, "sph").front()),
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
    if (wall->waves) set_xyz(walls.rest_place[k], rest_place_of(*wall->waves, x, 0));
    set_xyz(scene.nodes.v[i], velocity_at_start(*wall, scene, x));
  }
}

bool has_walls(const Scene& scene) { return scene.store.has<Walls>(); }

/// Work of the forces on a wall along the path of its particles at level n [J].
Work work_on(const Scene& scene, const Wall& wall, const Array<Line>& force, const Step& step) {
  return sum_over_awake(scene, wall.part, [&](Index k) -> Work {
    return work_along(work_path(scene.nodes, scene.particles.begin + k, step), xyz(force[k]));
  });
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

void add_energy(Walls& walls, const SphState& sph, Scene& scene, Models& models, Plan& plan) {
  for (Wall& wall : walls.list) {
    LedgerEntry& stored = models.ledger.entry("wall", wall.name);
    LedgerEntry& motion = models.ledger.entry("wall motion", wall.name);
    motion.external = true;
    plan.add({.name = "work of wall " + wall.name,
              .reason = asked_for_at(wall.where),
              .stage = Stage::look,
              .reads = {"v", "f"},
              .run = [&](const Step& step) {
                // The half step after the level is added when its rate is known.
                stored.add_work({0.5 * step.dt_old * wall_power(walls, sph, scene, wall), 0});
                motion.add_work(work_on(scene, wall, walls.reaction, step));
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
          .parts = add_parts,
          .state = make_state,
          .operations = add_operations};
}

Effect wall_pressure_effect() { return {.name = "wall pressure", .operations = add_pressure}; }

}  // namespace gannet
