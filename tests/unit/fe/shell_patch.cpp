// Patch tests: fields that an element must reproduce exactly.
#include <catch2/catch.hpp>

#include "fe/shell_shown.hpp"
#include "shell_testing.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

/// MacNeal and Harder 1985, Finite Elem. Anal. Des. 1: the distorted mesh of their membrane and
/// bending patch tests, 0.24 x 0.12.
Sheet macneal_harder() {
  return sheet_of({{0, 0, 0},
                   {0.24, 0, 0},
                   {0.24, 0.12, 0},
                   {0, 0.12, 0},
                   {0.04, 0.02, 0},
                   {0.18, 0.03, 0},
                   {0.16, 0.08, 0},
                   {0.08, 0.08, 0}},
                  {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7, 4, 5, 6, 7});
}

const ElasticPlastic patch_material{.rho = 1, .E = 1e6, .nu = 0.25};
const ShellSection patch_section{.thickness = 0.001, .points = 5};

ShellSection patch_section_of(ShellKind kind) {
  ShellSection section = patch_section;
  section.kind = kind;
  return section;
}

/// So small a step that the midpoint configuration is the given one to 1e-15; strains follow from
/// velocities, so their relative accuracy does not suffer.
constexpr double dt = 1e-12;

}  // namespace

TEST_CASE("shell: membrane patch test on a distorted mesh", "[fe]") {
  for (const Isa set : sets()) {
    const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad, ShellKind::triangle);
    Sheet s = macneal_harder();
    ShellBlock block = block_of(s, patch_material, patch_section_of(kind));
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      set_xyz(s.nodes.v[i], 1e-3 * Vec3(x.x() + x.y() / 2, x.y() + x.x() / 2, 0));
    }
    shell_pass(block, s.nodes, dt, set);
    show_stress(block, s.nodes.x);
    for (std::size_t e = 0; e < static_cast<std::size_t>(block.n_elements); ++e) {
      const double* sigma = &block.stress_shown[6 * e];
      CHECK(sigma[0] / dt == Approx(4000.0 / 3).epsilon(1e-10));
      CHECK(sigma[1] / dt == Approx(4000.0 / 3).epsilon(1e-10));
      CHECK(sigma[3] / dt == Approx(400).epsilon(1e-10));
      CHECK(std::abs(sigma[2]) / dt < 1e-10);
    }
    // The inner nodes are in equilibrium; sigma t L = 1333 x 0.001 x 0.1 is the scale of forces.
    for (std::size_t i = 4; i < 8; ++i) {
      CHECK(xyz(s.nodes.f[i]).norm() / dt < 1e-10 * 0.1);
      CHECK(xyz(s.nodes.torque[i]).norm() / dt < 1e-13);
    }
  }
}

