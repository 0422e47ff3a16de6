// Dummy particles of walls: where they stand, what fluid gives them, how they move.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sph/wall_points.hpp"
#include "sph/wall_state.hpp"

using namespace gannet;

namespace {

Plane across(const char* name, int axis, double at, double sense) {
  Plane plane;
  plane.name = name;
  plane.point = at * Vec3::Unit(axis);
  plane.normal = sense * Vec3::Unit(axis);
  return plane;
}

}  // namespace

TEST_CASE("walls: pressure and velocity of a wall particle from two of fluid, by hand", "[sph]") {
  // h = 1: W(1) = sigma/4 and W(1.5) = sigma/32, so the fluid weighs 8 to 1. Another wall particle
  // stands nearer than both and counts nothing; p0 is not 0, so that nothing hides behind it.
  const Array<Line> x{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1.5, 0, 1}, {-0.5, 0, 0, 1}};
  const Array<Line> v{{9, 9, 0, 1}, {1, 2, 0, 1}, {-1, 0, 0, 1}, {9, 9, 0, 1}};
  const Array<double> rho{7, 2, 3, 7};
  const Array<double> p{1e5, 10, 34, 1e5};
  ClusterList list;
  build_cluster_list(x, 4, 2.5, list);
  const Array<std::uint8_t> is_wall{1, 0, 0, 1};
  ClusterList near;
  Array<Index> clusters;
  keep_across(list, is_wall, Across::fluid_near_walls, near, clusters);
  REQUIRE(clusters == Array<Index>{0});
  Array<WallSums> sums;
  wall_sums(near, clusters, {x.data(), v.data(), rho.data(), p.data(), 4}, 2, 2, sums);
  const double sigma = 10 / (7 * std::numbers::pi);
  CHECK(sums[0].W == Approx(sigma * 9 / 32).epsilon(1e-13));
  // p: (8 10 + 34)/9; rho r_wf: (8 2 (-1), 3 (-1.5))/9; v: (8 (1, 2) + (-1, 0))/9
  const WallValues at_rest = wall_values(sums[0], Vec3::Zero());
  CHECK(at_rest.p == Approx(114.0 / 9).epsilon(1e-13));
  CHECK(at_rest.v.x() == Approx(7.0 / 9).epsilon(1e-13));
  CHECK(at_rest.v.y() == Approx(16.0 / 9).epsilon(1e-13));
  // g - a = (-9, -10): (-9)(-16/9) + (-10)(-4.5/9) = 21
  CHECK(wall_values(sums[0], {-9, -10, 3}).p == Approx(114.0 / 9 + 21).epsilon(1e-13));
}

TEST_CASE("walls: lists keep the fluid of clusters that hold walls, and nothing else", "[sph]") {
  // Sixteen particles in a row; the walls are 3 and 4, in the first cluster.
  Array<Line> x;
  for (int i = 0; i < 16; ++i) x.push_back({0.1 * i, 0, 0, 1});
  Array<std::uint8_t> is_wall(16, 0);
  is_wall[3] = is_wall[4] = 1;
  ClusterList list;
  ClusterList near;
  Array<Index> clusters;
  build_cluster_list(x, 16, 0.25, list);
  keep_across(list, is_wall, Across::fluid_near_walls, near, clusters);
  CHECK(clusters == Array<Index>{0});
  CHECK(near.offset[2] == near.offset[1]);
  CHECK(near.offset[1] % 2 == 0);
  Array<Index> found;
  for (std::int64_t k = 0; k < near.offset[1]; ++k) {
    if (near.source[k] < 16) found.push_back(near.source[k]);
  }
  std::sort(found.begin(), found.end());
  CHECK(found == Array<Index>{0, 1, 2, 5, 6, 7, 8, 9});  // 0.25 beyond the eighth, at 0.7
  // The other way round: both clusters hold fluid, walls are near the first alone.
  keep_across(list, is_wall, Across::walls_near_fluid, near, clusters);
  CHECK(clusters == Array<Index>{0});
  CHECK(near.offset[1] == 2);
  CHECK(near.source[0] + near.source[1] == 3 + 4);
}

