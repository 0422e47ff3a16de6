#include "output/stray_particles.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "output/checkpoint_head.hpp"

using namespace gannet;

namespace {

/// Particles on the diagonal of a box of 3 x 4 x 0, a floor at z = 0 and a wall at x = 12.
Scene two_in_a_tank() {
  Scene scene;
  scene.nodes.n_owned = 2;
  scene.particles = {0, 2};
  scene.nodes.x.resize(2);
  scene.nodes.x[0] = {0, 0, 0, 1};
  scene.nodes.x[1] = {3, 4, 0, 1};
  scene.planes.push_back({.name = "floor", .point = {7, 7, 0}});
  scene.planes.push_back({.name = "wall", .point = {12, 0, 0}, .normal = -Vec3::UnitX()});
  return scene;
}

}  // namespace

TEST_CASE("stray particles: the box holds nodes and planes, grown by its diagonal", "[output]") {
  const LostLimits limits = lost_limits(two_in_a_tank(), 0.1);
  const double diagonal = std::sqrt(12.0 * 12 + 4 * 4);  // x from 0 to the wall, y from 0 to 4
  CHECK(limits.low.x() == Approx(-diagonal));
  CHECK(limits.high.x() == Approx(12 + diagonal));
  CHECK(limits.high.y() == Approx(4 + diagonal));
  CHECK(limits.high.z() == Approx(diagonal));
  CHECK(limits.depth == 0.1);
  CHECK(lost_limits(two_in_a_tank(), 1).high.z() == Approx(100));  // at least 100 spacings
}

TEST_CASE("stray particles: lost behind a wall, far out, or nowhere", "[output]") {
  Scene scene = two_in_a_tank();
  const LostLimits limits = lost_limits(scene, 0.1);
  CHECK(count_lost(scene, limits) == 0);
  scene.nodes.x[0].z = -0.09;  // less than a spacing behind the floor
  CHECK(count_lost(scene, limits) == 0);
  CHECK(deepest_penetration(scene) == Approx(0.09));
  scene.nodes.x[0].z = -0.11;
  CHECK(count_lost(scene, limits) == 1);
  scene.nodes.x[1].y = 17;  // the diagonal is 12.65
  CHECK(count_lost(scene, limits) == 2);
  scene.nodes.x[1].y = std::nan("");
  CHECK(count_lost(scene, limits) == 2);
}

TEST_CASE("stray particles: those of walls stand behind planes", "[output]") {
  Scene scene = two_in_a_tank();
  scene.parts = {{.name = "water", .kind = "sph"}, {.name = "floor", .kind = "wall"}};
  scene.particle_part = {1, 0};
  const LostLimits limits = lost_limits(scene, 0.1);
  scene.nodes.x[0].z = -0.5;
  scene.nodes.x[1].z = 0.2;
  CHECK(count_lost(scene, limits) == 0);
  CHECK(deepest_penetration(scene) == Approx(-0.2));
}

TEST_CASE("stray particles: the worst look stands, and goes into a checkpoint", "[output]") {
  Scene scene = two_in_a_tank();
  scene.store.get<StrayLimits>().lost = lost_limits(scene, 0.1);
  CheckpointHead head;
  scene.nodes.x[0].z = -0.2;
  look_for_strays(scene, head.strays);
  scene.nodes.x[0].z = 0.2;
  look_for_strays(scene, head.strays);
  CHECK(head.strays.lost == 1);
  head.cpu_time = 3;
  const CheckpointHead read = head_from_text(to_text(head));
  CHECK(read.strays.lost == 1);
  CHECK(read.strays.deepest == 0.2);
  CHECK(read.cpu_time == 3);
}
