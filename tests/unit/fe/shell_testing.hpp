// Small shell models for tests.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "base/math.hpp"
#include "fe/shell.hpp"
#include "fe_testing.hpp"

namespace gannet::testing {

/// Points and quads with a node table over them.
struct Sheet {
  std::vector<Index> quads;
  Nodes nodes;
  [[nodiscard]] std::size_t size() const { return nodes.x.size(); }
};

inline Sheet sheet_of(const std::vector<Vec3>& points, std::vector<Index> quads) {
  Sheet s;
  s.quads = std::move(quads);
  s.nodes.n_owned = static_cast<Index>(points.size());
  s.nodes.rotating = {0, s.nodes.n_owned};
  for (auto* lines : {&s.nodes.x, &s.nodes.v, &s.nodes.f, &s.nodes.omega, &s.nodes.torque}) {
    lines->assign(points.size(), {});
  }
  for (std::size_t i = 0; i < points.size(); ++i) set_xyz(s.nodes.x[i], points[i]);
  return s;
}

/// nx x ny quads; the point of grid position (i, j) is place(i, j).
template <class F>
Sheet grid(int nx, int ny, F&& place) {
  std::vector<Vec3> points;
  std::vector<Index> quads;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) points.push_back(place(i, j));
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Index a = j * (nx + 1) + i;
      for (const Index node : {a, a + 1, a + nx + 2, a + nx + 1}) quads.push_back(node);
    }
  }
  return sheet_of(points, quads);
}

/// A warped, irregular sheet with elements of about 0.1 m.
inline Sheet crumpled(int nx, int ny, unsigned seed, double noise = 0.02) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-noise, noise);
  return grid(nx, ny, [&](int i, int j) {
    return Vec3(0.1 * i + u(random), 0.1 * j + u(random), u(random));
  });
}

inline void random_motion(Sheet& s, unsigned seed, double v, double omega) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    set_xyz(s.nodes.v[i], v * Vec3(u(random), u(random), u(random)));
    set_xyz(s.nodes.omega[i], omega * Vec3(u(random), u(random), u(random)));
  }
}

inline void clear_forces(Nodes& nodes) {
  for (Line& f : nodes.f) f = {};
  for (Line& m : nodes.torque) set_xyz(m, Vec3::Zero());
}

/// The quads, each cut along its diagonal 1-3.
inline std::vector<Index> triangles_of(const Sheet& s) {
  std::vector<Index> triangles;
  for (std::size_t k = 0; k < s.quads.size(); k += 4) {
    for (const std::size_t a : {0, 1, 2, 0, 2, 3}) triangles.push_back(s.quads[k + a]);
  }
  return triangles;
}

/// A block of the quads, or of twice as many triangles.
inline ShellBlock block_of(const Sheet& s, const ElasticPlastic& material,
                           const ShellSection& section, Index chunk = shell_chunk) {
  const bool triangles = section.kind == ShellKind::triangle;
  return make_shell_block(triangles ? triangles_of(s) : s.quads, s.nodes.x, material, section,
                          chunk);
}

}  // namespace gannet::testing
