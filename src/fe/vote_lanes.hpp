// The bounds that the elements of a block vote with. For *.isa.cpp files only.
#pragma once

#include "base/simd_vec.hpp"
#include "fe/element_votes.hpp"

namespace gannet::GANNET_ISA_NS {

/// By how much damping zeta of the highest mode lowers the stable step, squared: the step
/// (2/omega) ((1 + zeta^2)^(1/2) - zeta) is that of omega^2 times this.
GANNET_INLINE Vec damped_factor(Vec zeta) {
  const Vec factor = sqrt(Vec(1.0) + zeta * zeta) + zeta;
  return factor * factor;
}

/// Ratio that damping in proportion to stiffness gives the highest mode, beta omega/2; 0 where
/// there is none. omega2: from the own mass [1/s^2].
GANNET_INLINE Vec stiffness_ratio(const ElementVotes& votes, std::int32_t block, Vec omega2) {
  if (votes.damping_time == nullptr) return Vec(0.0);
  const Vec beta = Vec::load(votes.damping_time + 8 * static_cast<std::int64_t>(block));
  return Vec(0.5) * beta * sqrt(omega2);
}

/// beta/dt of a block, 0 before the first step [-]. Needs a damping time.
GANNET_INLINE Vec damping_per_step(const ElementVotes& votes, std::int32_t block, double dt) {
  const Vec beta = Vec::load(votes.damping_time + 8 * static_cast<std::int64_t>(block));
  return beta * Vec(dt > 0 ? 1 / dt : 0.0);
}

/// The bounds of a block with the mass that its elements have in fact [1/s^2], all frequencies of
/// an element being as one over the root of its mass. bound: from the own mass, damped or not.
GANNET_INLINE Vec with_added_mass(const ElementVotes& votes, std::int32_t block, Vec bound) {
  const std::int64_t first = 8 * static_cast<std::int64_t>(block);
  if (votes.inverse_mass != nullptr) bound *= Vec::load(votes.inverse_mass + first);
  if (votes.omega2 != nullptr) bound.store(votes.omega2 + first);
  return bound;
}

}  // namespace gannet::GANNET_ISA_NS
