#include "sph/list_age.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gannet {

namespace {

/// How many cells away are compared one by one.
constexpr Index range = 2;
/// How much further than 2 h these reach, in spacings: what water may move, relative to other
/// water further off, before lists are made anew.
constexpr double far_allowance = 2;

struct Grid {
  Vec3 low = Vec3::Zero();
  double edge = 0;
  std::array<Index, 3> n{};

  [[nodiscard]] Index cell_of(const Line& x) const {
    const Vec3 at = (xyz(x) - low) / edge;
    std::array<Index, 3> i{};
    for (std::size_t d = 0; d < 3; ++d) {
      i[d] = std::clamp(static_cast<Index>(at[static_cast<Eigen::Index>(d)]), Index{0}, n[d] - 1);
    }
    return (i[2] * n[1] + i[1]) * n[0] + i[0];
  }
};

/// Calls f(k) for all sources but the unseen.
template <class F>
void for_seen(std::span<const Line> x, Range unseen, F&& f) {
  const auto n = static_cast<Index>(x.size());
  const Index first = unseen.empty() ? n : unseen.begin;
  for (Index k = 0; k < first; ++k) f(k);
  for (Index k = unseen.end; !unseen.empty() && k < n; ++k) f(k);
}

Grid grid_of(std::span<const Line> x, Range unseen, double edge) {
  MotionBox box;
  for_seen(x, unseen, [&](Index k) { box.add(xyz(x[k])); });
  Grid grid{box.low, edge, {}};
  const double most = std::max(4096.0, 2.0 * static_cast<double>(x.size()));
  while (true) {
    const Vec3 n = ((box.high - box.low) / grid.edge).array().floor() + 1;
    if (n.prod() <= most) {
      for (std::size_t d = 0; d < 3; ++d) {
        grid.n[d] = static_cast<Index>(n[static_cast<Eigen::Index>(d)]);
      }
      return grid;
    }
    grid.edge *= 1.25;
  }
}

/// Counting sort of the sources by cell.
void sort_by_cell(std::span<const Line> x, Range unseen, const Grid& grid, ListAge& age) {
  age.n = grid.n;
  age.start.assign(static_cast<std::size_t>(age.n_cells() + 2), 0);
  age.member.resize(x.size() - static_cast<std::size_t>(unseen.size()));
  for_seen(x, unseen, [&](Index k) { ++age.start[grid.cell_of(x[k]) + 2]; });
  for (std::size_t c = 2; c < age.start.size(); ++c) age.start[c] += age.start[c - 1];
  for_seen(x, unseen, [&](Index k) { age.member[age.start[grid.cell_of(x[k]) + 1]++] = k; });
  age.start.pop_back();
  age.motion.resize(static_cast<std::size_t>(age.n_cells()));
}

/// The neighbour of cell c that is `away`, or -1 outside of the grid.
Index neighbour_of(const ListAge& age, Index c, const std::array<Index, 3>& away) {
  const Index i = c % age.n[0] + away[0];
  const Index j = c / age.n[0] % age.n[1] + away[1];
  const Index k = c / (age.n[0] * age.n[1]) + away[2];
  const bool inside = i >= 0 && i < age.n[0] && j >= 0 && j < age.n[1] && k >= 0 && k < age.n[2];
  return inside ? (k * age.n[1] + j) * age.n[0] + i : -1;
}

/// Whether cell c and one of these neighbours differ by more than they may.
bool cell_is_outdated(const ListAge& age, Index c, std::span<const ListAge::Neighbour> neighbours) {
  const MotionBox& here = age.motion[c];
  if (here.empty()) return false;
  for (const ListAge::Neighbour& neighbour : neighbours) {
    const Index other = neighbour_of(age, c, neighbour.away);
    if (other < 0 || age.motion[other].empty()) continue;
    if (largest_difference(here, age.motion[other]) > neighbour.allowed) return true;
  }
  return false;
}

/// Boxes of the motion of each row of cells along x.
std::vector<MotionBox> motion_of_rows(const ListAge& age) {
  std::vector<MotionBox> rows(static_cast<std::size_t>(age.n[1] * age.n[2]));
  for (Index r = 0; r < static_cast<Index>(rows.size()); ++r) {
    for (Index c = r * age.n[0]; c < (r + 1) * age.n[0]; ++c) rows[r].add(age.motion[c]);
  }
  return rows;
}

/// The neighbours by row: each stretch has the same steps along y and z.
std::vector<std::span<const ListAge::Neighbour>> by_row(const ListAge& age) {
  std::vector<std::span<const ListAge::Neighbour>> rows;
  const auto& all = age.neighbours;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].away[1] == all[begin].away[1] &&
           all[end].away[2] == all[begin].away[2]) {
      ++end;
    }
    rows.push_back(std::span(all).subspan(begin, end - begin));
  }
  return rows;
}

/// Whether cells of a row differ too much from those of the row that `neighbours` lie in. Most
/// rows need no look at their cells: as wholes they do not differ by that much.
bool rows_are_outdated(const ListAge& age, std::span<const MotionBox> rows, Index row,
                       std::span<const ListAge::Neighbour> neighbours) {
  const Index first = row * age.n[0];
  const Index other = neighbour_of(age, first, {0, neighbours[0].away[1], neighbours[0].away[2]});
  if (other < 0 || rows[other / age.n[0]].empty()) return false;
  double least = neighbours[0].allowed;
  for (const ListAge::Neighbour& n : neighbours) least = std::min(least, n.allowed);
  if (largest_difference(rows[row], rows[other / age.n[0]]) <= least) return false;
  for (Index c = first; c < first + age.n[0]; ++c) {
    if (cell_is_outdated(age, c, neighbours)) return true;
  }
  return false;
}

}  // namespace

void start_ageing(std::span<const Line> x, double support, double skin, double dx, ListAge& age,
                  Range unseen) {
  const Grid grid = grid_of(x, unseen, (support + far_allowance * dx) / range);
  sort_by_cell(x, unseen, grid, age);
  age.allowed_elsewhere = range * grid.edge - support;
  age.neighbours.clear();
  const auto gap = [&](Index steps) { return grid.edge * std::max(std::abs(steps) - 1, 0); };
  for (Index k = 0; k <= range; ++k) {
    for (Index j = -range; j <= range; ++j) {
      for (Index i = -range; i <= range; ++i) {
        if (k == 0 && (j < 0 || (j == 0 && i < 0))) continue;
        const double apart = Vec3(gap(i), gap(j), gap(k)).norm();
        age.neighbours.push_back({{i, j, k}, std::max(skin, apart - support)});
      }
    }
  }
}

bool outdated(const ListAge& age) {
  const std::vector<MotionBox> rows = motion_of_rows(age);
  MotionBox all;
  for (const MotionBox& box : rows) all.add(box);
  if (largest_difference(all, all) > age.allowed_elsewhere) return true;
  const auto neighbours = by_row(age);
  const int found = parallel_reduce(
      static_cast<Index>(rows.size()), 4, 0,
      [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
          if (rows[row].empty()) continue;
          for (const auto& stretch : neighbours) {
            if (rows_are_outdated(age, rows, row, stretch)) return 1;
          }
        }
        return 0;
      },
      [](int a, int b) { return a | b; });
  return found != 0;
}

}  // namespace gannet
