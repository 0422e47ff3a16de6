#include "sph/list_age.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gannet {

namespace {

/// How many cells away are compared one by one.
constexpr Index range = 2;
/// How much further than 2 h these reach, in spacings: what water may move, relative to other
/// water further off, before lists are made anew.
constexpr double far_allowance = 2;
/// Rows of cells a chunk.
constexpr Index row_chunk = 8;

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
  const Vec3 high = box.high.head<3>();
  Grid grid{Vec3::Zero(), edge, {}};
  const double most = std::max(4096.0, 2.0 * static_cast<double>(x.size()));
  while (!box.empty()) {
    // Cells stand where they stood at the last build, so that what was found out there holds here.
    grid.low = grid.edge * (box.low.head<3>() / grid.edge).array().floor();
    const Vec3 n = ((high - grid.low) / grid.edge).array().floor() + 1;
    if (n.prod() <= most) {
      for (std::size_t d = 0; d < 3; ++d) {
        grid.n[d] = static_cast<Index>(n[static_cast<Eigen::Index>(d)]);
      }
      return grid;
    }
    grid.edge *= 1.25;
  }
  grid.n = {1, 1, 1};
  return grid;
}

/// Numbers the cells that have members, of those counted in age.cell_at, and their rows.
void find_cells(ListAge& age) {
  age.place.clear();
  age.start.assign(1, 0);
  age.rows.clear();
  age.row_at.assign(static_cast<std::size_t>(age.n[1] * age.n[2]), -1);
  for (Index place = 0; place < static_cast<Index>(age.cell_at.size()); ++place) {
    const Index count = std::exchange(age.cell_at[place], -1);
    if (count == 0) continue;
    const Index cell = age.n_cells();
    age.cell_at[place] = cell;
    age.place.push_back(place);
    age.start.push_back(age.start.back() + count);
    Index& row = age.row_at[place / age.n[0]];
    if (row < 0) {
      row = static_cast<Index>(age.rows.size());
      age.rows.push_back({.begin = cell});
    }
    age.rows[row].end = cell + 1;
  }
}

/// Counting sort of the sources by cell.
void sort_by_cell(std::span<const Line> x, Range unseen, const Grid& grid, ListAge& age) {
  age.n = grid.n;
  age.cell_at.assign(static_cast<std::size_t>(age.n[0] * age.n[1] * age.n[2]), 0);
  for_seen(x, unseen, [&](Index k) { ++age.cell_at[grid.cell_of(x[k])]; });
  find_cells(age);
  Array<Index> next(age.start.begin(), age.start.end() - 1);
  age.member.resize(static_cast<std::size_t>(age.start.back()));
  for_seen(x, unseen, [&](Index k) { age.member[next[age.cell_at[grid.cell_of(x[k])]]++] = k; });
  age.motion.resize(age.place.size());
}

/// The neighbour of cell c that is `away`, or -1.
Index neighbour_of(const ListAge& age, Index c, const std::array<Index, 3>& away) {
  const Index place = age.place[c];
  const Index i = place % age.n[0] + away[0];
  const Index j = place / age.n[0] % age.n[1] + away[1];
  const Index k = place / (age.n[0] * age.n[1]) + away[2];
  const bool inside = i >= 0 && i < age.n[0] && j >= 0 && j < age.n[1] && k >= 0 && k < age.n[2];
  return inside ? age.cell_at[(k * age.n[1] + j) * age.n[0] + i] : -1;
}

/// Whether cell c and one of its neighbours differ by more than they may.
bool cell_is_outdated(const ListAge& age, Index c) {
  for (const ListAge::Neighbour& neighbour : age.neighbours) {
    const Index other = neighbour_of(age, c, neighbour.away);
    if (other < 0) continue;
    const double allowed = std::max(std::min(age.skin[c], age.skin[other]), neighbour.allowed);
    if (largest_difference(age.motion[c], age.motion[other]) > allowed) return true;
  }
  return false;
}

/// Calls f(other) for a row and those up to `range` away from it.
template <class F>
void for_rows_around(const ListAge& age, const ListAge::Row& row, F&& f) {
  const Index at = age.place[row.begin] / age.n[0];
  const Index j = at % age.n[1];
  const Index k = at / age.n[1];
  for (Index b = std::max(k - range, 0); b <= std::min(k + range, age.n[2] - 1); ++b) {
    for (Index a = std::max(j - range, 0); a <= std::min(j + range, age.n[1] - 1); ++a) {
      const Index other = age.row_at[b * age.n[1] + a];
      if (other >= 0) f(age.rows[other]);
    }
  }
}

