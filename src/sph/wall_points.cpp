#include "sph/wall_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sph/places.hpp"

namespace gannet {

namespace {

using Points = std::vector<Vec3>;

double depth(const Plane& plane, const Vec3& x) { return -plane.normal.dot(x - plane.point); }

/// The axis that a plane stands across; -1 for one that leans.
int axis_across(const Plane& plane, int dimension) {
  for (int d = 0; d < dimension; ++d) {
    if (std::abs(plane.normal[d]) == 1) return d;
  }
  return -1;
}

/// The planes that end one direction, if any.
struct Ends {
  bool lower = false;
  bool upper = false;
  double low = 0;
  double high = 0;
};

Ends ends_of(const std::vector<Plane>& planes, const WallRegion& region, int d) {
  Ends ends{.low = region.low[d], .high = region.high[d]};
  for (const Plane& plane : planes) {
    if (axis_across(plane, region.dimension) != d) continue;
    if (plane.normal[d] > 0) {
      ends.low = ends.lower ? std::max(ends.low, plane.point[d]) : plane.point[d];
      ends.lower = true;
    } else {
      ends.high = ends.upper ? std::min(ends.high, plane.point[d]) : plane.point[d];
      ends.upper = true;
    }
  }
  return ends;
}

/// Coordinates of the lattice along one axis, rising.
std::vector<double> coordinates(const Ends& ends, const WallRegion& region, int d) {
  const double length = ends.high - ends.low;
  const bool whole = (ends.lower && ends.upper) || region.periodic[static_cast<std::size_t>(d)];
  const double cells =
      whole ? std::round(length / region.dx) : std::ceil(length / region.dx - 1e-6);
  const int n = std::max(1, static_cast<int>(cells));
  const double cell = whole ? length / n : region.dx;
  std::vector<double> at;
  for (int k = region.n_layers; k > 0 && ends.lower; --k) {
    at.push_back(ends.low - (k - 0.5) * region.dx);
  }
  const bool from_above = ends.upper && !ends.lower;
  for (int k = 0; k < n; ++k) {
    at.push_back(from_above ? ends.high - (n - k - 0.5) * cell : ends.low + (k + 0.5) * cell);
  }
  for (int k = 1; k <= region.n_layers && ends.upper; ++k) {
    at.push_back(ends.high + (k - 0.5) * region.dx);
  }
  return at;
}

/// The plane that a point is deepest behind; -1 where it is behind none of them, or too deep
/// behind one.
int owner_of(const std::vector<Plane>& planes, const WallRegion& region, const Vec3& x) {
  int owner = -1;
  double most = 0;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double behind = depth(planes[k], x);
    if (behind > region.n_layers * region.dx) return -1;
    if (behind <= most + 1e-9 * region.dx) continue;  // equally deep: the earlier plane
    most = behind;
    owner = static_cast<int>(k);
  }
  return owner;
}

void add_across_axes(const std::vector<Plane>& planes, const WallRegion& region,
                     std::vector<Points>& points) {
  std::array<std::vector<double>, 3> at;
  for (int d = 0; d < 3; ++d) {
    auto& line = at[static_cast<std::size_t>(d)];
    line = d < region.dimension ? coordinates(ends_of(planes, region, d), region, d)
                                : std::vector<double>{0};
  }
  for (const double z : at[2]) {
    for (const double y : at[1]) {
      for (const double x : at[0]) {
        const int owner = owner_of(planes, region, {x, y, z});
        if (owner < 0) continue;
        const auto k = static_cast<std::size_t>(owner);
        if (axis_across(planes[k], region.dimension) >= 0) points[k].emplace_back(x, y, z);
      }
    }
  }
}

/// Two unit vectors along a plane; in a plane case the second one is zero.
std::array<Vec3, 2> along(const Vec3& normal, int dimension) {
  if (dimension == 2) return {Vec3(-normal.y(), normal.x(), 0), Vec3::Zero()};
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 first = normal.cross(Vec3::Unit(least)).normalized();
  return {first, normal.cross(first)};
}

bool within(const WallRegion& region, const Vec3& x) {
  const double margin = region.n_layers * region.dx;
  for (int d = 0; d < region.dimension; ++d) {
    const double more = region.periodic[static_cast<std::size_t>(d)] ? 0 : margin;
    if (x[d] < region.low[d] - more || x[d] >= region.high[d] + more) return false;
  }
  return true;
}

void add_leaning(const std::vector<Plane>& planes, std::size_t k, const WallRegion& region,
                 Places& crowd, std::vector<Points>& points) {
  const Plane& plane = planes[k];
  const auto [u, w] = along(plane.normal, region.dimension);
  const Vec3 middle = 0.5 * (region.low + region.high);
  const Vec3 foot = middle + depth(plane, middle) * plane.normal;
  const double radius = 0.5 * (region.high - region.low).norm() + region.n_layers * region.dx;
  const int n = static_cast<int>(std::ceil(radius / region.dx));
  const int n_w = region.dimension == 3 ? n : 0;
  for (int layer = 0; layer < region.n_layers; ++layer) {
    for (int j = -n_w; j <= n_w; ++j) {
      for (int i = -n; i <= n; ++i) {
        const Vec3 x = foot + region.dx * (i * u + j * w - (layer + 0.5) * plane.normal);
        if (!within(region, x) || owner_of(planes, region, x) < 0 || !crowd.has_room_at(x))
          continue;
        crowd.add(x);
        points[k].push_back(x);
      }
    }
  }
}

}  // namespace

std::vector<std::vector<Vec3>> points_behind(const std::vector<Plane>& planes,
                                             const WallRegion& region) {
  std::vector<Points> points(planes.size());
  add_across_axes(planes, region, points);
  Places crowd(0.75 * region.dx);
  for (const Points& one : points) {
    for (const Vec3& x : one) crowd.add(x);
  }
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (axis_across(planes[k], region.dimension) < 0) add_leaning(planes, k, region, crowd, points);
  }
  return points;
}

}  // namespace gannet
