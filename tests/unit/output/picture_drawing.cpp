// Spheres, faces, edges and letters on a canvas.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "base/parallel.hpp"
#include "output/picture_faces.hpp"
#include "output/picture_image.hpp"
#include "output/picture_spheres.hpp"
#include "output/picture_text.hpp"
#include "small_scene.hpp"

using namespace gannet;

namespace {

constexpr Rgb white{255, 255, 255};
constexpr Rgb red{200, 0, 0};
constexpr Rgb blue{0, 0, 200};

int n_drawn(const Canvas& canvas) {
  return static_cast<int>(std::count_if(canvas.depth.begin(), canvas.depth.end(),
                                        [](float d) { return d != Canvas::nothing; }));
}

int n_other_than(const Raster& image, Rgb colour) {
  return static_cast<int>(
      image.pixels.size() -
      static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), colour)));
}

bool is_red(Rgb c) { return c.r > 0 && c.b == 0; }

std::vector<Sphere> many_spheres(int n, float width, float height) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Sphere> spheres;
  for (int k = 0; k < n; ++k) {
    const float x = unit(random);
    const float y = unit(random);
    spheres.push_back(
        {x * width, y * height, 100 * unit(random), {static_cast<std::uint8_t>(k % 251), 100, 50}});
  }
  return spheres;
}

}  // namespace

TEST_CASE("picture spheres: a sphere covers the pixels of its disc", "[output]") {
  // Points of the integer grid within a circle: 1, 13, 81 for the radii 0.5, 2 and 5.
  for (const auto& [radius, wanted] : {std::pair{0.5, 1}, {2.0, 13}, {5.0, 81}}) {
    Canvas canvas(40, 80, white);
    const std::vector<Sphere> one{{.column = 20.5F, .row = 31.2F, .depth = 7, .colour = red}};
    draw_spheres(canvas, one, radius);  // across the border of two bands, rows 31 and 32
    CHECK(n_drawn(canvas) == wanted);
    CHECK(n_other_than(canvas.image, white) == wanted);
    // The middle is `radius` nearer than the centre, and 3-4-5 makes the edge.
    CHECK(canvas.depth[canvas.image.at(20, 31)] == Approx(7 + radius));
    if (radius == 5.0) CHECK(canvas.depth[canvas.image.at(23, 35)] == Approx(7).margin(1e-3));
  }
}

TEST_CASE("picture spheres: the nearer one hides the other in either order", "[output]") {
  const Sphere front{10.5F, 10.5F, 5, red};
  const Sphere behind{12.5F, 10.5F, -5, blue};
  for (const auto& both : {std::vector{front, behind}, std::vector{behind, front}}) {
    Canvas canvas(24, 24, white);
    draw_spheres(canvas, both, 4);
    CHECK(is_red(canvas.image.pixels[canvas.image.at(12, 10)]));
    CHECK(is_red(canvas.image.pixels[canvas.image.at(14, 10)]));
    CHECK(canvas.image.pixels[canvas.image.at(15, 10)].b > 0);
  }
}

TEST_CASE("picture spheres: two of the same depth meet half-way", "[output]") {
  Canvas canvas(24, 24, white);
  draw_spheres(canvas, std::vector<Sphere>{{8.5F, 10.5F, 0, red}, {13.5F, 10.5F, 0, blue}}, 4);
  for (int column = 5; column < 17; ++column) {
    CAPTURE(column);
    CHECK(is_red(canvas.image.pixels[canvas.image.at(column, 10)]) == (column <= 10));
  }
}

TEST_CASE("picture spheres: lit from the upper left", "[output]") {
  Canvas canvas(64, 64, white);
  draw_spheres(canvas, std::vector<Sphere>{{32.5F, 32.5F, 0, red}}, 20);
  const auto red_at = [&](int column, int row) {
    return canvas.image.pixels[canvas.image.at(column, row)].r;
  };
  CHECK(red_at(24, 22) > red_at(40, 42));
}

TEST_CASE("picture spheres: outside, half outside and NaN are no trouble", "[output]") {
  Canvas canvas(16, 16, white);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  draw_spheres(canvas, std::vector<Sphere>{{-50, 8, 0, red}, {8, 1e30F, 0, red}, {nan, 8, 0, red}},
               3);
  CHECK(n_drawn(canvas) == 0);
  // The middle in the corner pixel: a quarter of the disc of 13 with both axes, 1 + 2 + 2 + 1.
  draw_spheres(canvas, std::vector<Sphere>{{0.5F, 0.5F, 0, red}}, 2);
  CHECK(n_drawn(canvas) == 6);
}

TEST_CASE("picture spheres: the same picture whatever the number of threads", "[output]") {
  const std::vector<Sphere> spheres = many_spheres(3000, 200, 150);
  Canvas one(200, 150, white);
  Canvas three(200, 150, white);
  const int before = threads();
  set_threads(1);
  draw_spheres(one, spheres, 4.3);
  set_threads(3);
  draw_spheres(three, spheres, 4.3);
  set_threads(before);
  CHECK(one.image.pixels == three.image.pixels);
  CHECK(one.depth == three.depth);
}

