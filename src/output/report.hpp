// What a person reads at the end of a run, and numbers as a person reads them.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// A time with four digits and a fitting unit: 0.0123 -> "12.3 ms".
std::string time_text(double seconds);

/// A duration of the clock on the wall: "12.3 s", "1 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

/// A rate or a count with a prefix: 1.25e6 -> "1.25 M".
std::string count_text(double value);

/// What one operation of a plan cost in this process.
struct OperationCost {
  std::string model;
  std::string stage;
  std::string name;
  double seconds = 0;
  double share = 0;  ///< of the wall time since begin_run()
  std::int64_t calls = 0;
};

/// The operations of all models in the order of the plan, with what each cost.
/// wall: wall time of the run [s].
std::vector<OperationCost> operation_costs(const Models& models, double wall);

/// What resting particles saved. The steps are those since the start, whatever process made them;
/// the seconds are of this process: particle steps not computed at the mean cost of those computed,
/// over all operations but those of the stage `look`. Lists and all else that rest makes dearer is
/// in that cost, so it is an estimate from above where much of it does not shrink with the water in
/// motion.
struct RestSaving {
  double share = 0;    ///< of particle steps that were not computed [-]
  double seconds = 0;  ///< saved in this process [s]
};
RestSaving rest_saving(const Scene& scene, const Models& models);

/// What the operations of one model cost in this process. Those that run only where all models meet
/// count with the slowest, at whose steps they run.
struct ModelCost {
  std::string model;
  std::int64_t steps = 0;
  double seconds = 0;
  [[nodiscard]] double of_step() const {
    return steps > 0 ? seconds / static_cast<double>(steps) : 0;
  }
};
std::vector<ModelCost> model_costs(const Models& models);

/// How many times as long the same would take with all models at the step of the fastest, if every
/// operation cost as much a step as it did: n_last sum_k c_k / sum_k n_k c_k, c_k the cost of a
/// step of model k and n_k their number [-]. For two models r (1 + f)/(1 + r f), r = n_2/n_1, f =
/// c_2/c_1. 1 before the first step.
double subcycling_gain(const std::vector<ModelCost>& costs);

/// The report: how the run ended, and one line an operation: stage, name, calls, seconds, share.
/// The same list as `gannet explain` prints.
std::string report(Scene& scene, const Models& models, const RunRecord& record);

}  // namespace gannet
