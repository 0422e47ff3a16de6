#include "sph/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/math.hpp"

namespace gannet {

namespace {

/// One neighbour in a lattice of spacing 1 and smoothing length `ratio`.
struct Neighbour {
  Vec3 r;
  double F = 0;
};

std::vector<Neighbour> lattice_neighbours(const SmoothingKernel& kernel) {
  const double reach = kernel.reach();
  const int n = static_cast<int>(reach);
  const int n_z = kernel.dimension == 3 ? n : 0;
  std::vector<Neighbour> neighbours;
  for (int k = -n_z; k <= n_z; ++k) {
    for (int j = -n; j <= n; ++j) {
      for (int i = -n; i <= n; ++i) {
        const Vec3 r(i, j, k);
        if (r.norm() >= reach || r.norm() == 0) continue;
        neighbours.push_back({r, kernel.F(r.norm())});
      }
    }
  }
  return neighbours;
}

/// Both limits for one wave vector, in units of the spacing.
LatticeLimits limits_of_wave(const std::vector<Neighbour>& neighbours, double h, const Vec3& k) {
  Vec3 gradient = Vec3::Zero();
  Mat3 damping = Mat3::Zero();
  double spreading = 0;
  for (const Neighbour& n : neighbours) {
    const double phase = k.dot(n.r);
    gradient += n.F * std::sin(phase) * n.r;
    damping += std::abs(n.F) * (1 - std::cos(phase)) / (n.r.squaredNorm() + 0.01 * h * h) * n.r *
               n.r.transpose();
    spreading += 2 * std::abs(n.F) * (1 - std::cos(phase));
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> modes(damping, Eigen::EigenvaluesOnly);
  return {.sound = h * gradient.norm(),
          .viscous = h * h * modes.eigenvalues().maxCoeff(),
          .laminar = h * h * spreading};
}

}  // namespace

LatticeLimits lattice_limits(KernelType kernel, int dimension, double ratio) {
  const std::vector<Neighbour> neighbours = lattice_neighbours({kernel, dimension, ratio});
  std::vector<Vec3> directions{{1, 0, 0}, {1, 1, 0}};
  if (dimension == 3) directions.emplace_back(1, 1, 1);
  constexpr int n_waves = 200;
  LatticeLimits limits;
  limits.dimension = dimension;
  for (const Vec3& d : directions) {
    for (int w = 1; w <= n_waves; ++w) {
      const Vec3 k = d * (std::numbers::pi * w / n_waves);
      const LatticeLimits one = limits_of_wave(neighbours, ratio, k);
      limits.sound = std::max(limits.sound, one.sound);
      limits.viscous = std::max(limits.viscous, one.viscous);
      limits.laminar = std::max(limits.laminar, one.laminar);
    }
  }
  return limits;
}

double stable_step(const LatticeLimits& limits, double cfl, double h, double c, double lambda) {
  const double xi = lambda * h / (2 * limits.sound * c);
  return cfl * h / c * (std::sqrt(1 + xi * xi) - xi);
}

double largest_damping(const LatticeLimits& limits, double h, const Damping& damping) {
  const double central = 2 * (limits.dimension + 2) * damping.central_nu;
  return limits.viscous * (damping.slope / h + central / (h * h)) +
         limits.laminar * (damping.nu / (h * h) + damping.diffusion / h);
}

}  // namespace gannet
