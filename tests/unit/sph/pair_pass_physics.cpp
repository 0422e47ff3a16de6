// What the pair passes conserve, and how fast they converge.
#include <catch2/catch.hpp>
#include <cmath>

#include "pair_setup.hpp"

using namespace gannet;

TEST_CASE("pair passes: the forces of two particles are opposite to the last bit", "[sph]") {
  const Fluid lattice = jittered_lattice(2, 2, 2, 17);
  for (const Isa set : sets_to_test()) {
    for (int j = 1; j < 8; ++j) {
      Fluid pair;
      pair.k = lattice.k;
      auto copy = [&](int i, double shift) {
        const Vec3 away(shift, 0, 0);
        pair.add(xyz(lattice.x[i]) + away, xyz(lattice.v[i]), lattice.rho[i], lattice.p[i]);
      };
      copy(0, 0);
      for (int i = 0; i < 11; ++i) copy(1, 100.0 + i);  // so that they are not of one cluster
      copy(j, 0);
      const Results r = vectorised(set, pair);
      CHECK(r.f[0].x == -r.f[12].x);
      CHECK(r.f[0].y == -r.f[12].y);
      CHECK(r.f[0].z == -r.f[12].z);
      CHECK(r.X[0].x == -r.X[12].x);
      CHECK(r.f_viscous[0].y == -r.f_viscous[12].y);
      CHECK(r.drho_dt[0] == r.drho_dt[12]);
      CHECK(r.f[0].x != 0);
    }
  }
}

TEST_CASE("pair passes: momentum and angular momentum are conserved", "[sph]") {
  const bool flat = GENERATE(false, true);
  const Fluid fluid = flat ? jittered_lattice(40, 31, 1, 1) : jittered_lattice(11, 10, 13, 1);
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    Vec3 drift = Vec3::Zero();
    double sum_f = 0;
    double sum_X = 0;
    for (Index i = 0; i < fluid.n_targets; ++i) {
      force += xyz(r.f[i]);
      moment += xyz(fluid.x[i]).cross(xyz(r.f[i]));
      drift += xyz(r.X[i]);
      sum_f += xyz(r.f[i]).norm();
      sum_X += xyz(r.X[i]).norm();
    }
    // About 1400 sums of 75 terms: each rounds to 1e-16 of its terms, which are larger than f.
    CHECK(force.norm() < 1e-14 * sum_f);
    CHECK(moment.norm() < 1e-14 * sum_f * 0.4);  // the largest distance from the origin
    CHECK(drift.norm() < 1e-14 * sum_X);
  }
}

TEST_CASE("pair passes: laminar viscosity along the line of a pair keeps angular momentum",
          "[sph]") {
  Fluid fluid = jittered_lattice(11, 10, 13, 1);
  fluid.k.mu = 2;
  for (const bool central : {false, true}) {
    fluid.k.central = central;
    for (const Isa set : sets_to_test()) {
      const Results r = vectorised(set, fluid, {true, true, true});
      Vec3 force = Vec3::Zero();
      Vec3 moment = Vec3::Zero();
      double scale = 0;
      for (Index i = 0; i < fluid.n_targets; ++i) {
        force += xyz(r.f_laminar[i]);
        moment += xyz(fluid.x[i]).cross(xyz(r.f_laminar[i]));
        scale += xyz(r.f_laminar[i]).norm();
      }
      CHECK(force.norm() < 1e-14 * scale);
      CHECK((moment.norm() < 1e-14 * scale * 0.4) == central);
    }
  }
}

TEST_CASE("pair passes: pressure work is what the density rate stores", "[sph]") {
  // sum_i m p_i/rho_i^2 drho_i/dt + sum_i f_i . v_i = 0, f without viscosity: the same pair sums.
  const bool flat = GENERATE(false, true);
  const Fluid fluid = flat ? jittered_lattice(40, 31, 1, 2) : jittered_lattice(11, 10, 13, 2);
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, {false, false});
    double stored = 0;
    double work = 0;
    double scale = 0;
    for (Index i = 0; i < fluid.n_targets; ++i) {
      const double e = fluid.k.m * fluid.p[i] / (fluid.rho[i] * fluid.rho[i]) * r.drho_dt[i];
      stored += e;
      work += xyz(r.f[i]).dot(xyz(fluid.v[i]));
      scale += std::abs(e);
    }
    CHECK(std::abs(stored + work) < 1e-13 * scale);
    CHECK(std::abs(stored) > 1e-4 * scale);  // not trivially 0
  }
}

