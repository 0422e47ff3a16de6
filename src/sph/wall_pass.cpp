#include "sph/wall_pass.hpp"

#include <algorithm>
#include <cassert>

#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "kernel/cubic_spline.hpp"
#include "sph/wall_kernels.hpp"

namespace gannet {

namespace {

constexpr Index cluster_chunk = 32;

bool holds(const ClusterList& list, std::span<const std::uint8_t> is_wall, std::uint8_t wanted,
           Index cluster) {
  const Index begin = ClusterList::lanes * cluster;
  const Index end = std::min(list.n_targets, begin + ClusterList::lanes);
  return std::find(is_wall.begin() + begin, is_wall.begin() + end, wanted) != is_wall.begin() + end;
}

/// Calls f(source) for the sources of one sort in the list of a cluster, in order.
template <class F>
void for_sources(const ClusterList& list, std::span<const std::uint8_t> is_wall,
                 std::uint8_t wanted, Index cluster, F&& f) {
  for (std::int64_t k = list.offset[cluster]; k < list.offset[cluster + 1]; ++k) {
    const Index j = list.source[k];
    if (j < list.n_sources && is_wall[j] == wanted) f(j);
  }
}

}  // namespace

WallValues wall_values(const WallSums& sums, const Vec3& g_minus_a) {
  assert(sums.W > 0);
  const Vec3 rho_r(sums.rho_x, sums.rho_y, sums.rho_z);
  return {(sums.p + g_minus_a.dot(rho_r)) / sums.W, Vec3(sums.v_x, sums.v_y, sums.v_z) / sums.W};
}

void keep_across(const ClusterList& list, std::span<const std::uint8_t> is_wall, Across across,
                 ClusterList& kept, Array<Index>& clusters) {
  assert(is_wall.size() == static_cast<std::size_t>(list.n_sources));
  const std::uint8_t target = across == Across::fluid_near_walls ? 1 : 0;
  const std::uint8_t source = 1 - target;
  kept.n_targets = list.n_targets;
  kept.n_sources = list.n_sources;
  kept.n_clusters = list.n_clusters;
  kept.n_active = list.n_active;
  kept.radius = list.radius;
  kept.offset.assign(static_cast<std::size_t>(list.n_clusters) + 1, 0);
  parallel_for(list.n_active, cluster_chunk, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      if (!holds(list, is_wall, target, c)) continue;
      std::int64_t n = 0;
      for_sources(list, is_wall, source, c, [&](Index) { ++n; });
      kept.offset[c + 1] = n + n % 2;  // lists are of even length
    }
  });
  clusters.clear();
  for (Index c = 0; c < list.n_clusters; ++c) {
    if (kept.offset[c + 1] > 0) clusters.push_back(c);
    kept.offset[c + 1] += kept.offset[c];
  }
  kept.source.resize(static_cast<std::size_t>(kept.offset.back()) + ClusterList::spare);
  parallel_for(static_cast<Index>(clusters.size()), cluster_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index c = clusters[k];
      std::int64_t at = kept.offset[c];
      for_sources(list, is_wall, source, c, [&](Index j) { kept.source[at++] = j; });
      if (at < kept.offset[c + 1]) kept.source[at] = list.n_sources;
    }
  });
  // What is read ahead of the last list must be a source that there is.
  std::fill(kept.source.begin() + kept.offset.back(), kept.source.end(), list.n_sources);
}

void wall_sums(const ClusterList& near, std::span<const Index> clusters, const ParticleView& view,
               int dimension, double reach, Array<WallSums>& sums) {
  assert(view.p != nullptr && reach > 0 && reach <= near.radius);
  sums.resize(clusters.size() * ClusterList::lanes);
  WallJob job;
  job.x = &view.x->x;
  job.v = &view.v->x;
  job.rho = view.rho;
  job.p = view.p;
  job.offset = near.offset.data();
  job.source = near.source.data();
  job.cluster = clusters.data();
  job.n_targets = near.n_targets;
  job.n_sources = near.n_sources;
  job.h = reach / cubic_spline::support;
  job.sigma = cubic_spline::normalisation(dimension, job.h);
  job.sums = &sums.data()->W;
  parallel_for(static_cast<Index>(clusters.size()), cluster_chunk, [&](Index begin, Index end) {
    WallJob part = job;
    part.first = begin;
    part.last = end;
    GANNET_DISPATCH(wall_sums, part);
  });
}

}  // namespace gannet
