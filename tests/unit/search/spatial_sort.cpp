#include "search/spatial_sort.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <numeric>

#include "base/parallel.hpp"
#include "points.hpp"

using namespace gannet;

TEST_CASE("spatial sort: hand-sorted serpentine of four columns", "[search]") {
  // dx = 1, columns 2 wide: two in y (0-2, 2-4) and two in z; two points in each, x = 0 and x = 5.
  const Array<Line> x{{5, 0.5, 3, 0}, {0, 0.5, 3, 0},   // y low, z high: the last column, falling
                      {0, 3.5, 3, 0}, {5, 3.5, 3, 0},   // y high, z high: the third, rising
                      {5, 3.5, 0, 0}, {0, 3.5, 0, 0},   // y high, z low: the second, falling
                      {0, 0.5, 0, 0}, {5, 0.5, 0, 0}};  // y low, z low: the first, rising
  Array<Index> order;
  spatial_order(x, 1.0, order);
  CHECK(order == Array<Index>{6, 7, 4, 5, 2, 3, 0, 1});
}

TEST_CASE("spatial sort: a permutation that sorting again does not change", "[search]") {
  const bool flat = GENERATE(false, true);
  Array<Line> x = random_points(5000, {-4, 7, 1, 0}, {30, 10, flat ? 0.0 : 9.0, 0}, 21);
  for (std::size_t i = 0; i < x.size(); i += 3) x[i] = x[0];  // ties
  Array<Index> order;
  spatial_order(x, 0.8, order);
  Array<Index> all = order;
  std::sort(all.begin(), all.end());
  Array<Index> numbers(x.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  CHECK(all == numbers);

  Array<Line> sorted(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) sorted[k] = x[order[k]];
  spatial_order(sorted, 0.8, order);
  CHECK(order == numbers);
}

TEST_CASE("spatial sort: the same order for 1 and 2 threads", "[search]") {
  const Array<Line> x = random_points(50000, {0, 0, 0, 0}, {50, 50, 20, 0}, 5);
  Array<Index> one;
  Array<Index> two;
  set_threads(1);
  spatial_order(x, 1.0, one);
  set_threads(2);
  spatial_order(x, 1.0, two);
  CHECK(one == two);
  set_threads(0);
}

TEST_CASE("spatial sort: eight consecutive particles of a lattice are compact", "[search]") {
  Array<Line> x;
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) x.push_back({i + 0.01 * j, j + 0.01 * k, k + 0.01 * i, 0});
    }
  }
  Array<Index> order;
  spatial_order(x, 1.0, order);
  double mean_extent = 0;
  for (std::size_t c = 0; c < x.size() / 8; ++c) {
    double low = 1e9;
    double high = -1e9;
    for (std::size_t k = 8 * c; k < 8 * c + 8; ++k) {
      low = std::min(low, x[order[k]].x);
      high = std::max(high, x[order[k]].x);
    }
    mean_extent += (high - low) / (x.size() / 8.0);
  }
  // Two layers of four: 1 and what the lattice is sheared; 3 at the few ends of columns.
  CHECK(mean_extent < 1.6);
}

TEST_CASE("spatial sort: a far outlier does not ask for a huge grid", "[search]") {
  Array<Line> x = random_points(1000, {0, 0, 0, 0}, {10, 10, 10, 0}, 6);
  x.push_back({0, 1e12, -1e15, 0});
  Columns columns;
  sort_into_columns(x, 1.0, false, columns);
  CHECK(columns.start.size() <= 4097);
  CHECK(columns.start.back() == 1001);
}

namespace {

/// A scene of 3 nodes that are no particles, 5 particles and room for 2 ghosts.
struct SmallScene {
  Scene scene;
  Array<double> blocks = Array<double>(2 * 3 * 4, 0.0);  ///< 3 components in blocks of 4 lanes
  Array<std::uint8_t> awake = Array<std::uint8_t>(5, 0);
  Array<Index> list{4, 0, -1, 2, 99};

