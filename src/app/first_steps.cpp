#include "app/first_steps.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "sph/neighbour_lists.hpp"
#include "sph/sph_state.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Stopwatch*> watches(Models& models) {
  std::vector<Stopwatch*> list;
  for (Model& model : models.list) {
    for (int s = 0; s < n_stages; ++s) {
      for (Operation& op : model.plan.at(static_cast<Stage>(s))) list.push_back(&op.watch);
    }
  }
  return list;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Three tries, the best: whatever else the machine does only makes one slower.
double seconds_of_lists(Simulation& simulation) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto start = Clock::now();
    rebuild_lists(simulation.scene.store.get<SphState>(), simulation.scene);
    best = std::min(best, since(start));
  }
  return best;
}

}  // namespace

FirstSteps make_first_steps(Simulation& simulation, double budget, int least, int most) {
  advance(simulation.models);
  const std::vector<Stopwatch*> all = watches(simulation.models);
  std::vector<std::vector<double>> seconds(all.size());
  FirstSteps first;
  const auto start = Clock::now();
  while (first.steps < least || (first.steps < most && since(start) < budget)) {
    for (Stopwatch* w : all) *w = {};
    advance(simulation.models);
    for (std::size_t k = 0; k < all.size(); ++k) seconds[k].push_back(all[k]->seconds);
    ++first.steps;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    *all[k] = {first.steps * median(seconds[k]), first.steps};
    first.seconds += all[k]->seconds;
  }
  if (!simulation.scene.particles.empty()) first.list_seconds = seconds_of_lists(simulation);
  return first;
}

double flowing_step(const FirstSteps& first) {
  return first.per_step() + first.list_seconds / steps_per_list;
}

}  // namespace gannet
