// Particles for the tests of the pair passes, and the passes by instruction set.
#pragma once

#include <random>
#include <vector>

#include "base/isa.hpp"
#include "base/math.hpp"
#include "kernel/cubic_spline.hpp"
#include "sph/pair_pass.hpp"
#include "sph/reference_pass.hpp"

namespace gannet {

inline bool have_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
}

/// The instruction sets that can be tested here.
inline std::vector<Isa> sets_to_test() {
  std::vector<Isa> sets{Isa::avx2};
  if (have_avx512()) sets.push_back(Isa::avx512);
  return sets;
}

/// Particles with all that a pass reads, and the parameters of the pass.
struct Fluid {
  Array<Line> x, v;
  Array<double> rho, p;
  Index n_targets = 0;  ///< the particles after these are ghosts
  PairParameters k;

  void add(const Vec3& position, const Vec3& velocity, double density, double pressure) {
    x.push_back({position.x(), position.y(), position.z(), k.m});
    v.push_back({velocity.x(), velocity.y(), velocity.z(), 1.0 / k.m});
    rho.push_back(density);
    p.push_back(pressure);
    n_targets = static_cast<Index>(x.size());
  }
  [[nodiscard]] ParticleView view() const {
    return {x.data(), v.data(), rho.data(), p.data(), static_cast<Index>(x.size())};
  }
};

/// All that the passes return.
struct Results {
  Array<double> drho_dt;
  Array<Line> X, f, f_viscous;
  explicit Results(Index n)
      : drho_dt(static_cast<std::size_t>(n), -7.0),
        X(static_cast<std::size_t>(n), Line{7, 7, 7, 7}),
        f(static_cast<std::size_t>(n)),
        f_viscous(static_cast<std::size_t>(n), Line{7, 7, 7, 7}) {}
};

/// Which of the optional terms are on.
struct Terms {
  bool xsph = true;
  bool viscosity = true;
};

inline Results reference(const Fluid& fluid, Terms terms = {}) {
  Results r(fluid.n_targets);
  reference_rates(fluid.view(), fluid.n_targets, fluid.k,
                  {r.drho_dt.data(), terms.xsph ? r.X.data() : nullptr});
  reference_force(fluid.view(), fluid.n_targets, fluid.k,
                  {r.f.data(), terms.viscosity ? r.f_viscous.data() : nullptr});
  return r;
}

inline void run_kernels(Isa set, const PairJob& job, Terms terms) {
  if (set == Isa::avx512) {
    terms.xsph ? avx512::pair_rates_xsph(job) : avx512::pair_rates(job);
    terms.viscosity ? avx512::pair_force_viscous(job) : avx512::pair_force(job);
  } else {
    terms.xsph ? avx2::pair_rates_xsph(job) : avx2::pair_rates(job);
    terms.viscosity ? avx2::pair_force_viscous(job) : avx2::pair_force(job);
  }
}

/// Both passes with the kernels of one instruction set. skin: added to the list's radius [m].
inline Results vectorised(Isa set, const Fluid& fluid, Terms terms = {}, double skin = 0) {
  Results r(fluid.n_targets);
  ClusterList list;
  build_cluster_list(fluid.x, fluid.n_targets, 2.0 * fluid.k.h * (1 + 1e-12) + skin, list, set);
  Array<PackedParticle> packed;
  pack_particles(fluid.view(), packed);
  PairJob job = pair_job(list, packed, fluid.k);
  job.drho_dt = r.drho_dt.data();
  job.X = &r.X.data()->x;
  job.f = &r.f.data()->x;
  job.f_viscous = &r.f_viscous.data()->x;
  run_kernels(set, job, terms);
  return r;
}

/// A jittered lattice of n_x n_y n_z particles (n_z = 1: plane) at spacing dx, water-like, with
/// random velocities, densities and pressures of both signs.
inline Fluid jittered_lattice(int n_x, int n_y, int n_z, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double dx = 0.01;
  Fluid fluid;
  fluid.k.dimension = n_z == 1 ? 2 : 3;
  fluid.k.h = 1.3 * dx;
  fluid.k.m = 1000 * std::pow(dx, fluid.k.dimension);
  fluid.k.c0 = 50;
  fluid.k.alpha = 0.05;
  fluid.k.beta = 0.1;
  fluid.k.epsilon = 0.4;
  for (int k = 0; k < n_z; ++k) {
    for (int j = 0; j < n_y; ++j) {
      for (int i = 0; i < n_x; ++i) {
        const double jitter_z = n_z == 1 ? 0 : 0.2 * u(random);
        const Vec3 place(i + 0.2 * u(random), j + 0.2 * u(random), k + jitter_z);
        const Vec3 v(u(random), 2 + u(random), n_z == 1 ? 0 : u(random));
        fluid.add(dx * place, v, 1000 * (1 + 0.01 * u(random)), 1e4 * u(random));
      }
    }
  }
  return fluid;
}

}  // namespace gannet
