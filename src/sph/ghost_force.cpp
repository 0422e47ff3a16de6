#include "sph/ghost_force.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "sph/sph_operations.hpp"

namespace gannet {

namespace {

constexpr Index cluster_chunk = 512;

/// The clusters that have ghosts in their lists, and these ghosts: kept until lists are made anew.
struct GhostPairs {
  std::int64_t build = -1;           ///< sph.n_builds when it was made
  std::vector<Index> cluster;        ///< rising
  std::vector<std::int64_t> offset;  ///< where the ghosts of entry k begin; one more than clusters
  std::vector<Index> source;
  // The pass over a choice of them.
  ClusterList list;
  Array<Line> f, f_viscous, f_laminar, f_tensile;
};

/// n_owned: owned particles; ghosts are the sources from there on.
void find_pairs(const ClusterList& list, Index n_owned, GhostPairs& pairs) {
  pairs.cluster.clear();
  pairs.source.clear();
  pairs.offset.assign(1, 0);
  const Index filler = list.n_sources;
  for (Index c = 0; c < list.n_active; ++c) {
    for (std::int64_t e = list.offset[c]; e < list.offset[c + 1]; ++e) {
      const Index source = list.source[e];
      if (source >= n_owned && source != filler) pairs.source.push_back(source);
    }
    const auto n = static_cast<std::int64_t>(pairs.source.size());
    if (n == pairs.offset.back()) continue;
    pairs.cluster.push_back(c);
    pairs.offset.push_back(n);
  }
}

/// Lists with the ghosts of the chosen kinds only.
void choose(const SphState& sph, Index n_owned, std::span<const char> chosen, GhostPairs& pairs) {
  ClusterList& list = pairs.list;
  const ClusterList& all = sph.list;
  list.n_targets = all.n_targets;
  list.n_sources = all.n_sources;
  list.n_clusters = all.n_clusters;
  list.n_active = all.n_active;
  list.radius = all.radius;
  list.offset.assign(static_cast<std::size_t>(all.n_clusters) + 1, 0);
  list.source.clear();
  Index next = 0;
  for (std::size_t k = 0; k < pairs.cluster.size(); ++k) {
    for (; next <= pairs.cluster[k]; ++next) {
      list.offset[next] = static_cast<std::int64_t>(list.source.size());
    }
    for (std::int64_t e = pairs.offset[k]; e < pairs.offset[k + 1]; ++e) {
      const Index source = pairs.source[e];
      if (chosen[sph.halo.kind[source - n_owned]] != 0) list.source.push_back(source);
    }
    if (list.source.size() % 2 != 0) list.source.push_back(all.n_sources);
  }
  const auto n = static_cast<std::int64_t>(list.source.size());
  for (; next <= list.n_clusters; ++next) list.offset[next] = n;
  list.source.resize(list.source.size() + ClusterList::spare, all.n_sources);
}

/// Sum of lines of the clusters that have ghosts.
Vec3 sum_of(const Array<Line>& lines, const GhostPairs& pairs) {
  return parallel_sum(static_cast<Index>(pairs.cluster.size()), cluster_chunk, Vec3(Vec3::Zero()),
                      [&](Index begin, Index end) {
                        Vec3 sum = Vec3::Zero();
                        for (Index k = begin; k < end; ++k) {
                          const Index first = ClusterList::lanes * pairs.cluster[k];
                          const Index last =
                              std::min(first + ClusterList::lanes, pairs.list.n_targets);
                          for (Index i = first; i < last; ++i) sum += xyz(lines[i]);
                        }
                        return sum;
                      });
}

}  // namespace

GhostForce force_of_ghosts(SphState& sph, Scene& scene, std::span<const char> chosen) {
  GhostPairs& pairs = scene.store.get<GhostPairs>();
  if (pairs.build != sph.n_builds) {
    find_pairs(sph.list, scene.particles.size(), pairs);
    pairs.build = sph.n_builds;
  }
  if (pairs.cluster.empty()) return {};
  choose(sph, scene.particles.size(), chosen, pairs);
  const auto n = static_cast<std::size_t>(sph.list.n_targets);
  const auto wanted = [n](const Array<Line>& term, Array<Line>& result) -> Line* {
    result.resize(term.empty() ? 0 : n);
    return result.empty() ? nullptr : result.data();
  };
  pairs.f.resize(n);
  for (const Index c : pairs.cluster) {
    const Index first = ClusterList::lanes * c;
    std::fill_n(pairs.f.begin() + first, std::min(ClusterList::lanes, sph.list.n_targets - first),
                Line{});
  }
  const ForceOut out{.f = pairs.f.data(),
                     .f_viscous = wanted(sph.f_viscous, pairs.f_viscous),
                     .f_laminar = wanted(sph.f_laminar, pairs.f_laminar),
                     .f_tensile = wanted(sph.f_tensile, pairs.f_tensile)};
  if (!sph.packed_pressures) pack_for_force(sph, scene);
  pair_force(pairs.list, sph.packed, parameters_of(sph), out, {.clusters = pairs.cluster});
  GhostForce force;
  force.total = sum_of(pairs.f, pairs);
  if (out.f_viscous != nullptr) force.viscous += sum_of(pairs.f_viscous, pairs);
  if (out.f_laminar != nullptr) force.viscous += sum_of(pairs.f_laminar, pairs);
  return force;
}

}  // namespace gannet
