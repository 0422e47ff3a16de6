#include "search/cluster_list.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "base/math.hpp"
#include "base/parallel.hpp"
#include "points.hpp"
#include "search/spatial_sort.hpp"

using namespace gannet;

namespace {

double distance(const Line& a, const Line& b) { return (xyz(a) - xyz(b)).norm(); }

/// Distance of a point from the box around the targets of a cluster.
double distance_to_box(const Array<Line>& x, const ClusterList& list, Index cluster,
                       const Line& p) {
  Vec3 low = Vec3::Constant(1e300);
  Vec3 high = -low;
  const Index end = std::min(list.n_targets, 8 * cluster + 8);
  for (Index i = 8 * cluster; i < end; ++i) {
    low = low.cwiseMin(xyz(x[i]));
    high = high.cwiseMax(xyz(x[i]));
  }
  const Vec3 gap = (low - xyz(p)).cwiseMax(xyz(p) - high).cwiseMax(0.0);
  return gap.norm();
}

/// All pairs within the radius are listed, nothing twice, nothing that is not near the box.
void check_against_brute_force(const Array<Line>& x, const ClusterList& list) {
  int n_missing = 0;
  int n_far = 0;
  int n_bad = 0;
  for (Index c = 0; c < list.n_clusters; ++c) {
    const auto* begin = list.source.data() + list.offset[c];
    const auto* end = list.source.data() + list.offset[c + 1];
    n_bad += (end - begin) % 2 != 0;
    const bool padded = begin != end && end[-1] == list.n_sources;
    const std::set<Index> entries(begin, end - (padded ? 1 : 0));
    n_bad += static_cast<Index>(entries.size()) != end - begin - (padded ? 1 : 0);
    for (const Index j : entries) {
      n_bad += j < 0 || j >= list.n_sources;
      // Twice the rounding of the coordinates to single precision is allowed on top.
      n_far += distance_to_box(x, list, c, x[j]) > list.radius * (1 + 1e-4);
    }
    for (Index i = 8 * c; i < std::min(list.n_targets, 8 * c + 8); ++i) {
      for (Index j = 0; j < list.n_sources; ++j) {
        n_missing += distance(x[i], x[j]) <= list.radius && !entries.contains(j);
      }
    }
  }
  CHECK(n_missing == 0);
  CHECK(n_far == 0);
  CHECK(n_bad == 0);
}

}  // namespace

TEST_CASE("cluster list: holds all pairs within the radius, with ghosts", "[search]") {
  const bool flat = GENERATE(false, true);
  const int n_targets = GENERATE(1, 5, 8, 803);
  const int n_ghosts = GENERATE(0, 150);
  const Line size{12, 8, flat ? 0.0 : 5.0, 0};
  Array<Line> x = random_points(n_targets, {-3, 40, 2, 0}, size, 7);
  const Array<Line> ghosts = random_points(n_ghosts, {-5, 38, 2, 0}, {16, 12, size.z, 0}, 8);
  x.insert(x.end(), ghosts.begin(), ghosts.end());
  Array<Index> order;
  spatial_order(std::span<const Line>(x).first(n_targets), 1.0, order);
  Array<Line> sorted = x;
  for (int k = 0; k < n_targets; ++k) sorted[k] = x[order[k]];

  ClusterList list;
  build_cluster_list(sorted, n_targets, 2.1, list, Isa::avx2);
  CHECK(list.n_clusters == (n_targets + 7) / 8);
  CHECK(list.n_sources == n_targets + n_ghosts);
  check_against_brute_force(sorted, list);
}

TEST_CASE("cluster list: right for targets in any order", "[search]") {
  const Array<Line> x = random_points(500, {0, 0, 0, 0}, {9, 9, 9, 0}, 3);
  ClusterList list;
  build_cluster_list(x, 500, 1.5, list, Isa::avx2);
  check_against_brute_force(x, list);
}

TEST_CASE("cluster list: right with particles that flew far out", "[search]") {
  Array<Line> x = random_points(300, {0, 0, 0, 0}, {6, 6, 6, 0}, 3);
  // A pair of runaways in each direction, 0.5 apart: near each other, far from all others.
  for (const double far : {3e4, -5e5}) {
    x.push_back({far, 1, 2, 0});
    x.push_back({far + 0.5, 1, 2, 0});
    x.push_back({1, far, 2, 0});
    x.push_back({1, far, 2.5, 0});
    x.push_back({1, -far, far, 0});
    x.push_back({1, -far + 0.5, far, 0});
  }
  Array<Index> order;
  spatial_order(x, 1.0, order);
  Array<Line> sorted(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) sorted[k] = x[order[k]];
  ClusterList list;
  build_cluster_list(sorted, static_cast<Index>(x.size()), 1.6, list, Isa::avx2);
  int n_missing = 0;
  for (Index i = 0; i < list.n_targets; ++i) {
    const auto* begin = list.source.data() + list.offset[i / 8];
    const auto* end = list.source.data() + list.offset[i / 8 + 1];
    for (Index j = 0; j < list.n_sources; ++j) {
      n_missing += distance(sorted[i], sorted[j]) <= list.radius && std::find(begin, end, j) == end;
    }
  }
  CHECK(n_missing == 0);
}

