#include "scene/wave_spectrum.hpp"

#include <cmath>
#include <numbers>

namespace gannet {

namespace {

using std::numbers::pi;

/// The n-th number in [0, 1) of a seed, the same on every machine: SplitMix64, Steele, Lea and
/// Flood 2014, OOPSLA, DOI 10.1145/2660193.2660195.
double random_number(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// Components without amplitude, and the band of frequencies that each stands for [rad/s].
struct Band {
  WaveComponent wave;
  double width = 0;
};

std::vector<Band> bands_of(const SeaState& sea, double depth, double g) {
  const double omega_p = 2 * pi / sea.period;
  const double low = 0.5 * omega_p;
  double high = 3 * omega_p;
  if (sea.shortest > 0) high = std::min(high, dispersion(2 * pi / sea.shortest, depth, g));
  std::vector<Band> bands;
  const auto add = [&](double k, double omega, double width) {
    bands.push_back({{.k = k, .omega = omega, .along = sea.along}, width});
  };
  if (sea.repeat > 0) {
    const double dk = 2 * pi / sea.repeat;
    for (int i = 1; dispersion(i * dk, depth, g) <= high; ++i) {
      const double omega = dispersion(i * dk, depth, g);
      if (omega < low) continue;
      add(i * dk, omega,
          dispersion((i + 0.5) * dk, depth, g) - dispersion((i - 0.5) * dk, depth, g));
    }
    return bands;
  }
  const double width = (high - low) / sea.n;
  for (int i = 0; width > 0 && i < sea.n; ++i) {
    const double omega = low + (i + 0.5) * width;
    add(wave_number(omega, depth, g), omega, width);
  }
  return bands;
}

}  // namespace

double jonswap_shape(double omega, double omega_p, double gamma) {
  const double sigma = omega <= omega_p ? 0.07 : 0.09;
  const double away = (omega - omega_p) / (sigma * omega_p);
  return std::pow(omega, -5) * std::exp(-1.25 * std::pow(omega_p / omega, 4)) *
         std::pow(gamma, std::exp(-0.5 * away * away));
}

double wave_number(double omega, double depth, double g) {
  const double deep = omega * omega / g;
  double k = deep / std::sqrt(std::tanh(deep * depth));  // right in deep and in shallow water
  for (int i = 0; i < 20; ++i) {
    const double t = std::tanh(k * depth);
    k -= (k * t - deep) / (t + k * depth * (1 - t * t));
  }
  return k;
}

std::vector<WaveComponent> components_of(const SeaState& sea, double depth, double g) {
  std::vector<WaveComponent> waves;
  double m0 = 0;
  for (const Band& band : bands_of(sea, depth, g)) {
    WaveComponent wave = band.wave;
    const double energy = jonswap_shape(wave.omega, 2 * pi / sea.period, sea.gamma) * band.width;
    wave.a = std::sqrt(2 * energy);
    wave.phase = 2 * pi * random_number(sea.seed, waves.size());
    m0 += energy;
    waves.push_back(wave);
  }
  const double scale = std::sqrt(sea.height * sea.height / 16 / m0);
  for (WaveComponent& wave : waves) wave.a *= scale;
  return waves;
}

}  // namespace gannet
