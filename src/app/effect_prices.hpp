// What each pair term costs on a step: a short list that `gannet bench effects` measured
// on one thread, kept with the source (effect_prices.inc), one entry an instruction set and base
// scene. Within a pair pass terms are not timed one by one, so their prices come from here.
//
// To measure the list anew, on a quiet machine:
//   for s in avx2 avx512; do GANNET_ISA=$s gannet bench effects --prices; done >
//   src/app/effect_prices.inc
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace gannet {

/// One line of the list.
struct EffectPrice {
  const char* effect;           ///< name in the table of effects
  const char* base;             ///< scene that it was switched on over: "water", "water_2d", ...
  const char* instruction_set;  ///< "avx2"
  double ratio;                 ///< step with it over step without it
  double extra;                 ///< what it adds to a step [ns per particle or element]
  double
      inside;  ///< of that, what none of its own operations shows: the term in the pair pass [ns]
  double fma;  ///< rate of the machine when this was measured [GFLOP/s], one thread, double
};

std::span<const EffectPrice> effect_prices();

/// What one pair term costs inside the pair passes on this machine.
struct TermPrice {
  std::string effect;
  double ns = 0;       ///< per particle and step, one thread
  std::string source;  ///< where the number comes from, for a reader
};

/// Prices of the terms of the effects named, in a scene of particles: of the list for this
/// instruction set and dimension, times the FMA rate of the list over `fma` [GFLOP/s], the rate of
/// this machine, and times (h/dx / 1.3)^dimension, which the number of pairs grows with. Effects
/// without a price are left out.
std::vector<TermPrice> term_prices(Scene& scene, const std::vector<std::string>& effects,
                                   double fma);

}  // namespace gannet
