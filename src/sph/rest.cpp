// The effect `rest`: water where nothing above a stated disturbance happens is not computed. What
// that means stands in sph/rest.hpp.
//
// Energy. The entry `rest` holds the motion that was taken from water that came to rest, and what
// water in motion does to the compression of the water at rest beside it, which does not follow.
// What woken particles have at their first level came out of no work, and is taken off.
#include "sph/rest.hpp"

#include <fmt/format.h>

#include <string>

#include "plan/effect.hpp"
#include "scene/tracked_values.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/neighbour_lists.hpp"

namespace gannet {

namespace {
namespace rest {

Schema schema() {
  Key rest{.name = "rest",
           .kind = Kind::map,
           .text = "water is not computed where nothing above a disturbance happens"};
  rest.keys = {
      {.name = "tolerance",
       .text =
           "water that flows slower than this share of `speed` may rest, and faster water wakes "
           "it",
       .fallback = "1e-4",
       .limits = between(0, 100)},
      {.name = "speed",
       .unit = dim::velocity,
       .text = "speed that the tolerance is a share of (a tenth of the speed of sound)",
       .limits = positive()},
      {.name = "quiet",
       .unit = dim::time,
       .text = "how long water has to be still before it rests (speed over gravity)",
       .limits = positive()}};
  return {{"effects", rest}};
}

Keys keys_of(const Keys& root) { return root.map("effects").map("rest"); }

/// Whether what a probe of the force on a wall watches moves: a part, a boundary or one of its
/// planes.
bool moves(const Keys& root, const std::string& name) {
  if (root.has("parts") && root.map("parts").has(name)) {
    const Keys part = root.map("parts").map(name);
    if (!part.has("wall")) return true;
    const Keys wall = part.map("wall");
    return wall.has("velocity") || wall.has("angular_velocity") || wall.has("motion");
  }
  const std::string boundary = name.substr(0, name.find('.'));
  return !root.map("boundaries").has(boundary) ||
         root.map("boundaries").map(boundary).has("motion");
}

/// Water at rest presses on walls too, but its force is not summed up.
void refuse_forces_on_still_walls(const Keys& root) {
  if (!root.has("probes")) return;
  const Keys probes = root.map("probes");
  for (const std::string& name : probes.names()) {
    const Keys probe = probes.map(name);
    if (!probe.has("wall_force") || moves(root, probe.word("wall_force"))) continue;
    probe.complain("wall_force",
                   fmt::format("'{}' stands still, and with effects.rest the force of "
                               "water at rest on it is not summed up",
                               probe.word("wall_force")));
  }
}

/// What rest does not do right, each with its place.
void refuse(const Keys& root) {
  refuse_forces_on_still_walls(root);
  if (root.has("loads") && root.map("loads").has("gravity")) {
    const VectorFunction g = root.map("loads").vector_function("gravity");
    if (!g.constant()) {
      root.map("loads").complain("gravity",
                                 "changes in time, and effects.rest leaves water alone "
                                 "where nothing moves: let the tank move instead");
    }
  }
  if (!root.has("boundaries")) return;
  const Keys boundaries = root.map("boundaries");
  for (const std::string& name : boundaries.names()) {
    const Keys boundary = boundaries.map(name);
    if (!boundary.has("sponge") || !boundary.map("sponge").has("velocity")) continue;
    boundary.map("sponge").complain(
        "velocity", "drives water, and effects.rest leaves water alone where nothing moves");
  }
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "rest", scene)) return;
  auto& rest = scene.store.get<Rest>();
  const auto& sph = scene.store.get<SphState>();
  const Keys keys = keys_of(root);
  refuse(root);
  rest.asked_for = true;
  rest.tolerance = keys.number("tolerance");
  rest.speed = keys.number_or("speed", 0.1 * sph.c0);
  rest.state.assign(static_cast<std::size_t>(scene.particles.size()), rest_awake);
  const auto track = [&](Field field) {
    field.owner = "rest";
    scene.fields.push_back(std::move(field));
  };
  track(plain_field("rest", "", "Rest", Over::particles, rest.state, 1, GhostRule::none));
  track(plain_field("rest.disturbed_at", "s", "", Over::scene, rest.disturbed_at, 1,
                    GhostRule::none));
  track(plain_field("rest.flow", "m/s", "", Over::scene, rest.flow, 1, GhostRule::none));
  track_values(scene, "rest", "rest.looked_at", "s", 1, [&rest] { return &rest.looked_at; });
  track_values(scene, "rest", "rest.steps", "", 2,
               [&scene] { return &scene.resting.particle_steps; });
  track_values(scene, "rest", "rest.momentum", "kg m/s", 3,
               [&scene] { return scene.resting.momentum.data(); });
  // Before lists are restored: they are of those that are awake.
  scene.after_restart.insert(scene.after_restart.begin(),
                             [&] { count_rest(rest, scene.store.get<SphState>(), scene); });
}

/// Time that water has to be still: that of a fall to `speed`; without gravity, that of sound
/// through the scene [s].
double usual_quiet(const Rest& rest, const SphState& sph, const Scene& scene, const Vec3& extent) {
  const double g = scene.gravity.norm();
  return g > 0 ? rest.speed / g : extent.norm() / sph.c0;
}

void make_cells(const Keys& root, Rest& rest, const SphState& sph, const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    box.extend(xyz(scene.nodes.x[i]));
  }
  Vec3 low = box.min();
  Vec3 high = box.max();
  for (std::size_t d = 0; d < 3; ++d) {
    if (!sph.halo.periodic[d]) continue;
    const auto k = static_cast<Eigen::Index>(d);
    low[k] = sph.halo.low[k];
    high[k] = sph.halo.high[k];
  }
  rest.cells = cells_over(low, high, sph.kernel.reach() + sph.skin.most, sph.halo.periodic,
                          std::max<Index>(4096, scene.particles.size()));
  const auto n = static_cast<std::size_t>(rest.cells.size());
  rest.disturbed_at.assign(n, 0);
  rest.flow.assign(3 * n, 0);
  rest.n_resting.assign(n, 0);
  rest.quiet = keys_of(root).number_or("quiet", usual_quiet(rest, sph, scene, high - low));
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<Rest>() || !scene.store.get<Rest>().asked_for) return;
  auto& rest = scene.store.get<Rest>();
  auto& sph = scene.store.get<SphState>();
  make_cells(root, rest, sph, scene);
  // Of who comes to rest in the first step after a restart, the rates of the step before are asked.
  for (Field& field : scene.fields) {
    if (field.name == "drho_diffusion") field.checkpoint = true;
  }
  const std::string reason = asked_for_at(root.map("effects").where("rest"));
  Plan& plan = models.of_node(scene.particles.begin).plan;
  LedgerEntry& lost = models.ledger.entry("rest", "");
  plan.add({.name = "energy of particles that wake",
            .reason = reason,
            .stage = Stage::look,
            .reads = {"v", "f"},
            .run = [&](const Step& step) { lost.value -= energy_of_woken(rest, scene, step.dt); }});
  plan.add(
      {.name = "who rests",
       .reason = fmt::format("{}: slower than {:.3g} m/s for {:.3g} s; looked for every {} steps",
                             reason, rest.tolerance * rest.speed, rest.quiet, rest_every),
       .stage = Stage::half_drift,
       .reads = {"x", "v"},
       .writes = {"v", "order of particles"},
       .owns = {"rest", "rest.disturbed_at"},
       .run = [&](const Step& step) {
         const double t = step.t + 0.5 * step.dt;
         if (step.n % rest_every == 0 && look_for_rest(rest, sph, scene, t)) {
           lost.value += choose_rest(rest, sph, scene, t, step.dt);
           rebuild_lists(sph, scene);
         }
         scene.resting.particle_steps += scene.resting.n;
         scene.resting.all_particle_steps += scene.particles.size();
       }});
  plan.add({.name = "energy at the border of rest",
            .reason = reason,
            .stage = Stage::rates,
            .reads = {"x", "v", "rho", "p"},
            .run = [&](const Step& step) {
              lost.value += step.dt * power_at_border(rest, sph, scene);
            }});
}

std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  if (!scene.store.has<Rest>() || !scene.store.get<Rest>().asked_for) return list;
  const Rest& rest = scene.store.get<Rest>();
  const Keys keys = keys_of(root);
  if (!keys.has("speed")) {
    list.push_back({"effects.rest.speed", fmt::format("{:.4g} m/s", rest.speed),
                    "a tenth of the largest speed of sound"});
  }
  if (!keys.has("quiet")) {
    list.push_back({"effects.rest.quiet", fmt::format("{:.4g} s", rest.quiet),
                    "speed over gravity; without gravity, sound through the scene"});
  }
  return list;
}

}  // namespace rest
}  // namespace

Effect rest_effect() {
  return {.name = "rest",
          .schema = rest::schema,
          .state = rest::make_state,
          .operations = rest::add_operations,
          .choices = rest::choices};
}

}  // namespace gannet
