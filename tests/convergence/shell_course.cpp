// The obstacle course of linear shells: statics with the stiffness of the elements against
// converged solutions (MacNeal & Harder 1985, Finite Elem. Anal. Des. 1, 3-20; the cylinder from a
// double Fourier series of the Sanders-Koiter shell).
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "unit/fe/shell_statics.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// One mesh of a course, with the nodes of its edges found by their place in the grid.
struct Course {
  Sheet sheet;
  Statics statics;
  int nx, ny;
  [[nodiscard]] std::size_t node(int i, int j) const {
    return static_cast<std::size_t>(j * (nx + 1) + i);
  }
};

template <class F>
Course course(int nx, int ny, const ElasticPlastic& material, const ShellSection& section,
              F&& place) {
  Course c{grid(nx, ny, place), {}, nx, ny};
  c.statics = statics_of(c.sheet, block_of(c.sheet, material, section));
  return c;
}

/// A quarter of a roof under its weight: vertical displacement of the middle of the free edge.
double scordelis_lo(int n, ShellSection section) {
  section.thickness = 0.25;
  Course c = course(n, n, {.rho = 1, .E = 4.32e8, .nu = 0}, section, [&](int i, int j) {
    const double angle = 40 * degree * j / n;
    return Vec3(25.0 * i / n, 25 * std::sin(angle), 25 * std::cos(angle));
  });
  for (int k = 0; k <= n; ++k) {
    c.statics.hold(c.node(0, k), {1, 2});
    c.statics.hold(c.node(n, k), {0, 4, 5});
    c.statics.hold(c.node(k, 0), {1, 3, 5});
  }
  for (std::size_t e = 0; e < c.sheet.quads.size(); e += 4) {
    const auto x = [&](std::size_t a) {
      return xyz(c.sheet.nodes.x[static_cast<std::size_t>(c.sheet.quads[e + a])]);
    };
    const double area = 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
    for (std::size_t a = 0; a < 4; ++a) {
      c.statics.F[freedom(static_cast<std::size_t>(c.sheet.quads[e + a]), 2)] -= 90 * area / 4;
    }
  }
  return -solve(c.statics)[freedom(c.node(n, n), 2)];
}

/// An eighth of a cylinder between diaphragms under two forces: displacement under a force.
double pinched_cylinder(int n, ShellSection section) {
  section.thickness = 3;
  Course c = course(n, n, {.rho = 1, .E = 3e6, .nu = 0.3}, section, [&](int i, int j) {
    const double angle = 90 * degree * j / n;
    return Vec3(300.0 * i / n, 300 * std::sin(angle), 300 * std::cos(angle));
  });
  for (int k = 0; k <= n; ++k) {
    c.statics.hold(c.node(0, k), {0, 4, 5});
    c.statics.hold(c.node(n, k), {1, 2});
    c.statics.hold(c.node(k, 0), {1, 3, 5});
    c.statics.hold(c.node(k, n), {2, 3, 4});
  }
  c.statics.F[freedom(c.node(0, 0), 2)] = -0.25;
  return -solve(c.statics)[freedom(c.node(0, 0), 2)];
}

/// A quarter of a hemisphere with a hole of 18 degrees, pulled along x and pushed along y.
double hemisphere(int n, ShellSection section) {
  section.thickness = 0.04;
  Course c = course(n, n, {.rho = 1, .E = 6.825e7, .nu = 0.3}, section, [&](int i, int j) {
    const double theta = 90 * degree * i / n;
    const double phi = 72 * degree * j / n;
    return Vec3(10 * std::cos(phi) * std::cos(theta), 10 * std::cos(phi) * std::sin(theta),
                10 * std::sin(phi));
  });
  for (int k = 0; k <= n; ++k) {
    c.statics.hold(c.node(0, k), {1, 3, 5});
    c.statics.hold(c.node(n, k), {0, 4, 5});
  }
  c.statics.hold(c.node(0, 0), {2});
  c.statics.F[freedom(c.node(0, 0), 0)] = 1;
  c.statics.F[freedom(c.node(n, 0), 1)] = -1;
  return solve(c.statics)[freedom(c.node(0, 0), 0)];
}

