// The two particle pair passes: density rate (with XSPH, density diffusion, ...) and force (with
// viscosity, ...).
//
// Every pass first packs what it reads into one line per particle, then walks the cluster lists
// with eight targets in the lanes of a vector and one source broadcast at a time. Sources at index
// n_targets and above are ghosts. A term is on where its result is asked for; which kernels are
// compiled says PairKernel in sph/pair_kernels.hpp.
//
// r_ij = x_i - x_j, v_ij = v_i - v_j, grad_i W_ij = F_ij r_ij (kernel/smoothing_kernel.hpp). All
// particles of a pass have the same h and m. In 2D z and v_z are 0 (or equal), masses and forces
// are per metre of thickness.
#pragma once

#include <cstdint>
#include <span>

#include "base/array.hpp"
#include "base/isa.hpp"
#include "kernel/smoothing_kernel.hpp"
#include "search/cluster_list.hpp"
#include "sph/pair_kernels.hpp"

namespace gannet {

/// What a pass reads of one particle, in one cache line.
struct alignas(64) PackedParticle {
  double x = 0, y = 0, z = 0;     ///< position [m]
  double vx = 0, vy = 0, vz = 0;  ///< velocity [m/s]
  double rho = 0;                 ///< density [kg/m^3]
  double last = 0;  ///< force pass: p/rho^2 [m^5/(kg s^2)]; rates pass: s [kg/m^3], or 0
};

/// The packed particles of the last call of pack_particles().
struct Packed {
  bool single = false;          ///< for kernels in single precision
  Array<PackedParticle> lines;  ///< n_sources and 8 more; empty where single
  Array<PackedSingle> singles;  ///< the same; empty where not single
  double x_unit = 0;            ///< of PackedSingle [m]
  double v_unit = 0;            ///< [m/s]
};

/// The particles as a pass finds them: pointers to the first particle's entry of each field. All
/// hold n_sources entries: owned particles, then ghosts.
struct ParticleView {
  const Line* x = nullptr;      ///< position [m]
  const Line* v = nullptr;      ///< velocity [m/s]
  const double* rho = nullptr;  ///< density [kg/m^3], positive
  const double* p = nullptr;    ///< pressure [Pa], any sign; for the force pass, else null
  Index n_sources = 0;
  const double* s = nullptr;  ///< what density diffusion evens out [kg/m^3]; may be null
  Range unseen{};             ///< owned particles that no list holds: their lines mean nothing
};

/// What does not change from pair to pair.
struct PairParameters {
  int dimension = 3;   ///< 2 or 3: chooses the kernel's normalisation
  double h = 0;        ///< smoothing length [m]
  double m = 0;        ///< particle mass [kg]; in 2D [kg/m]
  double c0 = 0;       ///< speed of sound (c_i + c_j)/2 of the viscosity [m/s]
  double alpha = 0;    ///< linear viscosity [-]
  double beta = 0;     ///< quadratic viscosity [-]
  double epsilon = 0;  ///< XSPH [-]
  KernelType kernel = KernelType::cubic_spline;
  double rho0 = 1000;    ///< reference density: m/rho0 is the volume of a particle [kg/m^3]
  double dx = 0;         ///< spacing that W is compared at, for terms that ask for it [m]
  double delta = 0;      ///< density diffusion [-]
  double mu = 0;         ///< laminar viscosity [Pa s]
  bool central = false;  ///< which acts along the line of a pair
  double tensile = 0;    ///< repulsion under tension [-]
};

/// Results of the rates pass, one entry an owned particle. Terms whose result is null are off.
struct RatesOut {
  double* drho_dt = nullptr;          ///< stored [kg/(m^3 s)]
  Line* X = nullptr;                  ///< stored, w = 0 [m/s]; null: no XSPH
  double* drho_diffusion = nullptr;   ///< stored: the part of drho_dt that diffusion has
  double* drho_correction = nullptr;  ///< stored: what the corrected divergence adds to drho_dt
  Line* concentration = nullptr;      ///< stored: gradient [1/m]; w: div r [-]
  double* sum_mW = nullptr;           ///< stored: sum m W [kg/m^3]
  double* sum_VW = nullptr;           ///< stored: sum m/rho W [-]; both or none
};

/// Results of the force pass, one line an owned particle. Terms whose result is null are off.
struct ForceOut {
  Line* f = nullptr;             ///< added to x, y, z; w is left as it is [N]
  Line* f_viscous = nullptr;     ///< stored, w = 0: the artificial viscous part of f [N]
  Line* f_laminar = nullptr;     ///< stored, w = 0: the laminar part [N]
  Line* f_tensile = nullptr;     ///< stored, w = 0: the repulsion under tension [N]
  Line* f_correction = nullptr;  ///< stored, w = 0: what the corrected gradient adds [N]
};

/// How a pass is made.
struct PassOptions {
  const double* rho = nullptr;      ///< of the targets, as packed [kg/m^3]; for corrections only
  std::span<const Index> clusters;  ///< those to do; empty: all active ones
  Isa set = isa();                  ///< the kernels' instruction set, for tests
};

/// Packs n_sources particles and, behind them, the particle far away that pads the lists, for
/// packed.single or not. Arrays are resized (memory is only asked for when they grow). Parallel.
/// reach: radius of the kernel's support [m].
/// In single precision positions and velocities become whole multiples of a unit, 2^-31 of the
/// largest extent (or of 8 reach) and of twice the largest speed.
void pack_particles(const ParticleView& view, double reach, Packed& packed);

/// The arguments of the compiled kernels over all clusters, without results; for those who call
/// one instruction set directly (tests, bench). It points into list and packed.
PairJob pair_job(const ClusterList& list, const Packed& packed, const PairParameters& parameters);

/// Pass 1 at x(n+1/2), v(n+1/2):
///   drho_i/dt = sum_j m v_ij . grad_i W_ij
///   X_i = -epsilon sum_j m (v_i - v_j) / ((rho_i + rho_j)/2) W_ij
/// so that with XSPH particles move with the mean velocity around them: dx/dt = v + X.
/// With density diffusion (sph/density_diffusion.cpp says what s is), V = m/rho0:
///   drho_i/dt += 2 delta h c0 sum_j V (s_i - s_j) F_ij
/// With the correction, S_i = sum_j F_ij r_ij (x) r_ij:
///   drho_i/dt = -rho_i trace(sum_j F_ij v_ij (x) r_ij S_i^-1), exact for linear fields
/// Concentration (sph/concentration.cpp): gradient sum_j V (1 + 0.2 (W_ij/W(dx))^4) grad_i W_ij,
/// div r = -sum_j V r_ij . grad_i W_ij, which is the dimension inside the fluid.
/// list, packed: of the same particles in the same order, the list's radius at least the support
/// plus what has moved since; h, m > 0.
void pair_rates(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const RatesOut& out, const PassOptions& options = {});

/// Pass 2 at x(n), v(n-1/2):
///   f_i = -m sum_j m (p_i/rho_i^2 + p_j/rho_j^2 + Pi_ij) grad_i W_ij
///   Pi_ij = (-alpha c0 mu_ij + beta mu_ij^2) / ((rho_i + rho_j)/2)  where v_ij . r_ij < 0, else 0
///   mu_ij = h v_ij . r_ij / (r_ij^2 + 0.01 h^2)
/// Laminar viscosity: f_i += sum_j m^2 2 mu/(rho_i rho_j) r_ij . grad_i W_ij/(r_ij^2 + 0.01 h^2)
/// v_ij, or along the line of the pair, with d the dimension,
///   f_i += sum_j m^2 2 (d + 2) mu/(rho_i rho_j) v_ij . r_ij/(r_ij^2 + 0.01 h^2) grad_i W_ij
/// Repulsion under tension: f_i -= tensile m^2 sum_j (t_i + t_j) (W_ij/W(dx))^4 grad_i W_ij,
///   t = max(-p/rho^2, 0)
/// Correction: f_i = -m/rho_i grad p with grad p = -S_i^-1 sum_j (p_j - p_i) F_ij r_ij in place of
/// the
///   sum of both pressures; not the negative of what j gets.
/// The force of j on i is minus that of i on j to the last bit before they are summed. The work
/// that viscosity takes out per second is -sum_i f_viscous_i . v_i >= 0. Pressures may be
/// negative; nothing is cut here.
/// list, packed: as for pair_rates, packed with p; h, m > 0.
void pair_force(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const ForceOut& out, const PassOptions& options = {});

/// Density rate and force with viscosity in one pass; the bench's measure of the pair loop. A step
/// does not use it: the two belong at different time levels.
void pair_fused(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const RatesOut& rates, const ForceOut& force);

}  // namespace gannet
