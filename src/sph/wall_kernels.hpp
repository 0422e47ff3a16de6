// The wall kernel as it is compiled once per instruction set: plain pointers in and out. Callers
// use sph/wall_pass.hpp.
#pragma once

#include <cstdint>

namespace gannet {

/// One call of the wall kernel: a range of the listed clusters.
struct WallJob {
  const double* x = nullptr;             ///< 4 a source: x y z and something else
  const double* v = nullptr;             ///< 4 a source: vx vy vz and something else
  const double* rho = nullptr;           ///< 1 a source
  const double* p = nullptr;             ///< 1 a source
  const std::int64_t* offset = nullptr;  ///< where the list of a cluster begins in source
  const std::int32_t* source = nullptr;
  const std::int32_t* cluster = nullptr;  ///< the clusters to do
  std::int32_t n_targets = 0;
  std::int32_t n_sources = 0;  ///< this and higher numbers only fill up a list
  std::int32_t first = 0;      ///< clusters cluster[first] ... cluster[last - 1]
  std::int32_t last = 0;
  double h = 0;            ///< [m]
  double sigma = 0;        ///< normalisation of the kernel [1/m^dimension]
  double* sums = nullptr;  ///< 8 a lane, 64 a listed cluster: WallSums
};

namespace avx2 {
void wall_sums(const WallJob& job);
}  // namespace avx2

namespace avx512 {
void wall_sums(const WallJob& job);
}  // namespace avx512

}  // namespace gannet
