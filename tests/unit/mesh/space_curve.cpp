#include "mesh/space_curve.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

using namespace gannet;

namespace {

std::vector<Vec3> lattice(int nx, int ny, int nz) {
  std::vector<Vec3> points;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) points.emplace_back(0.3 * i, 0.3 * j - 7, 0.3 * k);
    }
  }
  return points;
}

double longest_step(const std::vector<Vec3>& points, const std::vector<Index>& order) {
  double longest = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vec3& a = points[static_cast<std::size_t>(order[k - 1])];
    longest = std::max(longest, (points[static_cast<std::size_t>(order[k])] - a).norm());
  }
  return longest;
}

bool is_permutation_of_all(std::vector<Index> order) {
  std::sort(order.begin(), order.end());
  std::vector<Index> all(order.size());
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

}  // namespace

TEST_CASE("curve: visits every point of a lattice of 2^k once, from neighbour to neighbour",
          "[mesh]") {
  // On such lattices a Hilbert curve never jumps: each step is one lattice spacing, 0.3.
  for (const auto& points : {lattice(16, 16, 16), lattice(32, 32, 1), lattice(1, 32, 32)}) {
    const auto order = curve_order(points);
    CHECK(order.size() == points.size());
    CHECK(is_permutation_of_all(order));
    CHECK(longest_step(points, order) == Approx(0.3).epsilon(1e-12));
  }
}

TEST_CASE("curve: points of a line follow the line", "[mesh]") {
  const auto points = lattice(1, 37, 1);
  const auto order = curve_order(points);
  CHECK(is_permutation_of_all(order));
  CHECK(longest_step(points, order) == Approx(0.3).epsilon(1e-12));
}

TEST_CASE("curve: blocks of consecutive points are compact", "[mesh]") {
  // 64 consecutive points of any lattice would fill a cube of 4 x 4 x 4 at best; a block in rows
  // of 40 would be 40 spacings long.
  const auto points = lattice(40, 28, 20);
  const auto order = curve_order(points);
  double mean_size = 0;
  const std::size_t n_blocks = points.size() / 64;
  for (std::size_t b = 0; b < n_blocks; ++b) {
    Vec3 low = points[static_cast<std::size_t>(order[64 * b])];
    Vec3 high = low;
    for (std::size_t k = 64 * b; k < 64 * b + 64; ++k) {
      low = low.cwiseMin(points[static_cast<std::size_t>(order[k])]);
      high = high.cwiseMax(points[static_cast<std::size_t>(order[k])]);
    }
    mean_size += (high - low).maxCoeff() / 0.3 / double(n_blocks);
  }
  CHECK(mean_size < 10);
}

TEST_CASE("curve: equal points keep the order of their indices", "[mesh]") {
  const std::vector<Vec3> same(5, Vec3(1, 2, 3));
  CHECK(curve_order(same) == std::vector<Index>{0, 1, 2, 3, 4});
  const std::vector<Vec3> pairs = {{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  CHECK(curve_order(pairs) == std::vector<Index>{1, 3, 0, 2});
  CHECK(curve_order({}).empty());
}
