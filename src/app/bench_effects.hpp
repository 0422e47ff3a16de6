// gannet bench effects: what each pair term and effect adds to a step.
#pragma once

#include "study/bench.hpp"

namespace gannet {

/// Steps small scenes with and without each effect in turns and prints what it adds: ratio of the
/// steps, nanoseconds a particle or element, and how much of that lies inside other operations.
/// options.json: as JSON; options.prices: as lines of effect_prices.inc. Returns the exit code.
int bench_effects(const BenchOptions& options);

}  // namespace gannet
