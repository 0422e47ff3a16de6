// effects.csv: after a run, what each operation, each effect and each pair term cost, beside what
// was predicted.
#pragma once

#include <string>
#include <vector>

#include "app/effect_prices.hpp"
#include "app/simulation.hpp"

namespace gannet {

/// Shares of the operations in the first steps of a run, of the medians over these steps: what
/// `gannet explain` predicts, which makes the same steps before a run.
class FirstShares {
 public:
  static constexpr int steps = 20;  ///< after one that is left out

  /// To be called after every step; does nothing once it knows.
  void note(const Models& models);
  /// One share an operation, in the order of the plans; empty before the steps are made.
  [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

 private:
  std::vector<double> before_;              ///< stopwatches after the step before [s]
  std::vector<std::vector<double>> steps_;  ///< what each operation took in each step [s]
  std::vector<double> shares_;
};

/// The table as text:
///   kind: operation; effect (the sum of its operations); pair term (rides inside a pair pass)
///   effect, model, stage, name, calls
///   seconds, share: measured, of the wall time; of a pair term: its price times particles and
///     steps over threads, not measured
///   predicted_share: of the first steps
///   price_ns: of a pair term, per particle and step on one thread
///   price_source: where that comes from
/// wall: [s]; particle_steps: particles times steps made; first: may be empty.
std::string effects_table(Simulation& simulation, const FirstShares& first,
                          const std::vector<TermPrice>& prices, double wall, double particle_steps);

/// Writes effects_table() as effects.csv in the output folder of the run. Throws
/// std::runtime_error where it cannot be written.
void write_effects_csv(Simulation& simulation, const FirstShares& first);

}  // namespace gannet
