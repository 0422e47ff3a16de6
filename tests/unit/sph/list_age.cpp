#include "sph/list_age.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sph/list_skin.hpp"

using namespace gannet;

namespace {

constexpr double dx = 0.1;
constexpr double support_radius = 0.26;
constexpr double skin = 0.03;

/// Particles of a long bar, three by three across, on a lattice of spacing dx.
Array<Line> bar(int length) {
  Array<Line> x;
  for (int i = 0; i < length; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) x.push_back({i * dx, j * dx, k * dx, 0});
    }
  }
  return x;
}

/// Age of lists of x after displacements d(x); skins are evened out.
template <class D>
bool outdated_after(const Array<Line>& x, Array<double>& skins, const D& d) {
  ListAge age;
  start_ageing(x, skins, support_radius, dx, age);
  measure_motion(age, [&](Index k) -> Vec3 { return d(xyz(x[k])); });
  return outdated(age);
}

/// The same with one skin for all.
template <class D>
bool outdated_after(const Array<Line>& x, const D& d) {
  Array<double> skins(x.size(), skin);
  return outdated_after(x, skins, d);
}

}  // namespace

TEST_CASE("list age: moving together ages nothing, however far", "[sph]") {
  CHECK_FALSE(outdated_after(bar(100), [](const Vec3&) { return Vec3(7, -3, 2); }));
}

TEST_CASE("list age: neighbours may differ by the skin, no more", "[sph]") {
  const auto half_moves = [](double by) {
    return outdated_after(bar(100),
                          [by](const Vec3& x) { return Vec3(0, x.x() > 5.02 ? by : 0, 0); });
  };
  CHECK_FALSE(half_moves(0.99 * skin));
  CHECK(half_moves(1.01 * skin));
}

TEST_CASE("list age: the thinner skin of two cells counts", "[sph]") {
  // Cells end at 7.13, where the skin changes, and so does the motion.
  const Array<Line> x = bar(100);
  const auto one_side_moves = [&](double by, bool right_is_thick, bool right_moves) {
    Array<double> skins;
    for (const Line& p : x) skins.push_back((p.x > 7.13) == right_is_thick ? 4 * skin : skin);
    return outdated_after(x, skins, [=](const Vec3& p) {
      return Vec3(0, (p.x() > 7.13) == right_moves ? by : 0, 0);
    });
  };
  for (const bool thick : {false, true}) {
    for (const bool moves : {false, true}) {
      CHECK_FALSE(one_side_moves(0.99 * skin, thick, moves));
      CHECK(one_side_moves(1.01 * skin, thick, moves));
      CHECK(one_side_moves(3.99 * skin, thick, moves));
    }
  }
}

TEST_CASE("list age: skins count where they are, and those of cells without targets do not",
          "[sph]") {
  const Array<Line> x = bar(100);
  const auto last_moves = [&](double by, std::size_t n_targets, double skin_of_others) {
    Array<double> skins(n_targets, skin_of_others);
    for (std::size_t k = 0; k < n_targets; ++k) {
      if (x[k].x > 7) skins[k] = 4 * skin;
    }
    return outdated_after(x, skins,
                          [by](const Vec3& p) { return Vec3(0, p.x() > 9.7 ? by : 0, 0); });
  };
  CHECK_FALSE(last_moves(3.99 * skin, x.size(), skin));
  CHECK(last_moves(4.01 * skin, x.size(), skin));
  CHECK_FALSE(last_moves(3.9 * skin, x.size() - 9 * 2, 4 * skin));
  CHECK_FALSE(last_moves(6 * skin, x.size() - 9 * 20, skin));  // ghosts, far from all targets
}

TEST_CASE("list age: rows of cells along y and z count as those along x", "[sph]") {
  const auto turned_half_moves = [](int turn, double by) {
    Array<Line> x = bar(100);
    for (Line& p : x) {
      p = turn == 1 ? Line{p.y, p.x, p.z, 0} : Line{p.y, p.z, p.x, 0};
    }
    return outdated_after(x, [=](const Vec3& p) { return Vec3(p[turn] > 5.02 ? by : 0, 0, 0); });
  };
  for (const int turn : {1, 2}) {
    CHECK_FALSE(turned_half_moves(turn, 0.99 * skin));
    CHECK(turned_half_moves(turn, 1.01 * skin));
  }
}

TEST_CASE("list age: there are no more cells than sources, however far apart they are", "[sph]") {
  Array<Line> x = bar(10);
  for (const Line& p : bar(10)) x.push_back({p.x + 20, p.y + 20, p.z + 20, 0});
  Array<double> skins(x.size(), skin);
  ListAge age;
  start_ageing(x, skins, support_radius, dx, age);
  CHECK(age.n_cells() <= static_cast<Index>(x.size()));
  std::vector<int> times(x.size(), 0);
  for (Index c = 0; c < age.n_cells(); ++c) {
    CHECK(age.start[c] < age.start[c + 1]);
    CHECK(age.cell_at[age.place[c]] == c);
    for (Index k = age.start[c]; k < age.start[c + 1]; ++k) ++times[age.member[k]];
  }
  CHECK(std::count(times.begin(), times.end(), 1) == static_cast<int>(x.size()));
}

