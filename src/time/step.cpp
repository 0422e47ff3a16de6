#include "time/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"

namespace gannet {

namespace {

/// Runs the operations of a stage. The clock is read once between two of them: a reading costs as
/// much as a short operation.
void run(std::span<Model* const> level, Stage stage) {
  using Watch = std::chrono::steady_clock;
  auto start = Watch::now();
  for (Model* model : level) {
    for (Operation& op : model->plan.at(stage)) {
      if (op.where_all_meet && !model->step.coincides) continue;
      op.run(model->step);
      const auto end = Watch::now();
      op.watch.seconds += std::chrono::duration<double>(end - start).count();
      ++op.watch.calls;
      start = end;
    }
  }
}

[[noreturn]] void no_step(const Model& model) {
  throw RunError(
      {fmt::format("the time step became {} s", model.vote.dt),
       fmt::format("model {}, {}", model.name,
                   model.vote.by == nullptr ? "no operation votes" : model.vote.limited_by()),
       fmt::format("at t = {:.6g} s, step {}, the operation named above allows no "
                   "positive, finite step",
                   model.step.t, model.step.n),
       "look at the last frames near that place; refine, stiffen or damp there"});
}

/// Shares of a step below which a difference is rounding.
constexpr double rounding_of_step = 1e-9;

/// What a difference of two times about t may be off by [s].
double rounding_of(double t) { return 4 * std::numeric_limits<double>::epsilon() * std::abs(t); }

/// The smallest whole number of substeps in the time that is left. That time is a difference of
/// times, with their rounding: what it adds to a whole number asks for no substep more.
double substeps_for(double left, double allowed, double t) {
  return std::ceil((left * (1 - rounding_of_step) - rounding_of(t)) / allowed);
}

/// Whether the substeps that a model still has to do may be as long as the last one: they are, by
/// no more than substeps_for() lets them be longer than its vote. Substeps that were found anew
/// from the time left would gather its rounding: late in a run, with many of them, the last one of
/// every coarse step would be cut in two, which is a resonance.
bool may_go_on(const Model& model) {
  if (model.substeps_left == 0) return false;
  const double longest =
      model.vote.dt * (1 + 2 * rounding_of_step) + rounding_of(model.step.t) / model.substeps_left;
  return model.step.dt <= longest;
}

/// The time of the level that the step of a model leads to.
double next_level(const Model& model) {
  return model.substeps_left == 1 ? model.target : model.step.t + model.step.dt;
}

void advance_time(Model& model) {
  Step& s = model.step;
  s.t = next_level(model);
  s.dt_old = s.dt;
  ++s.n;
  if (model.substeps_left > 0) --model.substeps_left;
}

/// The way of a model to its next level.
void move(Model& model) {
  Model* alone[] = {&model};
  for (const Stage stage : {Stage::half_drift, Stage::rates, Stage::drift}) run(alone, stage);
  advance_time(model);
}

}  // namespace

Vote smallest_vote(const Model& model) {
  Vote vote;
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : model.plan.at(static_cast<Stage>(s))) {
      if (!op.stable_dt) continue;
      const double dt = op.stable_dt();
      if (!(dt >= vote.dt)) {
        vote.dt = dt;
        vote.by = &op;
      }
    }
  }
  vote.dt *= model.dt_scale;
  return vote;
}

void choose_dt(std::span<Model* const> level) {
  for (std::size_t k = 0; k < level.size(); ++k) {
    Model& model = *level[k];
    model.vote = smallest_vote(model);
    if (!(model.vote.dt > 0)) no_step(model);
    const bool slowest = k == 0 && model.substeps_left == 0;
    if (slowest) {
      if (!std::isfinite(model.vote.dt)) no_step(model);
      model.step.dt = model.vote.dt;
      continue;
    }
    if (k > 0) {
      const Model& slower = *level[k - 1];
      model.target = next_level(slower);
      model.substeps_left = 0;
    }
    if (may_go_on(model)) continue;
    const double left = model.target - model.step.t;
    const double ratio = substeps_for(left, model.vote.dt, model.step.t);
    if (ratio > 1e9) no_step(model);
    model.substeps_left = std::max({1, model.substeps_left, static_cast<int>(ratio)});
    model.step.dt = left / model.substeps_left;
  }
}

void step(std::span<Model* const> level) {
  run(level, Stage::force);
  choose_dt(level);
  run(level, Stage::accelerate);
  run(level, Stage::kick);
  run(level, Stage::look);
  move(*level.back());
}

void evaluate_start(Models& models) {
  for (Model& model : models.list) {
    Model* level[] = {&model};
    run(level, Stage::force);
  }
}

void advance(Models& models) {
  std::vector<Model*> level;
  do {
    const double behind = models.list.back().step.t;
    level.clear();
    for (Model& m : models.list) {
      if (m.step.t == behind) level.push_back(&m);
    }
    for (Model* m : level) m->step.coincides = level.size() == models.list.size();
    step(level);
    for (std::size_t k = models.list.size() - 1; k > 0; --k) {
      if (models.list[k].step.t != next_level(models.list[k - 1])) break;
      move(models.list[k - 1]);
    }
  } while (models.list.back().step.t != models.list.front().step.t);
}

}  // namespace gannet
