#include "contact/gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "contact/force.hpp"
#include "scenes.hpp"

using namespace gannet;

namespace {

/// A sheet, and gaps of single points against all of its segments.
struct Sheet {
  Scene scene;
  Surface surface;
  std::vector<Index> all;
  GapRange range = GapRange::of(0.4);

  explicit Sheet(const test::Builder& b) {
    b.fill(scene);
    surface = make_surface(scene.parts[0]);
    update_surface(scene.nodes, surface);
    for (std::size_t s = 0; s < surface.segments.size(); ++s) {
      all.push_back(static_cast<Index>(s));
    }
  }
  Gap gap(const Vec3& x, std::int32_t& side) const {
    return gap_of(surface, nearest_segment(surface, all, x, range.near), x, range, side);
  }
  Vec3 force(const Vec3& x, std::int32_t& side) const {
    const Gap g = gap(x, side);
    return g.penetration > 0 ? penalty_force(1, g) : Vec3(Vec3::Zero());
  }
};

test::Builder flat() {
  test::Builder b;
  b.nx = 4;
  b.ny = 4;
  return b;
}

/// A sheet bent by `angle` in total at every line x = const.
test::Builder bent(double angle) {
  test::Builder b;
  b.nx = 8;
  b.ny = 2;
  b.shape = [angle](double x, double y) {
    Vec3 p(0, y, 0);
    for (int k = 0; k < static_cast<int>(std::lround(x)); ++k) {
      p += Vec3(std::cos(k * angle), 0, std::sin(k * angle));
    }
    return p;
  };
  return b;
}

/// Largest change of the force between neighbouring places of a walk along x = 1.5 .. 4.5 (arc of
/// the bent sheet) at a distance `height` from it, as a share of the force; the smooth turning of
/// the normal itself is made small by small steps.
double largest_jump(const Sheet& sheet, double angle, double height, int n) {
  std::int32_t side = 0;
  double jump = 0;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i <= n; ++i) {
    const double s = 1.5 + 3.0 * i / n;
    Vec3 p(0, 0.77, 0);
    double left = s;
    int k = 0;
    for (; left > 1; left -= 1, ++k) p += Vec3(std::cos(k * angle), 0, std::sin(k * angle));
    p += left * Vec3(std::cos(k * angle), 0, std::sin(k * angle));
    const double turn = (std::floor(s) + 0.5 * 0) * angle;
    p += height * Vec3(-std::sin(turn), 0, std::cos(turn));
    const Vec3 f = sheet.force(p, side);
    if (i > 0) jump = std::max(jump, (f - last).norm() / last.norm());
    last = f;
  }
  return jump;
}

}  // namespace

TEST_CASE("gap: penetration and direction on both sides, by hand", "[contact]") {
  const Sheet s(flat());
  std::int32_t side = 0;
  Gap g = s.gap({1.25, 2.5, 0.3}, side);
  CHECK(side == 1);
  CHECK(g.segment == 9);
  CHECK(g.penetration == Approx(0.1));
  CHECK((g.normal - Vec3::UnitZ()).norm() < 1e-14);
  CHECK(g.N[0] == Approx(0.375));
  CHECK(g.N[1] == Approx(0.125));
  side = 0;
  g = s.gap({1.25, 2.5, -0.3}, side);
  CHECK(side == -1);
  CHECK(g.penetration == Approx(0.1));
  CHECK((g.normal + Vec3::UnitZ()).norm() < 1e-14);
}

TEST_CASE("gap: a point that passed the mid-surface is pushed back to its side", "[contact]") {
  const Sheet s(flat());
  std::int32_t side = 0;
  (void)s.gap({1.2, 2.3, 0.3}, side);
  const Gap g = s.gap({1.2, 2.3, -0.1}, side);
  CHECK(side == 1);
  CHECK(g.penetration == Approx(0.5));
  CHECK((g.normal - Vec3::UnitZ()).norm() < 1e-13);
  const Gap on = s.gap({1.2, 2.3, 0}, side);  // exactly on it
  CHECK(on.penetration == Approx(0.4));
  CHECK((on.normal - Vec3::UnitZ()).norm() < 1e-13);
  // Further than the near distance, it is forgotten.
  CHECK(s.gap({1.2, 2.3, 0.51}, side).segment == -1);
  CHECK(side == 0);
}