TEST_CASE("walls: three layers behind the planes of a basin, corners filled once", "[sph]") {
  const std::vector<Plane> planes{across("x_min", 0, 0, 1), across("x_max", 0, 1, -1),
                                  across("y_min", 1, 0, 1)};
  const WallRegion region{
      .low = {-9, -9, 0}, .high = {9, 0.5, 0}, .dx = 0.1, .n_layers = 3, .dimension = 2};
  const auto points = points_behind(planes, region);
  REQUIRE(points.size() == 3);
  // Sides: 5 rows of 3, and of the corner of 3 x 3 what is deeper behind them than the floor, where
  // the earlier plane has the diagonal.
  CHECK(points[0].size() == 15 + 6);
  CHECK(points[1].size() == 15 + 6);
  CHECK(points[2].size() == 30 + 3 + 3);
  Vec3 sum = Vec3::Zero();
  for (const auto& part : points) {
    for (const Vec3& x : part) {
      sum += x;
      CHECK((x.x() < 0 || x.x() > 1 || x.y() < 0));
      CHECK(x.x() == Approx(-0.25 + 0.1 * std::round((x.x() + 0.25) / 0.1)));
    }
  }
  CHECK(sum.x() == Approx(0.5 * 78));
}

TEST_CASE("walls: a plane that leans gets layers along itself, clear of its neighbours", "[sph]") {
  Plane ramp;
  ramp.name = "ramp";
  ramp.normal = Vec3(-1, 1, 0).normalized();
  ramp.point = {1, 0, 0};
  const std::vector<Plane> planes{across("floor", 1, 0, 1), ramp};
  const WallRegion region{
      .low = {0, 0, 0}, .high = {2, 1, 0}, .dx = 0.1, .n_layers = 3, .dimension = 2};
  const auto points = points_behind(planes, region);
  CHECK(points[1].size() > 30);
  for (const Vec3& x : points[1]) {
    const double behind = -ramp.normal.dot(x - ramp.point);
    CHECK(behind > 0.049);
    CHECK(behind < 0.251);
    for (const Vec3& y : points[0]) CHECK((x - y).norm() >= 0.075);
  }
  for (const Vec3& x : points[0]) CHECK(-ramp.normal.dot(x - ramp.point) < 0.3 + 1e-12);
}

TEST_CASE("walls: a wall that turns keeps its radius, and its acceleration points inwards",
          "[sph]") {
  const Scene scene;
  Wall wall;
  wall.motion = {.velocity = {1, 0, 0}, .omega = {0, 0, 2}, .centre = {0, 1, 0}, .factor = {}};
  Vec3 x(0, 3, 0);
  CHECK((velocity_at_start(wall, scene, x) - Vec3(-3, 0, 0)).norm() < 1e-15);
  Step step;
  step.dt = 0.1;
  for (int n = 0; n < 50; ++n) {
    x += step.dt * mean_velocity(wall, scene, x, step);
    step.t += step.dt;
  }
  const Vec3 expected = Vec3(5, 1, 0) + 2 * Vec3(-std::sin(10.0), std::cos(10.0), 0);
  CHECK((x - expected).norm() < 1e-12);
  const Vec3 r = x - Vec3(5, 1, 0);
  CHECK((acceleration_at(wall, scene, x, step) + 4 * r).norm() < 1e-12);
  wall.motion = {.velocity = {3, 0, 0}};
  wall.motion.factor = {{0, 2}, {0, 4}};
  step.t = 1;
  CHECK(acceleration_at(wall, scene, x, step).x() == Approx(6));
  step.t = 3;
  CHECK(acceleration_at(wall, scene, x, step).x() == 0);
}

TEST_CASE("walls: layers behind a plane go with it as a rigid body", "[sph]") {
  Scene scene;
  scene.planes.push_back(across("floor", 1, 0, 1));
  Plane& plane = scene.planes.front();
  Wall wall;
  wall.plane = 0;
  CHECK_FALSE(moves(wall, scene));
  plane.moves = plane.turns = true;
  plane.point = {1, 2, 0};
  plane.velocity = plane.velocity_old = {3, 0, 0};
  plane.spin = plane.spin_old = {0, 0, std::numbers::pi};
  CHECK(moves(wall, scene));
  Step step;
  step.dt = 0.5;  // a quarter of a turn
  step.dt_old = 0.5;
  // From (2, 2) to (1, 3), and 1.5 along.
  const Vec3 v = mean_velocity(wall, scene, {2, 2, 0}, step);
  CHECK((step.dt * v - Vec3(0.5, 1, 0)).norm() < 1e-15);
  CHECK((acceleration_at(wall, scene, {2, 2, 0}, step) -
         Vec3(-std::numbers::pi * std::numbers::pi, 0, 0))
            .norm() < 1e-12);
  // The mean of the step before was 1 m/s and pi/2 less.
  plane.velocity_old = {2, 0, 0};
  plane.spin_old = {0, 0, std::numbers::pi / 2};
  CHECK((acceleration_at(wall, scene, {2, 2, 0}, step) -
         Vec3(2 - std::numbers::pi * std::numbers::pi, std::numbers::pi, 0))
            .norm() < 1e-12);
}
