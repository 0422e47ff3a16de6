#include "time/energy_balance.hpp"

#include <algorithm>
#include <cmath>

namespace gannet {

void EnergyBalance::update(const Ledger& ledger) {
  const double held = ledger.held();
  const double external = ledger.external();
  if (!started) {
    start_held = held - external;
    started = true;
  }
  imbalance = held - external - start_held;
  largest_total = std::max({largest_total, std::abs(held), std::abs(start_held + external)});
  double sizes = 0;
  for (const LedgerEntry& e : ledger.entries()) {
    if (!e.within_other) sizes += std::abs(e.value);
  }
  scale = std::max(scale, sizes);
}

double EnergyBalance::error() const { return largest_total > 0 ? imbalance / largest_total : 0; }

double EnergyBalance::error_of_scale() const { return scale > 0 ? imbalance / scale : 0; }

}  // namespace gannet
