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
  Packed packed;
  pack_particles(fluid.view(), 2.0 * fluid.k.h, packed);
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

TEST_CASE("pair passes: every kernel and term as the reference", "[sph]") {
  const bool flat = GENERATE(false, true);
  const auto kernel = GENERATE(KernelType::cubic_spline, KernelType::wendland_c2,
                               KernelType::wendland_c4, KernelType::quintic_spline);
  const bool single = GENERATE(false, true);
  Fluid fluid = flat ? jittered_lattice(20, 17, 1, 5) : jittered_lattice(8, 8, 8, 5);
  fluid.k.kernel = kernel;
  fluid.k.dx = 0.01;
  fluid.k.delta = 0.1;
  fluid.k.mu = 2;
  fluid.k.central = GENERATE(false, true);
  fluid.k.tensile = 0.3;
  for (std::size_t i = 0; i < fluid.rho.size(); ++i) fluid.s.push_back(fluid.rho[i] + fluid.x[i].y);
  const Terms terms{true, true, true};
  const Results expected = reference(fluid, terms);
  // In single precision a term of a sum is right to 1e-6; corrections divide by small moments.
  const double tolerance = single ? 5e-6 : 1e-12;
  const double corrected = single ? 1e-3 : 1e-9;
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, terms, 0.2 * fluid.k.h, single);
    CHECK(relative_difference(r.drho_diffusion, expected.drho_diffusion) < tolerance);
    CHECK(relative_difference(r.drho_correction, expected.drho_correction) < corrected);
    CHECK(relative_difference(r.drho_dt, expected.drho_dt) < corrected);
    CHECK(relative_difference(r.X, expected.X) < tolerance);
    CHECK(relative_difference(r.concentration, expected.concentration) < tolerance);
    for (std::size_t i = 0; i < expected.X.size(); ++i) {
      CHECK(r.concentration[i].w == Approx(expected.concentration[i].w).epsilon(tolerance));
    }
    CHECK(relative_difference(r.sum_mW, expected.sum_mW) < tolerance);
    CHECK(relative_difference(r.sum_VW, expected.sum_VW) < tolerance);
    CHECK(relative_difference(r.f_viscous, expected.f_viscous) < tolerance);
    CHECK(relative_difference(r.f_laminar, expected.f_laminar) < tolerance);
    CHECK(relative_difference(r.f_tensile, expected.f_tensile) < tolerance);
    CHECK(relative_difference(r.f_correction, expected.f_correction) < corrected);
    CHECK(relative_difference(r.f, expected.f) < corrected);
  }
}

TEST_CASE("pair passes: corrected, linear fields have exact rates and forces", "[sph]") {
  const bool flat = GENERATE(false, true);
  Fluid fluid = flat ? jittered_lattice(20, 17, 1, 5) : jittered_lattice(9, 9, 9, 5);
  Mat3 A;
  A << 1, 2, 3, -4, 5, 6, 7, -8, 2.5;
  Vec3 b(3e5, -2e5, 1e5);
  if (flat) {
    A.row(2).setZero();
    A.col(2).setZero();
    b.z() = 0;
  }
  for (std::size_t i = 0; i < fluid.x.size(); ++i) {
    set_xyz(fluid.v[i], A * xyz(fluid.x[i]));
    fluid.p[i] = 1e4 + b.dot(xyz(fluid.x[i]));
  }
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, {false, false, true});
    int n_exact = 0;
    for (std::size_t i = 0; i < fluid.x.size(); ++i) {
      if (r.drho_correction[i] == 0) continue;  // at the free surface the usual sums stand
      ++n_exact;
      const double rate = -fluid.rho[i] * A.trace();
      CHECK(r.drho_dt[i] == Approx(rate).epsilon(1e-10));
      const Vec3 f = -fluid.k.m / fluid.rho[i] * b;
      const Vec3 f_sum = xyz(r.f[i]) - xyz(r.f_laminar[i]) - xyz(r.f_tensile[i]);
      CHECK((f_sum - f).norm() < 1e-9 * f.norm());
    }
    CHECK(n_exact > static_cast<int>(fluid.x.size()) / 5);
  }
}

TEST_CASE("pair passes: single precision does not lose small differences of fast particles",
          "[sph]") {
  // Water that drifts at 10 m/s far from the origin, with differences of 1 mm/s.
  Fluid fluid = jittered_lattice(8, 8, 8, 11);
  for (Line& v : fluid.v) v = {10 + 1e-3 * v.x, 1e-3 * v.y, 1e-3 * v.z, v.w};
  for (Line& x : fluid.x) x.x += 50;
  const Results expected = reference(fluid);
  for (const Isa set : sets_to_test()) {
    const Results r = vectorised(set, fluid, {}, 0, true);
    CHECK(relative_difference(r.drho_dt, expected.drho_dt) < 1e-4);
    CHECK(relative_difference(r.f, expected.f) < 1e-5);
  }
}

TEST_CASE("pair passes: a list of clusters does those and leaves the others", "[sph]") {
  const Fluid fluid = jittered_lattice(9, 8, 7, 3);
  ClusterList list;
  build_cluster_list(fluid.x, fluid.n_targets, 2.2 * fluid.k.h, list);
  Packed packed;
  pack_particles(fluid.view(), 2.0 * fluid.k.h, packed);
  Results all(fluid.n_targets);
  Results some(fluid.n_targets);
  const Array<Index> clusters{1, 4, 62};
  pair_rates(list, packed, fluid.k, {all.drho_dt.data(), nullptr});
  pair_rates(list, packed, fluid.k, {some.drho_dt.data(), nullptr}, {.clusters = clusters});
  for (Index k = 0; k < fluid.n_targets; ++k) {
    const bool chosen = std::find(clusters.begin(), clusters.end(), k / 8) != clusters.end();
    CHECK(some.drho_dt[k] == (chosen ? all.drho_dt[k] : -7.0));
  }
}

TEST_CASE("pair passes: the fused pass gives what the two passes give", "[sph]") {
  const Fluid fluid = jittered_lattice(9, 8, 7, 3);
  const Results expected = reference(fluid);
  ClusterList list;
  build_cluster_list(fluid.x, fluid.n_targets, 2.2 * fluid.k.h, list);
  Packed packed;
  pack_particles(fluid.view(), 2.0 * fluid.k.h, packed);
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
    Packed packed;
    pack_particles(fluid.view(), 2.0 * fluid.k.h, packed);
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
