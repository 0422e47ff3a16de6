#include "mesh/fill.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/array.hpp"

namespace gannet {
namespace {

constexpr double most_points = 2e9;  // what an Index can count

// Cells of the box along each axis; in 2D there is one layer, at z = 0.
struct Lattice {
  Vec3 from = Vec3::Zero();
  Vec3 cell = Vec3::Zero();
  std::array<Index, 3> n{1, 1, 1};
};

// Cells along axis k; nothing, and a complaint, where not even one fits.
std::optional<double> cells_along(const Keys& box, double spacing, Eigen::Index k) {
  const double length = box.vector("to")[k] - box.vector("from")[k];
  if (!(length > 0)) {
    box.complain("to", fmt::format("{} = {:g} m must be greater than that of 'from', {:g} m",
                                   "xyz"[k], box.vector("to")[k], box.vector("from")[k]));
    return {};
  }
  // 1e-9: a box of one spacing that went through a formula is still one of one spacing.
  if (length < spacing * (1 - 1e-9)) {
    box.complain("to",
                 fmt::format("empty fill: the box is {:g} m thick in {}, the spacing is {:g} m",
                             length, "xyz"[k], spacing));
    return {};
  }
  return std::round(length / spacing);
}

std::optional<Lattice> lattice(const Keys& part, double spacing, int dimension) {
  const Keys fill = part.map("fill");
  if (!fill.has("box")) {
    fill.mistakes().add(fill.where(), fill.path() + ": says no region; a 'box' is wanted");
    return {};
  }
  const Keys box = fill.map("box");
  if (!box.has("from") || !box.has("to") || !(spacing > 0)) return {};  // complained about
  Lattice grid{.from = box.vector("from")};
  double n_points = 1;
  for (Eigen::Index k = 0; k < dimension; ++k) {
    const auto n = cells_along(box, spacing, k);
    if (!n) return {};
    n_points *= *n;
    if (n_points > most_points) {
      box.complain("to",
                   fmt::format("more than {:g} particles of spacing {:g} m would fill the box",
                               most_points, spacing));
      return {};
    }
    grid.n[static_cast<std::size_t>(k)] = static_cast<Index>(*n);
    grid.cell[k] = (box.vector("to")[k] - box.vector("from")[k]) / *n;
  }
  if (dimension == 2) {
    if (box.vector("from").z() > 0 || box.vector("to").z() < 0) {
      box.complain("to", "empty fill: the plane z = 0 of a 2D case does not meet the box");
      return {};
    }
    grid.from.z() = 0;
  }
  return grid;
}

// The n-th number of a fixed sequence, uniform in [-1, 1). SplitMix64 (Steele, Lea and Flood,
// OOPSLA 2014) as a hash of n: the same on every machine, whatever the order of the calls.
double uniform(std::uint64_t n) {
  std::uint64_t z = n * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1;
}

void move_at_random(std::vector<Vec3>& points, const Vec3& range, int seed) {
  std::uint64_t n = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)) << 32) + 1;
  for (Vec3& x : points) {
    for (Eigen::Index k = 0; k < 3; ++k, ++n) x[k] += range[k] * uniform(n);
  }
}

}  // namespace

std::vector<Vec3> fill_points(const Keys& part, double spacing, int dimension) {
  const auto grid = lattice(part, spacing, dimension);
  if (!grid) return {};
  const auto& [from, cell, n] = *grid;
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                 static_cast<std::size_t>(n[2]));
  for (Index k = 0; k < n[2]; ++k) {
    for (Index j = 0; j < n[1]; ++j) {
      for (Index i = 0; i < n[0]; ++i) {
        points.emplace_back(from + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(cell));
      }
    }
  }
  const Keys fill = part.map("fill");
  const double jitter = fill.number_or("jitter", 0);
  if (jitter > 0)
    move_at_random(points, jitter * cell, fill.has("seed") ? fill.integer("seed") : 0);
  return points;
}

double fill_cell_volume(const Keys& part, double spacing, int dimension) {
  const auto grid = lattice(part, spacing, dimension);
  if (!grid) return 0;
  return grid->cell.head(dimension).prod();
}

std::string fill_note(const Keys& part, double spacing, int dimension) {
  const auto grid = lattice(part, spacing, dimension);
  if (!grid) return "";
  std::string axes;
  for (Eigen::Index k = 0; k < dimension; ++k) {
    const double ratio = grid->cell[k] / spacing;
    if (std::abs(ratio - 1) <= 1e-6) continue;
    const Index n = grid->n[static_cast<std::size_t>(k)];
    axes += fmt::format("{}{} cells of {:.6g} m in {} ({:+.2g} %)", axes.empty() ? "" : ", ", n,
                        grid->cell[k], "xyz"[k], 100 * (ratio - 1));
  }
  if (axes.empty()) return "";
  const double volume = grid->cell.head(dimension).prod() / std::pow(spacing, dimension);
  const std::string box = part.map("fill").path() + ".box";
  return fmt::format(
      "{}: {}: the spacing of {:.6g} m does not divide the box, which is filled "
      "exactly by {}; a particle has {:+.2g} % of volume and mass against spacing^{}",
      part.map("fill").where("box").text(), box, spacing, axes, 100 * (volume - 1), dimension);
}

}  // namespace gannet
