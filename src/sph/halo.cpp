#include "sph/halo.hpp"

#include <cassert>
#include <cmath>
#include <cstring>

#include "base/parallel.hpp"

namespace gannet {

namespace {

/// First entry and ghost offset of a field over nodes or particles; false for other fields.
bool first_particle(const Field& field, const Scene& scene, Index& first) {
  if (field.over == Over::nodes) first = scene.particles.begin;
  if (field.over == Over::particles) first = 0;
  return field.over == Over::nodes || field.over == Over::particles;
}

double component(const Line& line, int d) { return d == 0 ? line.x : (d == 1 ? line.y : line.z); }

/// x moved by whole periods into [low, high).
double wrapped(double x, double low, double high) {
  if (x >= low && x < high) return x;
  const double period = high - low;
  const double moved = x - period * std::floor((x - low) / period);
  return moved < high ? moved : low;  // rounding may give exactly `high`
}

/// The smallest and largest shift, in periods, of one direction.
int lowest_shift(const Halo& halo, int d) {
  return halo.periodic[static_cast<std::size_t>(d)] ? -1 : 0;
}

void add_images(const Line* x, Index n, double reach, const std::array<int, 3>& periods,
                Halo& halo) {
  Vec3 shift = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    shift[d] = periods[static_cast<std::size_t>(d)] * (halo.high[d] - halo.low[d]);
  }
  const auto near = [&](const Line& p) {
    for (int d = 0; d < 3; ++d) {
      if (!halo.periodic[static_cast<std::size_t>(d)]) continue;
      const double image = component(p, d) + shift[d];
      if (image < halo.low[d] - reach || image > halo.high[d] + reach) return false;
    }
    return true;
  };
  for (Index k = 0; k < n; ++k) {
    if (!near(x[k])) continue;
    halo.source.push_back(k);
    halo.shift.push_back({shift.x(), shift.y(), shift.z(), 0});
  }
}

void copy_field(const Field& field, Index from, Index to) {
  for (int c = 0; c < field.components; ++c) {
    std::memcpy(field.at(to, c), field.at(from, c), static_cast<std::size_t>(size_of(field.type)));
  }
}

void shift_entry(const Field& field, Index entry, const Line& shift) {
  assert(field.type == Type::f64 && field.components == 3);
  for (int d = 0; d < 3; ++d) {
    *reinterpret_cast<double*>(field.at(entry, d)) += component(shift, d);
  }
}

void add_entry(const Field& field, Index from, Index to) {
  assert(field.type == Type::f64);
  for (int c = 0; c < field.components; ++c) {
    auto* ghost = reinterpret_cast<double*>(field.at(from, c));
    *reinterpret_cast<double*>(field.at(to, c)) += *ghost;
    *ghost = 0;
  }
}

}  // namespace

void wrap_particles(const Halo& halo, Scene& scene) {
  Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(scene.particles.size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      Line& p = x[k];
      if (halo.periodic[0]) p.x = wrapped(p.x, halo.low.x(), halo.high.x());
      if (halo.periodic[1]) p.y = wrapped(p.y, halo.low.y(), halo.high.y());
      if (halo.periodic[2]) p.z = wrapped(p.z, halo.low.z(), halo.high.z());
    }
  });
}

void choose_images(const Line* x, Index n, double reach, Halo& halo) {
  halo.source.clear();
  halo.shift.clear();
  const std::array<int, 3> lowest{lowest_shift(halo, 0), lowest_shift(halo, 1),
                                  lowest_shift(halo, 2)};
  for (int k = lowest[2]; k <= -lowest[2]; ++k) {
    for (int j = lowest[1]; j <= -lowest[1]; ++j) {
      for (int i = lowest[0]; i <= -lowest[0]; ++i) {
        if (i != 0 || j != 0 || k != 0) add_images(x, n, reach, {i, j, k}, halo);
      }
    }
  }
}

void resize_ghosts(const Halo& halo, Scene& scene) {
  const auto n = static_cast<Index>(halo.source.size());
  scene.nodes.n_ghosts = n;
  for (const Field& field : scene.fields) {
    Index first = 0;
    if (!first_particle(field, scene, first) || !field.resize) continue;
    field.resize(first + scene.particles.size() + n);
  }
}

void copy_out(const Halo& halo, Scene& scene) {
  const auto n = static_cast<Index>(halo.source.size());
  for (const Field& field : scene.fields) {
    const bool shifted = field.ghosts == GhostRule::copy_shifted;
    Index first = 0;
    if (!shifted && field.ghosts != GhostRule::copy) continue;
    if (!first_particle(field, scene, first)) continue;
    const Index ghosts = first + scene.particles.size();
    parallel_for(n, node_chunk, [&](Index begin, Index end) {
      for (Index g = begin; g < end; ++g) {
        const auto at = static_cast<std::size_t>(g);
        copy_field(field, first + halo.source[at], ghosts + g);
        if (shifted) shift_entry(field, ghosts + g, halo.shift[at]);
      }
    });
  }
}

void add_back(const Halo& halo, Scene& scene) {
  const auto n = static_cast<Index>(halo.source.size());
  for (const Field& field : scene.fields) {
    Index first = 0;
    if (field.ghosts != GhostRule::add_back || !first_particle(field, scene, first)) continue;
    const Index ghosts = first + scene.particles.size();
    for (Index g = 0; g < n; ++g) {
      add_entry(field, ghosts + g, first + halo.source[static_cast<std::size_t>(g)]);
    }
  }
}

}  // namespace gannet
