#include "sph/neighbour_lists.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "pool.hpp"

using namespace gannet;
using gannet::test::Pool;

namespace {

/// A plane sheet of water, repeated along y, whose particles each move for themselves, some of them
/// far faster than those around, and a jet that meets it.
Pool storm(const std::string& more) {
  return Pool(R"(
materials: {water: {density: 1000, c0: 100 m/s}}
parts:
  sheet: {sph: {material: water, spacing: 0.05)" +
                  more + R"(}, fill: {box: {from: [0, 0, 0], to: [1, 1, 0]}}}
  jet:
    sph: {material: water, spacing: 0.05)" +
                  more + R"(}
    fill: {box: {from: [1.3, 0.4, 0], to: [1.6, 0.6, 0]}}
    initial_velocity: [-8, 0, 0]
boundaries: {sides: {periodic: {y: [0, 1]}}}
)",
              2, Vec3::Zero(), [](Scene& scene) {
                for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
                  const auto k = static_cast<double>(scene.nodes.id[i]);
                  const double speed = std::sin(11 * k) > 0.95 ? 4.0 : 0.3;
                  set_xyz(scene.nodes.v[i], xyz(scene.nodes.v[i]) +
                                                speed * Vec3(std::sin(7 * k), std::cos(5 * k), 0));
                }
              });
}

double period(Pool& pool) { return pool.sph().halo.high.y() - pool.sph().halo.low.y(); }

/// Whether a line at a distance of (dx, dy) in the plane is nearer than `reach`. Plain numbers:
/// under the sanitizers these are asked for a hundred million times.
bool is_near(double dx, double dy, double reach) { return dx * dx + dy * dy < reach * reach; }

/// Pairs of an owned particle and a particle or an image of one along y that are nearer than
/// `reach`, less than half the period, with all particles at x.
int pairs_near(Pool& pool, const Array<Line>& all, Index i, double reach) {
  const double L = period(pool);
  const Line* x = all.data();
  const Line at = x[i];
  const Index n_particles = pool.scene.particles.size();
  int n = 0;
  for (Index j = 0; j < n_particles; ++j) {
    const double dx = at.x - x[j].x;
    if (dx > reach || dx < -reach) continue;
    double dy = at.y - x[j].y;
    if (dy > 0.5 * L) dy -= L;
    if (dy < -0.5 * L) dy += L;
    n += is_near(dx, dy, reach) ? 1 : 0;
  }
  return n;
}

/// Of those, the ones that the list of the particle holds.
int pairs_listed(Pool& pool, const Array<Line>& all, Index i, double reach) {
  const ClusterList& list = pool.sph().list;
  const auto c = static_cast<std::size_t>(i / ClusterList::lanes);
  const Line* x = all.data();
  const Line at = x[i];
  const auto end = list.source.data() + list.offset[c + 1];
  int n = 0;
  for (auto source = list.source.data() + list.offset[c]; source != end; ++source) {
    if (*source >= list.n_sources) continue;
    n += is_near(at.x - x[*source].x, at.y - x[*source].y, reach) ? 1 : 0;
  }
  return n;
}

/// The particles that miss a pair nearer than the kernel reaches, now.
int n_missing_now(Pool& pool) {
  const Array<Line> x(pool.scene.nodes.x.begin() + pool.scene.particles.begin,
                      pool.scene.nodes.x.end());
  const double reach = (1 - 1e-9) * pool.sph().kernel.reach();
  int n = 0;
  for (Index i = 0; i < pool.scene.particles.size(); ++i) {
    n += pairs_near(pool, x, i, reach) != pairs_listed(pool, x, i, reach);
  }
  return n;
}

/// The particles that miss a pair which was nearer than the kernel reaches and their skin when the
/// lists were built.
int n_missing_at_build(Pool& pool) {
  const SphState& sph = pool.sph();
  int n = 0;
  for (Index i = 0; i < pool.scene.particles.size(); ++i) {
    const double reach = (1 - 1e-6) * (sph.kernel.reach() + sph.list_skin[i]);
    n += pairs_near(pool, sph.x_build, i, reach) != pairs_listed(pool, sph.x_build, i, reach);
  }
  return n;
}

}  // namespace

TEST_CASE("neighbour lists: no pair is missing after any step of a storm", "[sph]") {
  for (const char* more : {"", ", skin: 0.2"}) {
    Pool pool = storm(more);
    int n_missing = 0;
    int n_steps = 0;
    while (pool.at().t < 0.08) {
      pool.run(1);
      ++n_steps;
      n_missing += n_missing_now(pool);
    }
    CHECK(n_missing == 0);
    CHECK(n_steps > 200);
    CHECK(pool.sph().n_builds > 10);
    CHECK(pool.sph().n_builds <
          0.8 * n_steps);  // lists that were made anew at every step say nothing
  }
}