  SmallScene() {
    Nodes& n = scene.nodes;
    n.n_owned = 8;
    scene.particles = {3, 8};
    n.x.resize(10);
    n.v.resize(10);
    n.id.resize(10);
    for (Index i = 0; i < 10; ++i) {
      n.id[i] = 100 + i;
      n.x[i] = {1.0 * i, 10.0 * i, 0.0, 0.5 * i};
      n.v[i] = {-1.0 * i, 0.25 * i, 0.0, 2.0 * i};
    }
    scene.fields.push_back(
        line_field("x", "m", "", Over::nodes, n.x, 0, 3, GhostRule::copy_shifted));
    scene.fields.push_back(line_field("m", "kg", "", Over::nodes, n.x, 3, 1, GhostRule::copy));
    scene.fields.push_back(line_field("v", "m/s", "", Over::nodes, n.v, 0, 4, GhostRule::copy));
    scene.fields.push_back(plain_field("id", "", "", Over::nodes, n.id, 1, GhostRule::copy));
    scene.fields.push_back(
        plain_field("awake", "", "", Over::particles, awake, 1, GhostRule::none));
    Field blocked = plain_field("S", "", "", Over::particles, blocks, 3, GhostRule::none);
    blocked.layout = {3 * 4 * 8, 8, 4 * 8, 4};
    blocked.count = [] { return Index{5}; };
    scene.fields.push_back(blocked);
    for (Index i = 0; i < 5; ++i) {
      awake[i] = static_cast<std::uint8_t>(10 + i);
      for (int c = 0; c < 3; ++c) set_S(i, c, 10.0 * i + c);
    }
    scene.index_lists.push_back({"list", &list});
  }
  void set_S(Index i, int c, double value) { std::memcpy(scene.fields.back().at(i, c), &value, 8); }
  [[nodiscard]] double S(Index i, int c) const {
    double value = 0;
    std::memcpy(&value, scene.fields.back().at(i, c), 8);
    return value;
  }
};

}  // namespace

TEST_CASE("permute: every particle keeps its id with all its data", "[search]") {
  SmallScene s;
  const Array<Index> order{3, 0, 4, 1, 2};
  permute_particles(s.scene, order);
  const Nodes& n = s.scene.nodes;
  for (Index k = 0; k < 5; ++k) {
    const Index old = order[k];
    CHECK(n.id[3 + k] == 103 + old);
    CHECK(n.x[3 + k].x == 3.0 + old);
    CHECK(n.x[3 + k].y == 30.0 + 10 * old);
    CHECK(n.x[3 + k].w == 1.5 + 0.5 * old);
    CHECK(n.v[3 + k].x == -3.0 - old);
    CHECK(n.v[3 + k].w == 6.0 + 2 * old);
    CHECK(s.awake[k] == 10 + old);
    for (int c = 0; c < 3; ++c) CHECK(s.S(k, c) == 10.0 * old + c);
  }
  // Particle 4 went to place 2, particle 0 to place 1, particle 2 to place 4.
  CHECK(s.list == Array<Index>{2, 1, -1, 4, 99});
}

TEST_CASE("permute: nodes that are no particles, and ghosts, stay where they are", "[search]") {
  SmallScene s;
  permute_particles(s.scene, Array<Index>{4, 3, 2, 1, 0});
  for (const Index i : {0, 1, 2, 8, 9}) {
    CHECK(s.scene.nodes.id[i] == 100 + i);
    CHECK(s.scene.nodes.x[i].y == 10.0 * i);
  }
}

TEST_CASE("permute: sorting the particles of a scene puts them in spatial order", "[search]") {
  SmallScene s;
  const double y[5] = {0, 9, 0.5, 9, 0.1};
  const double x[5] = {2, 1, 1, 3, 0};
  for (int i = 0; i < 5; ++i) {
    s.scene.nodes.x[3 + i].x = x[i];
    s.scene.nodes.x[3 + i].y = y[i];
  }
  // Columns 2 wide from y = 0: 4 (x 0), 2 (x 1), 0 (x 2) rise in column 0; column 4 rises: 1, 3.
  sort_particles(s.scene, 1.0);
  const Array<std::int64_t> ids(s.scene.nodes.id.begin() + 3, s.scene.nodes.id.begin() + 8);
  CHECK(ids == Array<std::int64_t>{107, 105, 103, 104, 106});
}
