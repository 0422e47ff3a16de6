#include "sph/sph_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/plan.hpp"

namespace gannet {

namespace {

/// Above these the fluid is not nearly incompressible any more.
constexpr double largest_mach = 0.1;
constexpr double largest_compression = 0.02;

/// A value and the particle that has it.
struct Extreme {
  double value = -1;
  Index particle = -1;
};

/// The largest f(k) of all particles that are computed; the first one where several have it, or one
/// that is not a number.
template <class F>
Extreme largest(const Scene& scene, const F& f) {
  return parallel_reduce(
      scene.awake().size(), node_chunk, Extreme{},
      [&](Index begin, Index end) {
        Extreme most;
        for (Index k = begin; k < end; ++k) {
          const double value = f(k);
          if (!(value <= most.value)) most = {value, k};
        }
        return most;
      },
      [](const Extreme& a, const Extreme& b) { return !(b.value <= a.value) ? b : a; });
}

/// The speed that 99.9 % of the particles do not pass.
double high_speed(SphState& sph, const Scene& scene, double dt) {
  const Index n = scene.awake().size();
  sph.scratch.resize(static_cast<std::size_t>(n));
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      sph.scratch[k] = velocity_at_level(scene.nodes, scene.particles.begin + k, dt).norm();
    }
  });
  const auto rank = static_cast<std::ptrdiff_t>(0.999 * (n - 1));
  std::nth_element(sph.scratch.begin(), sph.scratch.begin() + rank, sph.scratch.end());
  return sph.scratch[rank];
}

}  // namespace

KernelType kernel_named(const std::string& name) {
  if (name == "wendland_c2") return KernelType::wendland_c2;
  if (name == "wendland_c4") return KernelType::wendland_c4;
  return name == "quintic_spline" ? KernelType::quintic_spline : KernelType::cubic_spline;
}

ParticleView view_of(const SphState& sph, const Scene& scene) {
  const Index first = scene.particles.begin;
  ParticleView view;
  view.x = scene.nodes.x.data() + first;
  view.v = scene.nodes.v.data() + first;
  view.rho = sph.rho.data();
  view.n_sources = scene.particles.size() + scene.nodes.n_ghosts;
  view.unseen = {scene.seen().size(), scene.particles.size()};
  return view;
}

PairParameters parameters_of(const SphState& sph) {
  return {.dimension = sph.kernel.dimension,
          .h = sph.h,
          .m = sph.m,
          .c0 = sph.c0,
          .alpha = sph.terms.alpha,
          .beta = sph.terms.beta,
          .epsilon = sph.terms.epsilon,
          .kernel = sph.kernel.type,
          .rho0 = sph.rho0,
          .dx = sph.dx,
          .delta = sph.terms.delta,
          .mu = sph.terms.mu,
          .central = sph.terms.central,
          .tensile = sph.terms.tensile};
}

void advance_density(SphState& sph, const Scene& scene, double dt) {
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      sph.rho[k] += sph.drho_dt[k] * dt;
      sph.p[k] = pressure(eos_of(sph, scene, k), sph.rho[k]);
    }
  });
}

double internal_energy_of_part(const SphState& sph, const Scene& scene, int part) {
  const Murnaghan& eos = sph.eos[part];
  return sum_over_part(scene, part,
                       [&](Index k) { return sph.m * internal_energy(eos, sph.rho[k]); });
}

double internal_energy_at_work(const SphState& sph, const Scene& scene, int part) {
  const Murnaghan& eos = sph.eos[part];
  const double at_rest = sph.internal_at_rest.empty() ? 0.0 : sph.internal_at_rest[part];
  return at_rest + sum_over_awake(scene, part, [&](Index k) {
           return sph.m * internal_energy(eos, sph.rho[k]);
         });
}

ParticleVote smallest_stable_step(const SphState& sph, const Scene& scene) {
  const Extreme c2 = largest(scene, [&](Index k) {
    const Murnaghan& eos = eos_of(sph, scene, k);
    return eos.gamma * (sph.p[k] - eos.p0 + eos.B) / sph.rho[k];
  });
  Extreme mu{0, c2.particle};
  if (sph.terms.beta > 0) {
    mu =
        largest(scene, [&](Index k) { return sph.h * std::max(sph.drho_dt[k] / sph.rho[k], 0.0); });
  }
  const double linear = sph.terms.alpha * sph.c0;
  const double quadratic = 2 * sph.terms.beta * mu.value;
  const double nu = sph.terms.mu / sph.rho0;
  const Damping damping = {.slope = linear + quadratic,
                           .nu = sph.terms.central ? 0 : nu,
                           .central_nu = sph.terms.central ? nu : 0,
                           .diffusion = sph.terms.delta * sph.c0};
  return {stable_step(sph.limits, sph.cfl, sph.h, std::sqrt(c2.value),
                      largest_damping(sph.limits, sph.h, damping)),
          quadratic > linear ? mu.particle : c2.particle};
}

std::string text_of_particle(const Scene& scene, Index k) {
  const Index i = scene.particles.begin + k;
  const Line& x = scene.nodes.x[i];
  return fmt::format("{}: particle {} at ({:.4g}, {:.4g}, {:.4g}) m",
                     scene.parts[scene.particle_part[k]].name, scene.nodes.id[i], x.x, x.y, x.z);
}

std::string sound_speed_warning(SphState& sph, const Scene& scene, double dt) {
  const double speed = high_speed(sph, scene, dt);
  if (speed > largest_mach * sph.c0) {
    return fmt::format(
        "0.1 % of the particles move faster than {:.4g} m/s, a tenth of the speed of sound "
        "c0 = {:.4g} m/s is {:.4g} m/s: pressures are less and less those of water; give a larger "
        "c0 or expected_speed",
        speed, sph.c0, largest_mach * sph.c0);
  }
  const Extreme change = largest(
      scene, [&](Index k) { return std::abs(sph.rho[k] / eos_of(sph, scene, k).rho0 - 1); });
  if (change.value > largest_compression) {
    return fmt::format(
        "{} has a density {:.3g} % from its reference, more than 2 %: give a larger c0 or "
        "expected_speed",
        text_of_particle(scene, change.particle), 100 * change.value);
  }
  return "";
}

}  // namespace gannet