TEST_CASE("shell: constant curvature on parallelograms, with twist", "[fe]") {
  for (const Isa set : sets()) {
    Sheet s =
        grid(3, 3, [](int i, int j) { return Vec3(0.08 * i + 0.03 * j, 0.01 * i + 0.04 * j, 0); });
    ShellBlock block = block_of(s, patch_material, patch_section);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      // w = 1e-3 (x^2 + x y + y^2)/2, rotations (dw/dy, -dw/dx): no transverse shear.
      const double w = 0.5e-3 * (x.x() * x.x() + x.x() * x.y() + x.y() * x.y());
      set_xyz(s.nodes.v[i], {0, 0, w});
      set_xyz(s.nodes.omega[i], 0.5e-3 * Vec3(x.x() + 2 * x.y(), -(2 * x.x() + x.y()), 0));
    }
    shell_pass(block, s.nodes, dt, set);
    // Stress at the upper surface: MacNeal and Harder's 0.6667 and 0.2 (negative where w curves
    // upwards), read at the highest point of the rule and scaled to z = t/2.
    for (Index e = 0; e < block.n_elements; ++e) {
      // Side 1-2 lies at angle phi to x: turn the local stress back.
      const PlaneStress<double> local = stress_at(block, e, 4);
      const double scale = 1 / (block.constants.point[4] * dt);
      const double phi = std::atan2(0.01, 0.08);
      const double c = std::cos(phi);
      const double n = std::sin(phi);
      const double sxx = c * c * local.xx + n * n * local.yy - 2 * c * n * local.xy;
      const double syy = n * n * local.xx + c * c * local.yy + 2 * c * n * local.xy;
      const double sxy = c * n * (local.xx - local.yy) + (c * c - n * n) * local.xy;
      CHECK(sxx * scale == Approx(-2.0 / 3).epsilon(1e-10));
      CHECK(syy * scale == Approx(-2.0 / 3).epsilon(1e-10));
      CHECK(sxy * scale == Approx(-0.2).epsilon(1e-10));
      // No transverse shear (G w' = 4e5 1e-4 is the scale) and no hourglass force.
      CHECK(std::abs(block.value(e, block.layout.shear())) / dt < 1e-10 * 40);
      CHECK(std::abs(block.value(e, block.layout.shear() + 1)) / dt < 1e-10 * 40);
      for (int k = 0; k < 5; ++k) {
        CHECK(std::abs(block.value(e, block.layout.hourglass() + k)) / dt < 1e-16);
      }
    }
    // Inner nodes in equilibrium; moment per length M = sigma t^2/6 = 1.1e-7, times 0.1.
    for (const std::size_t i : {5, 6, 9, 10}) {
      CHECK(xyz(s.nodes.torque[i]).norm() / dt < 1e-10 * 1.1e-8);
      CHECK(xyz(s.nodes.f[i]).norm() / dt < 1e-10 * 1.1e-7);
    }
  }
}

TEST_CASE("shell: bending patch test on a distorted mesh", "[fe]") {
  for (const Isa set : sets()) {
    const ShellKind kind = GENERATE(ShellKind::quad, ShellKind::triangle);
    Sheet s = macneal_harder();
    ShellBlock block = block_of(s, patch_material, patch_section_of(kind));
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      const double w = 0.5e-3 * (x.x() * x.x() + x.x() * x.y() + x.y() * x.y());
      set_xyz(s.nodes.v[i], {0, 0, w});
      set_xyz(s.nodes.omega[i], 0.5e-3 * Vec3(x.x() + 2 * x.y(), -(2 * x.x() + x.y()), 0));
    }
    shell_pass(block, s.nodes, dt, set);
    // At the upper surface sxx = syy = -2/3 and sxy = -0.2 in whatever frame: their sum and
    // determinant.
    const double scale = 1 / (block.constants.point[4] * dt);
    for (Index e = 0; e < block.n_elements; ++e) {
      for (int g = 0; g < block.layout.in_plane(); ++g) {
        const PlaneStress<double> sigma = stress_at(block, e, 5 * g + 4);
        CHECK((sigma.xx + sigma.yy) * scale == Approx(-4.0 / 3).epsilon(1e-10));
        CHECK((sigma.xx * sigma.yy - sigma.xy * sigma.xy) * scale * scale ==
              Approx(4.0 / 9 - 0.04).epsilon(1e-10));
        // No transverse shear (G w' = 4e5 1e-4 is the scale).
        for (int d = 0; d < 2; ++d) {
          CHECK(std::abs(block.value(e, block.layout.shear() + 2 * g + d)) / dt < 1e-10 * 40);
        }
      }
    }
    for (std::size_t i = 4; i < 8; ++i) {
      CHECK(xyz(s.nodes.torque[i]).norm() / dt < 1e-10 * 1.1e-8);
      // 40 Pa through 1 mm, over an edge of 0.04 m
      CHECK(xyz(s.nodes.f[i]).norm() / dt < 1e-10 * 1.6e-6);
    }
  }
}

