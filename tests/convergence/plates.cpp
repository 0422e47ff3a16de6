// Thin plates: deflections under uniform and central loads against Kirchhoff's coefficients
// (Timoshenko & Woinowsky-Krieger), frequencies against Mindlin's plate (simply supported) and
// Leissa 1973 (clamped), by the stiffness and the lumped mass of the elements.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "unit/fe/shell_statics.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

const ElasticPlastic steel{.rho = 7800, .E = 210e9, .nu = 0.3};
constexpr double thickness = 0.01;
constexpr std::size_t n_modes = 6;

struct Plate {
  double uniform = 0;                       ///< w D/(q a^4) at the centre
  double centre = 0;                        ///< w D/(P a^2)
  std::array<double, n_modes> frequency{};  ///< [Hz]
};

/// The lowest frequencies of K x = omega^2 M x over what is free: subspace iteration.
std::array<double, n_modes> frequencies(const Statics& statics, const Eigen::VectorXd& mass) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < mass.size(); ++k) {
    if (!statics.held[static_cast<std::size_t>(k)]) free.push_back(k);
  }
  const auto n = static_cast<Eigen::Index>(free.size());
  std::vector<Eigen::Index> place(static_cast<std::size_t>(mass.size()), -1);
  for (Eigen::Index k = 0; k < n; ++k)
    place[static_cast<std::size_t>(free[static_cast<std::size_t>(k)])] = k;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index c = 0; c < statics.K.outerSize(); ++c) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(statics.K, c); it; ++it) {
      const Eigen::Index i = place[static_cast<std::size_t>(it.row())];
      const Eigen::Index j = place[static_cast<std::size_t>(it.col())];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, it.value());
    }
  }
  Eigen::SparseMatrix<double> K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd M(n);
  for (Eigen::Index k = 0; k < n; ++k) M[k] = mass[free[static_cast<std::size_t>(k)]];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K);
  constexpr Eigen::Index n_vectors = 2 * n_modes;
  Eigen::MatrixXd X(n, n_vectors);
  for (Eigen::Index k = 0; k < X.size(); ++k)
    X.data()[k] = std::sin(1.0 + 7.3 * static_cast<double>(k));
  Eigen::VectorXd omega2;
  for (int repeat = 0; repeat < 30; ++repeat) {
    const Eigen::MatrixXd MX = M.asDiagonal() * X;
    X = solver.solve(MX);
    const Eigen::MatrixXd a = X.transpose() * MX;
    const Eigen::MatrixXd b = X.transpose() * (M.asDiagonal() * X);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(
        0.5 * (a + a.transpose()), 0.5 * (b + b.transpose()));
    omega2 = small.eigenvalues();
    X = X * small.eigenvectors();
  }
  std::array<double, n_modes> f{};
  for (std::size_t k = 0; k < n_modes; ++k) {
    f[k] = std::sqrt(omega2[static_cast<Eigen::Index>(k)]) / (2 * std::numbers::pi);
  }
  return f;
}

/// A square plate of 1 m on n x n elements. Nodes turn about no normal, which nothing resists.
Plate plate(int n, ShellKind kind, bool clamped) {
  Sheet s = grid(n, n, [&](int i, int j) { return Vec3(double(i) / n, double(j) / n, 0); });
  const ShellBlock block = block_of(s, steel, {.kind = kind, .thickness = thickness, .points = 2});
  Statics statics = statics_of(s, block);
  add_shell_masses(block, s.nodes);
  Eigen::VectorXd mass(6 * static_cast<Eigen::Index>(s.size()));
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Line& x = s.nodes.x[i];
    for (int d = 0; d < 6; ++d) mass[freedom(i, d)] = d < 3 ? x.w : s.nodes.torque[i].w;
    statics.hold(i, {0, 1, 5});
    const bool at_x = x.x < 1e-9 || x.x > 1 - 1e-9;
    const bool at_y = x.y < 1e-9 || x.y > 1 - 1e-9;
    if (at_x || at_y) statics.hold(i, {2});
    if (clamped && (at_x || at_y)) statics.hold(i, {3, 4});
    if (at_x) statics.hold(i, {3});  // hard support: no turning about the normal of the edge
    if (at_y) statics.hold(i, {4});
  }
  const std::size_t middle = s.size() / 2;
  const double D = steel.E * std::pow(thickness, 3) / (12 * (1 - steel.nu * steel.nu));
  Plate p;
  for (std::size_t i = 0; i < s.size(); ++i) {
    statics.F[freedom(i, 2)] = s.nodes.x[i].w / (steel.rho * thickness);
  }
  p.uniform = solve(statics)[freedom(middle, 2)] * D;
  statics.F.setZero();
  statics.F[freedom(middle, 2)] = 1;
  p.centre = solve(statics)[freedom(middle, 2)] * D;
  p.frequency = frequencies(statics, mass);
  return p;
}

}  // namespace

TEST_CASE("plates: deflections and frequencies on 8, 16, 32 elements", "[convergence]") {
  const bool clamped = GENERATE(false, true);
  const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad);
  const double uniform = clamped ? 0.00126531904 : 0.00406235266;
  const double centre = clamped ? 0.0056119 : 0.0116007985;
  const std::array<double, n_modes> f =
      clamped ? std::array<double, n_modes>{89.928008, 183.41329, 183.41329,
                                            270.43609, 328.82406, 330.38351}
              : std::array<double, n_modes>{49.310884, 123.20999, 123.20999,
                                            197.02865, 246.19652, 246.19652};
  std::array<double, 3> first{};
  for (std::size_t k = 0; k < 3; ++k) {
    const int n = 8 << k;
    const Plate p = plate(n, kind, clamped);
    std::string line;
    double worst = 0;
    for (std::size_t m = 0; m < n_modes; ++m) {
      const double error = p.frequency[m] / f[m] - 1;
      worst = std::max(worst, std::abs(error));
      line += fmt::format(" {:+.2f}", 100 * error);
    }
    first[k] = p.frequency[0];
    WARN(fmt::format("{}, {}, {} x {}: uniform {:+.2f} %, centre {:+.2f} %, frequencies{} %",
                     clamped ? "clamped" : "simply supported",
                     kind == ShellKind::quad ? "full" : "one point", n, n,
                     100 * (p.uniform / uniform - 1), 100 * (p.centre / centre - 1), line));
    if (n < 32) continue;
    CHECK(p.uniform == Approx(uniform).epsilon(0.01));
    CHECK(p.centre == Approx(centre).epsilon(0.01));
    CHECK(std::abs(p.frequency[0] / f[0] - 1) < 0.005);
    CHECK(worst < (clamped ? 0.011 : 0.01));  // the clamped reference knows no shear
  }
  const double order = std::log2(std::abs((first[1] - first[0]) / (first[2] - first[1])));
  WARN(fmt::format("first frequency: order {:.2f}", order));
  CHECK(order > 1.7);
}
