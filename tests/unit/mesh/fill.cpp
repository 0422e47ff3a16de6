#include "mesh/fill.hpp"

#include <catch2/catch.hpp>

#include <set>

#include "case_values.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

Value filled(std::vector<double> from, std::vector<double> to, std::vector<Value> more = {}) {
  std::vector<Value> keys = {
      map("box", {numbers("from", std::move(from)), numbers("to", std::move(to))})};
  keys.insert(keys.end(), more.begin(), more.end());
  return part({map("fill", keys)});
}

std::string mistakes_of(const Value& part, double spacing, int dimension) {
  Mistakes mistakes;
  CHECK(fill_points(Keys(part, mistakes), spacing, dimension).empty());
  return messages(mistakes);
}

}  // namespace

TEST_CASE("fill: lattice points, x fastest, half a cell off every face", "[mesh]") {
  const Value part = filled({0, -1, 2}, {1, 0, 2.5});
  Mistakes mistakes;
  const auto points = fill_points(Keys(part, mistakes), 0.5, 3);
  const std::vector<Vec3> expected = {
      {0.25, -0.75, 2.25}, {0.75, -0.75, 2.25}, {0.25, -0.25, 2.25}, {0.75, -0.25, 2.25}};
  CHECK(points == expected);
  CHECK(fill_cell_volume(Keys(part, mistakes), 0.5, 3) == 0.125);
  CHECK(mistakes.empty());
}

TEST_CASE("fill: the cells fill a box exactly that is no whole number of spacings", "[mesh]") {
  // 1.1/0.3 = 3.67 -> 4 cells of 0.275; 1.0/0.3 = 3.33 -> 3 of 1/3; 0.3/0.3 -> 1.
  const Value part = filled({0, 0, 0}, {1.1, 1.0, 0.3});
  Mistakes mistakes;
  const auto points = fill_points(Keys(part, mistakes), 0.3, 3);
  REQUIRE(points.size() == 12);
  CHECK(points.front().x() == Approx(0.1375).epsilon(1e-14));
  CHECK(points.back().x() == Approx(1.1 - 0.1375).epsilon(1e-14));
  CHECK(12 * fill_cell_volume(Keys(part, mistakes), 0.3, 3) == Approx(0.33).epsilon(1e-14));
  CHECK(mistakes.empty());
}

TEST_CASE("fill: in 2D the points lie in the plane z = 0", "[mesh]") {
  const Value part = filled({0, 0, -7}, {1, 2, 7});
  Mistakes mistakes;
  const auto points = fill_points(Keys(part, mistakes), 0.5, 2);
  REQUIRE(points.size() == 8);
  CHECK(points[7] == Vec3(0.75, 1.75, 0));
  CHECK(fill_cell_volume(Keys(part, mistakes), 0.5, 2) == 0.25);
  const Value flat = filled({0, 0, 0}, {1, 2, 0});
  CHECK(fill_points(Keys(flat, mistakes), 0.5, 2) == points);
  CHECK(mistakes.empty());
}

TEST_CASE("fill: jitter stays within its part of a cell and repeats", "[mesh]") {
  const auto jittered = [](double seed) {
    const Value part =
        filled({0, 0, 0}, {8, 8, 8}, {numbers("jitter", {0.2}), numbers("seed", {seed})});
    Mistakes mistakes;
    return fill_points(Keys(part, mistakes), 1, 3);
  };
  const auto points = jittered(0);
  Mistakes mistakes;
  const Value regular = filled({0, 0, 0}, {8, 8, 8});
  const auto lattice = fill_points(Keys(regular, mistakes), 1, 3);
  REQUIRE(points.size() == 512);
  Vec3 mean = Vec3::Zero();
  Vec3 square = Vec3::Zero();
  for (std::size_t p = 0; p < 512; ++p) {
    const Vec3 offset = points[p] - lattice[p];
    CHECK(offset.cwiseAbs().maxCoeff() <= 0.2);
    mean += offset / 512;
    square += offset.cwiseAbs2() / 512;
  }
  // Uniform in [-0.2, 0.2]: variance 0.04/3; the mean of 512 scatters by sqrt(that/512) = 0.0051,
  // the variance by 0.04 sqrt(4/45/512) = 0.00053. Bounds of four such widths.
  CHECK(mean.cwiseAbs().maxCoeff() < 0.0204);
  CHECK((square.array() - 0.04 / 3).abs().maxCoeff() < 0.0021);
  CHECK(points == jittered(0));
  CHECK(points != jittered(1));
  // The first output of SplitMix64 from 0 is e220a8397b1dcdaf: 53 bits of it over 2^52, less 1.
  CHECK(points[0].x() ==
        0.5 + 0.2 * (double(0xe220a8397b1dcdafU >> 11) / double(std::uint64_t(1) << 52) - 1));
}

