// The energy balance of a run, from the ledger.
#pragma once

#include "plan/plan.hpp"

namespace gannet {

/// held(t) - external(t) = held(0) in a perfect run; the error is what that misses by, over the
/// largest total energy so far. Over::scene fields of the checkpoint carry it.
struct EnergyBalance {
  double start_held = 0;     ///< energy held at the start [J]
  double largest_total = 0;  ///< largest of held and start_held + external so far [J]
  double imbalance = 0;      ///< held - external - start_held [J]
  bool started = false;
  double scale = 0;  ///< largest sum of the sizes of all entries so far [J]

  /// Takes up the ledger at level n.
  void update(const Ledger& ledger);
  /// imbalance / largest total; 0 where nothing has energy.
  [[nodiscard]] double error() const;
  /// imbalance / scale: what the guard looks at, because entries may cancel in the total (work that
  /// comes in and pressure energy at the start of a run, say).
  [[nodiscard]] double error_of_scale() const;
};

}  // namespace gannet
