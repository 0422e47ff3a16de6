// The part of the list build that is compiled once per instruction set: plain pointers in and out.
// Callers use search/cluster_list.hpp.
#pragma once

#include <cstdint>

namespace gannet {

/// One call of the list kernel: clusters [first, last) of targets against sources in columns.
/// Coordinates are relative to an origin near most particles, so that single precision does.
struct ListJob {
  const double* target = nullptr;  ///< 4 doubles a target: x y z w [m], not relative
  std::int32_t n_targets = 0;
  std::int32_t first = 0;
  std::int32_t last = 0;
  double origin[3] = {0, 0, 0};
  // The sources in column order; rising in x within a column. 16 entries of padding.
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const std::int32_t* index = nullptr;  ///< their source numbers
  const std::int32_t* start = nullptr;  ///< n_y n_z + 1
  std::int32_t n_y = 0;
  std::int32_t n_z = 0;
  double y_min = 0;  ///< of the column grid, relative
  double z_min = 0;
  double width = 0;
  double radius = 0;
  const double* further = nullptr;  ///< how much further the list of a target reaches, or null [m]
  std::int32_t filler = 0;          ///< pads lists to even length
  std::int32_t* out = nullptr;      ///< the lists, one after the other
  std::int64_t capacity = 0;        ///< of out
  std::int64_t* count = nullptr;  ///< length of each list, one entry for each cluster from `first`
};

/// How far a call came: it stops before the cluster that might not fit into `out`.
struct ListProgress {
  std::int32_t next = 0;  ///< first cluster that is not done
  std::int64_t used = 0;  ///< entries of out
};

namespace avx2 {
ListProgress list_clusters(const ListJob& job);
}
namespace avx512 {
ListProgress list_clusters(const ListJob& job);
}

}  // namespace gannet
