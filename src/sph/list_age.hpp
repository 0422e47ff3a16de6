// How long neighbour lists stay right. A list holds every pair that was nearer than 2 h + skin
// when it was built; it misses a pair only once two particles have moved towards each other by
// more than what was left. What counts is motion relative to what is near: water that flows fast
// but smoothly keeps its lists for many steps.
//
// At a build particles are put into cells of edge e. Two particles in cells (i, j, k) apart were
// then at least D = e |(max(|i|-1, 0), ...)| apart, so the lists hold as long as
//   |d_a - d_b| <= max(skin, D - 2 h)   for all cells up to `range` apart in each direction,
//   |d_a - d_b| <= range e - 2 h        for all others,
// with d the displacements since the build. Displacements in a cell are bounded by a box.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"
#include "base/parallel.hpp"

namespace gannet {

/// Smallest and largest displacement in a cell, by component [m].
struct MotionBox {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  [[nodiscard]] bool empty() const { return low.x() > high.x(); }
  void add(const Vec3& d) {
    low = low.cwiseMin(d);
    high = high.cwiseMax(d);
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

/// The cells of one build.
struct ListAge {
  /// A cell `away` from another, and what their displacements may differ by [m].
  struct Neighbour {
    std::array<Index, 3> away{};
    double allowed = 0;
  };
  std::array<Index, 3> n{};           ///< cells along x, y, z; x runs fastest
  double allowed_elsewhere = 0;       ///< between all other cells [m]
  Array<Index> start;                 ///< where the members of a cell begin; one more than cells
  Array<Index> member;                ///< sources, by cell
  std::vector<Neighbour> neighbours;  ///< the cell itself and one of each pair of directions
  std::vector<MotionBox> motion;      ///< of each cell, when last asked
  [[nodiscard]] Index n_cells() const { return n[0] * n[1] * n[2]; }
};

/// Puts the sources of a new list into cells. With particles far out the cells become larger, so
/// that there are at most 2 a particle (and 4096): lists are then made anew more often.
/// x: positions at the build [m], finite; support: 2 h [m]; skin, dx: [m], > 0. unseen: sources
/// that no list holds, and that are left out here too.
void start_ageing(std::span<const Line> x, double support, double skin, double dx, ListAge& age,
                  Range unseen = {});

/// True where the boxes age.motion allow that a pair is missing. Parallel.
bool outdated(const ListAge& age);

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
