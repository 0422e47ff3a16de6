#include "app/effect_prices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/isa.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {

/// h/dx of the scenes that the list was measured with.
constexpr double ratio_of_list = 1.3;

const std::vector<EffectPrice> measured_prices = {
#include "app/effect_prices.inc"
};

}  // namespace

std::span<const EffectPrice> effect_prices() { return measured_prices; }

std::vector<TermPrice> term_prices(Scene& scene, const std::vector<std::string>& effects,
                                   double fma) {
  std::vector<TermPrice> found;
  if (scene.particles.empty()) return found;
  const SphState& sph = scene.store.get<SphState>();
  const std::string base = scene.dimension == 2 ? "water_2d" : "water";
  const double pairs = std::pow(sph.h / sph.dx / ratio_of_list, scene.dimension);
  for (const EffectPrice& p : effect_prices()) {
    const bool wanted = std::find(effects.begin(), effects.end(), p.effect) != effects.end();
    if (!wanted || base != p.base || name_of(isa()) != p.instruction_set) continue;
    found.push_back(
        {p.effect, std::max(p.inside, 0.0) * pairs * p.fma / fma,
         fmt::format("bench effects over {}, {}: {:.2f} ns at {:.1f} GFLOP/s, here {:.1f}", p.base,
                     p.instruction_set, p.inside, p.fma, fma)});
  }
  return found;
}

}  // namespace gannet
