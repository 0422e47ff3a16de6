// The pair passes against numbers by hand and against the plain reference.
#include "sph/pair_pass.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.hpp"
#include "pair_setup.hpp"

using namespace gannet;

namespace {

constexpr double pi = 3.14159265358979323846;

void check_line(const Line& line, double x, double y, double z, double scale) {
  CHECK(std::abs(line.x - x) <= 1e-14 * scale);
  CHECK(std::abs(line.y - y) <= 1e-14 * scale);
  CHECK(std::abs(line.z - z) <= 1e-14 * scale);
}

/// Largest difference of two lists of lines over the largest entry of the second.
double relative_difference(const Array<Line>& a, const Array<Line>& b) {
  double difference = 0;
  double largest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    difference = std::max(difference, (xyz(a[i]) - xyz(b[i])).norm());
    largest = std::max(largest, xyz(b[i]).norm());
  }
  return difference / largest;
}

double relative_difference(const Array<double>& a, const Array<double>& b) {
  double difference = 0;
  double largest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  return difference / largest;
}

/// Two particles at distance 1 = h that close in on each other.
Fluid two_particles() {
  Fluid fluid;
  fluid.k = {.dimension = 3, .h = 1, .m = 2, .c0 = 10, .alpha = 0.5, .beta = 2, .epsilon = 0.5};
  fluid.add({0, 0, 0}, {2, 0, 0}, 2, 8);
  fluid.add({1, 0, 0}, {0, 1, 0}, 1, 3);
  return fluid;
}

void check_two_particles(const Results& r) {
  // F(1) = -3/(4 pi), r_01 = (-1, 0, 0), v_01 = (2, -1, 0), v.r = -2: drho/dt = 2 (-2) F = 3/pi.
  CHECK(r.drho_dt[0] == Approx(3 / pi).epsilon(1e-14));
  CHECK(r.drho_dt[1] == Approx(3 / pi).epsilon(1e-14));
  // W(1) = 1/(4 pi), mean density 3/2: X_0 = -1/2 2 (2, -1, 0) / (3/2) / (4 pi).
  check_line(r.X[0], -1 / (3 * pi), 1 / (6 * pi), 0, 0.1);
  check_line(r.X[1], 1 / (3 * pi), -1 / (6 * pi), 0, 0.1);
  // p/rho^2 = 2 and 3; mu = -2/1.01; Pi = (5 2/1.01 + 2 (2/1.01)^2)/(3/2) = 11.828905662843510;
  // f_0 = -4 (5 + Pi) F (-1, 0, 0) = -3/pi (5 + Pi).
  check_line(r.f[0], -3 / pi * (5 + 11.828905662843510), 0, 0, 16);
  check_line(r.f[1], 3 / pi * (5 + 11.828905662843510), 0, 0, 16);
  check_line(r.f_viscous[0], -3 / pi * 11.828905662843510, 0, 0, 11);
}

}  // namespace

TEST_CASE("pair passes: two closing particles in 3D by hand", "[sph]") {
  const Fluid fluid = two_particles();
  check_two_particles(reference(fluid));
  for (const Isa set : sets_to_test()) check_two_particles(vectorised(set, fluid));
}

TEST_CASE("pair passes: particles that move apart feel no viscosity", "[sph]") {
  Fluid fluid = two_particles();
  fluid.v[0].x = -2;  // v_01 = (-2, -1, 0), v.r = 2
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid);
    CHECK(r.drho_dt[0] == Approx(-3 / pi).epsilon(1e-14));
    check_line(r.f[0], -15 / pi, 0, 0, 5);
    check_line(r.f_viscous[0], 0, 0, 0, 1);
    CHECK(r.f_viscous[0].w == 0);
  }
}

TEST_CASE("pair passes: three particles in 2D by hand", "[sph]") {
  Fluid fluid;
  fluid.k = {.dimension = 2, .h = 1, .m = 3, .epsilon = 1};
  fluid.add({0, 0, 0}, {0, 0, 0}, 1, 1);
  fluid.add({0.5, 0, 0}, {1, 0, 0}, 1, 2);
  fluid.add({0, 1.5, 0}, {0, -1, 0}, 1, -4);
  // sigma = 10/(7 pi); F(1/2) = -15/8 sigma, F(3/2) = -1/8 sigma, and with s = sqrt(5/2) between
  // particles 1 and 2: F(s) = -3/4 (2 - s)^2/s sigma.
  const double sigma = 10 / (7 * pi);
  const double s = std::sqrt(2.5);
  const double F_12 = -0.75 * (2 - s) * (2 - s) / s * sigma;
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, {true, false});
    // Pair 01: v.r = 1/2, pair 02: v.r = -3/2, pair 12: v_12 = (1, 1), r_12 = (1/2, -3/2): -1.
    CHECK(r.drho_dt[0] == Approx(-2.25 * sigma).epsilon(1e-14));
    CHECK(r.drho_dt[1] == Approx(-45.0 / 16 * sigma - 3 * F_12).epsilon(1e-14));
    CHECK(r.drho_dt[2] == Approx(9.0 / 16 * sigma - 3 * F_12).epsilon(1e-14));
    // X_0 = -3 (W(1/2) (-1, 0) + W(3/2) (0, 1)), w = 23/32 and 1/32.
    check_line(r.X[0], 69.0 / 32 * sigma, -3.0 / 32 * sigma, 0, 1);
    // f_0 = -9 (3 F(1/2) (-1/2, 0) + (-3) F(3/2) (0, -3/2)).
    check_line(r.f[0], -405.0 / 16 * sigma, 81.0 / 16 * sigma, 0, 12);
    CHECK(r.f_viscous[0].x == 7);  // not written without viscosity
  }
}

