#include "time/guards.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/parallel.hpp"

namespace gannet {

namespace {

Schema guards_schema() {
  Key guards{.name = "guards", .kind = Kind::map, .text = "limits at which a run is stopped"};
  guards.keys = {{.name = "active",
                  .kind = Kind::flag,
                  .text = "whether a run that goes wrong is stopped at all; `guards: off` says the "
                          "same",
                  .fallback = "on"},
                 {.name = "energy_error",
                  .text = "largest energy imbalance over the sizes of all energies together",
                  .fallback = "20 %",
                  .limits = positive()},
                 {.name = "smallest_dt_ratio",
                  .text = "smallest time step over the first one",
                  .fallback = "1e-4",
                  .limits = between(0, 1)},
                 {.name = "largest_speed",
                  .unit = dim::velocity,
                  .text = "largest speed of any node; absent: any finite speed",
                  .limits = positive()},
                 {.name = "density_range",
                  .text = "largest |rho/rho0 - 1| of a particle",
                  .fallback = "50 %",
                  .limits = positive()}};
  return {{"effects", guards}};
}

GuardLimits read_limits(const Keys& root) {
  GuardLimits limits;
  if (!root.has("effects") || !root.map("effects").has("guards")) return limits;
  const Keys keys = root.map("effects").map("guards");
  limits.energy_error = keys.number_or("energy_error", limits.energy_error);
  limits.smallest_dt_ratio = keys.number_or("smallest_dt_ratio", limits.smallest_dt_ratio);
  limits.largest_speed = keys.number_or("largest_speed", limits.largest_speed);
  limits.density_range = keys.number_or("density_range", limits.density_range);
  return limits;
}

/// The map of the case that says something of guards; an empty one where none does.
Keys guard_keys(const Keys& root) { return root.map("effects").map("guards"); }

bool switched_off(const Keys& root) {
  const Keys keys = guard_keys(root);
  return keys.has("active") && !keys.flag("active");
}

std::string place_of(const Scene& scene, Index i) {
  std::string part = "no part";
  for (const Part& p : scene.parts) {
    if (!p.is_particles() && p.nodes.contains(i)) part = p.name;
  }
  if (scene.particles.contains(i) && !scene.particle_part.empty()) {
    part =
        scene.parts[static_cast<std::size_t>(scene.particle_part[i - scene.particles.begin])].name;
  }
  const Line& x = scene.nodes.x[i];
  return fmt::format("part {}, {} {} at ({:.6g}, {:.6g}, {:.6g}) m", part,
                     scene.particles.contains(i) ? "particle" : "node", scene.nodes.id[i], x.x, x.y,
                     x.z);
}

/// First node that is computed and whose speed is not finite or above the limit; -1 where all are
/// well.
Index runaway_node(const Scene& scene, double limit) {
  const Nodes& nodes = scene.nodes;
  return parallel_reduce(
      scene.computed({0, nodes.n_owned}).size(), node_chunk, Index{-1},
      [&](Index a, Index b) {
        for (Index i = a; i < b; ++i) {
          const double v2 = xyz(nodes.v[i]).squaredNorm();
          const double x2 = xyz(nodes.x[i]).squaredNorm();
          if (!(v2 <= limit * limit) || !std::isfinite(x2)) return i;
        }
        return Index{-1};
      },
      [](Index a, Index b) { return a >= 0 ? a : b; });
}

std::string when(const Step& s) { return fmt::format("t = {:.6g} s, step {}", s.t, s.n); }

void check_motion(const Scene& scene, const GuardLimits& limits, const Step& s) {
  const double limit = limits.largest_speed > 0 ? limits.largest_speed : 1e12;
  const Index i = runaway_node(scene, limit);
  if (i < 0) return;
  const double speed = xyz(scene.nodes.v[i]).norm();
  throw RunError(
      {std::isfinite(speed) ? fmt::format("a node runs away at {:.4g} m/s", speed)
                            : std::string("a node has no finite velocity or position (NaN)"),
       place_of(scene, i),
       fmt::format("at {}; the force on it grew without bound: too large a step, too stiff a "
                   "contact, or parts that start inside each other",
                   when(s)),
       "look at the frames just before that time; lower the step factors, raise the viscosity, "
       "or check the start with `gannet check`"});
}

void check_density(const Scene& scene, const GuardLimits& limits, const Step& s) {
  const Field* rho = scene.field("rho");
  if (rho == nullptr || scene.particles.empty()) return;
  const Index n = scene.awake().size();
  const auto value = [&](Index k) { return *reinterpret_cast<const double*>(rho->at(k)); };
  const double mean = parallel_sum(n, node_chunk,
                                   [&](Index a, Index b) {
                                     double sum = 0;
                                     for (Index k = a; k < b; ++k) sum += value(k);
                                     return sum;
                                   }) /
                      n;
  const Index bad = parallel_reduce(
      n, node_chunk, Index{-1},
      [&](Index a, Index b) {
        for (Index k = a; k < b; ++k) {
          if (!(std::abs(value(k) / mean - 1) <= limits.density_range)) return k;
        }
        return Index{-1};
      },
      [](Index a, Index b) { return a >= 0 ? a : b; });
  if (bad < 0) return;
  throw RunError({fmt::format("a particle's density is {:.4g} kg/m^3", value(bad)),
                  place_of(scene, scene.particles.begin + bad),
                  fmt::format("at {}; the mean is {:.4g} kg/m^3 and the guard allows {:.3g} of it",
                              when(s), mean, limits.density_range),
                  "raise c0 or the viscosity, lower the step, or look for particles that start "
                  "on top of each other"});
}

/// Steps before the energy balance of a scene that starts without energy is held to its limit:
/// where a motion starts smoothly, the energies of the first steps grow so fast that the half step
/// between x and v shows in them.
constexpr std::int64_t first_steps = 20;

/// The energy of a motion of all nodes by a nanometre a second [J].
double energy_of_rounding(const Scene& scene) {
  constexpr double speed = 1e-9;
  double mass = 0;
  for (Index i = 0; i < scene.nodes.n_owned; ++i) mass += scene.nodes.x[i].w;
  return 0.5 * mass * speed * speed;
}

void check_energy(const GuardState& state, const Step& s) {
  const EnergyBalance& b = state.balance;
  const bool known = std::isfinite(b.imbalance);
  if (known && b.scale <= state.least_energy) return;
  if (known && s.n < first_steps && std::abs(b.start_held) <= 1e-9 * b.largest_total) return;
  const double error = known ? b.error_of_scale() : b.imbalance;
  if (std::abs(error) <= state.limits.energy_error) return;
  throw RunError(
      {fmt::format("the energy balance is off by {:.3g} %", 100 * error),
       "the whole scene (history/energy.csv tells which entry grew)",
       fmt::format("at {}; the guard allows {:.3g} %", when(s), 100 * state.limits.energy_error),
       "lower the step factors; a sudden growth means an instability, a slow one a "
       "dissipation that nothing measures"});
}

void check_step(GuardState& state, const Model& model) {
  double& first = state.record[4];
  const double dt = model.step.dt;
  if (first == 0) first = dt;
  if (dt >= state.limits.smallest_dt_ratio * first) return;
  throw RunError({fmt::format("the time step collapsed to {:.3g} s", dt),
                  fmt::format("model {}, {}", model.name, model.vote.limited_by()),
                  fmt::format("at {}; the first step was {:.3g} s", when(model.step), first),
                  "look at the element or particle named: it is crushed, or its contact is too "
                  "stiff"});
}

void save(GuardState& s) {
  s.record[0] = s.balance.start_held;
  s.record[1] = s.balance.largest_total;
  s.record[2] = s.balance.imbalance;
  s.record[3] = s.balance.started ? 1 : 0;
  s.record[5] = s.balance.scale;
}

void load(GuardState& s) {
  s.balance = {s.record[0], s.record[1], s.record[2], s.record[3] != 0, s.record[5]};
}

void guards_state(const Keys& root, Scene& scene) {
  GuardState& state = scene.store.get<GuardState>();
  state.limits = read_limits(root);
  state.record.assign(6, 0.0);
  Field f = plain_field("guards", "", "", Over::scene, state.record, 1, GhostRule::none);
  f.owner = "guards";
  scene.fields.push_back(std::move(f));
  scene.after_restart.push_back([&state] { load(state); });
}

void guards_operations(const Keys& root, Scene& scene, Models& models) {
  GuardState& state = scene.store.get<GuardState>();
  const Ledger& ledger = models.ledger;
  Model& model = models.list.back();
  state.least_energy = energy_of_rounding(scene);
  model.plan.add({.name = "energy balance",
                  .reason = "always there: the energy ledger",
                  .stage = Stage::look,
                  .where_all_meet = true,
                  .reads = {"ledger"},
                  .owns = {"guards"},
                  .run = [&state, &ledger](const Step&) {
                    state.balance.update(ledger);
                    save(state);
                  }});
  if (switched_off(root)) {
    scene.warnings.push_back(guard_keys(root).where("active").text() +
                             ": effects.guards.active: off: nothing stops a run whose motion, "
                             "density, energy or time step goes wrong");
    return;
  }
  model.plan.add({.name = "guards",
                  .reason = "rule: stops a run that goes wrong",
                  .stage = Stage::look,
                  .where_all_meet = true,
                  .reads = {"x", "v", "rho", "ledger"},
                  .run = [&scene, &state, &models](const Step& s) {
                    check_motion(scene, state.limits, s);
                    check_density(scene, state.limits, s);
                    check_energy(state, s);
                    check_step(state, models.list.front());
                  }});
}

Presence guards_presence(const Keys& root, Scene&) {
  using State = Presence::State;
  const Keys keys = guard_keys(root);
  const std::string place = keys.path() + " at " + keys.where().text();
  if (switched_off(root)) {
    return {State::off, keys.path() + ".active: off at " + keys.where("active").text()};
  }
  if (root.map("effects").given("guards")) return {State::on, place};
  return {State::automatic, "rule: a run that goes wrong is stopped"};
}

std::vector<Choice> guards_choices(const Keys& root, Scene&) {
  if (guard_keys(root).given("active")) return {};
  return {{"effects.guards.active", "on",
           "motion, density, energy and time step of every run are watched"}};
}

}  // namespace

Effect guards_effect() {
  return {.name = "guards",
          .schema = guards_schema,
          .state = guards_state,
          .operations = guards_operations,
          .presence = guards_presence,
          .choices = guards_choices};
}

}  // namespace gannet