TEST_CASE("list age: targets of a cell get the largest skin among them", "[sph]") {
  const Array<Line> x = bar(100);
  Array<double> skins(x.size(), skin);
  skins[500] = 2 * skin;
  ListAge age;
  start_ageing(x, skins, support_radius, dx, age);
  Array<double> again = skins;
  start_ageing(x, again, support_radius, dx, age);
  CHECK(again == skins);
  for (Index c = 0; c < age.n_cells(); ++c) {
    for (Index k = age.start[c]; k < age.start[c + 1]; ++k) {
      CHECK(skins[age.member[k]] == age.skin[c]);
    }
  }
  CHECK(std::count(skins.begin(), skins.end(), 2 * skin) > 9);
  CHECK(std::count(skins.begin(), skins.end(), 2 * skin) < 100);
}

TEST_CASE("list age: motion is relative to the cells around", "[sph]") {
  const Array<Line> x = bar(100);
  Array<double> skins(x.size(), skin);
  ListAge age;
  start_ageing(x, skins, support_radius, dx, age);
  measure_motion(age, [&](Index k) -> Vec3 { return {5, x[k].x > 9.85 ? 0.02 : 0.0, 0}; });
  const std::vector<double> motion = relative_motion(age);
  CHECK(motion.front() == 0);
  CHECK(motion.back() == Approx(0.02).epsilon(1e-12));
}

TEST_CASE("list age: a gentle shear lasts longer than its ends are apart", "[sph]") {
  const auto sheared = [](double rate) {
    return outdated_after(bar(100), [rate](const Vec3& x) { return Vec3(0, rate * x.x(), 0); });
  };
  CHECK_FALSE(sheared(0.015));  // the ends differ by 5 skins, neighbouring cells by 1.4/2 of one
  CHECK(sheared(0.2));
}

TEST_CASE("list age: bodies that were far apart are seen when they may have met", "[sph]") {
  Array<Line> x = bar(10);
  for (const Line& p : bar(10)) x.push_back({p.x + 3, p.y, p.z, 0});
  const auto approach = [&](double by) {
    return outdated_after(x, [by](const Vec3& p) { return Vec3(p.x() > 2 ? -by : 0, 0, 0); });
  };
  CHECK_FALSE(approach(0.1));  // three skins: they are still far apart
  CHECK(approach(2.2));        // 2.1 between the nearest: they overlap
}

TEST_CASE("list age: no motion may hide a pair that came within the support_radius", "[sph]") {
  // Displacements of many lengths: whenever the age says that all is well, a search over all pairs
  // finds none that is near now and was further than the list's reach before.
  const Array<Line> x = bar(60);
  Array<double> skins;
  for (const Line& p : x) skins.push_back(p.x < 2 ? skin : 0.5 * skin * (1 + p.x));
  int n_good = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double size = 0.002 * (1 + trial);
    const auto d = [&](const Vec3& p) {
      return Vec3(size * std::sin(3 * p.x() + trial), size * std::cos(2 * p.x()),
                  0.3 * size * std::sin(9 * p.y()));
    };
    if (outdated_after(x, skins, d)) continue;
    ++n_good;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (const Line& b : x) {
        const Vec3 before = xyz(x[i]) - xyz(b);
        const Vec3 now = before + d(xyz(x[i])) - d(xyz(b));
        if (now.norm() < support_radius && before.norm() > support_radius + skins[i])
          FAIL("a pair is missing");
      }
    }
  }
  CHECK(n_good > 5);
  CHECK(n_good < 60);
}

TEST_CASE("list skin: lists last as long as costs least, within the bounds of skins", "[sph]") {
  // n = sqrt(1.5 dx/(1.3 u)); the largest skin, 1.3 n times the largest motion, is at most 0.5.
  const ListSkin skin{.least = 0.1, .most = 0.5};
  CHECK(steps_to_last(skin, 0.04, 0.04, 1) == Approx(std::sqrt(1.5 / (1.3 * 0.04))));
  CHECK(steps_to_last(skin, 0.04, 0.1, 1) == Approx(0.5 / 0.13));
  CHECK(steps_to_last(skin, 0.04, 10, 1) == 1);
  CHECK(steps_to_last(skin, 0, 0, 1) == 1000);
  CHECK(skin_for(skin, 0.04, 5) == Approx(0.26));
  CHECK(skin_for(skin, 0.001, 5) == 0.1);
  CHECK(skin_for(skin, 0.2, 5) == 0.5);
  const ListSkin said{.least = 0.3, .most = 0.3};
  CHECK(skin_for(said, 0.2, 5) == 0.3);
  CHECK(skin_for(said, 0, 5) == 0.3);
}
