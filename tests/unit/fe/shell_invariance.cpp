// What a change of place, direction or speed must not change, and what the element must balance.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

#include "shell_testing.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

const ElasticPlastic steel{.rho = 7800, .E = 210e9, .nu = 0.3, .sigma_y = 250e6, .H = 1e9};
const ElasticPlastic elastic_steel{.rho = 7800, .E = 210e9, .nu = 0.3};

Vec3 total_force(const Nodes& nodes) {
  Vec3 sum = Vec3::Zero();
  for (const Line& f : nodes.f) sum += xyz(f);
  return sum;
}

Vec3 total_moment(const Nodes& nodes) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < nodes.x.size(); ++i) {
    sum += xyz(nodes.x[i]).cross(xyz(nodes.f[i])) + xyz(nodes.torque[i]);
  }
  return sum;
}

/// Turns the sheet rigidly by `angle` about `axis` (a unit vector through the origin) as a time
/// integration does: v is the chord over the step, omega the true angular velocity.
void turn(Sheet& s, const Vec3& axis, double angle, double dt) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vec3 x = xyz(s.nodes.x[i]);
    set_xyz(s.nodes.v[i], (R * x - x) / dt);
    set_xyz(s.nodes.omega[i], angle / dt * axis);
    set_xyz(s.nodes.x[i], R * x);
  }
}

/// Largest strain-like measure of the state: stress over E.
double largest_in_plane(const ShellBlock& block) {
  double most = 0;
  for (Index e = 0; e < block.n_elements; ++e) {
    for (int k = 0; k < block.layout.n_points; ++k) {
      const PlaneStress<double> sigma = stress_at(block, e, k);
      most = std::max({most, std::abs(sigma.xx), std::abs(sigma.yy), std::abs(sigma.xy)});
    }
  }
  return most / block.material.E;
}

double largest_shear(const ShellBlock& block) {
  double most = 0;
  for (Index e = 0; e < block.n_elements; ++e) {
    for (int k = 0; k < 2; ++k) {
      most = std::max(most, std::abs(block.value(e, block.layout.shear() + k)));
    }
  }
  return most / block.material.E;
}

}  // namespace

TEST_CASE("shell: rigid rotation of warped elements strains nothing", "[fe][convergence]") {
  const Vec3 axis = Vec3(1, 2, -0.5).normalized();
  for (const Isa set : sets()) {
    const auto shear_after = [&](int n_steps) {
      Sheet s = crumpled(4, 3, 1);
      ShellBlock block = block_of(s, elastic_steel, {.thickness = 0.01});
      for (int k = 0; k < n_steps; ++k) {
        turn(s, axis, 1.0 / n_steps, 1e-4);
        clear_forces(s.nodes);
        shell_pass(block, s.nodes, 1e-4, set);
      }
      // The chord of a rigid rotation has no symmetric gradient at the midpoint: exact.
      CHECK(largest_in_plane(block) < 1e-13);
      for (Index e = 0; e < block.n_elements; ++e) {
        for (int q = 0; q < 3; ++q) {  // forces of the hourglass modes against E t A^(1/2)
          CHECK(std::abs(block.value(e, block.layout.hourglass() + q)) < 1e-13 * 210e9 * 1e-3);
        }
      }
      return largest_shear(block);
    };
    // Transverse shear compares the chord with the rotation of the nodes: 2 tan(a/2) against a.
    const double coarse = shear_after(10);
    const double fine = shear_after(20);
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.05));
    CHECK(fine < 1e-3 / 12);
  }
}