TEST_CASE("fill: an empty region is a located mistake", "[mesh][errors]") {
  CHECK(mistakes_of(filled({0, 0, 0}, {1, 1, 0.004}), 0.01, 3) ==
        "case.yaml:14:5: parts.skin.fill.box.to: empty fill: the box is 0.004 m thick in z, the "
        "spacing is 0.01 m");
  CHECK(mistakes_of(filled({0, 2, 0}, {1, 1, 1}), 0.01, 3) ==
        "case.yaml:14:5: parts.skin.fill.box.to: y = 1 m must be greater than that of 'from', 2 "
        "m");
  CHECK(mistakes_of(filled({0, 0, 1}, {1, 1, 2}), 0.1, 2) ==
        "case.yaml:14:5: parts.skin.fill.box.to: empty fill: the plane z = 0 of a 2D case does not "
        "meet the box");
  CHECK(mistakes_of(filled({0, 0, 0}, {1e3, 1e3, 1e3}), 0.1, 3) ==
        "case.yaml:14:5: parts.skin.fill.box.to: more than 2e+09 particles of spacing 0.1 m would "
        "fill the box");
  CHECK(mistakes_of(part({map("fill", {})}), 0.1, 3) ==
        "case.yaml:11:5: parts.skin.fill: says no region; a 'box', an 'ellipsoid' or a 'cylinder' "
        "is wanted");
}

TEST_CASE("fill: one spacing thick holds one layer, also with rounding", "[mesh]") {
  const Value part = filled({0, 0, 0}, {0.3, 0.3, 0.1 + 0.2 - 0.2});  // a hair below or at 0.1
  Mistakes mistakes;
  CHECK(fill_points(Keys(part, mistakes), 0.1, 3).size() == 9);
  CHECK(mistakes.empty());
}

TEST_CASE("fill: an ellipse has the lattice points inside, centred", "[mesh]") {
  const Value part = test::part({map(
      "fill", {map("ellipsoid", {numbers("centre", {1, 2, 0}), numbers("radii", {1, 0.5, 0})})})});
  Mistakes mistakes;
  const auto points = fill_points(Keys(part, mistakes), 0.5, 2);
  // Rows at y = 2 +- 0.25: |x - 1| <= sqrt(1 - 0.25) = 0.87, so 0.25 and 0.75.
  const std::vector<Vec3> expected = {{0.25, 1.75, 0}, {0.75, 1.75, 0}, {1.25, 1.75, 0},
                                      {1.75, 1.75, 0}, {0.25, 2.25, 0}, {0.75, 2.25, 0},
                                      {1.25, 2.25, 0}, {1.75, 2.25, 0}};
  CHECK(points == expected);
  CHECK(fill_cell_volume(Keys(part, mistakes), 0.5, 2) == 0.25);
  // 8 cells of 0.25 for pi/2: +27 %.
  CHECK(fill_note(Keys(part, mistakes), 0.5, 2).find("+27 %") != std::string::npos);
  CHECK(mistakes.empty());
}

TEST_CASE("fill: a cylinder fills its length, and its circle as the spacing goes to 0", "[mesh]") {
  const Value part = test::part(
      {map("fill", {map("cylinder", {numbers("from", {2, 0, 1}), numbers("to", {0.9, 0, 1}),
                                     numbers("radius", {0.5})})})});
  Mistakes mistakes;
  for (const double dx : {0.1, 0.02}) {
    const auto points = fill_points(Keys(part, mistakes), dx, 3);
    const double volume =
        static_cast<double>(points.size()) * fill_cell_volume(Keys(part, mistakes), dx, 3);
    CHECK(volume == Approx(M_PI * 0.25 * 1.1).epsilon(0.5 * dx));
    for (const Vec3& x : points) {
      CHECK(std::hypot(x.y(), x.z() - 1) <= 0.5);
      CHECK(x.x() > 0.9);
      CHECK(x.x() < 2);
    }
  }
  CHECK(mistakes.empty());
}

TEST_CASE("fill: shapes that cannot be filled are mistakes", "[mesh]") {
  const auto ellipse = [](std::vector<double> radii) {
    return test::part(
        {map("fill", {map("ellipsoid", {numbers("centre", {0, 0, 0}), numbers("radii", radii)})})});
  };
  CHECK(mistakes_of(ellipse({1, 0.05, 0}), 0.1, 2).find("empty fill") != std::string::npos);
  const Value leaning = test::part(
      {map("fill", {map("cylinder", {numbers("from", {0, 0, 0}), numbers("to", {1, 1, 0}),
                                     numbers("radius", {0.5})})})});
  CHECK(mistakes_of(leaning, 0.1, 3).find("along x, y or z") != std::string::npos);
  CHECK(mistakes_of(leaning, 0.1, 2).find("plane case") != std::string::npos);
  const Value two = test::part({map(
      "fill", {map("box", {numbers("from", {0, 0, 0}), numbers("to", {1, 1, 1})}),
               map("ellipsoid", {numbers("centre", {0, 0, 0}), numbers("radii", {1, 1, 1})})})});
  CHECK(mistakes_of(two, 0.1, 3).find("more than one region") != std::string::npos);
}
