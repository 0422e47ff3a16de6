// Whole pictures, and the frames that they show.
#include "output/picture.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "output/picture_legend.hpp"
#include "output/vtk_series.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Two particles of values 0 and 1 side by side at z = 0.5; a square in front of the second one.
DrawnFrame two_and_a_square() {
  DrawnFrame frame;
  DrawnPart pool{.name = "pool", .particles = true};
  pool.points = {{0, 0, 0.5}, {1, 0, 0.5}, {0.9, 0.1, 0}};
  pool.values = {1, 1, 0};
  DrawnPart panel{.name = "panel"};
  panel.points = {{0.6, -0.5, 0.1}, {1.4, -0.5, 0.1}, {1.4, -0.5, 0.9}, {0.6, -0.5, 0.9}};
  panel.pieces = {{.corners = {0, 1, 2, 3}, .cell = 0}};
  frame.parts = {pool, panel};
  return frame;
}

struct Drawn {
  PictureSetup setup;
  PictureOptions options;
  Raster image;

  /// The pixel that shows x.
  [[nodiscard]] Rgb at(const Vec3& x) const {
    const Camera camera =
        camera_for(setup.view, setup.extent, scene_area(options.width, options.height));
    const Vec3 p = project(camera, x);
    return image.pixels[image.at(static_cast<int>(p.x()), static_cast<int>(p.y()))];
  }
};

Drawn draw(const DrawnFrame& frame, PictureOptions options) {
  options.width = 320;
  options.height = 180;
  PictureSetup setup = setup_of(frame, options);
  include_frame(setup, frame, options);
  return {setup, options, draw_picture(frame, setup, shown_quantity("speed"), options)};
}

bool is_grey(Rgb c) { return std::abs(c.r - c.g) <= 10 && std::abs(c.g - c.b) <= 10 && c.r < 250; }
bool is_yellow(Rgb c) { return c.r > 2 * c.b && c.g > 2 * c.b; }

/// Writes frames of the small scene until t = 0.4 ms.
void write_frames(SmallScene& small, const std::string& folder) {
  small.record().folder = folder;
  small.record().name = "small";
  small.models.list.front().plan.add(
      {.name = "frame", .stage = Stage::look, .run = [&small](const Step&) {
         write_frame(small.scene, small.models, small.record());
       }});
  for (int k = 0; k < 3; ++k) advance(small.models);
}

}  // namespace

TEST_CASE("picture: a particle behind a shell is not visible", "[output]") {
  const Drawn front = draw(two_and_a_square(), {.view = "y"});
  CHECK(is_yellow(front.at({0, 0, 0.5})));
  CHECK(is_grey(front.at({1, 0, 0.5})));

  // From the other side it is in front of the shell.
  const Drawn back = draw(two_and_a_square(), {.view = "180,0"});
  CHECK(is_yellow(back.at({1, 0, 0.5})));
}

TEST_CASE("picture: what is before a cut is left out", "[output]") {
  const Drawn drawn = draw(two_and_a_square(), {.view = "y", .cut = cut_of("y = -0.2")});
  CHECK(is_yellow(drawn.at({1, 0, 0.5})));
  CHECK(drawn.at({1.35, -0.5, 0.85}) == Rgb{255, 255, 255});
  CHECK_THROWS_AS(cut_of("w=1"), InputError);
  CHECK_THROWS_AS(cut_of("y=1 mm"), InputError);
}

TEST_CASE("picture: a see-through shell lets a part of the colour through", "[output]") {
  const Drawn drawn = draw(two_and_a_square(), {.view = "y", .opacity = 0.4});
  const Rgb behind = drawn.at({1, 0, 0.5});
  CHECK_FALSE(is_grey(behind));
  CHECK(behind.b > drawn.at({0, 0, 0.5}).b);
}

TEST_CASE("picture: a quantity that only elements have is shown on them", "[output]") {
  DrawnFrame frame = two_and_a_square();
  frame.parts[0].values.clear();
  frame.parts[1].values = {1};
  const Drawn drawn = draw(frame, {.view = "y", .range = Span{0, 1}});
  CHECK(is_yellow(drawn.at({1.1, -0.5, 0.3})));
  CHECK(drawn.at({0, 0, 0.5}).b > drawn.at({0, 0, 0.5}).r);
}

