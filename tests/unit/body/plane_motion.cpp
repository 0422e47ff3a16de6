// Moving planes: where they are, how fast, and that their places are exact.
#include "body/plane_motion.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "body/effects.hpp"
#include "small_world.hpp"

using namespace gannet;
using gannet::test::make_world;
using gannet::test::World;

namespace {

std::unique_ptr<World> world_of(const std::string& boundary) {
  Draft draft;
  draft.parts = {test::particles("pool", {{0.5, 0.5, 0.5}})};
  return make_world("let: {A: 20 mm, w: 30 rad/s}\nparts: {pool: {made: yes}}\nboundaries: {b: " +
                        boundary + "}\n",
                    draft, {planes_effect(), plane_motion_effect()});
}

std::string mistakes(const std::string& boundary) {
  try {
    return test::mistakes_of(*world_of(boundary));
  } catch (const InputError& error) {
    return error.what();
  }
}

void uneven_steps(World& world, int n) {
  for (int k = 0; k < n; ++k) {
    world.dt = k % 3 == 0 ? 1e-3 : 1.7e-3;
    world.take_steps(1);
  }
}

}  // namespace

TEST_CASE("moving planes: a velocity is followed to its integral, whatever the steps", "[body]") {
  auto world =
      world_of("{planes: {x: [0, 1], y: 0}, motion: {velocity: [\"A*w*cos(w*t)\", 0, 2 m/s]}}");
  CHECK(world->scene.planes[0].velocity == Vec3(0.6, 0, 2));  // at the start
  uneven_steps(*world, 40);
  const double t = world->time();
  const double x = 0.02 * std::sin(30 * t);
  const auto& planes = world->scene.planes;
  CHECK(planes[0].point.x() == Approx(x).margin(1e-12));
  CHECK(planes[1].point.x() == Approx(1 + x).margin(1e-12));
  CHECK(planes[1].point.z() == Approx(2 * t).epsilon(1e-13));
  CHECK(planes[1].normal == Vec3(-1, 0, 0));
  CHECK(planes[2].moves);
  CHECK_FALSE(planes[2].turns);
}

TEST_CASE("moving planes: a displacement holds at the level itself", "[body]") {
  auto world = world_of("{planes: {x: 0.1}, motion: {displacement: [\"A*cos(w*t)\", 0, 0]}}");
  uneven_steps(*world, 17);
  const double t = world->time();
  const Plane& plane = world->scene.planes[0];
  CHECK(plane.point.x() == 0.1 + (0.02 * std::cos(30 * t) - 0.02));
  const Vec3 before = plane.point;
  const double dt = world->dt;
  world->take_steps(1);
  CHECK((plane.point - before - world->dt * plane.velocity).norm() < 1e-16);
  CHECK(dt > 0);
}

TEST_CASE("moving planes: turned about an axis, by angle or by rate", "[body]") {
  const std::string rest = "centre: [1, 0, 0], axis: [0, 0, -2], ";
  auto angle = world_of("{planes: {x: 0}, motion: {rotation: {" + rest + "angle: \"-w*t\"}}}");
  auto rate = world_of("{planes: {x: 0}, motion: {rotation: {" + rest + "rate: \"-w\"}}}");
  uneven_steps(*angle, 20);
  uneven_steps(*rate, 20);
  const double a = 30 * angle->time();  // about +z
  for (World* world : {angle.get(), rate.get()}) {
    const Plane& plane = world->scene.planes[0];
    CHECK(plane.turns);
    CHECK((plane.normal - Vec3(std::cos(a), std::sin(a), 0)).norm() < 1e-12);
    CHECK((plane.point - Vec3(1 - std::cos(a), -std::sin(a), 0)).norm() < 1e-12);
    CHECK((plane.spin - Vec3(0, 0, 30)).norm() < 1e-9);
  }
}

TEST_CASE("moving planes: all that a restart needs is tracked", "[body]") {
  auto world = world_of("{planes: {x: 0}, motion: {velocity: [1 m/s, 0, 0]}}");
  uneven_steps(*world, 5);
  const Field* d = world->scene.field("motion.b.d");
  const Field* point = world->scene.field("plane.b.x_min.point");
  REQUIRE(d != nullptr);
  REQUIRE(point != nullptr);
  CHECK(*reinterpret_cast<const double*>(d->at(0)) == world->scene.planes[0].point.x());
  CHECK(*reinterpret_cast<const double*>(point->at(0)) == world->scene.planes[0].point.x());
  auto still = world_of("{planes: {x: 0}}");
  CHECK(still->scene.field("plane.b.x_min.point") == nullptr);
  CHECK(still->model().plan.at(Stage::drift).size() == 1);
}

TEST_CASE("moving planes: mistakes name their place", "[body]") {
  CHECK_THAT(mistakes("{planes: {x: 0}, motion: {}}"),
             Catch::Contains("case.yaml:4:") && Catch::Contains("say how the planes move"));
  CHECK_THAT(mistakes("{planes: {x: 0}, motion: {velocity: [1, 0, 0], displacement: [1, 0, 0]}}"),
             Catch::Contains("motion.displacement: a motion is given by one of"));
  CHECK_THAT(mistakes("{planes: {x: 0}, motion: {rotation: {axis: [0, 0, 1]}}}"),
             Catch::Contains("one of angle and rate"));
  CHECK_THAT(mistakes("{planes: {x: 0}, motion: {rotation: {axis: [0, 0, 0], rate: 1}}}"),
             Catch::Contains("an axis needs a length above 0"));
  CHECK_THAT(mistakes("{motion: {velocity: [1, 0, 0]}}"), Catch::Contains("no planes to move"));
  CHECK_THAT(mistakes("{planes: {x: 0}, motion: {velocity: [\"2*x\", 0, 0]}}"),
             Catch::Contains("unknown name 'x'"));
}
