#include "contact/planes.hpp"

#include <catch2/catch.hpp>

#include "base/parallel.hpp"
#include "contact/effects.hpp"
#include "scene/particle_material.hpp"
#include "scenes.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Particles of spacing 0.1 and c0 = 100 m/s in a case without a key, on a floor at z = 0 and a
/// wall at x = 0.
struct Basin {
  Scene scene;
  Value empty;
  Mistakes mistakes;
  std::unique_ptr<Run> run;

  explicit Basin(const std::vector<Vec3>& particles, const Vec3& v, double dt) {
    empty.is_map = true;
    Builder b;
    b.shape = [](double x, double y) { return Vec3(x, y, 50); };  // out of the way
    b.particles = particles;
    b.particle_velocity = v;
    b.particle_mass = 2;
    b.fill(scene);
    scene.planes.push_back({"floor", {0, 0, 0}, {0, 0, 1}, {}});
    scene.planes.push_back({"wall", {0, 0, 0}, {1, 0, 0}, {}});
    scene.store.get<ParticleMaterials>().of_part = {{}, {0.1, 1000, 100}};
    run = std::make_unique<Run>(scene, nullptr, dt);
    plane_contact_effect().operations(Keys(empty, mistakes), scene, run->models);
  }
  const PlaneSums& sums(std::size_t plane) {
    return scene.store.get<ParticlesOnPlanes>().sums[plane];
  }
};

}  // namespace

TEST_CASE("planes: force and vote by hand", "[contact]") {
  Basin b({{1, 1, 0.03}, {0.04, 1, 0.04}, {1, 1, 0.05}}, {0, 0, 0}, 1e-6);
  particles_on_planes(b.scene, b.scene.store.get<ParticlesOnPlanes>());
  // k = 2 (100/0.1)^2 = 2e6, p = 0.02 and 0.01
  CHECK(b.scene.nodes.f[4].z == Approx(4e4));
  CHECK(b.scene.nodes.f[5].z == Approx(2e4));
  CHECK(b.scene.nodes.f[5].x == Approx(2e4));
  CHECK(b.scene.nodes.f[6].z == 0);  // just at the distance
  CHECK(b.sums(0).force.z() == Approx(-6e4));
  CHECK(b.sums(1).force.x() == Approx(-2e4));
  CHECK(plane_step(1e6) == Approx(0.8e-3));
  double force[3];
  bool found = false;
  for (const Measure& m : b.scene.measures) {
    if (m.name != "plane.floor.force") continue;
    m.sample(force);
    found = true;
  }
  CHECK(found);
  CHECK(force[2] == Approx(-6e4));
}

TEST_CASE("planes: elastic bounce, restitution 1 and energy held", "[contact]") {
  Basin b({{1, 1, 0.1}}, {0.5, 0, -10}, 2e-6);
  const double before = kinetic(b.scene);
  double worst = 0;
  double last = 1;
  for (int i = 0; i < 10000; ++i) {
    b.run->step();
    double held = 0;
    for (const LedgerEntry& e : b.run->models.ledger.entries()) held += e.value;
    last = std::abs(held - before) / before;
    if (i > 0) worst = std::max(worst, last);
  }
  CHECK(b.scene.nodes.v[4].z == Approx(10).epsilon(1e-3));
  CHECK(b.scene.nodes.v[4].x == 0.5);
  // Work along work_path() is what changes the kinetic energy; within a bounce the share of a step
  // that counts at its level is first order: k p v dt/2 / (m v^2/2) < omega dt/2 = 1e-3.
  CHECK(worst < 1e-3);
  CHECK(last < 1e-12);
}

TEST_CASE("planes: a particle at 0.5 c0 is thrown back at the voted step", "[contact]") {
  Basin b({{1, 1, 0.1}}, {0, 0, -50}, plane_step(1e6));
  for (int i = 0; i < 20; ++i) b.run->step();
  CHECK(b.scene.nodes.x[4].z > 0);
  // omega dt = 0.8: the exit speed depends on where in a step contact begins; it stays bounded
  CHECK(b.scene.nodes.v[4].z > 30);
  CHECK(b.scene.nodes.v[4].z < 75);
}

TEST_CASE("planes: sums are the same bits for any number of threads", "[contact]") {
  std::vector<Vec3> many;
  for (int i = 0; i < 9000; ++i) {
    many.emplace_back(0.01 * (i % 97), 0, 0.06 * std::abs(std::sin(i)));
  }
  Vec3 first = Vec3::Zero();
  for (const int n : {1, 2, 3, 5}) {
    set_threads(n);
    Basin b(many, {0, 0, 0}, 1e-6);
    particles_on_planes(b.scene, b.scene.store.get<ParticlesOnPlanes>());
    if (n == 1) first = b.sums(0).force;
    CHECK(b.sums(0).force == first);
  }
  set_threads(0);
}

