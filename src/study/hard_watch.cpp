#include "study/hard_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "output/stray_particles.hpp"
#include "time/guards.hpp"

namespace gannet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Key of the cell of a grid that a point lies in: 21 bits a direction.
std::uint64_t cell_key(const std::array<std::int64_t, 3>& c) {
  constexpr std::int64_t middle = std::int64_t{1} << 20;
  std::uint64_t key = 0;
  for (const std::int64_t k : c) {
    key = (key << 21) | static_cast<std::uint64_t>((k + middle) & 0x1fffff);
  }
  return key;
}

std::array<std::int64_t, 3> cell_of(const Vec3& x, double size) {
  return {static_cast<std::int64_t>(std::floor(x.x() / size)),
          static_cast<std::int64_t>(std::floor(x.y() / size)),
          static_cast<std::int64_t>(std::floor(x.z() / size))};
}

using Grid = std::unordered_multimap<std::uint64_t, Index>;

/// Squared distance to the nearest particle in the grid around x, if below best2.
double nearest2(const Scene& scene, const Grid& grid, const Vec3& x, double size, double best2) {
  const auto c = cell_of(x, size);
  for (std::int64_t k = 0; k < 27; ++k) {
    const auto range =
        grid.equal_range(cell_key({c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1}));
    for (auto it = range.first; it != range.second; ++it) {
      const Vec3 y = xyz(scene.nodes.x[static_cast<std::size_t>(it->second)]);
      best2 = std::min(best2, (x - y).squaredNorm());
    }
  }
  return best2;
}

}  // namespace

bool LimitState::kept() const {
  return at_least ? worst >= limit : worst <= limit;  // false for NaN
}

double LimitState::margin() const {
  if (at_least) return limit > 0 ? worst / limit : infinity;
  return worst > 0 ? limit / worst : infinity;
}

std::vector<std::string> limit_names() {
  return {"finite",           "guard",       "energy_growth",
          "energy_error",     "momentum",    "penetration",
          "smallest_spacing", "smallest_dt", "exact"};
}

TotalMomentum total_momentum(const Nodes& nodes) {
  TotalMomentum p;
  for (Index i = 0; i < nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 mv = nodes.x[k].w * xyz(nodes.v[k]);
    p.sum += mv;
    p.scale += mv.norm();
  }
  return p;
}

double smallest_particle_spacing(const Scene& scene, double reach) {
  Grid grid;
  grid.reserve(static_cast<std::size_t>(scene.particles.size()));
  double best2 = reach * reach;
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(i)]);
    best2 = nearest2(scene, grid, x, reach, best2);
    grid.emplace(cell_key(cell_of(x, reach)), i);
  }
  return std::sqrt(best2);
}

bool all_finite(const Nodes& nodes) {
  for (Index i = 0; i < nodes.n_owned; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!xyz(nodes.x[k]).allFinite() || !xyz(nodes.v[k]).allFinite()) return false;
  }
  return true;
}

/// A limit that nothing can break is no test.
void complain_of_unseen_penetration(Scene& scene) {
  if (sees_penetration(scene)) return;
  throw InputError(
      "hard.penetration: is measured behind planes and at contacts of type node_to_segment, and "
      "here is neither; nodes of 'type: kernel' have no sides: say by hard.exact what passes "
      "through (probe 'flow')");
}

HardWatch::HardWatch(const HardCase& hard, Scene& scene, Models& models)
    : hard_(hard), scene_(&scene), models_(&models) {
  add("finite", 0);
  add("energy_growth", hard.energy_growth - 1);
  if (hard.energy_error) add("energy_error", *hard.energy_error);
  if (hard.momentum) add("momentum", *hard.momentum);
  if (hard.penetration) {
    complain_of_unseen_penetration(scene);
    add("penetration", *hard.penetration);
  }
  if (hard.smallest_spacing) add("smallest_spacing", *hard.smallest_spacing, true);
  if (hard.smallest_dt) add("smallest_dt", *hard.smallest_dt, true);
  for (const Exact& exact : hard.exact) add_probe(exact);
  start_momentum_ = total_momentum(scene.nodes).sum;
}

std::size_t HardWatch::add(const std::string& name, double limit, bool at_least) {
  limits_.push_back({name, at_least ? infinity : -infinity, limit, at_least, 0});
  return limits_.size() - 1;
}

