// The pair kernels as they are compiled once per instruction set: plain pointers in and out.
// Callers use sph/pair_pass.hpp.
#pragma once

#include <cstdint>

namespace gannet {

/// Terms of the pair passes. Which of them a pass has does not change from pair to pair.
enum PairTerm : unsigned {
  rate_term = 1U << 0,               ///< density rate
  xsph_term = 1U << 1,               ///< mean velocity of the surroundings
  diffusion_term = 1U << 2,          ///< diffusion of density
  concentration_term = 1U << 3,      ///< gradient of the particle concentration, div r
  shepard_term = 1U << 4,            ///< sums of W for renormalised densities
  rate_correction_term = 1U << 5,    ///< corrected divergence of the velocity
  force_term = 1U << 6,              ///< pressure
  viscous_term = 1U << 7,            ///< artificial viscosity
  laminar_term = 1U << 8,            ///< laminar viscosity
  tensile_term = 1U << 9,            ///< repulsion against clumping under tension
  force_correction_term = 1U << 10,  ///< corrected gradient of the pressure
  central_term = 1U << 11            ///< laminar viscosity acts along the line of a pair
};

/// A particle in 32 bytes, for pairs in single precision: positions and velocities are whole
/// multiples of a unit, so that their differences carry no rounding.
struct alignas(32) PackedSingle {
  std::int32_t x[3] = {0, 0, 0};
  std::int32_t v[3] = {0, 0, 0};
  float rho = 0;
  float last = 0;  ///< as in PackedParticle
};

/// One call of a pair kernel: a range of clusters.
struct PairJob {
  unsigned terms = 0;                    ///< PairTerm, those whose results are wanted
  const double* packed = nullptr;        ///< 8 doubles a particle: x y z vx vy vz rho last
  const PackedSingle* single = nullptr;  ///< the same for the kernels in single precision
  const double* rho = nullptr;           ///< 1 a target; read by corrections only
  const std::int64_t* offset = nullptr;  ///< n_clusters + 1
  const std::int32_t* source = nullptr;
  const std::int32_t* cluster = nullptr;  ///< clusters to do; null: all
  std::int32_t n_targets = 0;
  std::int32_t first = 0;  ///< clusters [first, last), places in `cluster` where it is given
  std::int32_t last = 0;
  int kernel = 0;  ///< KernelType
  int dimension = 3;
  double x_unit = 0;  ///< of PackedSingle [m]
  double v_unit = 0;  ///< [m/s]
  double h = 0;       ///< [m]
  double m = 0;       ///< [kg]
  double sigma = 0;   ///< normalisation of the kernel [1/m^dimension]
  double rho0 = 0;    ///< reference density of volumes m/rho0 [kg/m^3]
  double c0 = 0;      ///< [m/s]
  double alpha = 0;
  double beta = 0;
  double epsilon = 0;
  double delta = 0;                  ///< density diffusion [-]
  double mu = 0;                     ///< laminar viscosity, and what the form puts before it [Pa s]
  double tensile = 0;                ///< [-]
  double inv_W_dx = 0;               ///< 1/W(dx)
  double* drho_dt = nullptr;         ///< 1 a target, stored
  double* drho_diffusion = nullptr;  ///< 1, stored: the part of drho_dt that diffusion has
  double* drho_correction = nullptr;  ///< 1, stored: the part that the correction adds
  double* X = nullptr;                ///< 4 a target, stored
  double* concentration = nullptr;    ///< 4, stored: gradient, div r
  double* sum_mW = nullptr;           ///< 1, stored: sum m W
  double* sum_VW = nullptr;           ///< 1, stored: sum m/rho W
  double* f = nullptr;                ///< 4, added
  double* f_viscous = nullptr;        ///< 4, stored
  double* f_laminar = nullptr;        ///< 4, stored
  double* f_tensile = nullptr;        ///< 4, stored
  double* f_correction = nullptr;     ///< 4, stored
};

/// How a pass is done. Eight kernels serve all: the cubic spline with the terms that most scenes
/// have is compiled on its own, the others share one with every kernel and term. Two more are of
/// the bench alone.
enum class PairKernel {
  rates_cubic,         ///< rate, xsph, diffusion
  rates_cubic_single,  ///< the same in single precision
  rates_any,           ///< all terms of the rates
  rates_any_single,
  force_cubic,  ///< force, viscous
  force_cubic_single,
  force_any,  ///< all terms of the force
  force_any_single,
  fused,  ///< rate, force, viscous with the cubic spline
  fused_single
};

namespace avx2 {
void pair_pass(PairKernel kernel, const PairJob& job);
}

namespace avx512 {
void pair_pass(PairKernel kernel, const PairJob& job);
}

}  // namespace gannet
