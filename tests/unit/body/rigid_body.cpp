#include "body/rigid_body.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "small_world.hpp"

using namespace gannet;
using gannet::test::World;

namespace {

// Centre, two members at (1, 0, 0) and (-1, 0, 0) from it, one at (0, 2, 1).
const std::vector<Vec3> places{{5, 5, 5}, {6, 5, 5}, {4, 5, 5}, {5, 7, 6}};

Index node_at(const Scene& scene, const Vec3& place) {
  for (std::size_t i = 0; i < scene.nodes.x.size(); ++i) {
    if ((xyz(scene.nodes.x[i]) - place).norm() < 1e-9) return static_cast<Index>(i);
  }
  return -1;
}

struct Hull {
  std::unique_ptr<World> world;
  RigidBody* body = nullptr;
  Index member(int k) const { return body->members[static_cast<std::size_t>(k)]; }
  Line& x(Index i) const { return world->scene.nodes.x[static_cast<std::size_t>(i)]; }
  Line& v(Index i) const { return world->scene.nodes.v[static_cast<std::size_t>(i)]; }
};

using Push = std::function<Vec3(double t)>;

// A body of 4 kg with the given inertia; member k feels push[k](t).
Hull make_hull(const Mat3& inertia, const Vec3& omega, const Vec3& velocity,
               const std::vector<Push>& push = {}) {
  PartDraft part;
  part.name = "hull";
  part.cell = Cell::line;
  part.rotations = true;
  part.points = places;
  part.connectivity = {0, 1};
  part.velocity = velocity;
  Draft draft;
  draft.parts = {part};
  Hull hull;
  hull.world = test::make_world("", draft, {}, 1, 1);
  Scene& scene = hull.world->scene;
  RigidBodyInput input{.name = "hull", .mass = 4, .inertia = inertia, .omega = omega};
  input.node = node_at(scene, places[0]);
  for (std::size_t k = 1; k < places.size(); ++k) {
    input.members.push_back(node_at(scene, places[k]));
  }
  hull.body = &make_rigid_body(scene, input);
  Ledger& ledger = hull.world->models.ledger;
  Model& model = hull.world->model();
  // Forces come after the body's own operations in the table of effects, and must still count.
  add_rigid_body_operations(scene, model, ledger, *hull.body);
  LedgerEntry& work = ledger.entry("push", "hull");
  work.external = true;
  for (std::size_t k = 0; k < push.size(); ++k) {
    const Index i = input.members[k];
    const Push f = push[k];
    model.plan.add({.name = "push", .stage = Stage::force, .run = [&scene, i, f](const Step& s) {
                      add_xyz(scene.nodes.f[static_cast<std::size_t>(i)], f(s.t));
                    }});
  }
  const std::vector<Index> members = input.members;
  model.plan.add({.name = "work", .stage = Stage::look, .run = [=, &scene, &work](const Step& s) {
                    Work w = Work::Zero();
                    for (std::size_t k = 0; k < push.size(); ++k) {
                      w += work_along(work_path(scene.nodes, members[k], s), push[k](s.t));
                    }
                    work.add_work(w);
                  }});
  return hull;
}

Mat3 diagonal(double a, double b, double c) { return Vec3(a, b, c).asDiagonal(); }

// A full tensor with principal moments a, b, c.
Mat3 tilted(double a, double b, double c) {
  const Mat3 R = Quaternion(0.8, 0.1, -0.5, 0.3).normalized().toRotationMatrix();
  return R * diagonal(a, b, c) * R.transpose();
}

Quaternion attitude(const RigidBody& body) { return {body.q[3], body.q[0], body.q[1], body.q[2]}; }

}  // namespace

