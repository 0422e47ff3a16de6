// Neighbour lists of clusters: one list of sources for every eight consecutive targets.
//
// A cluster of eight particles that are near each other shares one list, so that a pair pass holds
// eight targets in the lanes of a vector and broadcasts one source after the other: no gathers, no
// masks, no scatter, and a third of the memory of a list per particle. The list holds more than it
// needs; the kernel's own cut-off drops the rest.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/array.hpp"
#include "base/isa.hpp"

namespace gannet {

struct ListWorkspace;

/// For every cluster of eight consecutive targets the sources within `radius` of its bounding box,
/// or further where a target asks for more, the targets themselves included. Sources are numbered
/// as particle fields are: targets (owned particles) [0, n_targets), then ghosts up to n_sources.
/// The index n_sources stands for a particle far away and pads each list to an even length.
struct ClusterList {
  static constexpr Index lanes = 8;
  static constexpr Index spare = 32;  ///< readable entries behind the last list
  Index n_targets = 0;
  Index n_sources = 0;
  Index n_clusters = 0;        ///< ceil(n_targets / 8)
  Index n_active = 0;          ///< the first ones: those that passes do unless told otherwise
  double radius = 0;           ///< [m]
  Array<std::int64_t> offset;  ///< n_clusters + 1: where the list of a cluster begins in source
  Array<Index> source;         ///< the lists; entries behind offset.back() mean nothing
  /// What a build works with, kept for the next one: asking for memory anew costs a third of it.
  std::shared_ptr<ListWorkspace> workspace;
};

/// Builds the list from the positions of all sources; every pair (target, source) at a distance of
/// at most `radius` + further[target] is in it. The list is a function of the arguments alone: not
/// of the number of threads, nor of the instruction set. A restart that hands in the positions of
/// the last build gets the same list. All clusters are active. x: positions [m] of n_sources
/// particles, owned first, finite; n_targets <= x.size(); radius: [m], positive. Targets in no
/// spatial order give a right but long list. with: the kernel's instruction set, for tests. unseen:
/// sources, none of them a target, that are left out whatever their place. further: n_targets
/// lengths, not negative [m]; empty: 0 for all.
void build_cluster_list(std::span<const Line> x, Index n_targets, double radius, ClusterList& list,
                        Isa with = isa(), Range unseen = {}, std::span<const double> further = {});

/// The largest displacement since a build, relative to the mean displacement of all particles [m]:
/// max_i |d_i - d_mean|, d_i = x_i - x_build_i. A list of radius 2 h + skin holds all pairs nearer
/// than 2 h as long as this is at most skin/2, for |d_i - d_j| is at most twice this; motion of
/// the whole body of water does not count.
/// x_build, x: n lines [m], the same particles in the same order (owned ones, not wrapped between).
double max_relative_displacement(std::span<const Line> x_build, std::span<const Line> x);

/// The largest speed relative to the mean velocity [m/s]: max_i |v_i - v_mean|.
/// v: n lines [m/s].
double max_relative_speed(std::span<const Line> v);

/// True where a list could miss a pair before the particles have moved on by `ahead`:
/// displacement + ahead > skin/2.
/// displacement: max_relative_displacement() [m]; skin: [m]; ahead: what is still to come until the
/// next check [m], usually max_relative_speed() times the part of a step that the list must last.
inline bool stale(double displacement, double skin, double ahead) {
  return displacement + ahead > 0.5 * skin;
}

}  // namespace gannet
