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

/// Whether cell c and one of its neighbours differ by more than they may.
bool cell_is_outdated(const ListAge& age, Index c) {
  const MotionBox& here = age.motion[c];
  for (const ListAge::Neighbour& neighbour : age.neighbours) {
    const Index other = neighbour_of(age, c, neighbour.away);
    if (other < 0 || age.motion[other].empty()) continue;
    const double allowed = std::max(std::min(age.skin[c], age.skin[other]), neighbour.allowed);
    if (largest_difference(here, age.motion[other]) > allowed) return true;
  }
  return false;
}

/// Each box joined with those up to `range` away along one direction of n cells, `stride` apart.
void join_along(const std::vector<MotionBox>& from, Index n, Index stride,
                std::vector<MotionBox>& to) {
  parallel_for(static_cast<Index>(from.size()) / n, 64, [&](Index begin, Index end) {
    for (Index line = begin; line < end; ++line) {
      const Index first = line / stride * stride * n + line % stride;
      for (Index i = 0; i < n; ++i) {
        MotionBox box;
        const Index last = std::min(i + range, n - 1);
        for (Index k = std::max(i - range, 0); k <= last; ++k) box.add(from[first + k * stride]);
        to[first + i * stride] = box;
      }
    }
  });
}

/// The motion of each cell and its neighbours together.
std::vector<MotionBox> motion_around(const ListAge& age) {
  std::vector<MotionBox> around(age.motion.size());
  std::vector<MotionBox> work(age.motion.size());
  join_along(age.motion, age.n[0], 1, around);
  join_along(around, age.n[1], age.n[0], work);
  join_along(work, age.n[2], age.n[0] * age.n[1], around);
  return around;
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

bool outdated(const ListAge& age) {
  const std::vector<MotionBox> around = motion_around(age);
  MotionBox all;
  for (const MotionBox& box : age.motion) all.add(box);
  if (largest_difference(all, all) > age.allowed_elsewhere) return true;
  const int found = parallel_reduce(
      age.n_cells(), 64, 0,
      [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) {
          if (age.motion[c].empty()) continue;
          // Most cells need no look at their neighbours: they do not differ from all of them.
          if (largest_difference(age.motion[c], around[c]) <= age.skin[c]) continue;
          if (cell_is_outdated(age, c)) return 1;
        }
        return 0;
      },
      [](int a, int b) { return a | b; });
  return found != 0;
}

std::vector<double> relative_motion(const ListAge& age) {
  const std::vector<MotionBox> around = motion_around(age);
  std::vector<double> motion(around.size(), 0);
  for (std::size_t c = 0; c < motion.size(); ++c) {
    if (!age.motion[c].empty()) motion[c] = largest_difference(age.motion[c], around[c]);
  }
  return motion;
}

}  // namespace gannet
