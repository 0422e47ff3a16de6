#include "mesh/space_curve.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace gannet {
namespace {

constexpr int n_bits = 21;  // of each axis: three of them fill 63 bits of a key
using Cell = std::array<std::uint32_t, 3>;

// Position along the curve of the cell given by n_axes integers of n_bits bits each.
std::uint64_t curve_key(Cell cell, int n_axes) {
  const std::uint32_t highest = 1U << (n_bits - 1);
  const auto n = static_cast<std::size_t>(n_axes);
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::size_t i = 0; i < n; ++i) {
      if (cell[i] & bit) {
        cell[0] ^= below;
      } else {
        const std::uint32_t exchanged = (cell[0] ^ cell[i]) & below;
        cell[0] ^= exchanged;
        cell[i] ^= exchanged;
      }
    }
  }
  for (std::size_t i = 1; i < n; ++i) cell[i] ^= cell[i - 1];
  std::uint32_t parity = 0;
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1) {
    if (cell[n - 1] & bit) parity ^= bit - 1;
  }
  std::uint64_t key = 0;
  for (int b = n_bits - 1; b >= 0; --b) {
    for (std::size_t i = 0; i < n; ++i) key = key << 1 | ((cell[i] ^ parity) >> b & 1U);
  }
  return key;
}

}  // namespace

std::vector<Index> curve_order(std::span<const Vec3> points) {
  if (points.empty()) return {};
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double side = (high - low).maxCoeff();
  std::array<Eigen::Index, 3> axes{};
  int n_axes = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    // An axis along which nothing happens would only tear the curve of the others apart.
    if (high[k] - low[k] > 1e-9 * side) axes[static_cast<std::size_t>(n_axes++)] = k;
  }
  const double scale = side > 0 ? ((1U << n_bits) - 1) / side : 0;
  std::vector<std::pair<std::uint64_t, Index>> keys(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    Cell cell{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(n_axes); ++i) {
      cell[i] = static_cast<std::uint32_t>((points[p][axes[i]] - low[axes[i]]) * scale);
    }
    keys[p] = {n_axes > 0 ? curve_key(cell, n_axes) : 0, static_cast<Index>(p)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& k) { return k.second; });
  return order;
}

}  // namespace gannet