TEST_CASE("rigid body: a free asymmetric top keeps energy and momentum for 1e5 steps", "[body]") {
  // Started near its middle axis, so that it tumbles; large and small steps.
  const double angle = GENERATE(0.19, 0.02);
  auto hull = make_hull(tilted(1, 2, 3), Vec3::Zero(), {0.5, 0, 0});
  RigidBody& body = *hull.body;
  const Mat3 axes = Quaternion(0.8, 0.1, -0.5, 0.3).normalized().toRotationMatrix();
  body.L = body.inertia * (axes * Vec3(0.02, 2, 0.01));
  hull.world->dt = angle / 2;
  const Vec3 L = body.L;
  const double energy = rotation_energy(body, 0);
  double worst_energy = 0;
  double least_spin = 1e9;
  for (int n = 0; n < 100000; ++n) {
    hull.world->take_steps(1);
    worst_energy = std::max(worst_energy, std::abs(rotation_energy(body, 0) / energy - 1));
    const Vec3 omega = xyz(hull.world->scene.nodes.omega[static_cast<std::size_t>(body.node)]);
    least_spin = std::min(least_spin, omega.dot(L) / L.squaredNorm());
  }
  CAPTURE(angle, worst_energy);
  CHECK(body.L == L);  // never touched
  // Rounding alone: a random walk of 1e5 steps of 1e-16 ends near 1e-13.
  CHECK(worst_energy < 1e-12);
  CHECK(std::abs(body.q.norm() - 1) < 1e-15);
  // The momentum that the motion really has: I times the angular velocity of a step, turned by the
  // attitudes before and after it; their mean is L within (dt |omega|)^2/4, and |omega| here stays
  // below 1.5 times its start.
  const RigidBody before = body;
  hull.world->take_steps(1);
  const Vec3 omega = xyz(hull.world->scene.nodes.omega[static_cast<std::size_t>(body.node)]);
  const Vec3 in_body = attitude(body).conjugate() * omega;
  const Vec3 momentum = 0.5 * (attitude(before) * (body.inertia * in_body) +
                               attitude(body) * (body.inertia * in_body));
  CHECK((momentum - L).norm() < angle * angle * L.norm());
  // Members neither drift apart nor off their place.
  const double distance = (xyz(hull.x(hull.member(0))) - xyz(hull.x(hull.member(1)))).norm();
  CHECK(distance == Approx(2).epsilon(1e-12));
  CHECK(least_spin > 0);
}

TEST_CASE("rigid body: a symmetric top precesses as in closed form, at order 2", "[body]") {
  // omega = L/I1 + lambda e3 with lambda = omega3 (1 - I3/I1), both fixed (L in space, e3 in the
  // body): R(t) = exp(t [L/I1]) R(0) exp(t lambda [e3]).
  const Mat3 I = diagonal(1.5, 1.5, 2.4);
  const Vec3 omega0(0.7, 0.2, 1.1);
  const Vec3 L = I * omega0;
  const double lambda = omega0.z() * (1 - 2.4 / 1.5);
  const double t = 6;
  const Quaternion exact = Quaternion(Eigen::AngleAxisd(t * L.norm() / 1.5, L.normalized())) *
                           Quaternion(Eigen::AngleAxisd(t * lambda, Vec3::UnitZ()));
  const auto error = [&](int steps) {
    Quaternion q = Quaternion::Identity();
    for (int n = 0; n < steps; ++n) q = rotate_freely(q, L, I.inverse(), t / steps).q;
    return q.angularDistance(exact);
  };
  const double coarse = error(200);
  const double fine = error(400);
  CAPTURE(coarse, fine);
  CHECK(coarse < 5e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.02));
  // The axis goes round L at the rate L/I1: by then 1.7 turns.
  CHECK(t * L.norm() / 1.5 / (2 * M_PI) > 1.5);
}

TEST_CASE("rigid body: a turn about a principal axis, by hand", "[body]") {
  // I = 2, L = 3: Omega = 1.5; the Cayley map of dt Omega = 0.3 turns by 2 atan(0.15).
  const FreeRotation turn =
      rotate_freely(Quaternion::Identity(), {0, 0, 3}, diagonal(1, 1, 2).inverse(), 0.2);
  CHECK((turn.omega - Vec3(0, 0, 1.5)).norm() < 1e-15);
  const Quaternion expected(Eigen::AngleAxisd(2 * std::atan(0.15), Vec3::UnitZ()));
  CHECK(turn.q.angularDistance(expected) < 1e-15);
  const FreeRotation rest =
      rotate_freely(Quaternion::Identity(), Vec3::Zero(), diagonal(1, 1, 2).inverse(), 0.2);
  CHECK(rest.q.coeffs() == Quaternion::Identity().coeffs());
  // Where there is no answer it says so.
  CHECK(!rotate_freely(Quaternion::Identity(), {0, 0, NAN}, diagonal(1, 1, 1), 0.2).settled);
}