TEST_CASE("neighbour lists: water that meets across a periodic end is seen in time", "[sph]") {
  // A stray particle makes the cells of the lists' age so large that the two drops, 5 m apart and
  // 1 m across the end, are far from each other in it.
  Pool pool(R"(
materials: {water: {density: 1000, c0: 100 m/s}}
parts:
  lower:
    sph: {material: water, spacing: 0.05}
    fill: {box: {from: [0, 0.3, 0], to: [0.2, 0.5, 0]}}
    initial_velocity: [0, -4, 0]
  upper:
    sph: {material: water, spacing: 0.05}
    fill: {box: {from: [0, 5.5, 0], to: [0.2, 5.7, 0]}}
    initial_velocity: [0, 4, 0]
  stray:
    sph: {material: water, spacing: 0.05}
    fill: {box: {from: [1000, 3, 0], to: [1000.1, 3.1, 0]}}
boundaries: {sides: {periodic: {y: [0, 6]}}}
)",
            2);
  int n_missing = 0;
  bool met = false;
  while (pool.at().t < 0.09) {
    pool.run(1);
    n_missing += n_missing_now(pool);
    for (Index i = 0; i < pool.scene.particles.size(); ++i) {
      const double v_y = pool.scene.nodes.v[pool.scene.particles.begin + i].y;
      met = met || (pool.x(i).y() < 1 && v_y > -3);
    }
  }
  CHECK(met);
  CHECK(n_missing == 0);
}

TEST_CASE("neighbour lists: skins are thick only where particles move against each other",
          "[sph]") {
  Pool pool = storm("");
  while (pool.at().t < 0.12) pool.run(1);
  const SphState& sph = pool.sph();
  double sum = 0;
  for (Index k = 0; k < pool.scene.particles.size(); ++k) {
    const double skin = sph.list_skin[static_cast<std::size_t>(k)];
    CHECK(skin >= sph.skin.least);
    CHECK(skin <= sph.skin.width);
    sum += skin;
  }
  CHECK(sum < 0.8 * sph.skin.width * pool.scene.particles.size());
}

TEST_CASE("neighbour lists: each reaches as far as its skin says, across a periodic end too",
          "[sph]") {
  for (const char* more : {"", ", skin: 0.4"}) {
    Pool pool = storm(more);
    int n_missing = n_missing_at_build(pool);
    while (pool.at().t < 0.08) {
      const std::int64_t built = pool.sph().n_builds;
      pool.run(1);
      if (pool.sph().n_builds > built) n_missing += n_missing_at_build(pool);
    }
    CHECK(n_missing == 0);
  }
}

TEST_CASE("neighbour lists: a restart with another skin takes the stored ones as they are",
          "[sph]") {
  Pool thick = storm(", skin: 0.4");
  thick.run(1);
  const std::int64_t built = thick.sph().n_builds;
  while (thick.sph().n_builds == built) thick.run(1);
  // As old as these lists become.
  test::Saved old;
  Step at;
  for (std::int64_t now = thick.sph().n_builds; thick.sph().n_builds == now; thick.run(1)) {
    old = test::save(thick.scene);
    at = thick.at();
  }
  for (const char* more : {", skin: 0.02", ", skin: 0.4", ", skin: 1", ""}) {
    Pool other = storm(more);
    test::load(old, other.scene);
    other.models.list.front().step = at;
    for (const auto& rebuild : other.scene.after_restart) rebuild();
    CHECK(other.sph().skin.width == Approx(0.4 * 0.05));
    CHECK(n_missing_now(other) == 0);
    CHECK(n_missing_at_build(other) == 0);
    int n_missing = 0;
    for (int k = 0; k < 30; ++k) {
      other.run(1);
      n_missing += n_missing_now(other);
    }
    CHECK(n_missing == 0);
    CHECK(other.sph().skin.width >= other.sph().skin.least);
    CHECK(other.sph().skin.width <= other.sph().skin.most);
  }
}

TEST_CASE("neighbour lists: water that meets head on is seen, wherever it was at the last build",
          "[sph]") {
  // Rows at all distances from a wall of water: some are just out of its reach at any build.
  Pool pool(R"(
materials: {water: {density: 1000, c0: 100 m/s}}
parts:
  still: {sph: {material: water, spacing: 0.05, skin: 0.5}, fill: {box: {from: [0, 0, 0], to: [0.3, 1, 0]}}}
  rows:
    sph: {material: water, spacing: 0.05, skin: 0.5}
    fill: {box: {from: [0.5, 0, 0], to: [0.7, 1, 0]}}
    initial_velocity: [-2, 0, 0]
boundaries: {sides: {periodic: {y: [0, 1]}}}
)",
            2, Vec3::Zero(), [](Scene& scene) {
              for (Index i = scene.particles.begin; i < scene.particles.end; ++i) {
                Line& x = scene.nodes.x[i];
                if (x.x > 0.4) x.x += 0.002 * std::floor(x.y / 0.1);
              }
            });
  int n_missing = 0;
  while (pool.at().t < 0.09) {
    pool.run(1);
    n_missing += n_missing_now(pool);
  }
  CHECK(n_missing == 0);
  CHECK(pool.sph().n_builds > 5);
}
