#include "sph/halo.hpp"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

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

/// The ends (-1, 0, 1) of an image's kind: x runs fastest, kind 13 is the particle itself.
constexpr std::size_t n_kinds = 27;
constexpr std::size_t no_image = 13;
constexpr std::array<int, 3> ends_of(std::size_t kind) {
  const int k = static_cast<int>(kind);
  return {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
}

/// What images of these ends look like.
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

/// How particles find their images along one direction, for each end.
struct Ends {
  bool there[3];
  double sign[3];
  double shift[3];
  double least[3];  ///< an image lies between these [m]
  double most[3];
};

std::array<Ends, 3> ends_of_domain(const Halo& halo, double reach) {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<Ends, 3> all{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto k = static_cast<Eigen::Index>(d);
    for (int end = -1; end <= 1; ++end) {
      std::array<int, 3> ends{0, 0, 0};
      ends[d] = end;
      const Image image = image_at(halo, ends);
      const auto e = static_cast<std::size_t>(end + 1);
      all[d].there[e] = has_images(halo, d, end);
      all[d].sign[e] = image.sign[k];
      all[d].shift[e] = image.shift[k];
      all[d].least[e] = halo.periodic[d] || end < 0 ? halo.low[k] - reach : -far;
      all[d].most[e] = halo.periodic[d] || end > 0 ? halo.high[k] + reach : far;
    }
  }
  return all;
}

/// Bit e + 1 is set where the image at end e of this direction is near enough to the domain to be
/// somebody's neighbour.
unsigned near_ends(const Ends& ends, double x) {
  unsigned near = 0;
  for (unsigned e = 0; e < 3; ++e) {
    const double image = ends.sign[e] * x + ends.shift[e];
    const bool far = image < ends.least[e] || image > ends.most[e];
    if (ends.there[e] && !far) near |= 1U << e;
  }
  return near;
}

/// Calls f(kind) for the kinds of images that a particle has, in order.
template <class F>
void for_images(const std::array<Ends, 3>& ends, const Line& x, F&& f) {
  constexpr unsigned only_itself = 2;
  const unsigned near[3] = {near_ends(ends[0], x.x), near_ends(ends[1], x.y),
                            near_ends(ends[2], x.z)};
  if ((near[0] | near[1] | near[2]) == only_itself) return;
  for (std::size_t kind = 0; kind < n_kinds; ++kind) {
    const bool has =
        (near[0] >> kind % 3 & near[1] >> kind / 3 % 3 & near[2] >> kind / 9 & 1U) != 0;
    if (has && kind != no_image) f(kind);
  }
}

/// Where the images of each kind from each chunk of particles go among the ghosts.
using KindCounts = std::array<Index, n_kinds>;

/// Turns the numbers of images by chunk and kind into places, kind after kind; fills halo.kinds.
/// Returns the number of all.
Index places_of(std::vector<KindCounts>& chunks, Halo& halo) {
  Index next = 0;
  for (std::size_t kind = 0; kind < n_kinds; ++kind) {
    const Index begin = next;
    for (KindCounts& chunk : chunks) next += std::exchange(chunk[kind], next);
    if (next > begin) halo.kinds.push_back({image_at(halo, ends_of(kind)), {begin, next}});
  }
  return next;
}

/// The entries of a field with base and strides at hand.
template <class T>
struct Entries {
  std::byte* base;
  Layout layout;
  T& at(Index entry, int c) const {
    const std::ptrdiff_t place = layout.lanes == 1
                                     ? entry * layout.entry_stride
                                     : (entry / layout.lanes) * layout.block_stride +
                                           (entry % layout.lanes) * layout.entry_stride;
    return *reinterpret_cast<T*>(base + place + c * layout.component_stride);
  }
};

template <class T>
Entries<T> entries_of(const Field& field) {
  return {field.base(), field.layout};
}

/// Ghosts [begin, end) become copies; `first` and `ghosts` are the entries of the first particle
/// and the first ghost.
template <class T>
void copy_values(const Field& field, const Halo& halo, Index first, Index ghosts, Index begin,
                 Index end) {
  const Entries<T> entries = entries_of<T>(field);
  const Index* source = halo.source.data();
  for (Index g = begin; g < end; ++g) {
    for (int c = 0; c < field.components; ++c) {
      entries.at(ghosts + g, c) = entries.at(first + source[g], c);
    }
  }
}

/// The same for vectors and points.
void copy_vectors(const Field& field, const Halo& halo, Index first, Index ghosts, Index begin,
                  Index end) {
  assert(field.type == Type::f64 && field.components == 3);
  const Entries<double> entries = entries_of<double>(field);
  const Index* source = halo.source.data();
  const bool point = field.ghosts == GhostRule::copy_shifted;
  for_kinds(halo, begin, end, [&](const Image& image, Index from, Index to) {
    const Vec3 sign = image.sign;
    const Vec3 shift = point ? image.shift : Vec3::Zero();
    for (Index g = from; g < to; ++g) {
      for (int d = 0; d < 3; ++d) {
        entries.at(ghosts + g, d) = sign[d] * entries.at(first + source[g], d) + shift[d];
      }
    }
  });
}

void copy_stretch(const Field& field, const Halo& halo, Index first, Index ghosts, Index begin,
                  Index end) {
  if (field.components == 3) return copy_vectors(field, halo, first, ghosts, begin, end);
  switch (field.type) {
    case Type::f64:
      return copy_values<double>(field, halo, first, ghosts, begin, end);
    case Type::i64:
      return copy_values<std::int64_t>(field, halo, first, ghosts, begin, end);
    case Type::i32:
      return copy_values<std::int32_t>(field, halo, first, ghosts, begin, end);
    case Type::u8:
      return copy_values<std::uint8_t>(field, halo, first, ghosts, begin, end);
  }
}

/// Adds ghosts of one kind to their sources, which all differ, and clears them.
void add_kind(const Field& field, const Halo& halo, Index first, Index ghosts,
              const ImageKind& kind) {
  assert(field.type == Type::f64);
  const Entries<double> entries = entries_of<double>(field);
  const Index* source = halo.source.data();
  parallel_for(kind.ghosts.size(), node_chunk, [&](Index begin, Index end) {
    for (Index g = kind.ghosts.begin + begin; g < kind.ghosts.begin + end; ++g) {
      for (int c = 0; c < field.components; ++c) {
        const double sign = c < 3 && field.components >= 3 ? kind.image.sign[c] : 1.0;
        double& ghost = entries.at(ghosts + g, c);
        entries.at(first + source[g], c) += sign * ghost;
        ghost = 0;
      }
    }
  });
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
  halo.clear_images();
  const std::array<Ends, 3> ends = ends_of_domain(halo, reach);
  std::vector<KindCounts> chunks(static_cast<std::size_t>((n + node_chunk - 1) / node_chunk));
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    KindCounts counts{};
    for (Index k = begin; k < end; ++k) {
      for_images(ends, x[k], [&](std::size_t kind) { ++counts[kind]; });
    }
    chunks[static_cast<std::size_t>(begin / node_chunk)] = counts;
  });
  const auto n_images = static_cast<std::size_t>(places_of(chunks, halo));
  halo.source.resize(n_images);
  halo.kind.resize(n_images);
  for (std::size_t k = 0; k < halo.kinds.size(); ++k) {
    const Range& ghosts = halo.kinds[k].ghosts;
    std::fill(halo.kind.begin() + ghosts.begin, halo.kind.begin() + ghosts.end,
              static_cast<std::uint8_t>(k));
  }
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    KindCounts next = chunks[static_cast<std::size_t>(begin / node_chunk)];
    for (Index k = begin; k < end; ++k) {
      for_images(ends, x[k], [&](std::size_t kind) { halo.source[next[kind]++] = k; });
    }
  });
}

