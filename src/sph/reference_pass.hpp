// The pair passes written as plainly as the equations: every particle against every other, one
// pair at a time. What the tests measure the vectorised passes by; a step never calls it.
#pragma once

#include "sph/pair_pass.hpp"

namespace gannet {

/// As pair_rates() without a list, in n_targets n_sources steps.
void reference_rates(const ParticleView& view, Index n_targets, const PairParameters& parameters,
                     const RatesOut& out);

/// As pair_force() without a list, in n_targets n_sources steps.
void reference_force(const ParticleView& view, Index n_targets, const PairParameters& parameters,
                     const ForceOut& out);

}  // namespace gannet