TEST_CASE("shell: shear patch test on a distorted mesh", "[fe]") {
  for (const Isa set : sets()) {
    const ShellKind kind = GENERATE(ShellKind::quad, ShellKind::triangle);
    Sheet s = macneal_harder();
    ShellBlock block = block_of(s, patch_material, patch_section_of(kind));
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      set_xyz(s.nodes.v[i], {0, 0, 1e-3 * (3 * x.x() + 2 * x.y())});
      set_xyz(s.nodes.omega[i], 1e-3 * Vec3(-2, -1, 0));  // gamma = (3 - 1, 2 + 2) 1e-3
    }
    shell_pass(block, s.nodes, dt, set);
    const double tau = 4e5 * 1e-3 * std::sqrt(20.0);
    for (Index e = 0; e < block.n_elements; ++e) {
      for (int g = 0; g < block.layout.in_plane(); ++g) {
        const int first = block.layout.shear() + 2 * g;
        CHECK(std::hypot(block.value(e, first), block.value(e, first + 1)) / dt ==
              Approx(tau).epsilon(1e-10));
        CHECK(std::abs(stress_at(block, e, 5 * g + 4).xx) / dt < 1e-10 * tau);
      }
      if (kind == ShellKind::triangle) {  // the shear that turns is zero
        CHECK(std::abs(block.value(e, block.layout.hourglass())) / dt < 1e-10 * tau * 0.1);
      }
    }
    for (std::size_t i = 4; i < 8; ++i) {
      CHECK(xyz(s.nodes.f[i]).norm() / dt < 1e-10 * tau * 0.001 * 0.1);
    }
  }
}

TEST_CASE("shell: a square with 2 x 2 points bends in its plane as a beam", "[fe]") {
  // Strain eps = k y along x, lateral strain free: energy E k^2 t/2 int y^2 = E k^2 t a^4/24. The
  // corners move by u = k x y; v = -k (x^2 + nu y^2)/2 is the same at all of them.
  const double a = 0.1;
  for (const Isa set : sets()) {
    Sheet s = grid(1, 1, [&](int i, int j) { return Vec3(a * i - a / 2, a * j - a / 2, 0); });
    ShellBlock block =
        block_of(s, patch_material, {.kind = ShellKind::quad, .thickness = 0.002, .points = 2});
    const double k = 1e-3;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      set_xyz(s.nodes.v[i], {k * x.x() * x.y(), 0, 0});
    }
    const ElementWork work = shell_pass(block, s.nodes, dt, set);
    CHECK(work.internal / (dt * dt) ==
          Approx(1e6 * k * k * 0.002 * a * a * a * a / 24).epsilon(1e-10));
  }
}

TEST_CASE("shell: hourglass stiffness of a square by hand", "[fe]") {
  // a = 0.1, BB = 2/a^2, A = a^2, r = 0.03: K_membrane = r E t/4, q = 4 v dt, f = -+ K q.
  const ElasticPlastic m{.rho = 1, .E = 1e6, .nu = 0.25};
  for (const Isa set : sets()) {
    Sheet s = grid(1, 1, [](int i, int j) { return Vec3(0.1 * i, 0.1 * j, 0); });
    ShellBlock block = block_of(s, m, {.thickness = 0.002});
    const double step = 1e-9;
    for (std::size_t i = 0; i < 4; ++i) {
      const double h = (i == 0 || i == 3) ? 1 : -1;  // grid order: corners 1 2 4 3
      set_xyz(s.nodes.v[i], {h, 0, 2 * h});
    }
    shell_pass(block, s.nodes, step, set);
    const double K_membrane = 0.03 * 1e6 * 0.002 / 4;
    // K_warp = r kappa G t^3 BB/12, G = 4e5
    const double K_warp = 0.03 * 5.0 / 6 * 4e5 * 8e-9 * 200 / 12;
    CHECK(s.nodes.f[0].x == Approx(-K_membrane * 4 * step).epsilon(1e-6));
    CHECK(s.nodes.f[1].x == Approx(K_membrane * 4 * step).epsilon(1e-6));
    CHECK(s.nodes.f[0].z == Approx(-K_warp * 8 * step).epsilon(1e-6));
    CHECK(s.nodes.f[0].y == Approx(0).margin(1e-20));
    // Viscous: the same K times sqrt(A)/c on the rate, and no memory.
    ShellBlock viscous = block_of(s, m, {.thickness = 0.002, .hourglass = HourglassForm::viscous});
    const double c = std::sqrt(1e6 / (1 - 0.0625));
    for (int repeat = 0; repeat < 2; ++repeat) {
      clear_forces(s.nodes);
      shell_pass(viscous, s.nodes, step, set);
      CHECK(s.nodes.f[0].x == Approx(-K_membrane * 0.1 / c * 4).epsilon(1e-6));
    }
  }
}

