// The state of the particles beyond what every node has. Found by scene.store.get<SphState>().
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "base/array.hpp"
#include "base/parallel.hpp"
#include "material/murnaghan.hpp"
#include "scene/scene.hpp"
#include "search/cluster_list.hpp"
#include "sph/halo.hpp"
#include "sph/list_age.hpp"
#include "sph/pair_pass.hpp"
#include "sph/stable_step.hpp"

namespace gannet {

/// What effects ask of the pair passes, in their state() call; 0 is off.
struct PairTerms {
  double alpha = 0;    ///< linear artificial viscosity [-]
  double beta = 0;     ///< quadratic artificial viscosity [-]
  double epsilon = 0;  ///< XSPH [-]
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
  double m = 0;                ///< mass of a particle [kg]; in 2D per metre of thickness
  double skin = 0;             ///< how much further than 2 h the lists reach [m]
  double cfl = 0;              ///< time step over (h/c), before viscosity [-]
  double c0 = 0;               ///< largest speed of sound of the parts [m/s]
  std::vector<Murnaghan> eos;  ///< one a part of the scene; unused where it has no particles
  std::vector<int> parts;      ///< numbers of the parts that are made of particles

  Array<double> rho;               ///< density [kg/m^3]
  Array<double> p;                 ///< pressure [Pa]
  Array<double> drho_dt;           ///< [kg/(m^3 s)]
  Array<double> smoothing_length;  ///< h of each particle [m]
  Array<Line> x_build;             ///< positions when the lists were built [m]
  Array<Line> X;                   ///< XSPH velocity [m/s]; empty without XSPH
  Array<Line> f_viscous;           ///< viscous force of the last force pass [N]; may be empty

  PairTerms terms;
  Halo halo;
  LatticeLimits limits;
  ClusterList list;
  ListAge age;
  Array<PackedParticle> packed;
  std::int64_t n_builds = 0;  ///< how often the lists were built in this run
  Array<double> scratch;      ///< one number a particle
  ParticleVote vote;          ///< of the last choice of the step
  bool warned = false;        ///< the user knows that sound is too slow
};

/// The equation of state of particle k.
inline const Murnaghan& eos_of(const SphState& sph, const Scene& scene, Index k) {
  return sph.eos[scene.particle_part[k]];
}

/// Sum of f(k) over the particles of a part, in chunks that are the same for any number of threads.
/// f: a function of the particle's index among the particles.
template <class F>
auto sum_over_part(const Scene& scene, int part, F&& f) {
  using T = std::decay_t<decltype(f(Index{0}))>;
  T zero;
  if constexpr (std::is_arithmetic_v<T>) {
    zero = 0;
  } else {
    zero.setZero();
  }
  return parallel_sum(scene.particles.size(), node_chunk, zero, [&](Index begin, Index end) {
    T sum = zero;
    for (Index k = begin; k < end; ++k) {
      if (scene.particle_part[k] == part) sum += f(k);
    }
    return sum;
  });
}

/// rho and p of every particle from drho_dt over the step dt [s]:
///   rho += drho_dt dt,  p = p(rho)
void advance_density(SphState& sph, const Scene& scene, double dt);

/// Internal energy of a part, sum m e(rho) [J], zero where all particles have their rho0.
double internal_energy_of_part(const SphState& sph, const Scene& scene, int part);

/// The smallest stable step [s] of the particles with their present rho, p and drho_dt: that of
/// stable_step() for the largest local speed of sound, c^2 = gamma (p - p0 + B)/rho, and, with
/// quadratic viscosity, the largest |mu| = h max(drho_dt/rho, 0): the rate at which a particle is
/// compressed along one direction, as the density rate measured it. Named is the particle of the
/// speed of sound, or of |mu| where the quadratic viscosity is the larger one.
ParticleVote smallest_stable_step(const SphState& sph, const Scene& scene);

/// "pool: particle 1207 at (0.1, 0, -0.2) m"
std::string text_of_particle(const Scene& scene, Index k);

/// Checks the speed of sound against the flow, at level n:
///   99.9th percentile of |v| <= c0/10,  |rho/rho0 - 1| <= 2 %
/// dt: the step after level n [s]. Uses sph.scratch. Returns a sentence for the user, or "".
std::string sound_speed_warning(SphState& sph, const Scene& scene, double dt);

}  // namespace gannet