void HardWatch::add_probe(const Exact& exact) {
  Probe probe{.exact = exact};
  for (const Measure& m : scene_->measures) {
    if (m.name == exact.measure) probe.measure = &m;
  }
  if (probe.measure == nullptr) {
    std::string names;
    for (const Measure& m : scene_->measures) names += (names.empty() ? "" : ", ") + m.name;
    throw InputError(fmt::format("hard.exact.{}: there is no measure '{}' (there: {})", exact.name,
                                 exact.measure, names));
  }
  const auto& components = probe.measure->components;
  if (!exact.component.empty()) {
    const auto found = std::find(components.begin(), components.end(), exact.component);
    if (found == components.end()) {
      throw InputError(fmt::format("hard.exact.{}: '{}' has no component '{}' (there: {})",
                                   exact.name, exact.measure, exact.component,
                                   fmt::join(components, ", ")));
    }
    probe.component = static_cast<std::size_t>(found - components.begin());
  }
  probe.limit = add("exact." + exact.name, exact.tolerance);
  probes_.push_back(std::move(probe));
}

void HardWatch::note(std::size_t which, double value) {
  LimitState& state = limits_[which];
  const bool worse = state.at_least ? value < state.worst : value > state.worst;
  if (!worse && !std::isnan(value)) return;
  state.worst = value;
  state.step = steps_;
}

double HardWatch::deviation(const Probe& probe) const {
  std::vector<double> values(probe.measure->components.size());
  probe.measure->sample(values.data());
  return values[probe.component] - probe.exact.expected(models_->list.front().step.t);
}

void HardWatch::look_at_energy() {
  const EnergyBalance& balance = scene_->store.get<GuardState>().balance;
  const double supply = balance.start_held + models_->ledger.external();
  largest_supply_ = std::max(largest_supply_, std::abs(supply));
  const double growth = balance.imbalance;
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    const std::string& name = limits_[k].name;
    if (name == "energy_growth") {
      note(k, largest_supply_ > 0 ? growth / largest_supply_ : (growth > 0 ? infinity : growth));
    }
    if (name == "energy_error") note(k, std::abs(balance.error()));
    if (name == "smallest_dt") note(k, models_->list.front().step.dt_old / first_dt_);
  }
}

void HardWatch::look_at_particles() {
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    const std::string& name = limits_[k].name;
    if (name == "finite") note(k, all_finite(scene_->nodes) ? 0 : infinity);
    if (name == "momentum") {
      const TotalMomentum p = total_momentum(scene_->nodes);
      largest_momentum_ = std::max(largest_momentum_, p.scale);
      const double drift = (p.sum - start_momentum_).norm();
      note(k, largest_momentum_ > 0 ? drift / largest_momentum_ : 0);
    }
    if (name == "penetration") note(k, deepest_penetration(*scene_));
    if (name == "smallest_spacing") {
      note(k, smallest_particle_spacing(*scene_, 4 * limits_[k].limit));
    }
  }
}

void HardWatch::look(bool closely) {
  ++steps_;
  const Step& step = models_->list.front().step;
  if (steps_ == 1) first_dt_ = step.dt_old;
  look_at_energy();
  for (Probe& probe : probes_) {
    if (step.t < probe.exact.from || probe.exact.when == Exact::When::end) continue;
    const double off = deviation(probe);
    if (probe.exact.when == Exact::When::always) note(probe.limit, std::abs(off));
    probe.sum += off * step.dt_old;
    probe.time += step.dt_old;
  }
  if (closely || steps_ % hard_.every == 0 || steps_ == 1) look_at_particles();
}

void HardWatch::finish() {
  look_at_particles();
  for (const Probe& probe : probes_) {
    if (probe.exact.when == Exact::When::end) note(probe.limit, std::abs(deviation(probe)));
    if (probe.exact.when == Exact::When::mean) {
      note(probe.limit, probe.time > 0 ? std::abs(probe.sum / probe.time) : infinity);
    }
  }
}

const LimitState* HardWatch::broken() const {
  for (const LimitState& state : limits_) {
    const bool untouched = std::isinf(state.worst) && (state.worst > 0) == state.at_least;
    if (!untouched && !state.kept()) return &state;
  }
  return nullptr;
}

}  // namespace gannet
