// The two particle pair passes: density rate (with XSPH) and force (with viscosity).
//
// Every pass first packs what it reads into one 64-byte line per particle, then walks the cluster
// lists with eight targets in the lanes of a vector and one source broadcast at a time. Sources at
// index n_targets and above are ghosts. Terms are compile-time flags of one kernel template; what
// is compiled: rates without and with XSPH, force without and with viscosity, and one fused pass
// that only the bench uses.
//
// r_ij = x_i - x_j, v_ij = v_i - v_j, grad_i W_ij = F_ij r_ij (kernel/cubic_spline.hpp). All
// particles of a pass have the same h and m. In 2D z and v_z are 0 (or equal), masses and forces
// are per metre of thickness.
#pragma once

#include <cstdint>
#include <span>

#include "base/array.hpp"
#include "search/cluster_list.hpp"
#include "sph/pair_kernels.hpp"

namespace gannet {

/// What a pass reads of one particle, in one cache line.
struct alignas(64) PackedParticle {
  double x = 0, y = 0, z = 0;     ///< position [m]
  double vx = 0, vy = 0, vz = 0;  ///< velocity [m/s]
  double rho = 0;                 ///< density [kg/m^3]
  double p_rho2 = 0;              ///< p/rho^2 [m^5/(kg s^2)]; 0 in the rates pass
};

/// The particles as a pass finds them: pointers to the first particle's entry of each field. All
/// hold n_sources entries: owned particles, then ghosts.
struct ParticleView {
  const Line* x = nullptr;      ///< position [m]
  const Line* v = nullptr;      ///< velocity [m/s]
  const double* rho = nullptr;  ///< density [kg/m^3], positive
  const double* p = nullptr;    ///< pressure [Pa], any sign; may be null for the rates pass
  Index n_sources = 0;
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
};

/// Results of the rates pass, one entry an owned particle.
struct RatesOut {
  double* drho_dt = nullptr;  ///< stored [kg/(m^3 s)]
  Line* X = nullptr;          ///< stored, w = 0 [m/s]; null: no XSPH
};

/// Results of the force pass, one line an owned particle.
struct ForceOut {
  Line* f = nullptr;          ///< added to x, y, z; w is left as it is [N]
  Line* f_viscous = nullptr;  ///< stored, w = 0: the viscous part of f [N]; null: no viscosity
};

/// Packs n_sources particles and, behind them, the particle far away that pads the lists.
/// packed is resized (memory is only asked for when it grows). Parallel.
void pack_particles(const ParticleView& view, Array<PackedParticle>& packed);

/// The arguments of the compiled kernels over all clusters, without results; for those who call
/// one instruction set directly (tests, bench). It points into list and packed.
PairJob pair_job(const ClusterList& list, std::span<const PackedParticle> packed,
                 const PairParameters& parameters);

/// Pass 1 at x(n+1/2), v(n+1/2):
///   drho_i/dt = sum_j m v_ij . grad_i W_ij
///   X_i = -epsilon sum_j m (v_i - v_j) / ((rho_i + rho_j)/2) W_ij
/// so that with XSPH particles move with the mean velocity around them: dx/dt = v + X.
/// list, packed: of the same particles in the same order, the list's radius at least 2 h plus what
/// has moved since; h, m > 0. X is only computed where out.X is given.
void pair_rates(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const RatesOut& out);

/// Pass 2 at x(n), v(n-1/2):
///   f_i = -m sum_j m (p_i/rho_i^2 + p_j/rho_j^2 + Pi_ij) grad_i W_ij
///   Pi_ij = (-alpha c0 mu_ij + beta mu_ij^2) / ((rho_i + rho_j)/2)  where v_ij . r_ij < 0, else 0
///   mu_ij = h v_ij . r_ij / (r_ij^2 + 0.01 h^2)
/// The force of j on i is minus that of i on j to the last bit before they are summed. The work
/// that viscosity takes out per second is -sum_i f_viscous_i . v_i >= 0. Pressures may be
/// negative; nothing is cut here. Pi is only computed where out.f_viscous is given.
/// list, packed: as for pair_rates, packed with p; h, m > 0.
void pair_force(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const ForceOut& out);

/// Density rate and force with viscosity in one pass; the bench's measure of the pair loop. A step
/// does not use it: the two belong at different time levels.
void pair_fused(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const RatesOut& rates, const ForceOut& force);

}  // namespace gannet