TEST_CASE("pair passes: viscosity takes out energy, and none in a rigid motion", "[sph]") {
  Fluid fluid = jittered_lattice(10, 10, 10, 4);
  auto power = [&](const Results& r) {
    double sum = 0;
    for (Index i = 0; i < fluid.n_targets; ++i) {
      sum += xyz(r.f_viscous[i]).dot(xyz(fluid.v[i]));
    }
    return sum;
  };
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid);
    const double lost = -power(r);
    CHECK(lost > 0);
    const Array<Line> v = fluid.v;
    for (Index i = 0; i < fluid.n_targets; ++i) {
      const Vec3 turn = Vec3(3, -2, 5).cross(xyz(fluid.x[i]) - Vec3(0.03, 0.04, 0.05));
      fluid.v[i] = {turn.x() + 1, turn.y(), turn.z(), 0};
    }
    const Results rigid = vectorised(set, fluid);
    double largest_rate = 0;
    for (const double rate : rigid.drho_dt) largest_rate = std::max(largest_rate, std::abs(rate));
    // v_ij . r_ij rounds to 1e-16 of |v||r|, about 0.5 m/s against differences of 0.1 m/s.
    CHECK(std::abs(power(rigid)) < 1e-12 * lost);
    CHECK(largest_rate < 1e-9);
    fluid.v = v;
  }
}

TEST_CASE("pair passes: XSPH draws velocities together", "[sph]") {
  // sum_i m X_i . v_i = -eps/2 sum_ij m^2/rho_ij |v_ij|^2 W_ij < 0.
  const Fluid fluid = jittered_lattice(9, 9, 9, 6);
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid);
    double sum = 0;
    double expected = 0;
    for (Index i = 0; i < fluid.n_targets; ++i) {
      sum += xyz(r.X[i]).dot(xyz(fluid.v[i]));
      for (Index j = 0; j < fluid.n_targets; ++j) {
        const Vec3 v_ij = xyz(fluid.v[i]) - xyz(fluid.v[j]);
        const double distance = (xyz(fluid.x[i]) - xyz(fluid.x[j])).norm();
        expected -= fluid.k.epsilon * fluid.k.m / (fluid.rho[i] + fluid.rho[j]) *
                    v_ij.squaredNorm() * cubic_spline::W(3, distance, fluid.k.h);
      }
    }
    CHECK(sum == Approx(expected).epsilon(1e-12));
    CHECK(sum < 0);
  }
}

namespace {

/// drho/dt at the middle of a lattice of spacing dx for a velocity field, h = 1.3 dx.
template <class Velocity>
double rate_at_origin(Isa set, int dimension, double dx, Velocity velocity) {
  Fluid fluid;
  fluid.k.dimension = dimension;
  fluid.k.h = 1.3 * dx;
  fluid.k.m = 1000 * std::pow(dx, dimension);
  fluid.add(Vec3::Zero(), velocity(Vec3(Vec3::Zero())), 1000, 0);
  const int n_z = dimension == 3 ? 3 : 0;
  for (int k = -n_z; k <= n_z; ++k) {
    for (int j = -3; j <= 3; ++j) {
      for (int i = -3; i <= 3; ++i) {
        const Vec3 x(i * dx, j * dx, k * dx);
        if (i != 0 || j != 0 || k != 0) fluid.add(x, velocity(x), 1000, 0);
      }
    }
  }
  return vectorised(set, fluid, {false, false}).drho_dt[0];
}

}  // namespace

TEST_CASE("density rate: a linear flow on a lattice gives -rho div v within 2 %",
          "[sph][convergence]") {
  const int dimension = GENERATE(2, 3);
  for (const Isa set : sets_to_test()) {
    const double rate = rate_at_origin(set, dimension, 0.01, [](const Vec3& x) {
      return Vec3(2 * x.x() + 5 * x.y(), 0.5 * x.y() - x.x(), 0);
    });
    // div v = 2.5. What is left is the lattice sum against the integral at h = 1.3 dx.
    CHECK(rate == Approx(-2500).epsilon(0.02));
  }
}

TEST_CASE("density rate: of order 2 in h for a curved flow", "[sph][convergence]") {
  const int dimension = GENERATE(2, 3);
  for (const Isa set : sets_to_test()) {
    // Over the linear flow of the same divergence, so that the constant of the lattice drops out.
    auto error = [&](double dx) {
      const double curved = rate_at_origin(
          set, dimension, dx, [](const Vec3& x) { return Vec3(std::sin(x.x()), 0, 0); });
      const double linear =
          rate_at_origin(set, dimension, dx, [](const Vec3& x) { return Vec3(x.x(), 0, 0); });
      return std::abs(curved / linear - 1);
    };
    const double order = std::log2(error(0.1) / error(0.05));
    CHECK(order == Approx(2.0).margin(0.02));
    CHECK(error(0.1) < 0.01);
  }
}
