// A round drop in free space that is stretched into an ellipse, v = (-A x, A y) at the start,
// against the exact solution for water that does not compress (Monaghan 1994, J. Comput. Phys. 110,
// 399, DOI 10.1006/jcph.1994.1034):
//   dA/dt = A^2 (a^4 - 1)/(a^4 + 1),   da/dt = -A a,   b = 1/a
#include "physics/running.hpp"
#include "support/order.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double until = 0.76;  // with A = 1/s at the start; by then b/a is 3.8 [s]

/// One row of the drop of radius 1 m, which is all that lies in it of a lattice with n spacings to
/// the radius. h/dx 1.3: at the usual 1.25 the order of b is 0.77, and a 0.7 % too long with 40.
std::string row(int j, int n) {
  const double dx = 1.0 / n;
  const double y = (j + 0.5) * dx;
  const double half = std::round(std::sqrt(1 - y * y) / dx) * dx;
  return fmt::format(R"yaml(  row_{}:
    sph: {{material: water, spacing: dx, smoothing_ratio: 1.3}}
    fill: {{box: {{from: [{:.12g} m, {:.12g} m, 0], to: [{:.12g} m, {:.12g} m, 0]}}}}
    initial_velocity: ["-x", "y", 0]
    initial_pressure: "500*max(1 - x^2 - y^2, 0)"
)yaml",
                     j + n, -half, j * dx, half, (j + 1) * dx);
}

/// A = 1/s, and sound ten times as fast as the tips at the end.
std::string drop(int n, const std::string& effects) {
  std::string rows;
  for (int j = -n; j < n; ++j) rows += row(j, n);
  return fmt::format(R"yaml(gannet: 1
title: Elliptic drop
dimension: 2
let: {{dx: {:.12g} m}}
materials: {{water: {{density: 1000, c0: 15 m/s}}}}
parts:
{}effects: {{{}}}
output: {{until: 1 s}}
)yaml",
                     1.0 / n, rows, effects);
}

/// The semi-axis along y at a time, by Heun's steps that are small beside every other error.
double exact_b(double t) {
  double A = 1, a = 1;
  const auto rate = [](double A_, double a_) {
    const double a4 = a_ * a_ * a_ * a_;
    return A_ * A_ * (a4 - 1) / (a4 + 1);
  };
  const int steps = 20000;
  const double dt = t / steps;
  for (int k = 0; k < steps; ++k) {
    const double A1 = A + dt * rate(A, a);
    const double a1 = a - dt * A * a;
    const double A2 = A + 0.5 * dt * (rate(A, a) + rate(A1, a1));
    a -= 0.5 * dt * (A * a + A1 * a1);
    A = A2;
  }
  return 1 / a;
}

struct Moments {
  double xx = 0, yy = 0, top = 0;
};

/// Means of x^2 and y^2, a^2/4 and b^2/4 of an ellipse [m^2], and of v^2 [m^2/s^2], and the highest
/// particle [m].
struct Shape {
  double xx = 0, yy = 0, vv = 0, top = 0;
};

Shape shape_of(const Scene& scene) {
  Shape shape;
  for_particles(scene, [&](std::size_t, const Vec3& x, const Vec3& v) {
    shape.xx += x.x() * x.x();
    shape.yy += x.y() * x.y();
    shape.vv += v.squaredNorm();
    shape.top = std::max(shape.top, x.y());
  });
  const double n = scene.particles.size();
  return {shape.xx / n, shape.yy / n, shape.vv / n, shape.top};
}

/// Errors at the end over the exact value [-].
struct EllipticDropResult {
  double b = 0;          ///< the semi-axis along y, from second moments
  double a = 0;          ///< along x
  double top = 0;        ///< b from the highest particle, which the flow draws out like the tip
  double kinetic = 0;    ///< kinetic energy, which stays what it was
  double imbalance = 0;  ///< energy error
};