TEST_CASE("pair passes: the force pass adds to f, the rest is stored", "[sph]") {
  const Fluid fluid = two_particles();
  ClusterList list;
  build_cluster_list(fluid.x, 2, 2.1, list);
  Array<PackedParticle> packed;
  pack_particles(fluid.view(), packed);
  Results r(2);
  r.f[0] = {100, 200, 300, 400};
  pair_rates(list, packed, fluid.k, {r.drho_dt.data(), r.X.data()});
  pair_force(list, packed, fluid.k, {r.f.data(), r.f_viscous.data()});
  check_line(r.f[0], 100 - 3 / pi * (5 + 11.828905662843510), 200, 300, 300);
  CHECK(r.f[0].w == 400);
  CHECK(r.f_viscous[0].w == 0);
  CHECK(r.X[0].w == 0);
  // Without the optional outputs: the same rates, no viscosity.
  Results plain(2);
  pair_rates(list, packed, fluid.k, {plain.drho_dt.data(), nullptr});
  pair_force(list, packed, fluid.k, {plain.f.data(), nullptr});
  CHECK(plain.drho_dt[0] == Approx(r.drho_dt[0]).epsilon(1e-15));
  check_line(plain.f[0], -15 / pi, 0, 0, 5);
  CHECK(plain.X[0].x == 7);
}

TEST_CASE("pair passes: as the reference on jittered lattices, with ghosts", "[sph]") {
  const bool flat = GENERATE(false, true);
  // 1, 6 and 8 targets, and a number that is not a multiple of 8.
  const int n_targets = GENERATE(1, 6, 8, 333);
  const bool ghosts = GENERATE(false, true);
  const Terms terms{GENERATE(false, true), GENERATE(false, true)};
  Fluid fluid = flat ? jittered_lattice(30, 17, 1, 5) : jittered_lattice(8, 8, 8, 5);
  if (!ghosts) {
    for (Array<Line>* lines : {&fluid.x, &fluid.v}) lines->resize(n_targets);
    for (Array<double>* values : {&fluid.rho, &fluid.p}) values->resize(n_targets);
  }
  fluid.n_targets = n_targets;
  const Results expected = reference(fluid, terms);
  const bool alone = fluid.x.size() == 1;
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, terms, 0.2 * fluid.k.h);
    if (alone) {
      CHECK(r.drho_dt[0] == 0);
      CHECK(xyz(r.f[0]).norm() == 0);
      continue;
    }
    CHECK(relative_difference(r.drho_dt, expected.drho_dt) < 1e-12);
    CHECK(relative_difference(r.f, expected.f) < 1e-12);
    if (terms.xsph) CHECK(relative_difference(r.X, expected.X) < 1e-12);
    if (terms.viscosity) CHECK(relative_difference(r.f_viscous, expected.f_viscous) < 1e-12);
  }
}

TEST_CASE("pair passes: the fused pass gives what the two passes give", "[sph]") {
  const Fluid fluid = jittered_lattice(9, 8, 7, 3);
  const Results expected = reference(fluid);
  ClusterList list;
  build_cluster_list(fluid.x, fluid.n_targets, 2.2 * fluid.k.h, list);
  Array<PackedParticle> packed;
  pack_particles(fluid.view(), packed);
  Results r(fluid.n_targets);
  pair_fused(list, packed, fluid.k, {r.drho_dt.data(), nullptr}, {r.f.data(), r.f_viscous.data()});
  CHECK(relative_difference(r.drho_dt, expected.drho_dt) < 1e-12);
  CHECK(relative_difference(r.f, expected.f) < 1e-12);
  CHECK(relative_difference(r.f_viscous, expected.f_viscous) < 1e-12);
}

TEST_CASE("pair passes: particles in one place give finite rates and no force", "[sph]") {
  Fluid fluid = two_particles();
  fluid.x[1] = fluid.x[0];
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid);
    CHECK(r.drho_dt[0] == 0);
    CHECK(xyz(r.f[0]).norm() == 0);
    // X_0 = -1/2 2 (2, -1, 0) / (3/2) W(0), W(0) = 1/pi.
    check_line(r.X[0], -4 / (3 * pi), 2 / (3 * pi), 0, 1);
  }
}

TEST_CASE("pair passes: the same bits for 1 and 2 threads", "[sph]") {
  const Fluid fluid = jittered_lattice(20, 20, 12, 9);
  auto run = [&](int n_threads) {
    set_threads(n_threads);
    ClusterList list;
    build_cluster_list(fluid.x, fluid.n_targets, 2.2 * fluid.k.h, list);
    Array<PackedParticle> packed;
    pack_particles(fluid.view(), packed);
    Results r(fluid.n_targets);
    pair_rates(list, packed, fluid.k, {r.drho_dt.data(), r.X.data()});
    pair_force(list, packed, fluid.k, {r.f.data(), r.f_viscous.data()});
    return r;
  };
  auto same = [](const Array<Line>& a, const Array<Line>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](const Line& p, const Line& q) {
      return p.x == q.x && p.y == q.y && p.z == q.z && p.w == q.w;
    });
  };
  const Results one = run(1);
  const Results two = run(2);
  CHECK(one.drho_dt == two.drho_dt);
  CHECK(same(one.X, two.X));
  CHECK(same(one.f, two.f));
  CHECK(same(one.f_viscous, two.f_viscous));
  set_threads(0);
}