TEST_CASE("planes: particles that start behind a wall are a mistake of the case", "[contact]") {
  Basin b({{1, 1, -0.3}}, {0, 0, 0}, 1e-6);
  CHECK_FALSE(b.mistakes.empty());
  Basin good({{1, 1, 0.3}}, {0, 0, 0}, 1e-6);
  CHECK(good.mistakes.empty());
}

TEST_CASE("planes: without planes or particles there is no operation", "[contact]") {
  Scene scene;
  Builder b;
  b.particles = {{0, 0, 3}};
  b.fill(scene);
  Run run(scene, nullptr, 1e-6);
  Value empty;
  empty.is_map = true;
  Mistakes mistakes;
  const auto n = run.model().plan.at(Stage::force).size();
  plane_contact_effect().operations(Keys(empty, mistakes), scene, run.models);
  CHECK(run.model().plan.at(Stage::force).size() == n);
  CHECK(scene.measures.empty());
}

TEST_CASE("planes: shell nodes rest on a plane, start penetration makes no force", "[contact]") {
  Scene scene;
  Builder b;
  b.node_mass = 3;
  b.shape = [](double x, double y) { return Vec3(x, y, x > 0.5 ? 0.004 : 0.02); };
  b.fill(scene);
  NodesOnPlanes c;
  c.part = 0;
  c.planes = {{"floor", {0, 0, 0}, {0, 0, 1}, {}}};
  c.law = {0.01, 0, 1e5};
  c.offset.assign(4, 0);
  c.begun.assign(1, 0);
  c.sums.resize(1);
  nodes_on_planes(scene, c);
  CHECK(c.sums[0].force.norm() == 0);
  CHECK(c.offset[1] == Approx(0.006));
  scene.nodes.x[0].z = 0.008;
  scene.nodes.x[1].z = 0.003;
  nodes_on_planes(scene, c);
  CHECK(scene.nodes.f[0].z == Approx(200));
  CHECK(scene.nodes.f[1].z == Approx(100));  // 0.007 less the 0.006 it began with
  // the first step: f . v dt/2 with v = f/m dt/2
  scene.nodes.v[0].z = 200.0 / 3 * 1e-3 / 2;  // as after the first kick
  scene.nodes.v[1].z = 100.0 / 3 * 1e-3 / 2;
  Step step;
  step.dt = 1e-3;
  const Work work = work_of_planes(scene, c, step).work;
  CHECK(work[0] == 0);  // there is no step before the first level
  CHECK(work[1] == Approx((200 * 200 + 100 * 100) / 3.0 * 1e-3 / 2 * 1e-3 / 2));
}

TEST_CASE("planes: a moving plane puts in its force along its own path", "[contact]") {
  Scene scene;
  Builder b;
  b.node_mass = 3;
  b.shape = [](double x, double y) { return Vec3(x, y, 0.02); };
  b.fill(scene);
  NodesOnPlanes c;
  c.part = 0;
  Plane floor{"floor", {0, 0, 0}, {0, 0, 1}, {}};
  floor.moves = true;
  floor.velocity = {0, 0, 3};
  floor.velocity_old = {0, 0, 2};
  floor.spin = {0, -5, 0};  // lifts what lies at x > 0
  scene.planes = {floor};
  c.planes = {floor};
  c.numbers = {0};
  c.law = {0.01, 0, 1e5};
  c.offset.assign(4, 0);
  c.begun.assign(1, 0);
  c.sums.resize(1);
  nodes_on_planes(scene, c);
  scene.planes[0].point.z() = 0.015;  // came nearer: 5 mm inside of 10 mm
  follow_planes(scene, c);
  nodes_on_planes(scene, c);
  double at_x = 0;
  for (const Index i : {0, 1, 2, 3}) {
    CHECK(scene.nodes.f[i].z == Approx(500));
    at_x += scene.nodes.x[i].x;
  }
  Step step;
  step.dt_old = 1e-3;
  step.dt = 2e-3;
  const Work put_in = work_of_planes(scene, c, step).put_in;
  CHECK(put_in[0] == Approx(4 * 500 * 2 * 0.5e-3));
  CHECK(put_in[1] == Approx(500 * (4 * 3 + 5 * at_x) * 1e-3));
}