TEST_CASE("rigid body: a couple of two members turns it, a lone force also moves it", "[body]") {
  const auto up = [](double) { return Vec3(0, 3, 0); };
  const auto down = [](double) { return Vec3(0, -3, 0); };
  auto couple = make_hull(diagonal(1, 1, 2), Vec3::Zero(), Vec3::Zero(), {up, down});
  couple.world->dt = 0.1;
  couple.world->take_steps(1);
  // Torque 2 x 3 N x 1 m = 6 N m over the first half step: L = 0.3, omega = 0.15.
  CHECK((couple.body->L - Vec3(0, 0, 0.3)).norm() < 1e-16);
  const double angle = 2 * std::atan(0.5 * 0.1 * 0.15);
  const Vec3 moved = xyz(couple.x(couple.member(0))) - places[1];
  CHECK((moved - Vec3(std::cos(angle) - 1, std::sin(angle), 0)).norm() < 1e-14);
  CHECK(xyz(couple.v(couple.body->node)).norm() == 0);
  CHECK((xyz(couple.v(couple.member(0))) * 0.1 - moved).norm() < 1e-15);  // the chord

  auto lone = make_hull(diagonal(1, 1, 2), Vec3::Zero(), Vec3::Zero(), {up});
  lone.world->dt = 0.1;
  lone.world->take_steps(1);
  CHECK((lone.body->L - Vec3(0, 0, 0.15)).norm() < 1e-16);
  CHECK((xyz(lone.v(lone.body->node)) - Vec3(0, 3.0 / 4 * 0.05, 0)).norm() < 1e-16);
  // Between steps a member is moved by no force of its own.
  CHECK(lone.v(lone.member(0)).w == 0);
  CHECK(lone.x(lone.member(0)).w == 0);
}

TEST_CASE("rigid body: work on members is energy of the body, at order 2", "[body]") {
  const std::vector<Push> push{[](double t) { return Vec3(0, 3 * std::cos(t), 1); },
                               [](double t) { return Vec3(2 * std::sin(2 * t), 0, -2); },
                               [](double) { return Vec3(-1, 0.5, 0); }};
  const auto worst = [&](double dt) {
    auto hull = make_hull(tilted(4, 6, 5), {0.3, -0.4, 0.5}, {1, 0, 0}, push);
    hull.world->dt = dt;
    Ledger& ledger = hull.world->models.ledger;
    double error = 0;
    double start = 0;
    for (int n = 0; n * dt < 4; ++n) {
      hull.world->take_steps(1);
      const double balance = ledger.entry("kinetic", "hull").value +
                             ledger.entry("kinetic of rotation", "hull").value -
                             ledger.entry("push", "hull").value;
      if (n == 0) start = balance;
      error = std::max(error, std::abs(balance - start));
    }
    return error;
  };
  const double coarse = worst(0.02);
  const double fine = worst(0.01);
  CAPTURE(coarse, fine);
  CHECK(coarse < 5e-3);  // of about 10 J that go in
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

TEST_CASE("rigid body: a spinning body votes for 0.2 rad a step", "[body]") {
  auto hull = make_hull(diagonal(1, 2, 3), {0, 10, 0}, Vec3::Zero());
  hull.world->dt = 1;
  hull.world->take_steps(1);
  CHECK(hull.world->model().step.dt_old == Approx(0.02).epsilon(1e-14));
  CHECK(hull.world->model().vote.limited_by() == "hull: its rotation");
}

TEST_CASE("rigid body: the tracked fields carry it on, bit for bit", "[body]") {
  const std::vector<Push> push{[](double t) { return Vec3(0, 3 * std::cos(t), 1); }};
  auto whole = make_hull(tilted(4, 6, 5), {0.3, -0.4, 0.5}, {1, 0, 0}, push);
  auto cut = make_hull(tilted(4, 6, 5), {0.3, -0.4, 0.5}, {1, 0, 0}, push);
  whole.world->dt = cut.world->dt = 0.05;
  whole.world->take_steps(10);
  auto& from = whole.world->scene.fields;
  auto& to = cut.world->scene.fields;
  REQUIRE(from.size() == to.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto bytes = static_cast<std::size_t>(from[k].components * size_of(from[k].type));
    for (Index e = 0; e < from[k].count(); ++e) std::memcpy(to[k].at(e), from[k].at(e), bytes);
  }
  cut.world->model().step = whole.world->model().step;
  whole.world->take_steps(10);
  cut.world->take_steps(10);
  CHECK(cut.body->q == whole.body->q);
  CHECK(cut.body->L == whole.body->L);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(xyz(cut.world->scene.nodes.x[i]) == xyz(whole.world->scene.nodes.x[i]));
    CHECK(xyz(cut.world->scene.nodes.v[i]) == xyz(whole.world->scene.nodes.v[i]));
  }
}
