#include "sph/pair_pass.hpp"

#include <algorithm>
#include <cassert>

#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "kernel/cubic_spline.hpp"

namespace gannet {

namespace {

constexpr Index pass_chunk = 32;  ///< clusters per task: 20 to 50 microseconds

/// A particle so far away that the kernel is 0, with a density that can be divided by.
constexpr PackedParticle far_away{1e30, 1e30, 1e30, 0, 0, 0, 1, 0};

/// Runs a kernel over all clusters, a chunk a task.
template <class Kernel>
void over_clusters(const PairJob& job, Kernel&& kernel) {
  parallel_for(job.last, pass_chunk, [&](Index begin, Index end) {
    PairJob part = job;
    part.first = begin;
    part.last = end;
    kernel(part);
  });
}

}  // namespace

void pack_particles(const ParticleView& view, Array<PackedParticle>& packed) {
  // The last cluster loads eight targets, whatever is left of them.
  packed.resize(static_cast<std::size_t>(view.n_sources) + ClusterList::lanes);
  parallel_for(static_cast<Index>(packed.size()), node_chunk, [&](Index begin, Index end) {
    const Index last = std::min(end, view.n_sources);
    for (Index i = begin; i < last; ++i) {
      const Line& x = view.x[i];
      const Line& v = view.v[i];
      const double rho = view.rho[i];
      const double p_rho2 = view.p == nullptr ? 0.0 : view.p[i] / (rho * rho);
      packed[i] = {x.x, x.y, x.z, v.x, v.y, v.z, rho, p_rho2};
    }
    for (Index i = std::max(begin, view.n_sources); i < end; ++i) packed[i] = far_away;
  });
}

PairJob pair_job(const ClusterList& list, std::span<const PackedParticle> packed,
                 const PairParameters& parameters) {
  assert(parameters.h > 0 && parameters.m > 0);
  assert(list.radius >= cubic_spline::support * parameters.h);
  assert(packed.size() >= static_cast<std::size_t>(list.n_sources + ClusterList::lanes));
  PairJob job;
  job.packed = &packed.data()->x;
  job.offset = list.offset.data();
  job.source = list.source.data();
  job.n_targets = list.n_targets;
  job.last = list.n_clusters;
  job.h = parameters.h;
  job.m = parameters.m;
  job.sigma = cubic_spline::normalisation(parameters.dimension, parameters.h);
  job.c0 = parameters.c0;
  job.alpha = parameters.alpha;
  job.beta = parameters.beta;
  job.epsilon = parameters.epsilon;
  return job;
}

void pair_rates(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const RatesOut& out) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  job.drho_dt = out.drho_dt;
  if (out.X == nullptr) {
    over_clusters(job, [](const PairJob& part) { GANNET_DISPATCH(pair_rates, part); });
    return;
  }
  job.X = &out.X->x;
  over_clusters(job, [](const PairJob& part) { GANNET_DISPATCH(pair_rates_xsph, part); });
}

void pair_force(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const ForceOut& out) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  job.f = &out.f->x;
  if (out.f_viscous == nullptr) {
    over_clusters(job, [](const PairJob& part) { GANNET_DISPATCH(pair_force, part); });
    return;
  }
  job.f_viscous = &out.f_viscous->x;
  over_clusters(job, [](const PairJob& part) { GANNET_DISPATCH(pair_force_viscous, part); });
}

void pair_fused(const ClusterList& list, std::span<const PackedParticle> packed,
                const PairParameters& parameters, const RatesOut& rates, const ForceOut& force) {
  if (list.n_clusters == 0) return;
  PairJob job = pair_job(list, packed, parameters);
  job.drho_dt = rates.drho_dt;
  job.f = &force.f->x;
  job.f_viscous = &force.f_viscous->x;
  over_clusters(job, [](const PairJob& part) { GANNET_DISPATCH(pair_fused, part); });
}

}  // namespace gannet
