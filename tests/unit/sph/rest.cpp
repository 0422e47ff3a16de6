#include "sph/rest.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "pool.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

/// 24 particles, each 1 m from the next, nobody's neighbour: the first flies at 1 m/s along y, the
/// others creep along x at 1 mm/s. 1 kg/m^3 makes 0.01^2 kg of each.
const char* const far_apart = R"(
materials: {gas: {density: 1, c0: 10 m/s}}
parts:
  dust: {sph: {material: gas, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [0.24 m, 10 mm, 0]}}}
effects: {rest: {tolerance: 0.01, speed: 1 m/s, quiet: 20 ms}}
)";

void spread(Scene& scene) {
  for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
    const auto k = static_cast<double>(scene.nodes.id[i] - scene.nodes.id[scene.particles.begin]);
    set_xyz(scene.nodes.x[i], {k, 0, 0});
    set_xyz(scene.nodes.v[i], k == 0 ? Vec3(0, 1, 0) : Vec3(1e-3, 0, 0));
  }
}

double entry(const Pool& pool, const std::string& name) {
  double sum = 0;
  for (const LedgerEntry& e : pool.models.ledger.entries()) {
    if (e.name == name) sum += e.value;
  }
  return sum;
}

}  // namespace

TEST_CASE("rest: cells clamp at their ends and go round where they repeat", "[sph]") {
  const RestCells cells = cells_over({0, -1, 0}, {10, 1, 0}, 0.9, {true, false, false}, 1000);
  CHECK(cells.n == std::array<Index, 3>{11, 3, 1});
  CHECK(cells.edge.x() == Approx(10.0 / 11));
  CHECK(cells.edge.y() == 0.9);
  CHECK(cells.cell_of({0.1, -0.9, 0}) == 0);
  CHECK(cells.cell_of({9.99, -0.9, 5}) == 10);
  CHECK(cells.cell_of({-0.01, -0.9, 0}) == 10);
  CHECK(cells.cell_of({10.01, -0.9, 0}) == 0);
  CHECK(cells.cell_of({0.1, -77, 0}) == 0);
  CHECK(cells.cell_of({0.1, 77, 0}) == 22);
}

TEST_CASE("rest: marks widen along each axis, around an end that repeats", "[sph]") {
  const RestCells cells = cells_over({0, 0, 0}, {5, 3, 0}, 1, {true, false, false}, 1000);
  REQUIRE(cells.n == std::array<Index, 3>{5, 4, 1});
  CellMarks marks(20, 0);
  marks[0] = 1;
  widen(cells, 1, marks);
  CHECK(marks == CellMarks{1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("rest: slow particles stop after the quiet time, and the ledger has their motion",
          "[sph]") {
  Pool pool(far_apart, 2, Vec3::Zero(), spread);
  const double m = 1e-4;
  const double v2 = 1e-6;
  while (pool.at().t < 15e-3) pool.run(1);
  CHECK(pool.scene.resting.n == 0);
  while (pool.at().t < 60e-3) pool.run(1);
  // The one that flies, and seven more to fill its cluster.
  CHECK(pool.scene.awake().size() == 8);
  CHECK(pool.scene.resting.n == 16);
  CHECK(entry(pool, "rest") == Approx(16 * 0.5 * m * v2).epsilon(1e-9));
  CHECK(entry(pool, "kinetic") == Approx(0.5 * m * (1 + 7 * v2)).epsilon(1e-9));
  CHECK(pool.scene.resting.momentum.x() == Approx(16 * m * 1e-3).epsilon(1e-9));
  CHECK(pool.scene.resting.momentum.y() == 0);
  const std::vector<Index> place = pool.by_id();
  CHECK(place[0] < 8);
  CHECK(pool.v(place[0]).y() == 1);
  for (Index k = 8; k < 24; ++k) CHECK(pool.v(k).norm() == 0);
}

TEST_CASE("rest: particles that move against each other may rest, water that flows may not",
          "[sph]") {
  // Two particles in each of twelve cells three apart, just too far from each other to be felt, at
  // 2 and 50 times the limit of the flow.
  for (const double speed : {0.02, 0.5}) {
    for (const bool opposed : {true, false}) {
      Pool pool(far_apart, 2, Vec3::Zero(), [&](Scene& scene) {
        const SphState& sph = scene.store.get<SphState>();
        const double edge = sph.kernel.reach() + sph.skin.most;
        for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
          const Index k = scene.nodes.id[i] - scene.nodes.id[scene.particles.begin];
          const double cell = k < 2 ? 0.0 : 3.0 * (k / 2) + 0.5;
          const bool upper = k % 2 == 1;
          set_xyz(scene.nodes.x[i], {cell * edge, upper ? 1.001 * sph.kernel.reach() : 0.0, 0});
          set_xyz(scene.nodes.v[i], {upper && opposed ? -speed : speed, 0, 0});
        }
      });
      while (pool.at().t < 40e-3) pool.run(1);
      const bool rests = pool.scene.resting.n > 0;
      CHECK(rests == (opposed && speed < 0.1));
    }
  }
}

TEST_CASE("rest: the share that is saved counts particle steps", "[sph]") {
  Pool pool(far_apart, 2, Vec3::Zero(), spread);
  while (pool.scene.resting.n == 0) pool.run(1);
  const double before = pool.scene.resting.particle_steps;
  const double all = pool.scene.resting.all_particle_steps;
  CHECK(before == 16);
  CHECK(all == 24.0 * pool.at().n);
  pool.run(3);
  CHECK(pool.scene.resting.particle_steps == before + 3 * 16);
  CHECK(pool.scene.resting.all_particle_steps == all + 3 * 24);
}

TEST_CASE("rest: who comes near wakes what rests, before it can be felt", "[sph]") {
  // The last of the line flies towards the one before it.
  Pool pool(far_apart, 2, Vec3::Zero(), [](Scene& scene) {
    spread(scene);
    for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
      if (scene.nodes.x[i].x == 23) set_xyz(scene.nodes.v[i], {-5, 0, 0});
    }
  });
  const double reach = pool.sph().kernel.reach();
  const auto gap = [&] {
    const std::vector<Index> place = pool.by_id();
    return pool.x(place[23]).x() - pool.x(place[22]).x();
  };
  while (pool.at().t < 60e-3) pool.run(1);
  // Seven of those that creep keep awake to fill up a cluster; it may not be this one.
  const std::vector<Index> place = pool.by_id();
  REQUIRE(place[22] >= pool.scene.awake().size());
  while (gap() > 1.2 * reach) pool.run(1);
  CHECK(pool.by_id()[22] < pool.scene.awake().size());
  CHECK(pool.v(pool.by_id()[22]).norm() == 0);
  pool.run(40);
  CHECK(pool.v(pool.by_id()[22]).norm() > 1e-3);
}
