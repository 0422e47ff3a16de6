#include "sph/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/math.hpp"
#include "kernel/cubic_spline.hpp"

namespace gannet {

namespace {

/// One neighbour in a lattice of spacing 1 and smoothing length `ratio`.
struct Neighbour {
  Vec3 r;
  double F = 0;
};

std::vector<Neighbour> lattice_neighbours(int dimension, double ratio) {
  const double reach = cubic_spline::support * ratio;
  const int n = static_cast<int>(reach);
  const int n_z = dimension == 3 ? n : 0;
  std::vector<Neighbour> neighbours;
  for (int k = -n_z; k <= n_z; ++k) {
    for (int j = -n; j <= n; ++j) {
      for (int i = -n; i <= n; ++i) {
        const Vec3 r(i, j, k);
        if (r.norm() >= reach || r.norm() == 0) continue;
        neighbours.push_back({r, cubic_spline::F(dimension, r.norm(), ratio)});
      }
    }
  }
  return neighbours;
}

/// Both limits for one wave vector, in units of the spacing.
LatticeLimits limits_of_wave(const std::vector<Neighbour>& neighbours, double h, const Vec3& k) {
  Vec3 gradient = Vec3::Zero();
  Mat3 damping = Mat3::Zero();
  for (const Neighbour& n : neighbours) {
    const double phase = k.dot(n.r);
    gradient += n.F * std::sin(phase) * n.r;
    damping += std::abs(n.F) * (1 - std::cos(phase)) / (n.r.squaredNorm() + 0.01 * h * h) * n.r *
               n.r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(damping, Eigen::EigenvaluesOnly);
  return {h * gradient.norm(), h * h * modes.eigenvalues().maxCoeff()};
}

}  // namespace

LatticeLimits lattice_limits(int dimension, double ratio) {
  const std::vector<Neighbour> neighbours = lattice_neighbours(dimension, ratio);
  std::vector<Vec3> directions{{1, 0, 0}, {1, 1, 0}};
  if (dimension == 3) directions.emplace_back(1, 1, 1);
  constexpr int n_waves = 200;
  LatticeLimits limits;
  for (const Vec3& d : directions) {
    for (int w = 1; w <= n_waves; ++w) {
      const Vec3 k = d * (std::numbers::pi * w / n_waves);
      const LatticeLimits one = limits_of_wave(neighbours, ratio, k);
      limits.sound = std::max(limits.sound, one.sound);
      limits.viscous = std::max(limits.viscous, one.viscous);
    }
  }
  return limits;
}

double stable_step(const LatticeLimits& limits, double cfl, double h, double c, double a) {
  const double xi = limits.viscous * a / (2 * limits.sound * c);
  return cfl * h / c * (std::sqrt(1 + xi * xi) - xi);
}

}  // namespace gannet
