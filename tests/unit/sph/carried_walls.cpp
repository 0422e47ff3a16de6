#include "sph/carried_walls.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace gannet;

namespace {

/// A body with its centre at (1, 2, 0), and two wall particles on it, at (2, 0, 0) and (0, 1, 0)
/// from the centre in its frame.
struct Ride {
  Scene scene;
  Walls walls;
  Carrier carrier;

  Ride() {
    Nodes& nodes = scene.nodes;
    nodes.n_owned = 3;
    nodes.rotating = {0, 1};
    nodes.x = {{1, 2, 0, 4}, {3, 2, 0, 0}, {1, 3, 0, 0}};
    nodes.v.assign(3, {});
    nodes.f.assign(3, {});
    nodes.omega.assign(1, {});
    nodes.torque.assign(1, {});
    scene.particles = {1, 3};
    scene.parts = {{.name = "body.box"}, {.name = "walls.box", .kind = "wall"}};
    scene.particle_part = {1, 1};
    carrier = {.name = "box", .node = 0, .inverse_mass = 0.25, .softest = 2};
    walls.list = {{.part = 1, .name = "box", .on_body = true, .carrier = &carrier}};
    walls.of_part = {-1, 0};
    walls.arm = {{2, 0, 0, 0}, {0, 1, 0, 0}};
  }
};

}  // namespace

TEST_CASE("walls on bodies: move along the chord of a quarter turn", "[sph]") {
  Ride ride;
  ride.carrier.q_next = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ());
  ride.scene.nodes.v[0] = {10, 0, 0, 0.25};
  ride.scene.nodes.v[1] = {1, 1, 0, 0};
  kick_carried_walls(ride.walls, ride.scene, {.dt_old = 0.3, .dt = 0.1});
  // (2, 0) turns to (0, 2), (0, 1) to (-1, 0), in 0.1 s.
  const Array<Line>& v = ride.scene.nodes.v;
  CHECK((xyz(v[1]) - Vec3(10 - 20, 20, 0)).norm() < 1e-13);
  CHECK((xyz(v[2]) - Vec3(10 - 10, -10, 0)).norm() < 1e-13);
  // From (1, 1) over the kick of 0.2 s; f stands for the acceleration where 1/m is 1.
  CHECK((xyz(ride.scene.nodes.f[1]) - Vec3(-55, 95, 0)).norm() < 1e-12);
  CHECK(v[1].w == 1);
}

TEST_CASE("walls on bodies: pressures follow the acceleration of the body a share at a time",
          "[sph]") {
  Ride ride;
  Wall& wall = ride.walls.list.front();
  wall.share = 0.25;
  wall.v_before = {1, 0, 0};
  wall.a = {4, 0, 0};
  ride.scene.nodes.v[0] = {3, 0, 0, 0.25};
  ride.scene.nodes.omega[0] = {0, 0, 0.4, 0};
  kick_carried_walls(ride.walls, ride.scene, {.dt_old = 0.1, .dt = 0.1});
  // a is 2/0.1 = 20: 4 + (20 - 4)/4 = 8; alpha is 0.4/0.1 = 4: 1
  CHECK((wall.a - Vec3(8, 0, 0)).norm() < 1e-13);
  CHECK((wall.alpha - Vec3(0, 0, 1)).norm() < 1e-13);
  // At the arm (2, 0): a + alpha x r + omega x (omega x r) = (8 - 0.16 2, 2)
  CHECK((acceleration_on_body(wall, ride.scene, {2, 0, 0}) - Vec3(7.68, 2, 0)).norm() < 1e-13);
}

TEST_CASE("walls on bodies: how easily wet particles are moved", "[sph]") {
  Ride ride;
  ride.walls.clusters = {0};
  ride.walls.sums.resize(ClusterList::lanes);
  note_ease(ride.walls, ride.scene);
  CHECK(ride.walls.list.front().ease == 0);  // dry
  ride.walls.sums[0].W = 1;
  note_ease(ride.walls, ride.scene);
  CHECK(ride.walls.list.front().ease == Approx(0.25 + 4.0 / 2));
  ride.walls.sums[1].W = 1;
  note_ease(ride.walls, ride.scene);
  CHECK(ride.walls.list.front().ease == Approx(2.25 + 0.25 + 1.0 / 2));
}
