// Rotation of which some components are given.
#include <catch2/catch.hpp>

#include <cmath>

#include "body/body_mass.hpp"
#include "body/rigid_body.hpp"
#include "body/rigid_measures.hpp"

using namespace gannet;

namespace {

const Mat3 tilted = [] {
  Mat3 m;
  m << 2, 0.2, -0.1, 0.2, 3, 0.3, -0.1, 0.3, 4;
  return m;
}();

const Quaternion start = Quaternion(0.8, 0.3, -0.2, 0.4).normalized();

/// Angular momentum of the midpoint rule: R (I Omega - dt/2 (I Omega) x Omega) of the mean angular
/// velocity in space.
Vec3 momentum_of(const Vec3& omega, double dt) {
  const Mat3 R = start.toRotationMatrix();
  const Vec3 w = R.transpose() * omega;
  return R * (tilted * w - 0.5 * dt * (tilted * w).cross(w));
}

}  // namespace

TEST_CASE("guided rotation: with nothing given it is the free one", "[body]") {
  const Vec3 L(1, -2, 3);
  const FreeRotation free = rotate_freely(start, L, tilted.inverse(), 0.1);
  Vec3 kept = L;
  const FreeRotation guided = rotate_guided(start, tilted, 0, Vec3::Zero(), 0.1, kept);
  REQUIRE(guided.settled);
  CHECK((guided.omega - free.omega).norm() < 1e-14);
  CHECK((guided.q.coeffs() - free.q.coeffs()).norm() < 1e-14);
  CHECK(kept == L);
}

TEST_CASE("guided rotation: a given component holds, the others keep their momentum", "[body]") {
  const Vec3 before(1, -2, 3);
  for (const unsigned mask : {1u, 2u, 4u, 3u, 5u, 6u}) {
    Vec3 L = before;
    const FreeRotation turn = rotate_guided(start, tilted, mask, Vec3::Zero(), 0.1, L);
    REQUIRE(turn.settled);
    CHECK((momentum_of(turn.omega, 0.1) - L).norm() < 1e-13);
    for (int d = 0; d < 3; ++d) {
      CAPTURE(mask, d);
      if ((mask >> d & 1u) != 0) {
        CHECK(std::abs(turn.omega[d]) < 1e-15);
      } else {
        CHECK(L[d] == before[d]);
      }
    }
  }
}

TEST_CASE("guided rotation: one that is given as a whole turns by its angle exactly", "[body]") {
  const Vec3 rate(0.3, -1.2, 2);
  const double dt = 0.3;  // 0.7 rad in one step
  Vec3 L(9, 9, 9);
  const FreeRotation turn = rotate_guided(start, tilted, 7, rate, dt, L);
  REQUIRE(turn.settled);
  const Quaternion expected(Eigen::AngleAxisd(rate.norm() * dt, rate.normalized()));
  CHECK((turn.q.toRotationMatrix() - (expected * start).toRotationMatrix()).norm() < 1e-14);
  CHECK((momentum_of(turn.omega, dt) - L).norm() < 1e-13);
}

TEST_CASE("roll, pitch and yaw of a rotation about each axis", "[body]") {
  const auto angles = [](double angle, const Vec3& axis) {
    return roll_pitch_yaw(Quaternion(Eigen::AngleAxisd(angle, axis)).coeffs());
  };
  CHECK((angles(0.3, Vec3::UnitX()) - Vec3(0.3, 0, 0)).norm() < 1e-15);
  CHECK((angles(-0.4, Vec3::UnitY()) - Vec3(0, -0.4, 0)).norm() < 1e-15);
  CHECK((angles(2, Vec3::UnitZ()) - Vec3(0, 0, 2)).norm() < 1e-15);
  const Quaternion all = Eigen::AngleAxisd(0.5, Vec3::UnitZ()) *
                         Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                         Eigen::AngleAxisd(0.1, Vec3::UnitX());
  CHECK((roll_pitch_yaw(all.coeffs()) - Vec3(0.1, 0.2, 0.5)).norm() < 1e-15);
}

TEST_CASE("body mass: of three point masses by hand", "[body]") {
  Nodes nodes;
  nodes.x = {{0, 0, 0, 2}, {4, 0, 0, 1}, {0, 4, 0, 1}};
  const BodyMass body = mass_of_nodes(nodes, {0, 1, 2});
  CHECK(body.mass == 4);
  CHECK((body.centre - Vec3(1, 1, 0)).norm() < 1e-15);
  // sum m (y^2, x^2, x^2 + y^2) = (2 + 1 + 9, 2 + 9 + 1, 24); sum m x y = 2 - 3 - 3 = -4
  Mat3 expected;
  expected << 12, 4, 0, 4, 12, 0, 0, 0, 24;
  CHECK((body.inertia - expected).norm() < 1e-14);
  CHECK(least_inertia(body) == Approx(8).epsilon(1e-14));
  CHECK(least_inertia(mass_of_nodes(nodes, {0, 1})) == 0);  // a line turns about itself freely
}
