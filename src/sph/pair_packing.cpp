// The packed lines of the pair passes, in double and in single precision.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "base/parallel.hpp"
#include "sph/pair_pass.hpp"

namespace gannet {

namespace {

/// A particle so far away that the kernel is 0, with a density that can be divided by.
constexpr PackedParticle far_away{1e30, 1e30, 1e30, 0, 0, 0, 1, 0};

/// Owned and ghost particles, then a full cluster of what the last cluster may load.
std::size_t packed_size(const ParticleView& view) {
  return static_cast<std::size_t>(view.n_sources) + ClusterList::lanes;
}

/// Calls f(begin, end) for pieces of [begin, end) that are not of the unseen.
template <class F>
void for_seen(const ParticleView& view, Index begin, Index end, F&& f) {
  if (view.unseen.empty()) return f(begin, end);
  if (begin < view.unseen.begin) f(begin, std::min(end, view.unseen.begin));
  if (end > view.unseen.end) f(std::max(begin, view.unseen.end), end);
}

/// The eighth number of a line.
double last_of(const ParticleView& view, Index i) {
  if (view.p != nullptr) return view.p[i] / (view.rho[i] * view.rho[i]);
  return view.s == nullptr ? 0.0 : view.s[i];
}

void pack_double(const ParticleView& view, Array<PackedParticle>& lines) {
  lines.resize(packed_size(view));
  parallel_for(static_cast<Index>(lines.size()), node_chunk, [&](Index begin, Index end) {
    const Index last = std::min(end, view.n_sources);
    for_seen(view, begin, last, [&](Index from, Index to) {
      for (Index i = from; i < to; ++i) {
        const Line& x = view.x[i];
        const Line& v = view.v[i];
        lines[i] = {x.x, x.y, x.z, v.x, v.y, v.z, view.rho[i], last_of(view, i)};
      }
    });
    for (Index i = std::max(begin, view.n_sources); i < end; ++i) lines[i] = far_away;
  });
}

/// Smallest and largest position, largest size of a velocity component.
struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  double speed = 0;
};

Extent extent_of(const ParticleView& view) {
  return parallel_reduce(
      view.n_sources, node_chunk, Extent{},
      [&](Index begin, Index end) {
        Extent e;
        for_seen(view, begin, end, [&](Index from, Index to) {
          for (Index i = from; i < to; ++i) {
            e.low = e.low.cwiseMin(xyz(view.x[i]));
            e.high = e.high.cwiseMax(xyz(view.x[i]));
            e.speed = std::max(e.speed, xyz(view.v[i]).cwiseAbs().maxCoeff());
          }
        });
        return e;
      },
      [](const Extent& a, const Extent& b) {
        return Extent{a.low.cwiseMin(b.low), a.high.cwiseMax(b.high), std::max(a.speed, b.speed)};
      });
}

/// Half of the range of whole numbers that positions and velocities use: differences fit.
constexpr double most = 1073741824.0;  // 2^30

std::int32_t whole(double value) {
  const double clipped = value >= -most ? std::min(value, most) : -most;
  return static_cast<std::int32_t>(std::lrint(clipped));
}

void pack_single(const ParticleView& view, double reach, Packed& packed) {
  const Extent extent = extent_of(view);
  const Vec3 middle = 0.5 * (extent.low + extent.high);
  const double half = std::max(0.5 * (extent.high - extent.low).maxCoeff(), 4 * reach);
  packed.x_unit = half / most;
  packed.v_unit = std::max(extent.speed, 1e-30) / most;
  packed.singles.resize(packed_size(view));
  const double per_x = 1 / packed.x_unit;
  const double per_v = 1 / packed.v_unit;
  const bool of_s = view.p == nullptr && view.s != nullptr && view.n_sources > 0;
  const double s_0 = of_s ? view.s[0] : 0.0;
  parallel_for(static_cast<Index>(packed.singles.size()), node_chunk, [&](Index begin, Index end) {
    const Index last = std::min(end, view.n_sources);
    for_seen(view, begin, last, [&](Index from, Index to) {
      for (Index i = from; i < to; ++i) {
        PackedSingle& line = packed.singles[i];
        const Vec3 x = (xyz(view.x[i]) - middle) * per_x;
        const Vec3 v = xyz(view.v[i]) * per_v;
        for (int d = 0; d < 3; ++d) line.x[d] = whole(x[d]);
        for (int d = 0; d < 3; ++d) line.v[d] = whole(v[d]);
        line.rho = static_cast<float>(view.rho[i]);
        // Only differences of s count: those from the first one keep more digits.
        line.last = static_cast<float>(last_of(view, i) - s_0);
      }
    });
    constexpr std::int32_t far = std::numeric_limits<std::int32_t>::max();
    for (Index i = std::max(begin, view.n_sources); i < end; ++i) {
      packed.singles[i] = {{far, far, far}, {0, 0, 0}, 1, 0};
    }
  });
}

}  // namespace

void pack_particles(const ParticleView& view, double reach, Packed& packed) {
  if (packed.single) {
    pack_single(view, reach, packed);
  } else {
    pack_double(view, packed.lines);
  }
}

}  // namespace gannet
