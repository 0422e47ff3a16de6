// How long neighbour lists stay right. A list holds every pair that was nearer than 2 h + skin
// when it was built; it misses a pair only once two particles have moved towards each other by
// more than what was left. What counts is motion relative to what is near: water that flows fast
// but smoothly keeps its lists for many steps. Skins differ from place to place: the few particles
// that move much relative to their neighbours have thick ones, so that all lists last as long.
//
// At a build particles are put into cells of edge e. Two particles in cells (i, j, k) apart were
// then at least D = e |(max(|i|-1, 0), ...)| apart, so the lists hold as long as
//   |d_a - d_b| <= max(min(s_a, s_b), D - 2 h)   for all cells up to `range` apart,
//   |d_a - d_b| <= min(range e - 2 h, 2 h)       for all others,
// with d the displacements since the build and s the skin of the targets in a cell; a cell without
// any has no lists of its own to grow old. Displacements in a cell are bounded by a box.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"
#include "base/parallel.hpp"

namespace gannet {

/// Smallest and largest displacement in a cell, by component; the fourth is 0 [m].
struct MotionBox {
  using Bounds = Eigen::Vector4d;
  Bounds low = Bounds::Constant(std::numeric_limits<double>::infinity());
  Bounds high = Bounds::Constant(-std::numeric_limits<double>::infinity());
  [[nodiscard]] bool empty() const { return low.x() > high.x(); }
  void add(const Vec3& d) {
    const Bounds bounds(d.x(), d.y(), d.z(), 0);
    low = low.cwiseMin(bounds);
    high = high.cwiseMax(bounds);
  }
  void add(const MotionBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
};

/// The largest distance of a point of one box from a point of another [m]; both not empty.
inline double largest_difference(const MotionBox& a, const MotionBox& b) {
  return (a.high - b.low).cwiseMax(b.high - a.low).norm();
}

/// The cells of one build: those with a source in them, by z, y, x.
struct ListAge {
  /// A cell `away` from another, and what their displacements may differ by without a skin [m].
  struct Neighbour {
    std::array<Index, 3> away{};
    double allowed = 0;
  };
  /// The cells along x with the same y and z.
  struct Row {
    Index begin = 0;
    Index end = 0;
    double skin = std::numeric_limits<double>::infinity();  ///< the smallest in it [m]
    MotionBox motion;
  };
  std::array<Index, 3> n{};           ///< places of cells along x, y, z; x runs fastest
  double allowed_elsewhere = 0;       ///< between all other cells [m]
  double least_skin = 0;              ///< of all rows [m]
  Array<Index> place;                 ///< of each cell
  Array<Index> cell_at;               ///< by place; -1 where there is none
  Array<Index> row_at;                ///< by place/n[0]; -1 where there is none
  Array<Index> start;                 ///< where the members of a cell begin; one more than cells
  Array<Index> member;                ///< sources, by cell
  std::vector<double> skin;           ///< of the targets in a cell; infinite without any [m]
  std::vector<Neighbour> neighbours;  ///< all cells up to `range` away, the cell itself too
  std::vector<MotionBox> motion;      ///< of each cell, when last asked
  std::vector<Row> rows;
  [[nodiscard]] Index n_cells() const { return static_cast<Index>(place.size()); }
};

/// Puts the sources of a new list into cells, and gives all targets in a cell the largest skin
/// among them. With particles far out the cells become larger, so that there are at most 2 a
/// particle (and 4096): lists are then made anew more often. x: positions at the build [m], finite;
/// skin: of each target, the first of the sources [m], > 0; support: 2 h; dx: [m], > 0. unseen:
/// sources that no list holds, none of them a target, and that are left out here too.
void start_ageing(std::span<const Line> x, std::span<double> skin, double support, double dx,
                  ListAge& age, Range unseen = {});

/// True where the boxes age.motion allow that a pair is missing. Finds age.rows[].motion. Parallel.
bool outdated(ListAge& age);

/// How much the displacements in each cell, by the boxes age.motion, may differ from those in cells
/// up to `range` away [m]. Parallel.
std::vector<double> relative_motion(const ListAge& age);

/// Fills age.motion from displacement(source), a Vec3 [m]; it is called from several threads.
template <class D>
void measure_motion(ListAge& age, const D& displacement) {
  parallel_for(age.n_cells(), 64, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      MotionBox box;
      for (Index k = age.start[c]; k < age.start[c + 1]; ++k) box.add(displacement(age.member[k]));
      age.motion[c] = box;
    }
  });
}

}  // namespace gannet