TEST_CASE("gap: on an edge, a corner and a diagonal the force is that of the plane", "[contact]") {
  const Sheet s(flat());
  for (const Vec3& x : {Vec3(2, 1.5, 0.3), Vec3(2, 2, 0.3), Vec3(1.5, 1.5, 0.3), Vec3(2, 1.5, -0.3),
                        Vec3(2, 2, -0.3)}) {
    std::int32_t side = 0;
    const Vec3 f = s.force(x, side);
    CHECK((f - Vec3(0, 0, x.z() > 0 ? 0.1 : -0.1)).norm() < 1e-14);
  }
  std::int32_t side = 0;
  const Gap g = s.gap({2, 2, 0.3}, side);
  CHECK(g.segment == 5);  // the lowest of the four around it
  CHECK(g.N[2] == Approx(1));
}

TEST_CASE("gap: a point may pass around the rim", "[contact]") {
  const Sheet s(flat());
  std::int32_t side = 0;
  Gap g = s.gap({-0.1, 2, 0.1}, side);
  CHECK(side == 1);
  g = s.gap({-0.2, 2, 0}, side);  // level with the sheet: pushed outwards
  CHECK((g.normal + Vec3::UnitX()).norm() < 1e-14);
  CHECK(g.penetration == Approx(0.2));
  g = s.gap({-0.1, 2, -0.1}, side);
  CHECK(side == -1);
  CHECK(g.penetration == Approx(0.4 - std::hypot(0.1, 0.1)));
  g = s.gap({0.1, 2, -0.3}, side);
  CHECK((g.normal + Vec3::UnitZ()).norm() < 1e-14);
}

TEST_CASE("gap: an element that has left leaves a hole with a rim around it", "[contact]") {
  Sheet s(flat());
  std::vector<std::uint8_t> gone(16, 0);
  s.surface.gone = &gone;
  gone[5] = 1;  // 1 < x < 2, 1 < y < 2
  update_surface(s.scene.nodes, s.surface);
  std::int32_t side = 0;
  CHECK(s.gap({1.5, 1.5, 0.2}, side).segment == -1);  // half a unit from its rim
  // Beside the hole nothing has changed.
  Gap g = s.gap({0.7, 1.5, 0.3}, side);
  CHECK(g.segment == 4);
  CHECK((g.normal - Vec3::UnitZ()).norm() < 1e-14);
  // A point may pass around the new rim, as around an old one.
  g = s.gap({1.1, 1.5, 0.1}, side);
  CHECK(side == 1);
  g = s.gap({1.2, 1.5, 0}, side);
  CHECK((g.normal - Vec3::UnitX()).norm() < 1e-14);
  CHECK(g.penetration == Approx(0.2));
  g = s.gap({1.1, 1.5, -0.1}, side);
  CHECK(side == -1);
  CHECK(g.penetration == Approx(0.4 - std::hypot(0.1, 0.1)));
  // So may one at the corner of the hole.
  side = 0;
  (void)s.gap({1.1, 1.1, 0.1}, side);
  (void)s.gap({1.1, 1.1, -0.1}, side);
  CHECK(side == -1);
  // Who leaves later opens the same rim as who leaves at once.
  gone[6] = 1;
  update_surface(s.scene.nodes, s.surface);
  Sheet at_once(flat());
  at_once.surface.gone = &gone;
  update_surface(at_once.scene.nodes, at_once.surface);
  CHECK(at_once.surface.at_rim == s.surface.at_rim);
  for (std::size_t k = 0; k < 16; ++k) {
    if (gone[k] != 0) continue;
    CHECK(at_once.surface.segments[k].neighbour == s.surface.segments[k].neighbour);
  }
}

