#include "sph/halo.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <tuple>

#include "pool.hpp"
#include "scene/draft.hpp"
#include "sph/moving_walls.hpp"
#include "sph/sticking_walls.hpp"

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
    const Vec3& s = halo.image_of(static_cast<Index>(g)).shift;
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
    CHECK(xyz(scene.nodes.x[3 + g]) ==
          xyz(scene.nodes.x[s]) + halo.image_of(static_cast<Index>(g)).shift);
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

TEST_CASE("halo: only the fields that are asked for are copied", "[sph]") {
  Three three({{0.1, -0.9, 5}, {5, 0.95, 7}, {5, 0, -3}});
  Scene& scene = three.scene;
  const Halo halo = [&] {
    Halo h = periodic_xy();
    choose_images(scene.nodes.x.data(), 3, 0.2, h);
    return h;
  }();
  resize_ghosts(halo, scene);
  copy_out(halo, scene);
  CHECK(copied_fields(scene).size() == 6);  // x, m, v, id, part, rho
  const Line x = scene.nodes.x[3];
  scene.nodes.x[halo.source[0]].y += 1;
  three.rho[halo.source[0]] = 9;
  const auto rho = static_cast<std::size_t>(scene.field("rho") - scene.fields.data());
  copy_out(halo, scene, std::vector{rho});
  CHECK(three.rho[3] == 9);
  CHECK(scene.nodes.x[3].y == x.y);
}

TEST_CASE("halo: many particles have the same images in the order of kinds and sources", "[sph]") {
  Halo halo;
  halo.periodic = {true, false, false};
  halo.wall_low = {false, true, false};
  halo.wall_high = {false, true, true};
  halo.high = {1, 1, 1};
  Array<Line> x;
  std::uint64_t seed = 1;
  const auto random = [&seed] {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(seed >> 11) * 0x1p-53;
  };
  for (int k = 0; k < 20000; ++k) x.push_back({random(), random(), random(), 0});
  const double reach = 0.2;
  choose_images(x.data(), static_cast<Index>(x.size()), reach, halo);
  // By hand: an image is one whose every coordinate is shifted or mirrored and within reach.
  std::vector<Index> sources;
  std::vector<Vec3> points;
  for (int k = 0; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        for (Index s = 0; s < 20000 && (i != 0 || j != 0 || k != 0); ++s) {
          const Vec3 p(x[s].x + i, j < 0 ? -x[s].y : (j > 0 ? 2 - x[s].y : x[s].y),
                       k > 0 ? 2 - x[s].z : x[s].z);
          if ((p.array() < -reach).any() || (p.array() > 1 + reach).any()) continue;
          sources.push_back(s);
          points.push_back(p);
        }
      }
    }
  }
  REQUIRE(std::equal(sources.begin(), sources.end(), halo.source.begin(), halo.source.end()));
  bool same = true;
  for (std::size_t g = 0; g < sources.size(); ++g) {
    const Vec3 image = halo.image_of(static_cast<Index>(g)).point(xyz(x[sources[g]]));
    same = same && (image - points[g]).cwiseAbs().maxCoeff() < 1e-15;
  }
  CHECK(same);
}

TEST_CASE("halo: ghosts hold what their sources hold after every copy of a step", "[sph]") {
  const char* text =
      "materials: {water: {density: 1000, c0: 30 m/s}}\n"
      "parts: {drop: {sph: {material: water, spacing: 0.1}, "
      "fill: {box: {from: [0, 0, 0], to: [0.8, 0.8, 0.8]}, jitter: 0.1}}}\n"
      "boundaries: {sides: {periodic: {x: [0, 0.8]}}}\n"
      "effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.5}}";
  test::Pool pool(text, 3, {0, 0, -10}, [](Scene& scene) {
    scene.planes.push_back({"floor", Vec3::Zero(), Vec3::UnitZ(), {}});
    for (Line& v : scene.nodes.v) set_xyz(v, {1, 0, -1});
  });
  Scene& scene = pool.scene;
  Halo& halo = pool.sph().halo;
  const auto of_ghosts = [&] {
    std::vector<double> values;
    for (Index g = scene.nodes.n_owned; g < scene.nodes.size(); ++g) {
      for (const Array<Line>* field : {&scene.nodes.x, &scene.nodes.v}) {
        const Line& line = (*field)[g];
        values.insert(values.end(), {line.x, line.y, line.z});
      }
      const Index k = g - scene.particles.begin;
      values.insert(values.end(),
                    {pool.sph().rho[k], pool.sph().p[k], static_cast<double>(scene.nodes.id[g])});
    }
    return values;
  };
  int n_copies = 0;
  for (const Stage stage : {Stage::half_drift, Stage::rates, Stage::drift}) {
    for (Operation& op : pool.plan().at(stage)) {
      if (!op.name.starts_with("halo: copy out")) continue;
      op.run = [&, copy = op.run](const Step& step) {
        copy(step);
        const std::vector<double> copied = of_ghosts();
        copy_out(halo, scene);
        CHECK(copied == of_ghosts());
        ++n_copies;
      };
    }
  }
  pool.run(60);
  CHECK(n_copies == 180);
  CHECK(pool.sph().n_builds > 1);
  CHECK(scene.nodes.n_ghosts > 300);
}

