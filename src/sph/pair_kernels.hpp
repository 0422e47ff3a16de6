// The pair kernels as they are compiled once per instruction set: plain pointers in and out.
// Callers use sph/pair_pass.hpp.
#pragma once

#include <cstdint>

namespace gannet {

/// One call of a pair kernel: a range of clusters.
struct PairJob {
  const double* packed = nullptr;        ///< 8 doubles a particle: x y z vx vy vz rho p/rho^2
  const std::int64_t* offset = nullptr;  ///< n_clusters + 1
  const std::int32_t* source = nullptr;
  std::int32_t n_targets = 0;
  std::int32_t first = 0;  ///< clusters [first, last)
  std::int32_t last = 0;
  double h = 0;      ///< [m]
  double m = 0;      ///< [kg]
  double sigma = 0;  ///< normalisation of the kernel [1/m^dimension]
  double c0 = 0;     ///< [m/s]
  double alpha = 0;
  double beta = 0;
  double epsilon = 0;
  double* drho_dt = nullptr;    ///< 1 a target, stored
  double* X = nullptr;          ///< 4 a target, stored
  double* f = nullptr;          ///< 4 a target, added
  double* f_viscous = nullptr;  ///< 4 a target, stored
};

namespace avx2 {
void pair_rates(const PairJob& job);
void pair_rates_xsph(const PairJob& job);
void pair_force(const PairJob& job);
void pair_force_viscous(const PairJob& job);
void pair_fused(const PairJob& job);
}  // namespace avx2

namespace avx512 {
void pair_rates(const PairJob& job);
void pair_rates_xsph(const PairJob& job);
void pair_force(const PairJob& job);
void pair_force_viscous(const PairJob& job);
void pair_fused(const PairJob& job);
}  // namespace avx512

}  // namespace gannet
