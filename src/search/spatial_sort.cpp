#include "search/spatial_sort.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include "base/parallel.hpp"

namespace gannet {

namespace {

struct Box {
  Line low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
           std::numeric_limits<double>::max(), 0};
  Line high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest(),
            std::numeric_limits<double>::lowest(), 0};
  Line sum{};
};

Box join(const Box& a, const Box& b) {
  Box c;
  c.low = {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z), 0};
  c.high = {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y),
            std::max(a.high.z, b.high.z), 0};
  c.sum = {a.sum.x + b.sum.x, a.sum.y + b.sum.y, a.sum.z + b.sum.z, 0};
  return c;
}

Box box_of(std::span<const Line> x) {
  return parallel_reduce(
      static_cast<Index>(x.size()), node_chunk, Box{},
      [&](Index begin, Index end) {
        Box box;
        for (Index i = begin; i < end; ++i) box = join(box, Box{x[i], x[i], x[i]});
        return box;
      },
      join);
}

/// Sets counts and corners of the grid. It begins a quarter of a column below the lowest point, so
/// that with columns of two spacings the sides fall between the layers of a lattice. Where the box
/// would need more than `most` columns, the longer side is halved around the mean until they
/// suffice: a few points that fly far out must not cost memory, and they stay right in the
/// outermost columns.
void lay_grid(const Box& box, Index n, double width, Columns& columns) {
  const double most = std::max(4096.0, 2.0 * n);
  auto count = [&](double extent) { return std::floor(std::min(1e15, extent / width + 0.25)) + 1; };
  double n_y = count(box.high.y - box.low.y);
  double n_z = count(box.high.z - box.low.z);
  while (n_y * n_z > most) {
    double& longer = n_y >= n_z ? n_y : n_z;
    longer = std::ceil(0.5 * longer);
  }
  auto corner = [&](double low, double high, double sum, double n_columns) {
    const double first = low - 0.25 * width;
    const double last = std::max(first, high - n_columns * width);
    return std::clamp(sum / n - 0.5 * n_columns * width, first, last);
  };
  columns.n_y = static_cast<Index>(n_y);
  columns.n_z = static_cast<Index>(n_z);
  columns.y_min = corner(box.low.y, box.high.y, box.sum.y, n_y);
  columns.z_min = corner(box.low.z, box.high.z, box.sum.z, n_z);
  columns.width = width;
}

Index place_in(double y, double y_min, double width, Index n) {
  const double place = (y - y_min) / width;
  if (!(place > 0)) return 0;
  return place < n - 1 ? static_cast<Index>(place) : n - 1;
}

/// Number of the column of each point.
void find_columns(std::span<const Line> x, Columns& g) {
  g.column_of.resize(x.size());
  parallel_for(static_cast<Index>(x.size()), node_chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Index iy = place_in(x[i].y, g.y_min, g.width, g.n_y);
      const Index iz = place_in(x[i].z, g.z_min, g.width, g.n_z);
      if (g.serpentine && iz % 2 == 1) iy = g.n_y - 1 - iy;
      g.column_of[i] = iz * g.n_y + iy;
    }
  });
}

/// Sorts the points of each column: x in the upper half of a key (falling where the serpentine
/// turns back), the index in the lower half, so that equal x keep their order.
void sort_along_x(std::span<const Line> x, const Box& box, Columns& columns) {
  const double extent = box.high.x - box.low.x;
  const double scale = extent > 0 ? 4294967295.0 / extent : 0.0;
  const Index n_columns = columns.n_y * columns.n_z;
  parallel_for(n_columns, 16, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const bool falls = columns.serpentine && c % 2 == 1;
      const auto first = columns.key.begin() + columns.start[c];
      const auto last = columns.key.begin() + columns.start[c + 1];
      for (auto k = first; k != last; ++k) {
        const auto along = static_cast<std::uint64_t>((x[*k].x - box.low.x) * scale);
        *k |= (falls ? 0xffffffffU - along : along) << 32U;
      }
      if (!std::is_sorted(first, last)) std::sort(first, last);
      std::transform(first, last, columns.order.begin() + columns.start[c],
                     [](std::uint64_t k) { return static_cast<Index>(k & 0xffffffffU); });
    }
  });
}

/// Whether the particles have entries in a tracked field, and which is the first.
bool holds_particles(const Scene& scene, const Field& field, Index& first) {
  if (field.over == Over::particles) {
    first = 0;
    return field.count() >= scene.particles.size();
  }
  first = scene.particles.begin;
  return field.over == Over::nodes && field.count() >= scene.particles.end;
}

/// A stretch of bytes that entries of a field have, one every `stride`.
struct Pieces {
  std::byte* first;
  std::ptrdiff_t stride;
  std::size_t bytes;
};

/// Permutes pieces of N bytes by way of `buffer`.
template <std::size_t N>
void permute_pieces_of(const Pieces& pieces, std::span<const Index> order, std::byte* buffer) {
  const auto n = static_cast<Index>(order.size());
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      std::memcpy(buffer + N * static_cast<std::size_t>(k),
                  pieces.first + pieces.stride * order[static_cast<std::size_t>(k)], N);
    }
  });
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      std::memcpy(pieces.first + pieces.stride * k, buffer + N * static_cast<std::size_t>(k), N);
    }
  });
}

