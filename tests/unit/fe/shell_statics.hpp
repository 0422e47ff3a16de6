// Linear statics of a sheet with the stiffness that its own kernel gives, for tests: forces from
// unit velocities in a step too small to move anything.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "shell_testing.hpp"

namespace gannet::testing {

/// Component d of a node: displacement x, y, z, rotation x, y, z.
inline Eigen::Index freedom(std::size_t node, int d) {
  return 6 * static_cast<Eigen::Index>(node) + d;
}

/// A sheet held and loaded: u = K^-1 F over what is free.
struct Statics {
  Eigen::SparseMatrix<double> K;
  Eigen::VectorXd F;
  std::vector<bool> held;

  void hold(std::size_t node, std::initializer_list<int> components) {
    for (const int d : components) held[static_cast<std::size_t>(freedom(node, d))] = true;
  }
};

/// The nodes that share an element with each node, itself among them.
inline std::vector<std::set<std::size_t>> neighbours(const Sheet& s) {
  std::vector<std::set<std::size_t>> near(s.size());
  for (std::size_t e = 0; e < s.quads.size(); e += 4) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        near[static_cast<std::size_t>(s.quads[e + a])].insert(
            static_cast<std::size_t>(s.quads[e + b]));
      }
    }
  }
  return near;
}

/// Groups of nodes of which no two have a neighbour in common.
inline std::vector<std::vector<std::size_t>> far_groups(
    const std::vector<std::set<std::size_t>>& near) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::vector<bool>> taken;  // by group and node
  for (std::size_t i = 0; i < near.size(); ++i) {
    std::size_t g = 0;
    const auto meets = [&](std::size_t k) {
      return std::any_of(near[i].begin(), near[i].end(),
                         [&](std::size_t j) { return taken[k][j]; });
    };
    while (g < groups.size() && meets(g)) ++g;
    if (g == groups.size()) {
      groups.emplace_back();
      taken.emplace_back(near.size(), false);
    }
    groups[g].push_back(i);
    for (const std::size_t j : near[i]) taken[g][j] = true;
  }
  return groups;
}

/// Stiffness [N/m, N, N m] of a block that is free of stress. What no element resists (a node that
/// turns about its fibre) is held by 1e-9 of the mean stiffness of rotations.
inline Statics statics_of(Sheet& s, const ShellBlock& fresh) {
  const double dt = 1e-14;
  const auto near = neighbours(s);
  std::vector<Eigen::Triplet<double>> entries;
  double turning = 0;
  for (const auto& group : far_groups(near)) {
    for (int c = 0; c < 6; ++c) {
      for (std::size_t i = 0; i < s.size(); ++i) {
        set_xyz(s.nodes.v[i], Vec3::Zero());
        set_xyz(s.nodes.omega[i], Vec3::Zero());
      }
      for (const std::size_t i : group) {
        set_xyz(c < 3 ? s.nodes.v[i] : s.nodes.omega[i], Vec3::Unit(c % 3));
      }
      clear_forces(s.nodes);
      ShellBlock block = fresh;
      shell_pass(block, s.nodes, dt);
      for (const std::size_t i : group) {
        for (const std::size_t j : near[i]) {
          for (int d = 0; d < 6; ++d) {
            const double force = d < 3 ? xyz(s.nodes.f[j])[d] : xyz(s.nodes.torque[j])[d - 3];
            entries.emplace_back(freedom(j, d), freedom(i, c), -force / dt);
            if (i == j && c == d && d > 2) turning -= force / dt;
          }
        }
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(6 * s.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k % 6 > 2) entries.emplace_back(k, k, 1e-9 * turning / static_cast<double>(n / 2));
  }
  Statics statics;
  statics.K.resize(n, n);
  statics.K.setFromTriplets(entries.begin(), entries.end());
  statics.F = Eigen::VectorXd::Zero(n);
  statics.held.assign(static_cast<std::size_t>(n), false);
  return statics;
}

/// Displacements and rotations under the loads.
inline Eigen::VectorXd solve(const Statics& statics) {
  Eigen::SparseMatrix<double> K = statics.K;
  Eigen::VectorXd F = statics.F;
  for (Eigen::Index c = 0; c < K.outerSize(); ++c) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(K, c); it; ++it) {
      const bool off = statics.held[static_cast<std::size_t>(it.row())] ||
                       statics.held[static_cast<std::size_t>(it.col())];
      if (off) it.valueRef() = it.row() == it.col() ? 1 : 0;
    }
  }
  for (Eigen::Index k = 0; k < F.size(); ++k) {
    if (statics.held[static_cast<std::size_t>(k)]) F[k] = 0;
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K);
  return solver.solve(F);
}

}  // namespace gannet::testing
