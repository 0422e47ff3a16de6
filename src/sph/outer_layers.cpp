#include "sph/outer_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>

#include "base/parallel.hpp"
#include "sph/crowd.hpp"
#include "sph/places.hpp"

namespace gannet {

namespace {

constexpr double moving_layers = 4;

/// Distance of each point from the surface, negative inside; `reach` where it is further away [m].
std::vector<double> signed_distances(const ClosedSurface& surface, double reach,
                                     const std::vector<Vec3>& points) {
  Vec3 low = surface.points.front();
  Vec3 high = low;
  for (const Vec3& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<double> d(points.size(), reach);
  parallel_for(static_cast<Index>(points.size()), 256, [&](Index begin, Index end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const Vec3& x = points[k];
      if (((x - low).array() < -reach).any() || ((x - high).array() > reach).any()) continue;
      const double away = std::min(distance(surface, x), reach);
      d[k] = contains(surface, x) ? -away : away;
    }
  });
  return d;
}

/// Whether the surface passes between the points, half a spacing off those next to it.
bool fits(const std::vector<double>& d, double dx) {
  return std::ranges::all_of(d, [&](double q) { return std::abs(q) > 0.45 * dx; });
}

/// Parts points into those that are images of each other about the middle of all of them, from the
/// ends to the middle, whatever the order of the points.
auto images_among(const std::vector<std::size_t>& points, const std::vector<Vec3>& lattice,
                  double dx) {
  Vec3 middle = Vec3::Zero();
  for (const std::size_t k : points) middle += lattice[k] / static_cast<double>(points.size());
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>, std::greater<>> images;
  for (const std::size_t k : points) {
    const Vec3 r = (lattice[k] - middle) / (1e-3 * dx);
    const std::array<std::int64_t, 3> key{std::llround(std::abs(r.z())),
                                          std::llround(std::abs(r.y())),
                                          std::llround(std::abs(r.x()))};
    images[key].push_back(k);
  }
  return images;
}

/// 0 for the points whose place the surface takes: as many as the volume inside asks for, the
/// deepest first. Of those that are equally deep and go in part, evenly many go everywhere, images
/// of each other together.
std::vector<std::uint8_t> those_that_stay(const std::vector<Vec3>& lattice,
                                          const std::vector<double>& d, double dx) {
  double wanted = 0;  // a cell through which the surface goes is inside in part
  for (const double q : d) wanted += std::clamp(0.5 - q / dx, 0.0, 1.0);
  std::vector<std::size_t> order(d.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return d[a] < d[b]; });
  std::vector<std::uint8_t> stays(d.size(), 1);
  for (std::size_t first = 0; first < order.size() && wanted > 0;) {
    std::vector<std::size_t> equal{order[first]};
    while (first + equal.size() < order.size() &&
           d[order[first + equal.size()]] - d[order[first]] < 1e-6 * dx) {
      equal.push_back(order[first + equal.size()]);
    }
    std::ranges::sort(equal);
    const auto n = static_cast<double>(equal.size());
    const double share = std::min(wanted / n, 1.0);
    double due = 0;
    for (const auto& [place, images] : images_among(equal, lattice, dx)) {
      const auto size = static_cast<double>(images.size());
      due += share * size;
      if (due < 0.5 * size) continue;
      due -= size;
      for (const std::size_t k : images) stays[k] = 0;
    }
    wanted -= n;
    first += equal.size();
  }
  return stays;
}

/// The cells that the lattice has inside of the surface, each cut into 2^d that are inside or not.
void add_inside(const ClosedSurface& surface, const std::vector<Vec3>& cells, Crowd& crowd) {
  const double quarter = 0.25 * crowd.dx;
  const double V = std::pow(2 * quarter, surface.dimension);
  const int n = 1 << surface.dimension;
  for (const Vec3& x : cells) {
    for (int c = 0; c < n; ++c) {
      Vec3 part = x;
      for (int k = 0; k < surface.dimension; ++k) part[k] += (c >> k & 1) != 0 ? quarter : -quarter;
      if (!contains(surface, part)) continue;
      crowd.x.push_back(part);
      crowd.V.push_back(V);
    }
  }
}

/// What moves, in the order of the lattice, and what else is within reach of it.
struct Layers {
  std::vector<std::size_t> moving;
  std::vector<std::size_t> others;
  std::vector<Vec3> cells_inside;  ///< that are inside at least in part
};

Layers layers_of(const std::vector<Vec3>& lattice, const std::vector<double>& d,
                 const std::vector<std::uint8_t>& stays, double dx, double reach) {
  Layers layers;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (d[k] >= reach) continue;
    if (d[k] < dx && d[k] > -moving_layers * dx) layers.cells_inside.push_back(lattice[k]);
    if (stays[k] == 0) continue;
    (d[k] < moving_layers * dx ? layers.moving : layers.others).push_back(k);
  }
  return layers;
}

