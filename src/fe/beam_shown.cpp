#include "fe/beam_shown.hpp"

#include <algorithm>

namespace gannet {

namespace {

double share_of_failed(const BeamBlock& block, std::size_t e) {
  const std::size_t n = fibre_values(block.law.section, block.law.yield);
  std::size_t failed = 0;
  for (std::size_t k = 3; k < n; k += 4) failed += block.fibres[n * e + k] >= 1 ? 1 : 0;
  return block.has_left(e) ? 1 : static_cast<double>(4 * failed) / static_cast<double>(n);
}

}  // namespace

void show_plastic_strain(BeamBlock& block) {
  const std::size_t n = fibre_values(block.law.section, block.law.yield);
  block.plastic_shown.assign(block.l0.size(), 0);
  for (std::size_t e = 0; e < block.l0.size(); ++e) {
    for (std::size_t k = 1; k < n; k += block.law.yield.n_values()) {
      block.plastic_shown[e] = std::max(block.plastic_shown[e], block.fibres[n * e + k]);
    }
  }
}

void show_damage(BeamBlock& block) {
  block.damage_shown.resize(block.l0.size());
  for (std::size_t e = 0; e < block.l0.size(); ++e)
    block.damage_shown[e] = share_of_failed(block, e);
}

}  // namespace gannet