TEST_CASE("halo: images go with a wall that moves, and get its velocity twice", "[sph]") {
  Three three({{0.1, 0, 0}, {0.9, 0, 0}, {0.5, 0, 0}});
  Scene& scene = three.scene;
  Plane plane{"wall", {0, 0, 0}, {1, 0, 0}, {}};
  plane.moves = true;
  scene.planes = {plane};
  Halo halo;
  halo.wall_low = {true, false, false};
  halo.wall_high = {true, false, false};
  halo.low = {0, 0, 0};
  halo.high = {1, 0, 0};
  halo.moving = {{0, true, 0}};
  for (Index i = 0; i < 3; ++i) scene.nodes.v[i] = {2, 3, 0, 0.5};
  choose_images(scene.nodes.x.data(), 3, 0.2, halo);
  resize_ghosts(halo, scene);
  REQUIRE(scene.nodes.n_ghosts == 2);
  copy_out(halo, scene);
  scene.planes[0].point.x() = 0.03;
  scene.planes[0].velocity.x() = 5;
  for (int twice = 0; twice < 2; ++twice) move_images(halo, scene);  // says where, not how far
  // The particle at 0.1 behind the lower wall at 0.03: 0.06 - 0.1; the one at 0.9 behind 1.
  for (Index g = 0; g < 2; ++g) {
    const Line& x = scene.nodes.x[3 + g];
    const Line& v = scene.nodes.v[3 + g];
    const bool low = halo.image_of(g).shift.x() == 0;
    CHECK(x.x == Approx(low ? -0.04 : 1.1));
    CHECK(v.x == (low ? 8 : -2));
    CHECK(v.y == 3);
  }
  const WallsGone gone = walls_gone(halo, scene, 0.01);
  CHECK(gone.low.x() == Approx(0.08));
  CHECK(gone.high.x() == 0);
  follow_walls(halo, scene);
  CHECK(halo.low.x() == 0.03);
  CHECK(walls_gone(halo, scene, 0).low.x() == 0);
}

TEST_CASE("halo: images behind walls that water sticks to go the other way", "[sph]") {
  Three three({{0.1, 0.1, 0}, {0.9, 0.5, 0}, {0.5, 0.5, 0}});
  Scene& scene = three.scene;
  Plane side{"side", {0, 0, 0}, {1, 0, 0}, {}};
  side.moves = true;
  side.velocity = {5, 7, 0};
  scene.planes = {side};
  Halo halo;
  halo.wall_low = {true, true, false};
  halo.wall_high = {true, false, false};
  halo.low = {0, 0, 0};
  halo.high = {1, 1, 0};
  halo.sticking = {{0, true, 0}};
  for (Index i = 0; i < 3; ++i) scene.nodes.v[i] = {2, 3, 0, 0.5};
  choose_images(scene.nodes.x.data(), 3, 0.2, halo);
  resize_ghosts(halo, scene);
  copy_out(halo, scene);
  stick_images(halo, scene);
  REQUIRE(scene.nodes.n_ghosts == 4);
  for (Index g = 0; g < 4; ++g) {
    const Image& image = halo.image_of(g);
    const Vec3 v = xyz(scene.nodes.v[3 + g]);
    const bool behind_side = image.sign.x() < 0 && image.shift.x() == 0;
    if (!behind_side && image.sign.x() < 0) CHECK(v == Vec3(-2, 3, 0));
    if (!behind_side && image.sign.x() > 0) CHECK(v == Vec3(2, -3, 0));
    // 2 v_wall - v; in the corner the floor mirrors that.
    if (behind_side) CHECK(v == Vec3(8, image.sign.y() < 0 ? -11 : 11, 0));
  }
}
