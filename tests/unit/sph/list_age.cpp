#include "sph/list_age.hpp"

#include <catch2/catch.hpp>
#include <cmath>

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

/// Age of lists of x after displacements d(x).
template <class D>
bool outdated_after(const Array<Line>& x, const D& d) {
  ListAge age;
  start_ageing(x, support_radius, skin, dx, age);
  measure_motion(age, [&](Index k) -> Vec3 { return d(xyz(x[k])); });
  return outdated(age);
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
  int n_good = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double size = 0.002 * (1 + trial);
    const auto d = [&](const Vec3& p) {
      return Vec3(size * std::sin(3 * p.x() + trial), size * std::cos(2 * p.x()),
                  0.3 * size * std::sin(9 * p.y()));
    };
    if (outdated_after(x, d)) continue;
    ++n_good;
    for (const Line& a : x) {
      for (const Line& b : x) {
        const Vec3 before = xyz(a) - xyz(b);
        const Vec3 now = before + d(xyz(a)) - d(xyz(b));
        if (now.norm() < support_radius && before.norm() > support_radius + skin)
          FAIL("a pair is missing");
      }
    }
  }
  CHECK(n_good > 5);
  CHECK(n_good < 60);
}

TEST_CASE("list skin: follows the motion of a step, within its bounds", "[sph]") {
  // s = sqrt(1.5 u dx), u = width/steps.
  ListSkin skin{.width = 0.2, .least = 0.1, .most = 0.5, .steps = 5};
  adapt(skin, 1);
  CHECK(skin.width == Approx(std::sqrt(1.5 * 0.04)));
  skin = {.width = 0.2, .least = 0.1, .most = 0.5, .steps = 0};  // old before they were used
  adapt(skin, 1);
  CHECK(skin.width == 0.5);
  skin = {.width = 0.2, .least = 0.1, .most = 0.5, .steps = 1000};
  adapt(skin, 1);
  CHECK(skin.width == 0.1);
  skin = {.width = 0.3, .least = 0.3, .most = 0.3, .steps = 2};  // said by the case
  adapt(skin, 1);
  CHECK(skin.width == 0.3);
}
