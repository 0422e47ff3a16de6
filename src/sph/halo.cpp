#include "sph/halo.hpp"

#include <cassert>
#include <cmath>
#include <cstring>

#include "base/parallel.hpp"

namespace gannet {

namespace {

/// First entry and ghost offset of a field over nodes or particles; false for
/// other fields.
bool first_particle(const Field& field, const Scene& scene, Index& first) {
  if (field.over == Over::nodes) first = scene.particles.begin;
  if (field.over == Over::particles) first = 0;
  return field.over == Over::nodes || field.over == Over::particles;
}

/// x moved by whole periods into [low, high).
double wrapped(double x, double low, double high) {
  if (x >= low && x < high) return x;
  const double period = high - low;
  const double moved = x - period * std::floor((x - low) / period);
  return moved < high ? moved : low;  // rounding may give exactly `high`
}

/// Ends of a direction that make images: -1 the lower, 1 the upper, 0 neither.
bool has_images(const Halo& halo, std::size_t d, int end) {
  if (end == 0 || halo.periodic[d]) return true;
  return end < 0 ? halo.wall_low[d] : halo.wall_high[d];
}

/// What images of these ends (-1, 0, 1 by direction) look like.
Image image_at(const Halo& halo, const std::array<int, 3>& ends) {
  Image image;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    if (halo.periodic[d]) {
      image.shift[k] = ends[d] * (halo.high[k] - halo.low[k]);
    } else if (ends[d] != 0) {
      image.sign[k] = -1;
      image.shift[k] = 2 * (ends[d] < 0 ? halo.low[k] : halo.high[k]);
    }
  }
  return image;
}

/// Whether an image is near enough to the domain to be somebody's neighbour.
bool within_reach(const Halo& halo, const std::array<int, 3>& ends, const Vec3& image,
                  double reach) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    const bool low = halo.periodic[d] || ends[d] < 0;
    const bool high = halo.periodic[d] || ends[d] > 0;
    if (low && image[k] < halo.low[k] - reach) return false;
    if (high && image[k] > halo.high[k] + reach) return false;
  }
  return true;
}

void add_images(const Line* x, Index n, double reach, const std::array<int, 3>& ends, Halo& halo) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (!has_images(halo, d, ends[d])) return;
  }
  const Image image = image_at(halo, ends);
  for (Index k = 0; k < n; ++k) {
    if (!within_reach(halo, ends, image.point(xyz(x[k])), reach)) continue;
    halo.source.push_back(k);
    halo.image.push_back(image);
  }
}

void copy_field(const Field& field, Index from, Index to) {
  for (int c = 0; c < field.components; ++c) {
    std::memcpy(field.at(to, c), field.at(from, c), static_cast<std::size_t>(size_of(field.type)));
  }
}

double& number_at(const Field& field, Index entry, Eigen::Index c) {
  return *reinterpret_cast<double*>(field.at(entry, static_cast<int>(c)));
}

/// A copied vector or point becomes that of the image.
void transform_entry(const Field& field, Index entry, const Image& image) {
  assert(field.type == Type::f64 && field.components == 3);
  const bool point = field.ghosts == GhostRule::copy_shifted;
  for (Eigen::Index d = 0; d < 3; ++d) {
    double& value = number_at(field, entry, d);
    value = image.sign[d] * value + (point ? image.shift[d] : 0.0);
  }
}

void add_entry(const Field& field, Index from, Index to, const Image& image) {
  assert(field.type == Type::f64);
  for (Eigen::Index c = 0; c < field.components; ++c) {
    double& ghost = number_at(field, from, c);
    number_at(field, to, c) += c < 3 && field.components >= 3 ? image.sign[c] * ghost : ghost;
    ghost = 0;
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
  halo.image.clear();
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
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
    Index first = 0;
    if (field.ghosts != GhostRule::copy_shifted && field.ghosts != GhostRule::copy) continue;
    if (!first_particle(field, scene, first)) continue;
    const Index ghosts = first + scene.particles.size();
    parallel_for(n, node_chunk, [&](Index begin, Index end) {
      for (Index g = begin; g < end; ++g) {
        const auto at = static_cast<std::size_t>(g);
        copy_field(field, first + halo.source[at], ghosts + g);
        if (field.components == 3) transform_entry(field, ghosts + g, halo.image[at]);
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
      const auto at = static_cast<std::size_t>(g);
      add_entry(field, ghosts + g, first + halo.source[at], halo.image[at]);
    }
  }
}

}  // namespace gannet
