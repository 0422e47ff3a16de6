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
  Array<double> rho, p, s;
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
    return {x.data(),
            v.data(),
            rho.data(),
            p.data(),
            static_cast<Index>(x.size()),
            s.empty() ? nullptr : s.data()};
  }
};

/// All that the passes return.
struct Results {
  Array<double> drho_dt, drho_diffusion, drho_correction, sum_mW, sum_VW;
  Array<Line> X, concentration, f, f_viscous, f_laminar, f_tensile, f_correction;
  explicit Results(Index n) {
    const auto size = static_cast<std::size_t>(n);
    for (Array<double>* a : {&drho_dt, &drho_diffusion, &drho_correction, &sum_mW, &sum_VW}) {
      a->assign(size, -7.0);
    }
    for (Array<Line>* a : {&X, &concentration, &f_viscous, &f_laminar, &f_tensile, &f_correction}) {
      a->assign(size, Line{7, 7, 7, 7});
    }
    f.assign(size, Line{});
  }
};

/// Which of the optional terms are on. `all`: every term there is.
struct Terms {
  bool xsph = true;
  bool viscosity = true;
  bool all = false;
};

inline RatesOut rates_of(Results& r, Terms terms) {
  RatesOut out{r.drho_dt.data(), terms.xsph ? r.X.data() : nullptr};
  if (!terms.all) return out;
  out.drho_diffusion = r.drho_diffusion.data();
  out.drho_correction = r.drho_correction.data();
  out.concentration = r.concentration.data();
  out.sum_mW = r.sum_mW.data();
  out.sum_VW = r.sum_VW.data();
  return out;
}

inline ForceOut force_of(Results& r, Terms terms) {
  ForceOut out{r.f.data(), terms.viscosity ? r.f_viscous.data() : nullptr};
  if (!terms.all) return out;
  out.f_laminar = r.f_laminar.data();
  out.f_tensile = r.f_tensile.data();
  out.f_correction = r.f_correction.data();
  return out;
}

inline Results reference(const Fluid& fluid, Terms terms = {}) {
  Results r(fluid.n_targets);
  reference_rates(fluid.view(), fluid.n_targets, fluid.k, rates_of(r, terms));
  reference_force(fluid.view(), fluid.n_targets, fluid.k, force_of(r, terms));
  return r;
}

/// Both passes with the kernels of one instruction set. skin: added to the list's radius [m].
inline Results vectorised(Isa set, const Fluid& fluid, Terms terms = {}, double skin = 0,
                          bool single = false) {
  Results r(fluid.n_targets);
  const PassOptions options{.rho = fluid.rho.data(), .set = set};
  const double reach = support(fluid.k.kernel) * fluid.k.h;
  ClusterList list;
  build_cluster_list(fluid.x, fluid.n_targets, reach * (1 + 1e-12) + skin, list, set);
  Packed packed;
  packed.single = single;
  ParticleView view = fluid.view();
  view.p = nullptr;
  pack_particles(view, reach, packed);
  pair_rates(list, packed, fluid.k, rates_of(r, terms), options);
  pack_particles(fluid.view(), reach, packed);
  pair_force(list, packed, fluid.k, force_of(r, terms), options);
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
