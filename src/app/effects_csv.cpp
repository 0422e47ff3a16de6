#include "app/effects_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "app/effects.hpp"
#include "base/parallel.hpp"
#include "output/files.hpp"
#include "output/run_record.hpp"
#include "study/bench.hpp"

namespace gannet {

namespace {

struct Placed {
  const Model* model = nullptr;
  Stage stage = Stage::force;
  const Operation* op = nullptr;
};

std::vector<Placed> all_operations(const Models& models) {
  std::vector<Placed> list;
  for (const Model& model : models.list) {
    for (int s = 0; s < n_stages; ++s) {
      const auto stage = static_cast<Stage>(s);
      for (const Operation& op : model.plan.at(stage)) list.push_back({&model, stage, &op});
    }
  }
  return list;
}

std::vector<double> stopwatches(const Models& models) {
  std::vector<double> seconds;
  for (const Placed& p : all_operations(models)) seconds.push_back(p.op->watch.seconds);
  return seconds;
}

/// A text as a field of CSV: quoted where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string share_text(double share) { return fmt::format("{:.5f}", share); }

/// The effects that ride inside a pair pass: those that a case has and the price list knows.
std::vector<std::string> effects_in_plan(const Models& models) {
  std::vector<std::string> names;
  for (const Placed& p : all_operations(models)) names.push_back(p.op->effect);
  return names;
}

struct Sum {
  double seconds = 0;
  double predicted = 0;
};

Sum sum_of(const std::vector<Placed>& operations, const std::vector<double>& predicted,
           const std::string& effect) {
  Sum sum;
  for (std::size_t k = 0; k < operations.size(); ++k) {
    if (operations[k].op->effect != effect) continue;
    sum.seconds += operations[k].op->watch.seconds;
    if (!predicted.empty()) sum.predicted += predicted[k];
  }
  return sum;
}

}  // namespace

void FirstShares::note(const Models& models) {
  if (!shares_.empty()) return;
  const std::vector<double> now = stopwatches(models);
  steps_.emplace_back();
  for (std::size_t k = 0; k < now.size() && !before_.empty(); ++k) {
    steps_.back().push_back(now[k] - before_[k]);
  }
  before_ = now;
  if (static_cast<int>(steps_.size()) != steps + 1) return;
  std::vector<double> spent(now.size());
  for (std::size_t k = 0; k < now.size(); ++k) {
    std::vector<double> values;
    for (std::size_t s = 1; s < steps_.size(); ++s) values.push_back(steps_[s][k]);
    std::nth_element(values.begin(), values.begin() + steps / 2, values.end());
    spent[k] = values[steps / 2];
  }
  const double all = std::accumulate(spent.begin(), spent.end(), 0.0);
  for (double& s : spent) s = all > 0 ? s / all : 0;
  shares_ = std::move(spent);
  steps_.clear();
}

std::string effects_table(Simulation& simulation, const FirstShares& first,
                          const std::vector<TermPrice>& prices, double wall,
                          double particle_steps) {
  const std::vector<Placed> operations = all_operations(simulation.models);
  const std::vector<double>& predicted = first.shares();
  const auto share = [&](double seconds) { return share_text(wall > 0 ? seconds / wall : 0); };
  const auto foretold = [&](double s) { return predicted.empty() ? "" : share_text(s); };
  std::string text =
      "kind,effect,model,stage,name,calls,seconds,share,predicted_share,price_ns,price_source\n";
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < operations.size(); ++k) {
    const Operation& op = *operations[k].op;
    fmt::format_to(out, "operation,{},{},{},{},{},{:.6f},{},{},,\n", field(op.effect),
                   field(operations[k].model->name), name_of(operations[k].stage), field(op.name),
                   op.watch.calls, op.watch.seconds, share(op.watch.seconds),
                   predicted.empty() ? "" : share_text(predicted[k]));
  }
  for (const Effect& effect : effects()) {
    const Sum sum = sum_of(operations, predicted, effect.name);
    if (sum.seconds == 0) continue;
    fmt::format_to(out, "effect,{},,,{},,{:.6f},{},{},,\n", field(effect.name), field(effect.name),
                   sum.seconds, share(sum.seconds), foretold(sum.predicted));
  }
  for (const TermPrice& p : prices) {
    const double seconds = 1e-9 * p.ns * particle_steps / threads();
    fmt::format_to(out, "pair term,{},,,{},,{:.6f},{},,{:.3f},{}\n", field(p.effect),
                   field(p.effect), seconds, share(seconds), p.ns, field(p.source));
  }
  return text;
}

void write_effects_csv(Simulation& simulation, const FirstShares& first) {
  const RunRecord& record = simulation.scene.store.get<RunRecord>();
  const auto prices =
      term_prices(simulation.scene, effects_in_plan(simulation.models), fma_rate(1));
  const StepsDone done = steps_done(simulation.scene, simulation.models, record);
  write_whole_file(record.folder + "/effects.csv",
                   effects_table(simulation, first, prices, wall_time(record), done.particle_steps),
                   Durable::no);
}

}  // namespace gannet
