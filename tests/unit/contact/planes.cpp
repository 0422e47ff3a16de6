#include "contact/planes.hpp"

#include <catch2/catch.hpp>

#include "base/parallel.hpp"
#include "contact/effects.hpp"
#include "contact/part_contact.hpp"
#include "contact/part_planes.hpp"
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

namespace {

/// A plate of one element, four nodes of mass 3, thickness 0.02 and E t = 1e5, and a floor.
struct PlateOnFloor {
  Scene scene;
  PartMeeting meeting;
  PartOnPlanes* c = nullptr;

  PlateOnFloor(double friction, double z) {
    Builder b;
    b.node_mass = 3;
    b.shape = [z](double x, double y) { return Vec3(x, y, z); };
    b.fill(scene);
    scene.planes = {{"floor", {0, 0, 0}, {0, 0, 1}, {}}};
    c = &make_part_on_planes(scene, "c", 0, {.thickness = 0.02, .young = 5e6}, {0}, friction > 0);
    c->distance = 0.01;
    c->law.friction = friction;
  }
  void pass(double dt_old = 0) {
    for (Line& f : scene.nodes.f) f = {};
    meeting.stiffness.assign(scene.nodes.x.size(), 0);
    meeting.touched.clear();
    part_on_planes_pass(scene, *c, {.dt_old = dt_old, .dt = 1e-3}, meeting);
  }
};

}  // namespace

TEST_CASE("planes: a plate is pushed out by hand, what it starts with makes no force",
          "[contact]") {
  PlateOnFloor p(0, 0.02);
  p.scene.nodes.x[1].z = 0.004;
  p.pass();
  CHECK(p.c->on_planes.norm() == 0);
  CHECK(p.c->offset[1] == Approx(0.006));
  CHECK(p.c->numbers[1] == 1);
  CHECK(p.meeting.touched.empty());
  p.scene.nodes.x[0].z = 0.008;
  p.scene.nodes.x[1].z = 0.003;
  p.pass();
  // k = 2 * 0.2 E t/A times a quarter of A, but for the little that the face is bent.
  const double k = 0.4 * 1e5 / 4;
  CHECK(p.scene.nodes.f[0].z == Approx(k * 0.002).epsilon(1e-3));
  CHECK(p.scene.nodes.f[1].z == Approx(k * 0.001).epsilon(1e-3));  // less what it began with
  CHECK(p.c->on_planes.z() == Approx(-k * 0.003).epsilon(1e-3));
  // A plane does not give way: omega^2 = k/m.
  CHECK(rate_of(p.scene.nodes, Followers{}, p.meeting).omega2 == Approx(k / 3).epsilon(1e-3));
}

TEST_CASE("planes: friction sticks below its limit and slips at it", "[contact]") {
  PlateOnFloor p(0.5, 0.02);
  p.pass();
  for (std::size_t i = 0; i < 4; ++i) p.scene.nodes.x[i].z = 0.009;  // 1 mm inside
  const double k = 0.4 * 1e5 / 4;
  for (std::size_t i = 0; i < 4; ++i) p.scene.nodes.v[i].x = 0.2;
  p.pass(1e-3);  // slip 0.2 mm: k 0.2 mm is less than half of k 1 mm
  CHECK(p.scene.nodes.f[0].x == Approx(-k * 0.2e-3));
  p.pass(2e-3);  // another 0.4 mm: 0.6 mm is more
  CHECK(p.scene.nodes.f[0].x == Approx(-0.5 * k * 1e-3));
  CHECK(p.c->on_planes.x() == Approx(4 * 0.5 * k * 1e-3));
  for (std::size_t i = 0; i < 4; ++i) p.scene.nodes.x[i].z = 0.02;
  p.pass(1e-3);
  CHECK(p.c->tangential[0].x == 0);  // what lets go forgets
}

TEST_CASE("planes: a moving plane puts in its force along its own path", "[contact]") {
  PlateOnFloor p(0, 0.02);
  Plane& floor = p.scene.planes[0];
  floor.moves = true;
  floor.velocity = {0, 0, 3};
  floor.velocity_old = {0, 0, 2};
  floor.spin = {0, -5, 0};  // lifts what lies at x > 0
  Ledger ledger;
  add_part_on_planes(p.scene, *p.c, p.meeting, ledger);
  p.pass();
  floor.point.z() = 0.015;  // came nearer: 5 mm inside of 10 mm
  p.pass();
  const double f = 0.4 * 1e5 / 4 * 0.005;
  double at_x = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(p.scene.nodes.f[i].z == Approx(f));
    at_x += p.scene.nodes.x[i].x;
  }
  Step step;
  step.dt_old = 1e-3;
  step.dt = 2e-3;
  add_work_on_planes(p.scene, *p.c, step);
  CHECK(p.c->put_in->value == Approx(4 * f * 2 * 0.5e-3));
  CHECK(p.c->put_in->pending == Approx(f * (4 * 3 + 5 * at_x) * 1e-3));
}