/// The lattice goes on beyond its ends, where nothing of it is within reach of what moves.
void add_beyond(const std::vector<Vec3>& lattice, const std::vector<double>& d, double reach,
                const Layers& layers, Crowd& crowd) {
  Places places(0.5 * crowd.dx);
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (std::abs(d[k]) < reach) places.add(lattice[k]);
  }
  const int n = static_cast<int>(std::ceil(crowd.kernel.reach() / crowd.dx));
  const int n_z = crowd.surface->dimension == 3 ? n : 0;
  const double V = std::pow(crowd.dx, crowd.surface->dimension);
  for (const std::size_t k : layers.moving) {
    for (int c = -n_z; c <= n_z; ++c) {
      for (int b = -n; b <= n; ++b) {
        for (int a = -n; a <= n; ++a) {
          const Vec3 x = lattice[k] + crowd.dx * Vec3(a, b, c);
          if (!places.has_room_at(x)) continue;
          places.add(x);
          crowd.x.push_back(x);
          crowd.V.push_back(V);
        }
      }
    }
  }
}

/// Unit normal of a facet, outwards.
Vec3 normal_of(const ClosedSurface& surface, std::size_t facet) {
  const auto& [a, b, c] = surface.facets[facet];
  const auto corner = [&](Index k) { return surface.points[static_cast<std::size_t>(k)]; };
  const Vec3 along = corner(b) - corner(a);
  if (surface.dimension == 2) return Vec3(along.y(), -along.x(), 0).normalized();
  return along.cross(corner(c) - corner(a)).normalized();
}

/// Points nearer than half a spacing begin there, outside; those on the surface, of which side and
/// direction are rounding, along the normal.
void push_out(Crowd& crowd, std::vector<double>& d) {
  for (std::size_t i = 0; i < crowd.n_moving; ++i) {
    if (d[i] >= 0.5 * crowd.dx) continue;
    Vec3 foot = crowd.surface->points.front();
    std::size_t facet = 0;
    for (std::size_t f = 0; f < crowd.surface->facets.size(); ++f) {
      const Vec3 p = nearest_on_facet(*crowd.surface, f, crowd.x[i]);
      if ((p - crowd.x[i]).squaredNorm() >= (foot - crowd.x[i]).squaredNorm()) continue;
      foot = p;
      facet = f;
    }
    const Vec3 outwards = std::abs(d[i]) < 1e-6 * crowd.dx ? normal_of(*crowd.surface, facet)
                                                           : Vec3((crowd.x[i] - foot) / d[i]);
    crowd.x[i] = foot + 0.5 * crowd.dx * outwards;
    d[i] = 0.5 * crowd.dx;
  }
}

}  // namespace

double reach_outside(const ClosedSurface& surface, double dx) {
  return moving_layers * dx + crowd_beside(surface, dx).kernel.reach() + dx;
}

std::vector<std::uint8_t> stand_outside(const ClosedSurface& surface, double dx,
                                        std::vector<Vec3>& lattice) {
  if (lattice.empty()) return {};
  Crowd crowd = crowd_beside(surface, dx);
  const double reach = reach_outside(surface, dx);
  const std::vector<double> d = signed_distances(surface, reach, lattice);
  std::vector<std::uint8_t> stays(d.size());
  if (fits(d, dx)) {
    std::ranges::transform(d, stays.begin(), [](double q) { return q > 0 ? 1 : 0; });
    return stays;
  }
  stays = those_that_stay(lattice, d, dx);
  const Layers layers = layers_of(lattice, d, stays, dx, reach);
  std::vector<double> distances;
  for (const std::size_t k : layers.moving) {
    crowd.x.push_back(lattice[k]);
    distances.push_back(d[k]);
  }
  crowd.n_moving = crowd.x.size();
  for (const std::size_t k : layers.others) crowd.x.push_back(lattice[k]);
  crowd.V.assign(crowd.x.size(), std::pow(dx, surface.dimension));
  add_inside(surface, layers.cells_inside, crowd);
  add_beyond(lattice, d, reach, layers, crowd);
  push_out(crowd, distances);
  find_facets(crowd, distances);
  spread_out(crowd);
  for (std::size_t i = 0; i < crowd.n_moving; ++i) lattice[layers.moving[i]] = crowd.x[i];
  return stays;
}

}  // namespace gannet
