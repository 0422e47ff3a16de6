#include "sph/halo.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <tuple>

#include "scene/draft.hpp"

using namespace gannet;

namespace {

Halo periodic_xy() {
  Halo halo;
  halo.periodic = {true, true, false};
  halo.low = {0, -1, 0};
  halo.high = {10, 1, 0};
  return halo;
}

/// Three particles with one field of their own.
struct Three {
  Scene scene;
  Array<double> rho{1, 2, 3};

  explicit Three(const std::vector<Vec3>& points) {
    PartDraft part;
    part.name = "water";
    part.points = points;
    Draft draft;
    draft.parts = {part};
    assemble(draft, scene);
    scene.fields.push_back(
        plain_field("rho", "kg/m^3", "Density", Over::particles, rho, 1, GhostRule::copy));
  }
};

}  // namespace

TEST_CASE("halo: images of a corner, of a face and of the middle", "[sph]") {
  Halo halo = periodic_xy();
  const Array<Line> x{{0.1, -0.9, 5, 0}, {5, 0.95, 7, 0}, {5, 0, -3, 0}};
  choose_images(x.data(), 3, 0.2, halo);
  std::set<std::tuple<Index, double, double, double>> images;
  for (std::size_t g = 0; g < halo.source.size(); ++g) {
    const Vec3& s = halo.image[g].shift;
    images.insert({halo.source[g], s.x(), s.y(), s.z()});
  }
  CHECK(halo.source.size() == 4);
  CHECK(images == std::set<std::tuple<Index, double, double, double>>{
                      {0, 10, 0, 0}, {0, 0, 2, 0}, {0, 10, 2, 0}, {1, 0, -2, 0}});
}

TEST_CASE("halo: particles that left come back on the other side, others stay", "[sph]") {
  Three three({{-0.25, 0.5, 9}, {10, -3.5, -9}, {3, 1, 0}});
  wrap_particles(periodic_xy(), three.scene);
  std::set<std::tuple<double, double, double>> found;
  for (const Line& x : three.scene.nodes.x) found.insert({x.x, x.y, x.z});
  CHECK(found ==
        std::set<std::tuple<double, double, double>>{{9.75, 0.5, 9}, {0, 0.5, -9}, {3, -1, 0}});
}

TEST_CASE("halo: copy out shifts positions and copies the rest; add back sums forces", "[sph]") {
  Three three({{0.1, -0.9, 5}, {5, 0.95, 7}, {5, 0, -3}});
  Scene& scene = three.scene;
  Halo halo = periodic_xy();
  choose_images(scene.nodes.x.data(), 3, 0.2, halo);
  resize_ghosts(halo, scene);
  REQUIRE(scene.nodes.size() == 7);
  REQUIRE(three.rho.size() == 7);
  for (Index i = 0; i < 3; ++i) scene.nodes.v[i] = {i + 1.0, 0, -i - 1.0, 0.5};
  copy_out(halo, scene);
  for (Index g = 0; g < 4; ++g) {
    const Index s = halo.source[g];
    CHECK(xyz(scene.nodes.x[3 + g]) == xyz(scene.nodes.x[s]) + halo.image[g].shift);
    CHECK(xyz(scene.nodes.v[3 + g]) == xyz(scene.nodes.v[s]));
    CHECK(scene.nodes.id[3 + g] == scene.nodes.id[s]);
    CHECK(three.rho[3 + g] == three.rho[s]);
  }
  for (Index i = 0; i < 7; ++i) scene.nodes.f[i] = {1, 2, 4, 0};
  add_back(halo, scene);
  Vec3 total = Vec3::Zero();
  for (Index i = 0; i < 3; ++i) total += xyz(scene.nodes.f[i]);
  CHECK(total == Vec3(7, 14, 28));
  for (Index i = 3; i < 7; ++i) CHECK(xyz(scene.nodes.f[i]) == Vec3::Zero());
  int with_three = 0;
  for (Index i = 0; i < 3; ++i) with_three += scene.nodes.f[i].x == 4;
  CHECK(with_three == 1);
}

TEST_CASE("halo: walls mirror positions and velocities, a corner both ways", "[sph]") {
  Three three({{0.1, -0.9, 5}, {9.8, 0, 7}, {5, 0, -3}});
  Scene& scene = three.scene;
  Halo halo;
  halo.wall_low = {true, true, false};
  halo.wall_high = {true, false, false};
  halo.low = {0, -1, 0};
  halo.high = {10, 0, 0};
  choose_images(scene.nodes.x.data(), 3, 0.25, halo);
  resize_ghosts(halo, scene);
  REQUIRE(scene.nodes.n_ghosts == 4);
  // Nodes are numbered along a curve: which of the three points is node i?
  std::array<Index, 3> point{};
  for (Index i = 0; i < 3; ++i) {
    const double x = scene.nodes.x[i].x;
    point[i] = x == 0.1 ? 0 : (x == 9.8 ? 1 : 2);
    scene.nodes.v[i] = {point[i] + 1.0, 2, -point[i] - 1.0, 0.5};
  }
  copy_out(halo, scene);
  std::set<std::tuple<Index, double, double, double, double, double>> images;
  for (Index g = 0; g < 4; ++g) {
    const Line& x = scene.nodes.x[3 + g];
    const Line& v = scene.nodes.v[3 + g];
    images.insert({point[halo.source[g]], x.x, x.y, x.z, v.x, v.y});
    CHECK(v.z == -point[halo.source[g]] - 1.0);
    CHECK(three.rho[3 + g] == three.rho[halo.source[g]]);
  }
  const double x1 = 20 - 9.8;
  const double y0 = 0.9 - 2;
  CHECK(images == std::set<std::tuple<Index, double, double, double, double, double>>{
                      {0, -0.1, -0.9, 5, -1, 2},
                      {0, 0.1, y0, 5, 1, -2},
                      {0, -0.1, y0, 5, -1, -2},
                      {1, x1, 0, 7, -2, 2}});
  scene.nodes.f.assign(7, {1, 2, 4, 0});
  add_back(halo, scene);
  // Particle 0 gets (-1, 2), (1, -2) and (-1, -2) beside its own; z adds up.
  for (Index i = 0; i < 3; ++i) {
    if (point[i] == 0) CHECK(xyz(scene.nodes.f[i]) == Vec3(0, 0, 16));
    if (point[i] == 1) CHECK(xyz(scene.nodes.f[i]) == Vec3(0, 4, 8));
  }
}