TEST_CASE("cluster list: the same for every instruction set and number of threads", "[search]") {
  // More than one wave of 64 chunks of 128 clusters, and 5 left over.
  const int n = 8 * 128 * 64 + 8 * 200 + 5;
  const Array<Line> x = random_points(n, {0, 0, 0, 0}, {60, 40, 28, 0}, 11);
  Array<Index> order;
  spatial_order(x, 1.0, order);
  Array<Line> sorted(x.size());
  for (int k = 0; k < n; ++k) sorted[k] = x[order[k]];
  auto build = [&](int n_threads, Isa with) {
    set_threads(n_threads);
    ClusterList list;
    build_cluster_list(sorted, n - 1000, 2.9, list, with);
    list.source.resize(static_cast<std::size_t>(list.offset.back()));
    return list;
  };
  const ClusterList one = build(1, Isa::avx2);
  const ClusterList two = build(2, Isa::avx2);
  CHECK(one.offset == two.offset);
  CHECK(one.source == two.source);
  if (have_avx512()) {
    const ClusterList wide = build(1, Isa::avx512);
    CHECK(one.offset == wide.offset);
    CHECK(one.source == wide.source);
  }
  set_threads(0);
}

TEST_CASE("cluster list: building twice into the same list gives the same list", "[search]") {
  const Array<Line> many = random_points(4000, {0, 0, 0, 0}, {20, 20, 10, 0}, 4);
  const Array<Line> few = random_points(90, {0, 0, 0, 0}, {5, 5, 5, 0}, 5);
  ClusterList fresh;
  build_cluster_list(few, 90, 2.0, fresh);
  ClusterList used;
  build_cluster_list(many, 4000, 2.0, used);
  build_cluster_list(few, 90, 2.0, used);
  CHECK(fresh.offset == used.offset);
  CHECK(std::equal(fresh.source.begin(), fresh.source.begin() + fresh.offset.back(),
                   used.source.begin()));
}

TEST_CASE("cluster list: no targets, no list", "[search]") {
  ClusterList list;
  build_cluster_list({}, 0, 1.0, list);
  CHECK(list.n_clusters == 0);
  CHECK(list.offset.size() == 1);
}

TEST_CASE("staleness: motion of all particles together does not count", "[search]") {
  const Array<Line> x_build = random_points(10000, {0, 0, 0, 0}, {5, 5, 5, 0}, 2);
  Array<Line> x = x_build;
  for (Line& line : x) line.x += 1024.0;
  // The sum of coordinates of 1e3 loses 1e-13 each.
  CHECK(max_relative_displacement(x_build, x) < 1e-12);
  // One of 10,000 moves by 1 in y: the mean moves by 1e-4.
  x[77].y += 1.0;
  CHECK(max_relative_displacement(x_build, x) == Approx(1.0 - 1e-4).epsilon(1e-12));
  CHECK(max_relative_displacement({}, {}) == 0.0);
}

TEST_CASE("staleness: the largest relative speed, and room for what is to come", "[search]") {
  // Mean (1, 0, 0); the relative velocities are (2, 0, 0), (-2, 0, 0), (0, 1.5, 0), (0, -1.5, 0).
  const Array<Line> v{{3, 0, 0, 0}, {-1, 0, 0, 0}, {1, 1.5, 0, 0}, {1, -1.5, 0, 0}};
  CHECK(max_relative_speed(v) == Approx(2.0).epsilon(1e-15));
  CHECK_FALSE(stale(0.05, 0.25, 0.07));
  CHECK(stale(0.05, 0.25, 0.08));
}

TEST_CASE("cluster list: sources that are left out are in no list, all others stay", "[search]") {
  // Twelve on a line, 1 apart; eight targets, one that stays and two that nobody sees, a ghost.
  std::vector<Line> x;
  for (int k = 0; k < 12; ++k) x.push_back({1.0 * k, 0, 0, 0});
  ClusterList list;
  build_cluster_list(x, 8, 2.5, list, Isa::avx2, {9, 11});
  CHECK(list.n_clusters == 1);
  CHECK(list.n_active == 1);
  CHECK(list.n_sources == 12);
  // From -2.5 to 9.5: 0 to 9, of which 9 is left out.
  std::vector<Index> found(list.source.begin(), list.source.begin() + list.offset[1]);
  std::sort(found.begin(), found.end());
  CHECK(found == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7, 8, 12});
  // The ghost goes by its number among all.
  x[11] = {-1, 0, 0, 0};
  build_cluster_list(x, 8, 2.5, list, Isa::avx2, {9, 11});
  found.assign(list.source.begin(), list.source.begin() + list.offset[1]);
  std::sort(found.begin(), found.end());
  CHECK(found == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7, 8, 11});
}
