#include "search/cluster_list.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "base/isa.hpp"
#include "base/math.hpp"
#include "base/parallel.hpp"
#include "search/cluster_kernel.hpp"
#include "search/spatial_sort.hpp"

namespace gannet {

namespace {

constexpr Index chunk_clusters = 128;  ///< clusters that one task lists
constexpr Index wave_chunks = 64;      ///< tasks whose lists are in scratch at a time

/// The sources in column order, in single precision relative to their mean.
struct SourceTable {
  Columns columns;
  Array<float> x, y, z;
  Vec3 origin = Vec3::Zero();
  Array<Line> seen;  ///< their positions, where some are left out
};

/// The lists of one chunk, before they are joined.
struct Scratch {
  std::unique_ptr<Index[]> data;
  std::int64_t capacity = 0;
  std::int64_t used = 0;
};

}  // namespace

struct ListWorkspace {
  SourceTable table;
  std::vector<Scratch> scratch;
};

namespace {

Vec3 mean_of(std::span<const Line> x) {
  if (x.empty()) return Vec3::Zero();
  const Vec3 sum = parallel_reduce(
      static_cast<Index>(x.size()), node_chunk, Vec3(Vec3::Zero()),
      [&](Index begin, Index end) {
        Vec3 part = Vec3::Zero();
        for (Index i = begin; i < end; ++i) part += xyz(x[i]);
        return part;
      },
      [](const Vec3& a, const Vec3& b) { return Vec3(a + b); });
  return sum / static_cast<double>(x.size());
}

/// The positions without those of the unseen, one behind the other in `kept` where there are any.
std::span<const Line> without(std::span<const Line> x, Range unseen, Array<Line>& kept) {
  if (unseen.empty()) return x;
  kept.resize(x.size() - static_cast<std::size_t>(unseen.size()));
  std::copy_n(x.begin(), unseen.begin, kept.begin());
  std::copy(x.begin() + unseen.end, x.end(), kept.begin() + unseen.begin);
  return kept;
}

void fill_table(std::span<const Line> all, Range unseen, double radius, SourceTable& table) {
  const std::span<const Line> x = without(all, unseen, table.seen);
  // Two particle spacings at the usual radius of 2 h + skin = 2.86 spacings.
  sort_into_columns(x, 0.7 * radius, false, table.columns);
  table.origin = mean_of(x);
  const std::size_t room = x.size() + 16;  // the kernel loads 16 at a time
  table.columns.order.resize(room, 0);
  for (Array<float>* c : {&table.x, &table.y, &table.z}) c->resize(room, 0.0F);
  parallel_for(static_cast<Index>(x.size()), node_chunk, [&](Index begin, Index end) {
    for (Index q = begin; q < end; ++q) {
      const Line& line = x[table.columns.order[q]];
      table.x[q] = static_cast<float>(line.x - table.origin.x());
      table.y[q] = static_cast<float>(line.y - table.origin.y());
      table.z[q] = static_cast<float>(line.z - table.origin.z());
      // From here on sources go by their numbers among all.
      if (table.columns.order[q] >= unseen.begin) table.columns.order[q] += unseen.size();
    }
  });
}

ListJob job_of(std::span<const Line> x, const SourceTable& table, const ClusterList& list) {
  ListJob job;
  job.target = &x.data()->x;
  job.n_targets = list.n_targets;
  for (int d = 0; d < 3; ++d) job.origin[d] = table.origin[d];
  job.x = table.x.data();
  job.y = table.y.data();
  job.z = table.z.data();
  job.index = table.columns.order.data();
  job.start = table.columns.start.data();
  job.n_y = table.columns.n_y;
  job.n_z = table.columns.n_z;
  job.y_min = table.columns.y_min - table.origin.y();
  job.z_min = table.columns.z_min - table.origin.z();
  job.width = table.columns.width;
  job.radius = list.radius;
  job.filler = list.n_sources;
  return job;
}

/// Lists the clusters of the job; lengths go to offset[first + 1 ...].
void list_chunk(ListJob job, Isa with, ClusterList& list, Scratch& scratch) {
  scratch.used = 0;
  while (job.first < job.last) {
    job.out = scratch.data.get() + scratch.used;
    job.capacity = scratch.capacity - scratch.used;
    job.count = list.offset.data() + job.first + 1;
    const ListProgress progress =
        with == Isa::avx512 ? avx512::list_clusters(job) : avx2::list_clusters(job);
    scratch.used += progress.used;
    job.first = progress.next;
    if (job.first == job.last) break;
    const std::int64_t capacity = 2 * scratch.capacity + 256 * chunk_clusters;
    auto larger = std::make_unique_for_overwrite<Index[]>(static_cast<std::size_t>(capacity));
    std::copy_n(scratch.data.get(), scratch.used, larger.get());
    scratch.data = std::move(larger);
    scratch.capacity = capacity;
  }
}

/// Makes room for n entries; when memory must be asked for, for as many as all clusters will need
/// if they go on like the first `done`.
void make_room(ClusterList& list, std::int64_t n, Index done) {
  const auto need = static_cast<std::size_t>(n);
  if (need <= list.source.size()) return;
  if (need > list.source.capacity()) {
    const double share = static_cast<double>(list.n_clusters) / done;
    list.source.reserve(static_cast<std::size_t>(1.1 * share * static_cast<double>(n)));
  }
  list.source.resize(need);
}

}  // namespace

void build_cluster_list(std::span<const Line> x, Index n_targets, double radius, ClusterList& list,
                        Isa with, Range unseen, std::span<const double> further) {
  assert(radius > 0 && n_targets <= static_cast<Index>(x.size()));
  assert(unseen.empty() || n_targets <= unseen.begin);
  assert(further.empty() || n_targets == static_cast<Index>(further.size()));
  list.n_targets = n_targets;
  list.n_sources = static_cast<Index>(x.size());
  list.n_clusters = (n_targets + ClusterList::lanes - 1) / ClusterList::lanes;
  list.n_active = list.n_clusters;
  list.radius = radius;
  list.offset.assign(static_cast<std::size_t>(list.n_clusters) + 1, 0);
  if (list.n_clusters == 0) return;

  if (!list.workspace) list.workspace = std::make_shared<ListWorkspace>();
  ListWorkspace& work = *list.workspace;
  fill_table(x, unseen, radius, work.table);
  ListJob job = job_of(x, work.table, list);
  job.further = further.empty() ? nullptr : further.data();
  const Index n_chunks = (list.n_clusters + chunk_clusters - 1) / chunk_clusters;
  const auto n_scratch = static_cast<std::size_t>(std::min(n_chunks, wave_chunks));
  if (work.scratch.size() < n_scratch) work.scratch.resize(n_scratch);
  auto end_of = [&](Index chunk) { return std::min(list.n_clusters, chunk * chunk_clusters); };

  // Chunks are listed into scratch and joined wave by wave: the lists are the largest thing that a
  // run holds, and so there is never a second copy of all of them.
  for (Index wave = 0; wave < n_chunks; wave += wave_chunks) {
    const Index n_here = std::min(wave_chunks, n_chunks - wave);
    parallel_for(n_here, 1, [&](Index k, Index) {
      ListJob part = job;
      part.first = end_of(wave + k);
      part.last = end_of(wave + k + 1);
      list_chunk(part, with, list, work.scratch[k]);
    });
    for (Index c = end_of(wave); c < end_of(wave + n_here); ++c) {
      list.offset[c + 1] += list.offset[c];
    }
    const Index done = end_of(wave + n_here);
    make_room(list, list.offset[done] + ClusterList::spare, done);
    parallel_for(n_here, 1, [&](Index k, Index) {
      std::copy_n(work.scratch[k].data.get(), work.scratch[k].used,
                  list.source.data() + list.offset[end_of(wave + k)]);
    });
  }
}

double max_relative_displacement(std::span<const Line> x_build, std::span<const Line> x) {
  assert(x_build.size() == x.size());
  if (x.empty()) return 0;
  const auto n = static_cast<Index>(x.size());
  const Vec3 sum = parallel_reduce(
      n, node_chunk, Vec3(Vec3::Zero()),
      [&](Index begin, Index end) {
        Vec3 part = Vec3::Zero();
        for (Index i = begin; i < end; ++i) part += xyz(x[i]) - xyz(x_build[i]);
        return part;
      },
      [](const Vec3& a, const Vec3& b) { return Vec3(a + b); });
  const Vec3 mean = sum / static_cast<double>(n);
  const double largest = parallel_reduce(
      n, node_chunk, 0.0,
      [&](Index begin, Index end) {
        double part = 0;
        for (Index i = begin; i < end; ++i) {
          part = std::max(part, (xyz(x[i]) - xyz(x_build[i]) - mean).squaredNorm());
        }
        return part;
      },
      [](double a, double b) { return std::max(a, b); });
  return std::sqrt(largest);
}

double max_relative_speed(std::span<const Line> v) {
  const Vec3 mean = mean_of(v);
  const double largest = parallel_reduce(
      static_cast<Index>(v.size()), node_chunk, 0.0,
      [&](Index begin, Index end) {
        double part = 0;
        for (Index i = begin; i < end; ++i) part = std::max(part, (xyz(v[i]) - mean).squaredNorm());
        return part;
      },
      [](double a, double b) { return std::max(a, b); });
  return std::sqrt(largest);
}

}  // namespace gannet
