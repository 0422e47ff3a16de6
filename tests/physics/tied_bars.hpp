// A bar of coarse and fine elements in two models, and one coarse step of it as a matrix.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

namespace gannet::test {

/// A free bar of 12 coarse elements of 1 m and 12 fine ones, coarse over fine step `ratio`: smaller
/// by that (size) or as much stiffer a material (stiff). `buffer`: further coarse elements that
/// advance with the fine ones. All waves that the mesh holds run in it.
struct Chain {
  bool stiff = false;
  int ratio = 2;
  int buffer = 2;
  double cfl = 0.9;
};

/// What the bar starts with at x [m/s]: some of every wave that it holds.
inline double start_velocity(double x) {
  return 1e-3 * (std::sin(37.7 * x) + std::cos(5.3 * x) + std::sin(1.1 * x * x));
}

inline std::string text_of(const Chain& c) {
  const double m = c.ratio;
  std::string text = "gannet: 1\nparts:\n";
  double x = 0;
  const auto part = [&](const char* name, int n, double h, double EA) {
    text += fmt::format(
        "  {}:\n    cable: {{EA: {:.17g}, mass_per_length: 1, tension_only: no, dt_factor: {}}}\n"
        "    shape: {{line: {{from: [{:.17g}, 0, 0], to: [{:.17g}, 0, 0], elements: {}}}}}\n"
        "    initial_velocity: [\"1e-3*(sin(37.7*x) + cos(5.3*x) + sin(1.1*x*x))\", 0, 0]\n",
        name, EA, c.cfl, x, x + n * h, n);
    x += n * h;
  };
  part("coarse", 12, 1, 1);
  const double seam = x;
  if (c.buffer > 0) part("buffer", c.buffer, 1, 1);
  const double join = x;
  part("fine", 12, c.stiff ? 1 : 1 / m, c.stiff ? m * m : 1);
  text += "ties:\n";
  if (c.buffer > 0) {
    text +=
        fmt::format("  seam: {{nodes: {{nearest: [{}, 0, 0], of: buffer}}, to: coarse}}\n", seam);
  }
  text += fmt::format("  join: {{nodes: {{nearest: [{}, 0, 0], of: fine}}, to: {}}}\n", join,
                      c.buffer > 0 ? "buffer" : "coarse");
  text += fmt::format("models: {{slow: {{parts: coarse}}, fast: {{parts: [{}fine]}}}}\n",
                      c.buffer > 0 ? "buffer, " : "");
  return text + "effects: {guards: off}\noutput: {until: 1e12 s, checkpoint: never}\n";
}

/// The matrices of that bar for n nodes from left to right: M as a diagonal, and what elements of
/// the slow and of the fast model add to K.
struct BarMatrices {
  Eigen::VectorXd M;
  Eigen::MatrixXd slow, fast;
};

inline BarMatrices matrices_of(const Chain& c) {
  const int coarse = 12 + c.buffer;
  const int elements = coarse + 12;
  const Eigen::Index n = elements + 1;
  BarMatrices b{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (int e = 0; e < elements; ++e) {
    const double h = e < coarse || c.stiff ? 1 : 1.0 / c.ratio;
    const double k = (e >= coarse && c.stiff ? 1.0 * c.ratio * c.ratio : 1) / h;
    b.M[e] += h / 2;
    b.M[e + 1] += h / 2;
    Eigen::MatrixXd& K = e < 12 ? b.slow : b.fast;
    K(e, e) += k;
    K(e + 1, e + 1) += k;
    K(e, e + 1) -= k;
    K(e + 1, e) -= k;
  }
  return b;
}

/// A B. The library's product for large matrices takes half a minute to compile.
inline Eigen::MatrixXd times(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(A.rows(), B.cols());
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    for (Eigen::Index k = 0; k < A.cols(); ++k) C.col(j) += B(k, j) * A.col(k);
  }
  return C;
}

/// The kick by dt M^-1 K, and the drift by dt, on (x, v).
inline Eigen::MatrixXd kick_of(const BarMatrices& b, const Eigen::MatrixXd& K, double dt) {
  const Eigen::Index n = b.M.size();
  Eigen::MatrixXd kick = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) kick(n + i, j) = -dt / b.M[i] * K(i, j);
  }
  return kick;
}

inline Eigen::MatrixXd drift_of(const BarMatrices& b, double dt) {
  const Eigen::Index n = b.M.size();
  Eigen::MatrixXd drift = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) drift(i, n + i) = dt;
  return drift;
}

/// One coarse step dT with n = ratio substeps as a matrix on (x, v): half an impulse of the slow
/// forces, n steps of the leapfrog with the fast ones, half an impulse.
inline Eigen::MatrixXd coarse_step(const Chain& c) {
  const BarMatrices b = matrices_of(c);
  const double dT = c.cfl;
  const double dt = dT / c.ratio;
  const Eigen::MatrixXd half = kick_of(b, b.fast, dt / 2);
  const Eigen::MatrixXd substep = times(half, times(drift_of(b, dt), half));
  Eigen::MatrixXd all = kick_of(b, b.slow, dT / 2);
  for (int n = 0; n < c.ratio; ++n) all = times(substep, all);
  return times(kick_of(b, b.slow, dT / 2), all);
}

/// By how much the fastest growing motion of the bar grows in a coarse step: the growth of the
/// norm of G^m from m = 2^22 to 2^23. A bar in free flight alone gives log 2/2^22 = 2e-7.
inline double growth_of(const Chain& c) {
  constexpr int doublings = 23;
  Eigen::MatrixXd G = coarse_step(c);
  double size = 0;  // log of the norm of the power, and of the one before it
  double before = 0;
  for (int k = 0; k < doublings; ++k) {
    before = size;
    G = times(G, G);
    size = 2 * size + std::log(G.norm());
    G /= G.norm();
  }
  return (size - before) / std::pow(2.0, doublings - 1);
}

}  // namespace gannet::test