/// The sizes that fields have; the size is known to the compiler, for it is most of the work.
void permute_pieces(const Pieces& pieces, std::span<const Index> order, std::byte* buffer) {
  switch (pieces.bytes) {
    case 1:
      return permute_pieces_of<1>(pieces, order, buffer);
    case 4:
      return permute_pieces_of<4>(pieces, order, buffer);
    case 8:
      return permute_pieces_of<8>(pieces, order, buffer);
    case 24:
      return permute_pieces_of<24>(pieces, order, buffer);
    case 32:
      return permute_pieces_of<32>(pieces, order, buffer);
    default:
      for (std::size_t at = 0; at < pieces.bytes; ++at) {
        permute_pieces_of<1>({pieces.first + at, pieces.stride, 1}, order, buffer);
      }
  }
}

/// The most bytes of one entry that permute_pieces() takes at once.
constexpr std::size_t most_bytes = 32;

/// Of a field whose entries lie in blocks of lanes, one component after the other.
void permute_blocked(const Field& field, Index first, std::span<const Index> order,
                     std::byte* buffer, std::size_t bytes) {
  const auto n = static_cast<Index>(order.size());
  for (int c = 0; c < field.components; ++c) {
    for (Index k = 0; k < n; ++k) {
      std::memcpy(buffer + bytes * static_cast<std::size_t>(k),
                  field.at(first + order[static_cast<std::size_t>(k)], c), bytes);
    }
    for (Index k = 0; k < n; ++k) {
      std::memcpy(field.at(first + k, c), buffer + bytes * static_cast<std::size_t>(k), bytes);
    }
  }
}

/// Permutes entries [first, first + n) of one field by way of `buffer`.
void permute_field(const Field& field, Index first, std::span<const Index> order,
                   std::byte* buffer) {
  const auto one = static_cast<std::size_t>(size_of(field.type));
  if (field.layout.lanes != 1) return permute_blocked(field, first, order, buffer, one);
  const bool joined =
      field.components == 1 || field.layout.component_stride == static_cast<std::ptrdiff_t>(one);
  if (joined) {
    const std::size_t bytes = one * static_cast<std::size_t>(field.components);
    permute_pieces({field.at(first, 0), field.layout.entry_stride, bytes}, order, buffer);
    return;
  }
  for (int c = 0; c < field.components; ++c) {
    permute_pieces({field.at(first, c), field.layout.entry_stride, one}, order, buffer);
  }
}

void permute_index_lists(Scene& scene, std::span<const Index> order) {
  if (scene.index_lists.empty()) return;
  const auto n = static_cast<Index>(order.size());
  Array<Index> new_place(order.size());
  for (Index k = 0; k < n; ++k) new_place[order[k]] = k;
  for (IndexList& entry : scene.index_lists) {
    for (Index& i : *entry.list) {
      if (i >= 0 && i < n) i = new_place[i];
    }
  }
}

}  // namespace

void sort_into_columns(std::span<const Line> x, double width, bool serpentine, Columns& columns) {
  assert(width > 0);
  const auto n = static_cast<Index>(x.size());
  columns.serpentine = serpentine;
  columns.order.resize(x.size());
  if (n == 0) {
    columns.n_y = columns.n_z = 0;
    columns.start.assign(1, 0);
    return;
  }
  const Box box = box_of(x);
  lay_grid(box, n, width, columns);
  find_columns(x, columns);

  // A counting sort: start[c + 1] first counts, then is where the next point of column c goes, and
  // in the end is where column c ends.
  const Index n_columns = columns.n_y * columns.n_z;
  columns.start.assign(static_cast<std::size_t>(n_columns) + 2, 0);
  const Array<Index>& column = columns.column_of;
  for (Index i = 0; i < n; ++i) ++columns.start[column[i] + 2];
  for (Index c = 0; c < n_columns; ++c) columns.start[c + 2] += columns.start[c + 1];
  columns.key.resize(x.size());
  for (Index i = 0; i < n; ++i) {
    columns.key[columns.start[column[i] + 1]++] = static_cast<std::uint64_t>(i);
  }
  columns.start.pop_back();
  sort_along_x(x, box, columns);
}

void spatial_order(std::span<const Line> x, double dx, Array<Index>& order) {
  Columns columns;
  columns.order.swap(order);
  sort_into_columns(x, 2.0 * dx, true, columns);
  order.swap(columns.order);
}

void permute_particles(Scene& scene, std::span<const Index> order) {
  assert(static_cast<Index>(order.size()) <= scene.particles.size());
  const auto buffer = std::make_unique_for_overwrite<std::byte[]>(most_bytes * order.size());
  for (const Field& field : scene.fields) {
    Index first = 0;
    if (holds_particles(scene, field, first)) permute_field(field, first, order, buffer.get());
  }
  permute_index_lists(scene, order);
}

void sort_particles(Scene& scene, double dx) {
  Array<Index> order;
  const auto first = static_cast<std::size_t>(scene.particles.begin);
  const auto n = static_cast<std::size_t>(scene.awake().size());
  spatial_order(std::span<const Line>(scene.nodes.x).subspan(first, n), dx, order);
  permute_particles(scene, order);
}

}  // namespace gannet