TEST_CASE("picture: a plane scene is seen from z, others from three quarters", "[output]") {
  DrawnFrame frame = two_and_a_square();
  CHECK(setup_of(frame, {}).view.toward.isApprox(view_of("iso").toward));
  for (Vec3& x : frame.parts[0].points) x.z() = 0;
  CHECK(setup_of(frame, {}).view.toward == Vec3::UnitZ());
}

TEST_CASE("picture: the spacing is the median distance to the nearest neighbour", "[output]") {
  std::vector<Vec3> points;
  for (int k = 0; k < 300; ++k) points.emplace_back(0.02 * (k % 10), 0.02 * (k / 10), 0);
  points.emplace_back(50, 50, 50);
  CHECK(spacing_of(points) == Approx(0.02));
  CHECK(spacing_of({Vec3::Zero()}) == 0);
}

TEST_CASE("picture: one stray particle does not shrink the scene", "[output]") {
  DrawnFrame frame = two_and_a_square();
  frame.parts.pop_back();
  DrawnPart& pool = frame.parts[0];
  pool.points.clear();
  for (int k = 0; k <= 1000; ++k) pool.points.emplace_back(0.001 * k, 0, 0.1 * (k % 2));
  pool.points[7].x() = 100;
  pool.values.assign(pool.points.size(), 1);
  const PictureSetup setup = setup_of(frame, {.view = "y"});
  // 15 % of the width of the others and the radius, where 100 m would be.
  CHECK(setup.extent.right < 1.2);
  CHECK(setup.extent.right > 1);
  CHECK(setup.extent.left == Approx(-setup.radius[0]));
}

TEST_CASE("picture: frames come back from the files of a run", "[output]") {
  const EmptyFolder folder("frames");
  SmallScene small;
  write_frames(small, folder.path);
  const Series series = read_series(folder.path);
  CHECK(series.name == "small");
  REQUIRE(series.frames.size() == 3);
  CHECK(series.frames[0].t == 0);
  CHECK(series.frames[1].t > 0);

  const DrawnFrame frame = read_frame(series, series.frames[0], shown_quantity("pressure"));
  REQUIRE(frame.parts.size() == 4);
  CHECK(frame.parts[0].name == "pool");
  CHECK(frame.parts[0].particles);
  CHECK(frame.parts[0].points.size() == 5);
  // Particles 0 2 3 5 6 of p = 10 k at the start.
  CHECK(frame.parts[0].values == std::vector<double>{0, 20, 30, 50, 60});
  CHECK(frame.parts[1].pieces.size() == 4);
  CHECK(frame.parts[1].pieces[0].corners.size() == 4);
  CHECK(frame.parts[1].values.empty());
  CHECK(frame.parts[2].name == "bars & more");
  CHECK(frame.parts[2].pieces[1].corners.size() == 2);

  // Every node of the panel has 6 m/s, and so have its cells.
  const DrawnFrame speed = read_frame(series, series.frames[0], shown_quantity("speed"));
  REQUIRE(speed.parts[1].values.size() == 4);
  CHECK(speed.parts[1].values[3] == Approx(6));
  // Components of 1e6 + 0 ... 5: direct differences 1, 1, 2 and three shears of about 1e6:
  // sqrt(3 + 3 ((1e6 + 3)^2 + (1e6 + 4)^2 + (1e6 + 5)^2)).
  const DrawnFrame stress = read_frame(series, series.frames[0], shown_quantity("stress"));
  REQUIRE(stress.parts[1].values.size() == 4);
  CHECK(stress.parts[1].values[0] == Approx(3.0e6 + 12).epsilon(1e-9));

  CHECK_NOTHROW(draw(speed, {}));
  CHECK_THROWS_WITH(read_frame(series, series.frames[0], shown_quantity("colour")),
                    Catch::Contains("no part has this quantity") && Catch::Contains("Pressure"));
}

TEST_CASE("picture: what is no output folder is said to be none", "[output]") {
  const EmptyFolder folder("empty");
  CHECK_THROWS_WITH(read_series(folder.path), Catch::Contains("holds no .pvd file"));
  CHECK_THROWS_WITH(read_series(folder.path + "/not_there"), Catch::Contains("is not a folder"));
  test::write_file(folder.path + "/a.pvd", "this is no XML");
  CHECK_THROWS_WITH(read_series(folder.path), Catch::Contains("cannot be read as a .pvd"));
  test::write_file(folder.path + "/b.pvd", "");
  CHECK_THROWS_WITH(read_series(folder.path), Catch::Contains("several"));
}
