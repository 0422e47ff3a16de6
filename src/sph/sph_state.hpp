// The state of the particles beyond what every node has. Found by scene.store.get<SphState>().
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "base/array.hpp"
#include "base/parallel.hpp"
#include "kernel/smoothing_kernel.hpp"
#include "material/murnaghan.hpp"
#include "scene/scene.hpp"
#include "search/cluster_list.hpp"
#include "sph/halo.hpp"
#include "sph/list_age.hpp"
#include "sph/list_skin.hpp"
#include "sph/pair_pass.hpp"
#include "sph/stable_step.hpp"

namespace gannet {

/// What effects ask of the pair passes, in their state() call; 0 is off.
struct PairTerms {
  double alpha = 0;            ///< linear artificial viscosity [-]
  double beta = 0;             ///< quadratic artificial viscosity [-]
  double epsilon = 0;          ///< XSPH [-]
  double delta = 0;            ///< density diffusion [-]
  double mu = 0;               ///< laminar viscosity [Pa s]
  bool central = false;        ///< which acts along the line of a pair
  double tensile = 0;          ///< repulsion under tension [-]
  bool corrected = false;      ///< corrected gradients (CSPM)
  bool concentration = false;  ///< gradient of the concentration and div r
  [[nodiscard]] bool viscous() const { return alpha > 0 || beta > 0; }
};

/// A stable step and the particle whose it is.
struct ParticleVote {
  double dt = 0;
  Index particle = -1;
};

/// All particles share spacing, smoothing length and mass. Time levels at entry to a step: rho and
/// p at n; drho_dt and X at n-1/2. Arrays hold one entry a particle; rho, p and x_build also have
/// room for ghosts.
struct SphState {
  double dx = 0;               ///< spacing at the start [m]
  double h = 0;                ///< smoothing length [m]
  SmoothingKernel kernel;      ///< of that smoothing length
  double m = 0;                ///< mass of a particle [kg]; in 2D per metre of thickness
  ListSkin skin;               ///< how much further than 2 h the lists reach
  double cfl = 0;              ///< time step over (h/c), before viscosity [-]
  double c0 = 0;               ///< largest speed of sound of the parts [m/s]
  double rho0 = 0;             ///< largest reference density of the parts [kg/m^3]
  std::vector<Murnaghan> eos;  ///< one a part of the scene; unused where it has no particles
  std::vector<int> parts;      ///< numbers of the parts that are made of particles
  std::vector<bool>
      restless;  ///< parts that move as they are told, one a part of the scene; or none

  Array<double> rho;               ///< density [kg/m^3]
  Array<double> p;                 ///< pressure [Pa]
  Array<double> drho_dt;           ///< [kg/(m^3 s)]
  Array<double> smoothing_length;  ///< h of each particle [m]
  Array<Line> x_build;             ///< positions when the lists were built [m]
  Array<double> list_skin;         ///< how much further than 2 h the list of each reaches [m]
  Array<Line> X;                   ///< XSPH velocity [m/s]; empty without XSPH
  /// Parts of the force of the last force pass [N], each empty where its term is absent.
  Array<Line> f_viscous, f_laminar, f_tensile, f_correction;
  /// Parts of the density rate of the last rates pass [kg/(m^3 s)], empty where absent.
  Array<double> drho_diffusion, drho_correction;
  Array<double> s;            ///< what density diffusion evens out [kg/m^3]; empty without it
  Array<Line> shift;          ///< drift of the last step by shifting [m/s]; empty without it
  Array<Line> concentration;  ///< its gradient [1/m], w: div r [-]; empty where nobody asks
  Array<Line> v_seen;  ///< velocity that viscous terms see, ghosts too [m/s]; empty: v itself

  PairTerms terms;
  Halo halo;
  LatticeLimits limits;
  ClusterList list;
  ListAge age;
  Packed packed;
  bool packed_pressures = false;         ///< packed by the force stage, not by the rates stage
  std::int64_t n_builds = 0;             ///< how often the lists were built in this run
  Array<double> scratch;                 ///< one number a particle
  std::vector<double> internal_at_rest;  ///< of the particles at rest of each part [J]; or empty
  ParticleVote vote;                     ///< of the last choice of the step
  std::string limited_by;                ///< its particle, in words: they are sorted later on
  bool warned = false;                   ///< the user knows that sound is too slow
};

/// Whether source k is fluid, and not a particle of a wall.
inline bool is_fluid(const Scene& scene, Index k) {
  return scene.parts[static_cast<std::size_t>(scene.particle_part[k])].kind == "sph";
}

/// The equation of state of particle k.
inline const Murnaghan& eos_of(const SphState& sph, const Scene& scene, Index k) {
  return sph.eos[scene.particle_part[k]];
}

/// The kernel of that name in a case.
KernelType kernel_named(const std::string& name);

/// The particles, ghosts too, as pair passes read them; without p and s.
ParticleView view_of(const SphState& sph, const Scene& scene);

/// What pair passes are told.
PairParameters parameters_of(const SphState& sph);

/// Sum of f(k) over those of the first n particles that are of a part, in chunks that are the same
/// for any number of threads. f: a function of the particle's index among the particles.
template <class F>
auto sum_over_first(const Scene& scene, Index n, int part, F&& f) {
  using T = std::decay_t<decltype(f(Index{0}))>;
  T zero;
  if constexpr (std::is_arithmetic_v<T>) {
    zero = 0;
  } else {
    zero.setZero();
  }
  return parallel_sum(n, node_chunk, zero, [&](Index begin, Index end) {
    T sum = zero;
    for (Index k = begin; k < end; ++k) {
      if (scene.particle_part[k] == part) sum += f(k);
    }
    return sum;
  });
}

/// The sum over all particles of a part.
template <class F>
auto sum_over_part(const Scene& scene, int part, F&& f) {
  return sum_over_first(scene, scene.particles.size(), part, f);
}

/// The sum over those that are computed, for what is 0 for particles at rest.
template <class F>
auto sum_over_awake(const Scene& scene, int part, F&& f) {
  return sum_over_first(scene, scene.awake().size(), part, f);
}

/// rho and p of every particle from drho_dt over the step dt [s]:
///   rho += drho_dt dt,  p = p(rho)
void advance_density(SphState& sph, const Scene& scene, double dt);

/// Internal energy of a part, sum m e(rho) [J], zero where all particles have their rho0.
double internal_energy_of_part(const SphState& sph, const Scene& scene, int part);

/// The same, with what sph.internal_at_rest knows of particles at rest.
double internal_energy_at_work(const SphState& sph, const Scene& scene, int part);

/// The smallest stable step [s] of the particles with their present rho, p and drho_dt: that of
/// stable_step() for the largest local speed of sound, c^2 = gamma (p - p0 + B)/rho, the damping of
/// all terms, and, with quadratic viscosity, the largest |mu| = h max(drho_dt/rho, 0): the rate at
/// which a particle is compressed along one direction, as the density rate measured it. Named is
/// the particle of the speed of sound, or of |mu| where the quadratic viscosity is the larger one.
ParticleVote smallest_stable_step(const SphState& sph, const Scene& scene);

/// "pool: particle 1207 at (0.1, 0, -0.2) m"
std::string text_of_particle(const Scene& scene, Index k);

/// Checks the speed of sound against the flow, at level n:
///   99.9th percentile of |v| <= c0/10,  |rho/rho0 - 1| <= 2 %
/// dt: the step after level n [s]. Uses sph.scratch. Returns a sentence for the user, or "".
std::string sound_speed_warning(SphState& sph, const Scene& scene, double dt);

}  // namespace gannet