/// n spacings to the radius.
EllipticDropResult run(int n, const std::string& effects) {
  const auto s = make_simulation_of_text(drop(n, effects));
  const Shape start = shape_of(s->scene);
  run_until(*s, until, [] {});
  const Shape end = shape_of(s->scene);
  const double b = exact_b(time_of(*s));
  const EllipticDropResult r{.b = std::sqrt(end.yy / start.yy) / b - 1,
                             .a = std::sqrt(end.xx / start.xx) * b - 1,
                             .top = end.top / b / (1 - 0.5 / n) - 1,
                             .kinetic = end.vv / start.vv - 1,
                             .imbalance = energy_error(*s)};
  WARN(
      fmt::format("elliptic drop, R/dx {}, {}: b {:+.2e}, a {:+.2e}, b of the tip {:+.2e}, "
                  "kinetic energy {:+.2e}; energy error {:.1e}",
                  n, effects, r.b, r.a, r.top, r.kinetic, r.imbalance));
  return r;
}

/// Sums of V F x^2 and V F y^2, but for the sign, over the square lattice of the drop, b times as
/// long in y and narrower by that in x: 1 each if sums were integrals.
std::pair<double, double> weights_of_lattice(double b) {
  const SmoothingKernel kernel{KernelType::cubic_spline, 2, 1.3};
  double along_x = 0;
  double along_y = 0;
  for (int i = -9; i <= 9; ++i) {
    for (int j = -9; j <= 9; ++j) {
      const double x = i / b;
      const double y = j * b;
      const double F = kernel.F(std::hypot(x, y));
      along_x -= F * x * x;
      along_y -= F * y * y;
    }
  }
  return {along_x, along_y};
}

const char* const with_shifting =
    "viscosity: {alpha: 0.01}, density_diffusion: {delta: 0.1}, shifting: {}";

}  // namespace

TEST_CASE("elliptic drop: semi-axes and energy of the exact solution", "[convergence][sph]") {
  std::vector<EllipticDropResult> r;
  for (const int n : {10, 20, 40}) r.push_back(run(n, with_shifting));
  WARN(fmt::format(
      "elliptic drop: orders from 10 to 20 to 40: b {:.2f}, {:.2f}; a {:.2f}, {:.2f}; "
      "b of the tip {:.2f}, {:.2f}; kinetic energy {:.2f}, {:.2f}",
      test::order(r[0].b, r[1].b), test::order(r[1].b, r[2].b), test::order(r[0].a, r[1].a),
      test::order(r[1].a, r[2].a), test::order(r[0].top, r[1].top), test::order(r[1].top, r[2].top),
      test::order(r[0].kinetic, r[1].kinetic), test::order(r[1].kinetic, r[2].kinetic)));
  // Artificial viscosity goes with h. Of the axes, what shifting does to their rim scatters.
  CHECK(test::order(r[0].kinetic, r[1].kinetic) > 0.9);
  CHECK(test::order(r[1].kinetic, r[2].kinetic) > 0.9);
  CHECK(0.5 * test::order(r[0].b, r[2].b) > 0.8);
  CHECK(std::abs(r[2].b) < 0.005);
  CHECK(std::abs(r[2].a) < 0.01);
  CHECK(std::abs(r[2].top) < 0.01);
  for (const EllipticDropResult& each : r) CHECK(each.imbalance < 1e-3);
}

// Without shifting the particles keep their order, in a lattice that is drawn out with the water.
// Where it is twice as long as at the start, the divergence counts what flows along y with less
// than half its weight (1 on the lattice at the start): the density does not see the water widen,
// and no finer particles help.
TEST_CASE("elliptic drop: a lattice drawn out loses the volume", "[convergence][sph]") {
  const auto [along_x, along_y] = weights_of_lattice(2);
  WARN(fmt::format("lattice drawn out by 2: weights {:.3f} along x, {:.3f} along y", along_x,
                   along_y));
  CHECK(along_x > 1);
  CHECK(along_y < 0.5);
  for (const int n : {10, 20}) {
    const EllipticDropResult r =
        run(n, "viscosity: {alpha: 0.01}, density_diffusion: {delta: 0.1}");
    CHECK(r.a > 0.03);  // with shifting a third of that at most
  }
}