/// Calls f(cell, motion of it and its neighbours together) for the cells of a row, until that is
/// true; whether it was. work: of no meaning.
template <class F>
bool any_in_row(const ListAge& age, const ListAge::Row& row, std::vector<MotionBox>& work, F&& f) {
  const Index first = age.place[row.begin] % age.n[0] - range;
  const Index last = age.place[row.end - 1] % age.n[0] + range;
  work.assign(static_cast<std::size_t>(last - first + 1), {});
  for_rows_around(age, row, [&](const ListAge::Row& other) {
    for (Index c = other.begin; c < other.end; ++c) {
      const Index i = age.place[c] % age.n[0];
      if (i >= first && i <= last) work[i - first].add(age.motion[c]);
    }
  });
  for (Index c = row.begin; c < row.end; ++c) {
    const Index i = age.place[c] % age.n[0] - first;
    MotionBox around;
    for (Index k = i - range; k <= i + range; ++k) around.add(work[k]);
    if (f(c, around)) return true;
  }
  return false;
}

/// Whether one of these rows may miss a pair. Most need no look at their cells: as a whole they
/// do not differ from those around. Nor do most cells at each of their neighbours.
bool rows_are_outdated(const ListAge& age, Index begin, Index end) {
  std::vector<MotionBox> work;
  for (Index r = begin; r < end; ++r) {
    const ListAge::Row& row = age.rows[r];
    MotionBox around;
    for_rows_around(age, row, [&](const ListAge::Row& other) { around.add(other.motion); });
    if (largest_difference(row.motion, around) <= row.skin) continue;
    const bool found = any_in_row(age, row, work, [&](Index c, const MotionBox& box) {
      return largest_difference(age.motion[c], box) > age.skin[c] && cell_is_outdated(age, c);
    });
    if (found) return true;
  }
  return false;
}

/// Finds the motion of each row; that of all.
MotionBox join_rows(ListAge& age) {
  return parallel_reduce(
      static_cast<Index>(age.rows.size()), row_chunk, MotionBox{},
      [&](Index begin, Index end) {
        MotionBox all;
        for (Index r = begin; r < end; ++r) {
          MotionBox box;
          for (Index c = age.rows[r].begin; c < age.rows[r].end; ++c) box.add(age.motion[c]);
          age.rows[r].motion = box;
          all.add(box);
        }
        return all;
      },
      [](MotionBox a, const MotionBox& b) {
        a.add(b);
        return a;
      });
}

/// Gives the targets of each cell the largest skin among them.
void even_out(std::span<double> skin, ListAge& age) {
  const auto n_targets = static_cast<Index>(skin.size());
  age.skin.resize(static_cast<std::size_t>(age.n_cells()));
  parallel_for(age.n_cells(), 64, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      double largest = 0;
      for (Index k = age.start[c]; k < age.start[c + 1]; ++k) {
        const Index i = age.member[k];
        if (i < n_targets) largest = std::max(largest, skin[i]);
      }
      for (Index k = age.start[c]; k < age.start[c + 1]; ++k) {
        if (age.member[k] < n_targets) skin[age.member[k]] = largest;
      }
      age.skin[c] = largest > 0 ? largest : std::numeric_limits<double>::infinity();
    }
  });
  age.least_skin = std::numeric_limits<double>::infinity();
  for (ListAge::Row& row : age.rows) {
    row.skin = *std::min_element(age.skin.begin() + row.begin, age.skin.begin() + row.end);
    age.least_skin = std::min(age.least_skin, row.skin);
  }
}

}  // namespace

void start_ageing(std::span<const Line> x, std::span<double> skin, double support, double dx,
                  ListAge& age, Range unseen) {
  const Grid grid = grid_of(x, unseen, (support + far_allowance * dx) / range);
  sort_by_cell(x, unseen, grid, age);
  even_out(skin, age);
  // Two particles too far from a periodic end to have images there are 2 (2 h + skin) apart across
  // it, which no cell tells: however large cells are, they may not move towards each other by more
  // than 2 h.
  age.allowed_elsewhere = std::min(range * grid.edge - support, support);
  age.neighbours.clear();
  const auto gap = [&](Index steps) { return grid.edge * std::max(std::abs(steps) - 1, 0); };
  for (Index k = -range; k <= range; ++k) {
    for (Index j = -range; j <= range; ++j) {
      for (Index i = -range; i <= range; ++i) {
        const double apart = Vec3(gap(i), gap(j), gap(k)).norm();
        age.neighbours.push_back({{i, j, k}, apart - support});
      }
    }
  }
}

bool outdated(ListAge& age) {
  const MotionBox all = join_rows(age);
  if (all.empty()) return false;
  const double most = largest_difference(all, all);
  if (most > age.allowed_elsewhere) return true;
  if (most <= age.least_skin) return false;
  return parallel_reduce(
             static_cast<Index>(age.rows.size()), row_chunk, 0,
             [&](Index begin, Index end) { return rows_are_outdated(age, begin, end) ? 1 : 0; },
             [](int a, int b) { return a | b; }) != 0;
}

std::vector<double> relative_motion(const ListAge& age) {
  std::vector<double> motion(age.motion.size());
  parallel_for(static_cast<Index>(age.rows.size()), row_chunk, [&](Index begin, Index end) {
    std::vector<MotionBox> work;
    for (Index r = begin; r < end; ++r) {
      any_in_row(age, age.rows[r], work, [&](Index c, const MotionBox& around) {
        motion[c] = largest_difference(age.motion[c], around);
        return false;
      });
    }
  });
  return motion;
}

}  // namespace gannet