TEST_CASE("gap: beside a keel the side is right whatever segment is the nearest", "[contact]") {
  // A roof of two planes at 120 degrees to each other; points outside and inside near the ridge.
  test::Builder b;
  b.nx = 4;
  b.ny = 2;
  b.shape = [](double x, double y) { return Vec3(x - 2, y, -std::abs(x - 2) * std::sqrt(3.0)); };
  const Sheet s(b);
  for (const double dx : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
    std::int32_t outside = 0;
    std::int32_t inside = 0;
    (void)s.gap({dx, 1.0, 0.2}, outside);  // above a vertex of the ridge as well as off it
    (void)s.gap({dx, 0.9, -0.5 - 2 * std::abs(dx)}, inside);
    CHECK(outside == 1);
    CHECK(inside == -1);
  }
}

TEST_CASE("gap: no force jump when sliding over the edges of a flat, distorted mesh", "[contact]") {
  test::Builder b;
  b.nx = 6;
  b.ny = 6;
  b.shape = [](double x, double y) {
    return Vec3(x + 0.2 * std::sin(3 * y), y + 0.2 * std::sin(2 * x + 1), 0);
  };
  const Sheet s(b);
  std::int32_t side = 0;
  double worst = 0;
  for (int i = 0; i <= 4000; ++i) {
    const double u = 1 + 4.0 * i / 4000;
    const Vec3 f = s.force({u, 0.8 + 0.9 * u, 0.3}, side);
    worst = std::max(worst, (f - Vec3(0, 0, 0.1)).norm());
  }
  CHECK(worst < 1e-13);  // of 0.1: rounding
}

TEST_CASE("gap: force jump below 1 % when sliding over the edges of a slightly bent mesh",
          "[contact]") {
  // 0.5 degrees at every edge: a radius of 115 edge lengths. On the convex side the force is
  // continuous; on the concave side its direction turns by the angle of the edge at once,
  // 2 sin(0.25 deg) = 0.87 %.
  const double half_degree = 0.5 * std::numbers::pi / 180;
  const Sheet s(bent(half_degree));
  const double concave = largest_jump(s, half_degree, 0.3, 30000);
  CHECK(concave < 0.01);
  CHECK(concave > 0.008);
  CHECK(largest_jump(s, half_degree, -0.3, 30000) < 0.01);
}

TEST_CASE("gap: of a point that repeats, the image that is near the surface counts", "[contact]") {
  const Sheet sheet(flat());  // 4 m x 4 m about (2, 2, 0)
  const Periods periods{{3, 0, 0}};
  // Listed at x = 31.6, wrapped since to 0.6: as near the sheet at 1.6 (k = -10) as at 3.6 (-9.3).
  const std::vector<Line> x_search{{31.6, 2, 0.5, 0}};
  const std::vector<Line> x{{0.7, 2, 0.3, 0}};
  SegmentCandidates list;
  find_candidates({x_search, {}, 0, sheet.surface.x, sheet.surface.corners, 1.0, periods}, list);
  std::int32_t side = 0;
  double offset = 0;
  Gap gap;
  find_gaps(sheet.surface, list, x, sheet.range, false, {{&side, 1}, {&offset, 1}}, {&gap, 1},
            {periods, x_search, Vec3::Zero()});
  REQUIRE(gap.segment >= 0);
  CHECK(gap.penetration == Approx(0.1));
  CHECK(gap.normal.z() == Approx(1));
  CHECK(side > 0);
  Vec3 foot = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Segment& g = sheet.surface.segments[static_cast<std::size_t>(gap.segment)];
    foot += gap.N[k] * xyz(sheet.surface.x[static_cast<std::size_t>(g.corner[k])]);
  }
  CHECK(std::remainder(foot.x() - 0.7, 3) == Approx(0).margin(1e-12));
}
