#include "output/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "output/output.hpp"
#include "time/guards.hpp"

namespace gannet {

std::string time_text(double seconds) {
  const double size = std::abs(seconds);
  if (size == 0 || !std::isfinite(size)) return fmt::format("{} s", seconds);
  if (size >= 0.9999995) return fmt::format("{:.4g} s", seconds);
  if (size >= 0.9999995e-3) return fmt::format("{:.4g} ms", seconds * 1e3);
  if (size >= 0.9999995e-6) return fmt::format("{:.4g} us", seconds * 1e6);
  return fmt::format("{:.4g} ns", seconds * 1e9);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string count_text(double value) {
  if (value >= 1e9) return fmt::format("{:.3g} G", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.3g} M", value / 1e6);
  if (value >= 1e3) return fmt::format("{:.3g} k", value / 1e3);
  return fmt::format("{:.3g}", value);
}

std::vector<OperationCost> operation_costs(const Models& models, double wall) {
  std::vector<OperationCost> costs;
  for (const Model& m : models.list) {
    for (int s = 0; s < n_stages; ++s) {
      const auto stage = static_cast<Stage>(s);
      for (const Operation& op : m.plan.at(stage)) {
        const double share = wall > 0 ? op.watch.seconds / wall : 0;
        costs.push_back({m.name, name_of(stage), op.name, op.watch.seconds, share, op.watch.calls});
      }
    }
  }
  return costs;
}

std::vector<ModelCost> model_costs(const Models& models) {
  std::vector<ModelCost> costs;
  for (const Model& m : models.list) {
    ModelCost& cost = costs.emplace_back(ModelCost{.model = m.name});
    for (int s = 0; s < n_stages; ++s) {
      for (const Operation& op : m.plan.at(static_cast<Stage>(s))) {
        (op.where_all_meet ? costs.front() : cost).seconds += op.watch.seconds;
        if (!op.where_all_meet) cost.steps = std::max(cost.steps, op.watch.calls);
      }
    }
  }
  return costs;
}

double subcycling_gain(const std::vector<ModelCost>& costs) {
  double of_one_step = 0;
  double all = 0;
  for (const ModelCost& c : costs) {
    of_one_step += c.of_step();
    all += c.seconds;
  }
  return all > 0 ? static_cast<double>(costs.back().steps) * of_one_step / all : 1;
}

RestSaving rest_saving(const Scene& scene, const Models& models) {
  const Resting& resting = scene.resting;
  if (!(resting.all_particle_steps > 0)) return {};
  RestSaving saving{.share = resting.particle_steps / resting.all_particle_steps};
  for (const OperationCost& c : operation_costs(models, 0)) {
    if (c.stage != name_of(Stage::look)) saving.seconds += c.seconds;
  }
  saving.seconds *= saving.share / (1 - saving.share);
  return saving;
}

namespace {

/// "mooring.line_1.extremes: from largest 3.7e+05 N, ..."
std::string text_of(const Measure& measure) {
  std::vector<double> values(measure.components.size());
  measure.sample(values.data());
  std::string text = measure.name + ":";
  for (std::size_t c = 0; c < values.size(); ++c) {
    text += fmt::format("{} {} {:.6g} {}", c > 0 ? "," : "", measure.components[c], values[c],
                        measure.unit);
  }
  return text;
}

/// "models: sea 42 steps of 87.9 ms, structure 842 of 43.3 us; ..."
std::string text_of_models(const std::vector<ModelCost>& costs) {
  std::string text = "models:";
  for (const ModelCost& c : costs) {
    const bool first = &c == &costs.front();
    text += fmt::format("{} {} {}{} of {}", first ? "" : ",", c.model, c.steps,
                        first ? " steps" : "", time_text(c.of_step()));
  }
  return text + fmt::format("; all at the step of {} would take {:.4g} times as long\n",
                            costs.back().model, subcycling_gain(costs));
}

}  // namespace

std::string report(Scene& scene, const Models& models, const RunRecord& record) {
  const double wall = wall_time(record);
  const StepsDone done = steps_done(scene, models, record);
  const std::vector<OperationCost> costs = operation_costs(models, wall);
  const bool several = models.list.size() > 1;
  const auto title = [&](const OperationCost& c) {
    return several ? c.model + ": " + c.name : c.name;
  };
  std::size_t width = 24;
  for (const OperationCost& c : costs) width = std::max(width, title(c).size());

  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: {}\n", record.status, record.exit_reason);
  fmt::format_to(out, "t = {}, {} steps in {}, {} threads, energy error {:.3g} %\n",
                 time_text(models.list.front().step.t), models.list.back().step.n,
                 duration_text(wall), record.threads,
                 100 * scene.store.get<GuardState>().balance.error());
  fmt::format_to(out, "{} particle steps/s, {} element steps/s\n",
                 count_text(done.particle_steps / wall), count_text(done.element_steps / wall));
  if (record.output.strays.lost > 0) {
    fmt::format_to(out, "{} particles were lost: behind a wall, or far out (docs/output.md)\n",
                   record.output.strays.lost);
  }
  if (several) text += text_of_models(model_costs(models));
  if (scene.resting.all_particle_steps > 0) {
    const RestSaving saving = rest_saving(scene, models);
    fmt::format_to(out,
                   "rest: {:.3g} % of the particles on the mean, {} particle steps not computed; "
                   "that saved about {}\n",
                   100 * saving.share, count_text(scene.resting.particle_steps),
                   duration_text(saving.seconds));
  }
  for (const Measure& m : scene.measures) {
    if (m.at_end) text += text_of(m) + "\n";
  }
  fmt::format_to(out, "{:<11} {:<{}} {:>10} {:>10} {:>7}\n", "stage", "operation", width, "calls",
                 "seconds", "share");
  double rest = wall;
  for (const OperationCost& c : costs) {
    fmt::format_to(out, "{:<11} {:<{}} {:>10} {:>10.3f} {:>5.1f} %\n", c.stage, title(c), width,
                   c.calls, c.seconds, 100 * c.share);
    rest -= c.seconds;
  }
  fmt::format_to(out, "{:<11} {:<{}} {:>10} {:>10.3f} {:>5.1f} %\n", "", "all else", width, "",
                 rest, wall > 0 ? 100 * rest / wall : 0);
  fmt::format_to(out, "{}\n", last_output(record));
  return text;
}

}  // namespace gannet