TEST_CASE("picture faces: two triangles of a square cover each pixel once", "[output]") {
  Canvas canvas(20, 20, white);
  const Vec3 a(2, 3, 0);
  const Vec3 b(12, 3, 10);
  const Vec3 c(12, 13, 10);
  const Vec3 d(2, 13, 0);
  // Half covered: where the two overlapped, or left a gap on the diagonal, it would show.
  draw_triangle(canvas, {a, b, c}, {{0, 0, 0}, 0.5});
  draw_triangle(canvas, {a, c, d}, {{0, 0, 0}, 0.5});
  CHECK(n_other_than(canvas.image, white) == 100);
  CHECK(std::count(canvas.image.pixels.begin(), canvas.image.pixels.end(), Rgb{128, 128, 128}) ==
        100);
  CHECK(n_drawn(canvas) == 0);  // see-through faces hide nothing
  draw_triangle(canvas, {a, b, c}, {red, 1});
  draw_triangle(canvas, {a, d, c}, {red, 1});
  CHECK(n_drawn(canvas) == 100);
  // Depth rises from 0 to 10 over 10 columns: 3.5 in the middle of the fourth.
  CHECK(canvas.depth[canvas.image.at(5, 4)] == Approx(3.5));
  CHECK(canvas.depth[canvas.image.at(5, 11)] == Approx(3.5));
}

TEST_CASE("picture faces: edges hide and are hidden", "[output]") {
  Canvas canvas(20, 20, white);
  draw_triangle(canvas, {Vec3(0, 0, 1), Vec3(40, 0, 1), Vec3(0, 40, 1)}, {red, 1});
  draw_edge(canvas, {5.5, 4.5, 0}, {14.5, 4.5, 0}, 1, {blue, 1});
  CHECK(std::count(canvas.image.pixels.begin(), canvas.image.pixels.end(), blue) == 0);
  draw_edge(canvas, {5.5, 4.5, 2}, {14.5, 4.5, 2}, 1, {blue, 1});
  CHECK(std::count(canvas.image.pixels.begin(), canvas.image.pixels.end(), blue) == 10);
}

TEST_CASE("picture faces: only what lies behind its neighbours is darkened", "[output]") {
  Canvas canvas(20, 20, white);
  const Paint grey{{100, 100, 100}, 1};
  draw_triangle(canvas, {Vec3(0, 0, 0), Vec3(40, 0, 0), Vec3(0, 40, 0)}, grey);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 10; ++column) canvas.depth[canvas.image.at(column, row)] = 50;
  }
  darken_gaps(canvas, 2, 1);
  CHECK(canvas.image.pixels[canvas.image.at(15, 10)] == grey.colour);
  CHECK(canvas.image.pixels[canvas.image.at(5, 10)] == grey.colour);
  // Three of eight neighbours are in front: 100 exp(-3/8) = 68.7.
  CHECK(canvas.image.pixels[canvas.image.at(11, 10)].r == 69);
}

TEST_CASE("picture text: a width for each letter, a shape for each character", "[output]") {
  // "I" is 0 columns wide and "H" 4, 1.7 between them: 5.7 columns of 0.9 sixths of the height.
  CHECK(text_width("IH", 12) == Approx(5.7 * 0.9 * 2));
  CHECK(text_width("", 12) == 0);
  CHECK(text_width("\xc3\xa9", 12) == text_width("?", 12));
  for (char c = '!'; c <= '~'; ++c) {
    CAPTURE(c);
    Raster image(40, 40, white);
    draw_text(image, 10, 28, std::string(1, c), {.height = 16, .colour = red});
    CHECK(n_other_than(image, white) > 2);
  }
}

TEST_CASE("picture text: an I is a stroke from the baseline to the top", "[output]") {
  Raster image(20, 30, white);
  draw_text(image, 10.5, 20.5, "I", {.height = 12, .colour = red});
  CHECK(image.pixels[image.at(10, 14)] == red);
  CHECK(image.pixels[image.at(10, 9)] == red);
  CHECK(image.pixels[image.at(10, 20)] == red);
  CHECK(image.pixels[image.at(10, 6)] == white);
  CHECK(image.pixels[image.at(10, 22)] == white);
  CHECK(image.pixels[image.at(13, 14)] == white);
}

TEST_CASE("picture image: shrinking takes means, merging keeps black and white", "[output]") {
  Raster image(4, 2, white);
  image.pixels[image.at(0, 0)] = {0, 0, 0};
  image.pixels[image.at(1, 1)] = {0, 0, 0};
  Raster small = shrink(image, 2);
  REQUIRE(small.width == 2);
  REQUIRE(small.height == 1);
  CHECK(small.pixels[0] == Rgb{128, 128, 128});
  CHECK(small.pixels[1] == white);
  merge_shades(small);
  CHECK(small.pixels[0] == Rgb{130, 130, 130});
  CHECK(small.pixels[1] == white);
}

TEST_CASE("picture image: a PNG reads back with its size and every pixel", "[output]") {
  const test::EmptyFolder folder("png");
  const std::string path = folder.path + "/a.png";
  Raster image(7, 5, white);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      image.pixels[image.at(column, row)] = {static_cast<std::uint8_t>(column),
                                             static_cast<std::uint8_t>(50 + row), 200};
    }
  }
  write_png(image, path);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  REQUIRE(size[0] == 7);
  REQUIRE(size[1] == 5);
  REQUIRE(reader->GetOutput()->GetNumberOfScalarComponents() == 3);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      // VTK's rows run from the bottom.
      const auto* p =
          static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer(column, 4 - row, 0));
      CHECK(Rgb{p[0], p[1], p[2]} == image.pixels[image.at(column, row)]);
    }
  }
  CHECK_THROWS_AS(write_png(image, folder.path + "/not/there.png"), std::runtime_error);
}
