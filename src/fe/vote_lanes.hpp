// The bounds that the elements of a block vote with. For *.isa.cpp files only.
#pragma once

#include "base/simd.hpp"
#include "fe/element_votes.hpp"

namespace gannet::GANNET_ISA_NS {

/// The bounds of a block with the mass that its elements have in fact [1/s^2], all frequencies of
/// an element being as one over the root of its mass. bound: from the own mass, damped or not.
GANNET_INLINE Vec8 with_added_mass(const ElementVotes& votes, std::int32_t block, Vec8 bound) {
  const std::int64_t first = 8 * static_cast<std::int64_t>(block);
  if (votes.inverse_mass != nullptr) bound *= Vec8::load(votes.inverse_mass + first);
  if (votes.omega2 != nullptr) bound.store(votes.omega2 + first);
  return bound;
}

}  // namespace gannet::GANNET_ISA_NS