TEST_CASE("shell: stress and forces turn with the body", "[fe]") {
  Sheet s = crumpled(3, 3, 2);
  ShellBlock block = block_of(s, steel, {.thickness = 0.01});
  random_motion(s, 3, 1, 1);
  const double dt = 1e-5;
  for (int k = 0; k < 3; ++k) shell_pass(block, s.nodes, dt);
  for (Line& v : s.nodes.v) v = {};
  for (Line& w : s.nodes.omega) w = {};
  clear_forces(s.nodes);
  shell_pass(block, s.nodes, 0);
  show_stress(block, s.nodes.x);
  const Array<Line> f = s.nodes.f;
  const Array<Line> m = s.nodes.torque;
  const Array<double> sigma = block.stress_shown;
  const Mat3 R = Eigen::AngleAxisd(1.3, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  for (Line& x : s.nodes.x) set_xyz(x, R * xyz(x));
  clear_forces(s.nodes);
  shell_pass(block, s.nodes, 0);
  show_stress(block, s.nodes.x);
  double scale = 0;
  for (const Line& line : f) scale = std::max(scale, xyz(line).norm());
  CHECK(scale > 1);
  for (std::size_t i = 0; i < f.size(); ++i) {
    CHECK((xyz(s.nodes.f[i]) - R * xyz(f[i])).norm() < 1e-12 * scale);
    CHECK((xyz(s.nodes.torque[i]) - R * xyz(m[i])).norm() < 1e-12 * scale);
  }
  for (std::size_t e = 0; e < 9; ++e) {
    const auto tensor = [&](const double* a) {
      Mat3 t;
      t << a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2];
      return t;
    };
    const Mat3 expected = R * tensor(&sigma[6 * e]) * R.transpose();
    CHECK((tensor(&block.stress_shown[6 * e]) - expected).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("shell: forces and moments of warped elements balance", "[fe]") {
  for (const Isa set : sets()) {
    for (const auto form : {HourglassForm::stiffness, HourglassForm::viscous}) {
      Sheet s = crumpled(5, 5, 4);
      ShellBlock block = block_of(s, steel, {.thickness = 0.01, .hourglass = form});
      random_motion(s, 5, 2, 20);
      const double dt = 5e-6;
      for (int k = 0; k < 20; ++k) {
        for (std::size_t i = 0; i < s.size(); ++i) {
          add_xyz(s.nodes.x[i], dt * xyz(s.nodes.v[i]));
        }
        clear_forces(s.nodes);
        shell_pass(block, s.nodes, dt, set);
      }
      double scale = 0;
      for (const Line& f : s.nodes.f) scale += xyz(f).norm();
      CHECK(scale > 1e5);
      CHECK(total_force(s.nodes).norm() < 1e-14 * scale);
      CHECK(total_moment(s.nodes).norm() < 1e-14 * scale);  // lever arms are below 1 m
    }
  }
}

TEST_CASE("shell: forces are the transpose of the strains", "[fe]") {
  // From rest, in a step too small to move the nodes: energy of all kinds = -(f.v + m.omega) dt/2.
  for (const Isa set : sets()) {
    Sheet s = crumpled(3, 3, 6, 0.03);
    ShellBlock block = block_of(s, elastic_steel, {.thickness = 0.05});
    random_motion(s, 7, 1, 10);
    const double dt = 1e-14;
    const ElementWork work = shell_pass(block, s.nodes, dt, set);
    double power = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      power += xyz(s.nodes.f[i]).dot(xyz(s.nodes.v[i])) +
               xyz(s.nodes.torque[i]).dot(xyz(s.nodes.omega[i]));
    }
    CHECK(work.hourglass > 0);
    CHECK(work.internal + work.hourglass == Approx(-0.5 * power * dt).epsilon(1e-11));
  }
}

TEST_CASE("shell: the frequency bound holds and is close", "[fe]") {
  // The stiffness of one element, column by column from unit velocities, against its lumped mass.
  double tightest = 10;
  double loosest = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double thickness = seed % 2 == 0 ? 0.005 : 0.08;
    const double nu = seed % 3 == 0 ? 0.0 : 0.33;
    Sheet s = crumpled(1, 1, 100 + seed, seed == 0 ? 0.0 : 0.025);
    const ElasticPlastic m{.rho = 7800, .E = 210e9, .nu = nu};
    const ShellBlock fresh = block_of(s, m, {.thickness = thickness});
    add_shell_masses(fresh, s.nodes);
    Eigen::MatrixXd K(24, 24);
    double bound = 0;
    const double dt = 1e-14;
    for (int c = 0; c < 24; ++c) {
      ShellBlock block = fresh;
      clear_forces(s.nodes);
      for (std::size_t i = 0; i < 4; ++i) {
        Vec3 v = Vec3::Zero();
        Vec3 w = Vec3::Zero();
        if (c / 6 == static_cast<int>(i)) (c % 6 < 3 ? v : w)[c % 3] = 1;
        set_xyz(s.nodes.v[i], v);
        set_xyz(s.nodes.omega[i], w);
      }
      shell_pass(block, s.nodes, dt);
      bound = block.omega2;
      for (int i = 0; i < 4; ++i) {
        const auto n = static_cast<std::size_t>(i);
        for (int d = 0; d < 3; ++d) {
          K(6 * i + d, c) = -xyz(s.nodes.f[n])[d] / dt / std::sqrt(s.nodes.x[n].w);
          K(6 * i + 3 + d, c) = -xyz(s.nodes.torque[n])[d] / dt / std::sqrt(s.nodes.torque[n].w);
        }
      }
      const auto column = static_cast<std::size_t>(c / 6);
      K.col(c) /= std::sqrt(c % 6 < 3 ? s.nodes.x[column].w : s.nodes.torque[column].w);
    }
    CHECK((K - K.transpose()).norm() < 1e-9 * K.norm());
    const double omega2 =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues().maxCoeff();
    CHECK(omega2 <= bound * (1 + 1e-12));
    tightest = std::min(tightest, bound / omega2);
    loosest = std::max(loosest, bound / omega2);
  }
  CAPTURE(tightest, loosest);
  CHECK(loosest < 1.35);  // 1.02 to 1.29 reached: up to 12 % of the step given away
}

TEST_CASE("shell: plastic work is part of the internal energy", "[fe]") {
  // One square stretched along x with free sides would need equilibrium; stretched with fixed
  // sides (uniaxial strain) its energy is that of the point: E' eps_y^2/2 up to yield and beyond.
  Sheet s = grid(1, 1, [](int i, int j) { return Vec3(0.1 * i, 0.1 * j, 0); });
  ShellBlock block = block_of(s, steel, {.thickness = 0.002});
  const PlaneStressLaw law = plane_stress_law(steel);
  ElementWork total;
  PlaneStress<double> sigma{0, 0, 0};
  double eps_p = 0;
  double work = 0;
  const double dt = 1e-6;
  double length = 0.1;
  for (int k = 0; k < 100; ++k) {
    const double d = 3e-6;  // displacement of the right side
    for (const std::size_t i : {1, 3}) {
      s.nodes.v[i].x = d / dt;
      s.nodes.x[i].x += d;
    }
    const ElementWork w = shell_pass(block, s.nodes, dt);
    total.internal += w.internal;
    total.plastic += w.plastic;
    const double e = d / (length + 0.5 * d);  // strain in the midpoint configuration
    const PlaneStress<double> old = sigma;
    add_elastic(law, e, 0.0, 0.0, sigma);
    eps_p += return_to_yield(law, law.yield + law.hardening * eps_p, sigma);
    work += 0.5 * (old.xx + sigma.xx) * e * 0.002 * 0.1 * (length + 0.5 * d);
    length += d;
  }
  CHECK(eps_p > 0);
  CHECK(total.internal == Approx(work).epsilon(1e-12));
  CHECK(total.plastic > 0);
  // Dissipation of a flowing point: (sigma_y + H eps_p/2) eps_p per volume; the volume grows by
  // 3e-3 during it.
  const double volume = 0.002 * 0.1 * 0.1;
  CHECK(total.plastic ==
        Approx((steel.sigma_y + 0.5 * steel.H * eps_p) * eps_p * volume).epsilon(4e-3));
}

TEST_CASE("shell: the thickness follows stretching only where asked", "[fe]") {
  for (const bool changes : {false, true}) {
    Sheet s = grid(1, 1, [](int i, int j) { return Vec3(0.1 * i, 0.1 * j, 0); });
    ShellBlock block =
        block_of(s, elastic_steel, {.thickness = 0.002, .thickness_changes = changes});
    for (const std::size_t i : {1, 3}) {
      s.nodes.v[i].x = 1;
      s.nodes.x[i].x += 1e-5;
    }
    shell_pass(block, s.nodes, 1e-5);
    // eps_yy = 0: eps_zz = -nu/(1 - nu) eps_xx.
    const double e = 1e-5 / (0.1 + 0.5e-5);
    const double expected = changes ? 0.002 * (1 - 0.3 / 0.7 * e) : 0.002;
    CHECK(block.value(0, block.layout.thickness()) == Approx(expected).epsilon(1e-8));
  }
}
