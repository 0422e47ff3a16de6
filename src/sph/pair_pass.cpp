#include "sph/pair_pass.hpp"

#include <algorithm>
#include <cassert>

#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr Index pass_chunk = 32;  ///< clusters per task: 20 to 50 microseconds

double* numbers(Line* lines) { return lines == nullptr ? nullptr : &lines->x; }

/// Runs a kernel over all clusters of a job, a chunk a task.
void over_clusters(PairKernel kernel, const PairJob& job, Isa set) {
  parallel_for(job.last, pass_chunk, [&](Index begin, Index end) {
    PairJob part = job;
    part.first = begin;
    part.last = end;
    set == Isa::avx512 ? avx512::pair_pass(kernel, part) : avx2::pair_pass(kernel, part);
  });
}

void choose_clusters(PairJob& job, std::span<const Index> clusters) {
  if (clusters.empty()) return;
  job.cluster = clusters.data();
  job.last = static_cast<Index>(clusters.size());
}

/// A kernel in double and in single precision.
struct KernelPair {
  PairKernel in_double;
  PairKernel in_single;
};

/// The kernel that is compiled for what a job asks.
PairKernel kernel_for(const PairJob& job, unsigned usual, KernelPair cubic, KernelPair any) {
  const bool is_cubic = job.kernel == static_cast<int>(KernelType::cubic_spline);
  const KernelPair& both = is_cubic && (job.terms & ~usual) == 0 ? cubic : any;
  return job.single == nullptr ? both.in_double : both.in_single;
}

}  // namespace

PairJob pair_job(const ClusterList& list, const Packed& packed, const PairParameters& parameters) {
  assert(parameters.h > 0 && parameters.m > 0);
  const SmoothingKernel kernel{parameters.kernel, parameters.dimension, parameters.h};
  assert(list.radius >= kernel.reach());
  PairJob job;
  job.packed = packed.single ? nullptr : &packed.lines.data()->x;
  job.single = packed.single ? packed.singles.data() : nullptr;
  job.x_unit = packed.x_unit;
  job.v_unit = packed.v_unit;
  job.offset = list.offset.data();
  job.source = list.source.data();
  job.n_targets = list.n_targets;
  job.last = list.n_active;
  job.kernel = static_cast<int>(parameters.kernel);
  job.dimension = parameters.dimension;
  job.h = parameters.h;
  job.m = parameters.m;
  job.sigma = kernel.normalisation();
  job.rho0 = parameters.rho0;
  job.c0 = parameters.c0;
  job.alpha = parameters.alpha;
  job.beta = parameters.beta;
  job.epsilon = parameters.epsilon;
  job.delta = parameters.delta;
  job.mu = (parameters.central ? 2.0 * (parameters.dimension + 2) : 2.0) * parameters.mu;
  job.tensile = parameters.tensile;
  job.inv_W_dx = parameters.dx > 0 ? 1.0 / kernel.W(parameters.dx) : 0.0;
  return job;
}

void pair_rates(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const RatesOut& out, const PassOptions& options) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  choose_clusters(job, options.clusters);
  job.rho = options.rho;
  job.drho_dt = out.drho_dt;
  job.X = numbers(out.X);
  job.drho_diffusion = out.drho_diffusion;
  job.drho_correction = out.drho_correction;
  job.concentration = numbers(out.concentration);
  job.sum_mW = out.sum_mW;
  job.sum_VW = out.sum_VW;
  if (out.drho_dt != nullptr) job.terms |= rate_term;
  if (out.X != nullptr) job.terms |= xsph_term;
  if (out.drho_diffusion != nullptr) job.terms |= diffusion_term;
  if (out.drho_correction != nullptr) job.terms |= rate_correction_term;
  if (out.concentration != nullptr) job.terms |= concentration_term;
  if (out.sum_mW != nullptr) job.terms |= shepard_term;
  over_clusters(kernel_for(job, rate_term | xsph_term | diffusion_term,
                           {PairKernel::rates_cubic, PairKernel::rates_cubic_single},
                           {PairKernel::rates_any, PairKernel::rates_any_single}),
                job, options.set);
}

void pair_force(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const ForceOut& out, const PassOptions& options) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  choose_clusters(job, options.clusters);
  job.rho = options.rho;
  job.f = numbers(out.f);
  job.f_viscous = numbers(out.f_viscous);
  job.f_laminar = numbers(out.f_laminar);
  job.f_tensile = numbers(out.f_tensile);
  job.f_correction = numbers(out.f_correction);
  job.terms = force_term;
  if (out.f_viscous != nullptr) job.terms |= viscous_term;
  if (out.f_laminar != nullptr) {
    job.terms |= laminar_term | (parameters.central ? central_term : 0U);
  }
  if (out.f_tensile != nullptr) job.terms |= tensile_term;
  if (out.f_correction != nullptr) job.terms |= force_correction_term;
  over_clusters(kernel_for(job, force_term | viscous_term,
                           {PairKernel::force_cubic, PairKernel::force_cubic_single},
                           {PairKernel::force_any, PairKernel::force_any_single}),
                job, options.set);
}

void pair_fused(const ClusterList& list, const Packed& packed, const PairParameters& parameters,
                const RatesOut& rates, const ForceOut& force) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  job.terms = rate_term | force_term | viscous_term;
  job.drho_dt = rates.drho_dt;
  job.f = &force.f->x;
  job.f_viscous = &force.f_viscous->x;
  over_clusters(packed.single ? PairKernel::fused_single : PairKernel::fused, job, isa());
}

}  // namespace gannet
