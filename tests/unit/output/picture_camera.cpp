#include "output/picture_camera.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"

using namespace gannet;

namespace {

/// Rounding of a few products.
constexpr double tight = 1e-12;

void check_vector(const Vec3& is, const Vec3& wanted) {
  CHECK((is - wanted).norm() == Approx(0).margin(tight));
}

}  // namespace

TEST_CASE("picture camera: the front view puts x to the right, z up and -y near", "[output]") {
  Camera camera{.view = view_of("y"), .scale = 100, .origin_column = 320, .origin_row = 240};
  check_vector(project(camera, {0, 0, 0}), {320, 240, 0});
  check_vector(project(camera, {1.5, 0.25, 0.5}), {470, 190, -25});
}

TEST_CASE("picture camera: views from x and z", "[output]") {
  Camera camera{.view = view_of("x")};
  check_vector(project(camera, {3, 1, 2}), {1, -2, 3});
  camera.view = view_of("z");
  check_vector(project(camera, {3, 1, 2}), {3, -1, 2});
}

TEST_CASE("picture camera: angles turn from the front", "[output]") {
  // Azimuth 0, elevation 0 is the front; 90 degrees later the viewer is at +x; at elevation 90
  // above, with y up.
  Camera camera{.view = view_of("0,0")};
  check_vector(project(camera, {3, 1, 2}), {3, -2, -1});
  camera.view = view_of("90,0");
  check_vector(project(camera, {3, 1, 2}), {1, -2, 3});
  camera.view = view_of("0,90");
  check_vector(project(camera, {3, 1, 2}), {3, -1, 2});
  // sin 30 = 1/2: a point 2 m up is 1 m nearer.
  camera.view = view_of("0,30");
  CHECK(project(camera, {0, 0, 2}).z() == Approx(1).margin(tight));
}

TEST_CASE("picture camera: directions are orthonormal and right-handed", "[output]") {
  for (const char* text : {"x", "y", "z", "iso", "-110.5,33"}) {
    const View v = view_of(text);
    CAPTURE(text);
    check_vector(v.right.cross(v.up), v.toward);
    CHECK(v.right.norm() == Approx(1).margin(tight));
    CHECK(v.up.norm() == Approx(1).margin(tight));
    CHECK(v.right.dot(v.up) == Approx(0).margin(tight));
  }
}

TEST_CASE("picture camera: an extent fills its area and stands in the middle", "[output]") {
  Extent extent;
  extent.include(-1, 0);
  extent.include(3, 1);
  // 4 m x 1 m into 200 x 100 pixels: the width decides, 50 pixels a metre; 25 rows stay free above.
  const Camera camera =
      camera_for(view_of("y"), extent, {.left = 10, .top = 20, .width = 200, .height = 100});
  CHECK(camera.scale == Approx(50));
  check_vector(project(camera, {-1, 0, 1}), {10, 45, 0});
  check_vector(project(camera, {3, 0, 0}), {210, 95, 0});
}

TEST_CASE("picture camera: what is no view is refused", "[output]") {
  for (const char* text : {"front", "30", "30,100", "30,20,10", "nan,0", ""}) {
    CAPTURE(text);
    CHECK_THROWS_AS(view_of(text), InputError);
  }
}
