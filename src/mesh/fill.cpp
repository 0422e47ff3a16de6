#include "mesh/fill.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>

#include "base/array.hpp"

namespace gannet {
namespace {

constexpr double most_points = 2e9;  // what an Index can count

// Cells along each axis, of which those count whose middle is inside; in 2D there is one layer, at
// z = 0.
struct Lattice {
  Vec3 from = Vec3::Zero();
  Vec3 cell = Vec3::Zero();
  std::array<Index, 3> n{1, 1, 1};
  std::function<bool(const Vec3&)> inside;  // none: all
  double volume = 0;                        // of the shape, where it is not a box
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

// Whether a lattice of so many cells can be filled.
bool is_possible(double n_cells, const Keys& shape, const char* key, double spacing) {
  if (n_cells <= most_points) return true;
  shape.complain(key, fmt::format("more than {:g} particles of spacing {:g} m would fill the {}",
                                  most_points, spacing, shape.name()));
  return false;
}

std::optional<Lattice> box_lattice(const Keys& box, double spacing, int dimension) {
  if (!box.has("from") || !box.has("to")) return {};  // complained about
  Lattice grid{.from = box.vector("from")};
  double n_points = 1;
  for (Eigen::Index k = 0; k < dimension; ++k) {
    const auto n = cells_along(box, spacing, k);
    if (!n) return {};
    n_points *= *n;
    if (!is_possible(n_points, box, "to", spacing)) return {};
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

// Whole cells of one spacing along axis k, as many on both sides of the middle.
void centre_cells(Lattice& grid, Eigen::Index k, double middle, double half, double spacing) {
  const double n = std::max(1.0, std::ceil(half / spacing - 1e-9));
  grid.n[static_cast<std::size_t>(k)] = static_cast<Index>(2 * n);
  grid.cell[k] = spacing;
  grid.from[k] = middle - n * spacing;
}

std::optional<Lattice> ellipsoid_lattice(const Keys& shape, double spacing, int dimension) {
  if (!shape.has("centre") || !shape.has("radii")) return {};
  const Vec3 centre = shape.vector("centre");
  const Vec3 radii = shape.vector("radii");
  Lattice grid;
  double n_cells = 1;
  grid.volume = dimension == 3 ? 4.0 / 3 * std::numbers::pi : std::numbers::pi;
  for (Eigen::Index k = 0; k < dimension; ++k) {
    if (!(radii[k] >= spacing)) {
      shape.complain("radii", fmt::format("empty fill: the radius along {} is {:g} m, the spacing "
                                          "is {:g} m",
                                          "xyz"[k], radii[k], spacing));
      return {};
    }
    n_cells *= 2 * radii[k] / spacing;
    if (!is_possible(n_cells, shape, "radii", spacing)) return {};
    centre_cells(grid, k, centre[k], radii[k], spacing);
    grid.volume *= radii[k];
  }
  grid.inside = [centre, radii, dimension](const Vec3& x) {
    return (x - centre).head(dimension).cwiseQuotient(radii.head(dimension)).squaredNorm() <= 1;
  };
  return grid;
}

std::optional<Lattice> cylinder_lattice(const Keys& shape, double spacing, int dimension) {
  if (!shape.has("from") || !shape.has("to") || !shape.has("radius")) return {};
  if (dimension == 2) {
    shape.complain("", "a plane case has no cylinders; an 'ellipsoid' is a disc there");
    return {};
  }
  const Vec3 along = shape.vector("to") - shape.vector("from");
  const double R = shape.number("radius");
  Eigen::Index axis = 0;
  const double length = along.cwiseAbs().maxCoeff(&axis);
  if (!(length > 0) || along.norm() != length) {
    shape.complain("to", "the axis of a cylinder of particles goes along x, y or z");
    return {};
  }
  if (!(R >= spacing) || !(length >= spacing * (1 - 1e-9))) {
    shape.complain("radius", fmt::format("empty fill: the cylinder is {:g} m long and {:g} m in "
                                         "radius, the spacing is {:g} m",
                                         length, R, spacing));
    return {};
  }
  const double n = std::round(length / spacing);
  if (!is_possible(n * 4 * R * R / (spacing * spacing), shape, "radius", spacing)) return {};
  Lattice grid;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (k != axis) centre_cells(grid, k, shape.vector("from")[k], R, spacing);
  }
  grid.n[static_cast<std::size_t>(axis)] = static_cast<Index>(n);
  grid.cell[axis] = length / n;
  grid.from[axis] = std::min(shape.vector("from")[axis], shape.vector("to")[axis]);
  grid.volume = std::numbers::pi * R * R * length;
  grid.inside = [axis, R, middle = shape.vector("from")](const Vec3& x) {
    Vec3 r = x - middle;
    r[axis] = 0;
    return r.squaredNorm() <= R * R;
  };
  return grid;
}

std::optional<Lattice> lattice(const Keys& part, double spacing, int dimension) {
  using Make = std::optional<Lattice> (*)(const Keys&, double, int);
  constexpr std::array<std::pair<const char*, Make>, 3> shapes{
      {{"box", box_lattice}, {"ellipsoid", ellipsoid_lattice}, {"cylinder", cylinder_lattice}}};
  const Keys fill = part.map("fill");
  std::optional<Lattice> grid;
  int n_shapes = 0;
  for (const auto& [name, make] : shapes) {
    if (!fill.has(name)) continue;
    ++n_shapes;
    if (spacing > 0) grid = make(fill.map(name), spacing, dimension);
  }
  if (n_shapes == 1) return grid;
  fill.mistakes().add(fill.where(),
                      fill.path() + (n_shapes == 0 ? ": says no region; a 'box', an 'ellipsoid' "
                                                     "or a 'cylinder' is wanted"
                                                   : ": says more than one region"));
  return {};
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

/// By how much the cells that are inside differ from the shape.
std::string shape_note(const Keys& part, const Lattice& grid, std::size_t n, int dimension) {
  const double volume = static_cast<double>(n) * grid.cell.head(dimension).prod();
  const Keys fill = part.map("fill");
  return fmt::format("{}: {}: {} cells have {:+.2g} % of the volume and mass of the shape",
                     fill.where().text(), fill.path(), n, 100 * (volume / grid.volume - 1));
}

}  // namespace

std::vector<Vec3> fill_points(const Keys& part, double spacing, int dimension) {
  const auto grid = lattice(part, spacing, dimension);
  if (!grid) return {};
  const Vec3& from = grid->from;
  const Vec3& cell = grid->cell;
  const auto& n = grid->n;
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                 static_cast<std::size_t>(n[2]));
  for (Index k = 0; k < n[2]; ++k) {
    for (Index j = 0; j < n[1]; ++j) {
      for (Index i = 0; i < n[0]; ++i) {
        const Vec3 x = from + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(cell);
        if (!grid->inside || grid->inside(x)) points.push_back(x);
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
  if (grid->inside)
    return shape_note(part, *grid, fill_points(part, spacing, dimension).size(), dimension);
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