/// A strip twisted by 90 degrees, held at its root and loaded at its tip along the width there
/// (direction 2) or the thickness (1): the elements keep nearly the shape of the usual 12 x 2.
double twisted_beam(int n, ShellSection section, int direction) {
  section.thickness = 0.32;
  const int across = std::max(2, n / 4);
  Course c = course(n, across, {.rho = 1, .E = 29e6, .nu = 0.22}, section, [&](int i, int j) {
    const double angle = 90 * degree * i / n;
    const double y = 1.1 * (static_cast<double>(j) / across - 0.5);
    return Vec3(12.0 * i / n, y * std::cos(angle), y * std::sin(angle));
  });
  for (int k = 0; k <= across; ++k) {
    c.statics.hold(c.node(0, k), {0, 1, 2, 3, 4, 5});
    const double share = (k == 0 || k == across ? 0.5 : 1.0) / across;
    c.statics.F[freedom(c.node(n, k), direction)] = share;
  }
  return solve(c.statics)[freedom(c.node(n, across / 2), direction)];
}

struct Obstacle {
  std::string name;
  std::function<double(int, const ShellSection&)> run;
  double reference;
  double tolerance;  ///< at 16 elements
};

std::vector<Obstacle> obstacles() {
  return {{"Scordelis-Lo roof", scordelis_lo, 0.3024, 0.03},
          {"pinched cylinder", pinched_cylinder, 1.82763e-5, 0.08},
          {"hemisphere", hemisphere, 0.0940, 0.03},
          {"twisted beam, weak root",
           [](int n, const ShellSection& s) { return twisted_beam(n, s, 2); }, 0.005424, 0.03},
          {"twisted beam, strong root",
           [](int n, const ShellSection& s) { return twisted_beam(n, s, 1); }, 0.001754, 0.03}};
}

/// Values on 4, 8, 16 (and 32) elements a side, and what they say of the order: from the change
/// from mesh to mesh.
void run_course(const Obstacle& obstacle, const ShellSection& section, const char* element,
                bool finest) {
  std::vector<double> value;
  std::string line;
  for (const int n : {4, 8, 16, 32}) {
    if (n == 32 && !finest) continue;
    value.push_back(obstacle.run(n, section));
    line += fmt::format(" {:.4f}", value.back() / obstacle.reference);
  }
  const std::size_t last = value.size() - 1;
  const double order =
      std::log2(std::abs((value[last - 1] - value[last - 2]) / (value[last] - value[last - 1])));
  WARN(fmt::format("{}, {}: over the reference{}, order {:.2f}", obstacle.name, element, line,
                   order));
  CHECK(value[2] / obstacle.reference == Approx(1).margin(obstacle.tolerance));
  const auto change = [&](std::size_t k) { return std::abs(value[k] - value[k - 1]); };
  CHECK(change(last) < change(1));
  if (finest) CHECK(change(last) < 0.5 * change(last - 1) + 0.001 * obstacle.reference);
}

}  // namespace

TEST_CASE("shell course: one-point shells", "[convergence]") {
  for (const Obstacle& obstacle : obstacles())
    run_course(obstacle, {.points = 2}, "one point", false);
}

TEST_CASE("shell course: fully integrated shells", "[convergence]") {
  for (const Obstacle& obstacle : obstacles()) {
    run_course(obstacle, {.kind = ShellKind::quad, .points = 2}, "full", false);
  }
}

TEST_CASE("shell course: up to 32", "[.][convergence_long]") {
  for (const Obstacle& obstacle : obstacles()) {
    run_course(obstacle, {.points = 2}, "one point", true);
    run_course(obstacle, {.kind = ShellKind::quad, .points = 2}, "full", true);
  }
}

TEST_CASE("shell course: triangles come near from below", "[convergence]") {
  // Two a square: membrane strain is constant, so that bending in the plane and of curved surfaces
  // needs finer meshes than quadrilaterals.
  for (const Obstacle& obstacle : obstacles()) {
    std::vector<double> error;
    std::string line;
    for (const int n : {4, 8, 16, 32}) {
      const double ratio =
          obstacle.run(n, {.kind = ShellKind::triangle, .points = 2}) / obstacle.reference;
      error.push_back(1 - ratio);
      line += fmt::format(" {:.4f}", ratio);
    }
    WARN(fmt::format("{}, triangles: over the reference{}", obstacle.name, line));
    CHECK(error[1] < error[0]);
    CHECK(error[2] < error[1]);
    CHECK(std::abs(error[3]) < error[2]);
    CHECK(std::abs(error[3]) < 0.08);
  }
}

TEST_CASE("shell course: the warping correction is what a twisted beam needs", "[convergence]") {
  const ShellSection without{.points = 2, .warping = false};
  const double with_it = twisted_beam(16, {.points = 2}, 2) / 0.005424;
  const double free = twisted_beam(16, without, 2) / 0.005424;
  WARN(fmt::format("twisted beam, 16 elements: {:.4f} with it, {:.4f} without", with_it, free));
  CHECK(with_it == Approx(1).margin(0.03));
  CHECK(std::abs(free - 1) > 0.2);
}