void resize_ghosts(const Halo& halo, Scene& scene) {
  const Index n = halo.n_ghosts();
  scene.nodes.n_ghosts = n;
  for (const Field& field : scene.fields) {
    Index first = 0;
    if (!first_particle(field, scene, first) || !field.resize) continue;
    field.resize(first + scene.particles.size() + n);
  }
}

FieldPlaces copied_fields(const Scene& scene) {
  FieldPlaces places;
  for (std::size_t k = 0; k < scene.fields.size(); ++k) {
    const Field& field = scene.fields[k];
    Index first = 0;
    const bool copied = field.ghosts == GhostRule::copy_shifted || field.ghosts == GhostRule::copy;
    if (copied && first_particle(field, scene, first)) places.push_back(k);
  }
  return places;
}

void copy_out(const Halo& halo, Scene& scene, std::span<const std::size_t> fields) {
  parallel_for(halo.n_ghosts(), node_chunk, [&](Index begin, Index end) {
    for (const std::size_t k : fields) {
      const Field& field = scene.fields[k];
      Index first = 0;
      first_particle(field, scene, first);
      copy_stretch(field, halo, first, first + scene.particles.size(), begin, end);
    }
  });
}

void copy_out(const Halo& halo, Scene& scene) { copy_out(halo, scene, copied_fields(scene)); }

void add_back(const Halo& halo, Scene& scene) {
  for (const Field& field : scene.fields) {
    Index first = 0;
    if (field.ghosts != GhostRule::add_back || !first_particle(field, scene, first)) continue;
    for (const ImageKind& kind : halo.kinds) {
      add_kind(field, halo, first, first + scene.particles.size(), kind);
    }
  }
}

}  // namespace gannet