TEST_CASE("shell: a middle off the nodes turns their membrane force into a moment", "[fe]") {
  // Nodes stretched by eps along x: N = E/(1 - nu^2) t eps, and N z0 about the nodes.
  for (const Isa set : sets()) {
    const ShellKind kind = GENERATE(ShellKind::one_point, ShellKind::quad, ShellKind::triangle);
    const double z0 = 0.003;
    Sheet s = grid(2, 2, [](int i, int j) { return Vec3(0.1 * i, 0.1 * j, 0); });
    ShellBlock block =
        block_of(s, patch_material, {.kind = kind, .thickness = 0.002, .offset = z0});
    for (std::size_t i = 0; i < s.size(); ++i) {
      set_xyz(s.nodes.v[i], {1e-3 * s.nodes.x[i].x, 0, 0});
    }
    shell_pass(block, s.nodes, dt, set);
    show_section_forces(block, s.nodes.x);
    const double N = 1e6 / (1 - 0.0625) * 0.002 * 1e-3;
    CHECK(s.nodes.f[5].x / dt == Approx(-N * 0.1).epsilon(1e-10));  // the middle of the end
    CHECK(s.nodes.torque[5].y / dt == Approx(-N * 0.1 * z0).epsilon(1e-10));
    CHECK(block.forces_shown[0] / dt == Approx(N).epsilon(1e-10));
    CHECK(block.forces_shown[1] / dt == Approx(0.25 * N).epsilon(1e-10));
    CHECK(std::abs(block.forces_shown[6]) / dt < 1e-10 * N * z0);  // no moment about the middle
    // The same seen from the middle: nodes turn about an axis z0 above them, strain k z0 there.
    ShellBlock bent = block_of(s, patch_material, {.kind = kind, .thickness = 0.002, .offset = z0});
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double x = s.nodes.x[i].x;
      set_xyz(s.nodes.v[i], {-z0 * x, 0, -0.5 * x * x});
      set_xyz(s.nodes.omega[i], {0, x, 0});
    }
    shell_pass(bent, s.nodes, dt, set);
    show_section_forces(bent, s.nodes.x);
    const double D = 1e6 / (1 - 0.0625) * 8e-9 / 12;
    CHECK(std::abs(bent.forces_shown[0]) / dt < 1e-10 * D / z0);
    CHECK(bent.forces_shown[6] / dt == Approx(D).epsilon(1e-9));
    CHECK(bent.forces_shown[7] / dt == Approx(0.25 * D).epsilon(1e-9));
  }
}

TEST_CASE("shell: mass and rotary inertia by hand", "[fe]") {
  Sheet s = grid(2, 1, [](int i, int j) { return Vec3(0.1 * i, 0.2 * j, 0); });
  ShellBlock block = block_of(s, {.rho = 2700, .E = 70e9, .nu = 0.3}, {.thickness = 0.01});
  add_shell_masses(block, s.nodes);
  const double corner = 2700 * 0.01 * 0.02 / 4;
  CHECK(s.nodes.x[0].w == Approx(corner).epsilon(1e-14));
  CHECK(s.nodes.x[1].w == Approx(2 * corner).epsilon(1e-14));
  CHECK(s.nodes.torque[0].w == Approx(corner * 0.02 / 8).epsilon(1e-14));  // A/8 > t^2/12
  // Triangles: a third of the mass at each corner, A/6.
  Sheet one = grid(1, 1, [](int i, int j) { return Vec3(0.1 * i, 0.2 * j, 0); });
  add_shell_masses(block_of(one, {.rho = 2700, .E = 70e9, .nu = 0.3},
                            {.kind = ShellKind::triangle, .thickness = 0.01}),
                   one.nodes);
  const double third = 2700 * 0.01 * 0.01 / 3;
  CHECK(one.nodes.x[1].w == Approx(third).epsilon(1e-14));
  CHECK(one.nodes.x[0].w == Approx(2 * third).epsilon(1e-14));
  CHECK(one.nodes.torque[1].w == Approx(third * 0.01 / 6).epsilon(1e-14));
}
