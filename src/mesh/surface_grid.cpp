#include "mesh/surface_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gannet {

namespace {

/// The range of cells along a direction whose middles lie within [from, to].
std::array<std::int64_t, 2> cells_within(const SurfaceGrid& grid, int d, double from, double to) {
  if (grid.dimension == 2 && d == 2) return {0, 0};
  const double first = std::ceil((from - grid.low[d]) / grid.cell[d] - 0.5);
  const double last = std::floor((to - grid.low[d]) / grid.cell[d] - 0.5);
  const auto most = static_cast<double>(grid.n[static_cast<std::size_t>(d)] - 1);
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, most + 1)),
          static_cast<std::int64_t>(std::clamp(last, -1.0, most))};
}

struct Box {
  Vec3 low;
  Vec3 high;
};

Box box_of(const ClosedSurface& s, const std::array<Index, 3>& f) {
  Box box{s.points[static_cast<std::size_t>(f[0])], s.points[static_cast<std::size_t>(f[0])]};
  for (int c = 1; c < s.dimension; ++c) {
    const Vec3& p = s.points[static_cast<std::size_t>(f[static_cast<std::size_t>(c)])];
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

/// Where the row at (y, z) passes a facet; NaN where it does not.
double crossing(const ClosedSurface& s, const std::array<Index, 3>& f, double y, double z) {
  const Vec3& a = s.points[static_cast<std::size_t>(f[0])];
  const Vec3& b = s.points[static_cast<std::size_t>(f[1])];
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (s.dimension == 2) {
    if ((a.y() > y) == (b.y() > y)) return none;
    return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  const Vec3& c = s.points[static_cast<std::size_t>(f[2])];
  const auto area = [](double y1, double z1, double y2, double z2) { return y1 * z2 - z1 * y2; };
  const double u = area(b.y() - y, b.z() - z, c.y() - y, c.z() - z);
  const double v = area(c.y() - y, c.z() - z, a.y() - y, a.z() - z);
  const double w = area(a.y() - y, a.z() - z, b.y() - y, b.z() - z);
  if ((u > 0) != (v > 0) || (u > 0) != (w > 0)) return none;
  return (u * a.x() + v * b.x() + w * c.x()) / (u + v + w);
}

}  // namespace

Vec3 SurfaceGrid::point(std::int64_t i, std::int64_t j, std::int64_t k) const {
  const Vec3 middle(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5,
                    static_cast<double>(k) + 0.5);
  return low + middle.cwiseProduct(cell);
}

Vec3 SurfaceGrid::point(std::size_t number) const {
  const auto m = static_cast<std::int64_t>(number);
  return point(m % n[0], m / n[0] % n[1], m / (n[0] * n[1]));
}

SurfaceGrid grid_around(const ClosedSurface& surface, double dx, double margin) {
  SurfaceGrid grid{.dimension = surface.dimension};
  Vec3 low = surface.points[static_cast<std::size_t>(surface.facets.front()[0])];
  Vec3 high = low;
  for (const auto& f : surface.facets) {
    const Box box = box_of(surface, f);
    low = low.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
  }
  for (int d = 0; d < surface.dimension; ++d) {
    const double size = high[d] - low[d] + 2 * margin;
    auto& n = grid.n[static_cast<std::size_t>(d)];
    n = std::max<std::int64_t>(1, std::llround(size / dx));
    grid.low[d] = low[d] - margin;
    grid.cell[d] = size / static_cast<double>(n);
  }
  return grid;
}

std::vector<std::uint8_t> inside_of(const ClosedSurface& surface, const SurfaceGrid& grid) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(grid.n[1] * grid.n[2]));
  const Vec3 beside = Vec3(0, 1e-6, 0.7e-6).cwiseProduct(grid.cell);
  for (const auto& f : surface.facets) {
    const Box box = box_of(surface, f);
    const Vec3 margin = grid.cell;
    const auto js = cells_within(grid, 1, box.low.y() - margin.y(), box.high.y() + margin.y());
    const auto ks = cells_within(grid, 2, box.low.z() - margin.z(), box.high.z() + margin.z());
    for (std::int64_t k = ks[0]; k <= ks[1]; ++k) {
      for (std::int64_t j = js[0]; j <= js[1]; ++j) {
        const Vec3 at = grid.point(0, j, k) + beside;
        const double x = crossing(surface, f, at.y(), at.z());
        if (!std::isnan(x)) rows[static_cast<std::size_t>(j + grid.n[1] * k)].push_back(x);
      }
    }
  }
  std::vector<std::uint8_t> inside(grid.size(), 0);
  for (std::size_t number = 0; number < inside.size(); ++number) {
    const double x = grid.point(number).x();
    const auto& row = rows[number / static_cast<std::size_t>(grid.n[0])];
    inside[number] = std::ranges::count_if(row, [&](double at) { return at > x; }) % 2 == 1 ? 1 : 0;
  }
  return inside;
}

std::vector<double> distances_to(const ClosedSurface& surface, const SurfaceGrid& grid,
                                 double reach) {
  std::vector<double> least(grid.size(), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Box box = box_of(surface, surface.facets[f]);
    std::array<std::array<std::int64_t, 2>, 3> range{};
    for (int d = 0; d < 3; ++d) {
      range[static_cast<std::size_t>(d)] =
          cells_within(grid, d, box.low[d] - reach, box.high[d] + reach);
    }
    for (std::int64_t k = range[2][0]; k <= range[2][1]; ++k) {
      for (std::int64_t j = range[1][0]; j <= range[1][1]; ++j) {
        for (std::int64_t i = range[0][0]; i <= range[0][1]; ++i) {
          const double d = distance_to_facet(surface, f, grid.point(i, j, k));
          double& here = least[static_cast<std::size_t>(i + grid.n[0] * (j + grid.n[1] * k))];
          if (d < reach) here = std::min(here, d);
        }
      }
    }
  }
  return least;
}

}  // namespace gannet
