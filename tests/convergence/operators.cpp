// Order of the sums over particles: divergence, pressure gradient and viscous force of smooth
// fields on a lattice and on a jittered one, at a fixed h/dx, without and with corrected gradients.
//
// What to expect, with e the error, dx -> 0 and h/dx fixed:
//   lattice, plain        e0 + O(h^2); e0, up to 1e-2, is what the sum over lattice points differs
//                         from the integral over the kernel, whatever h
//   lattice, corrected    O(h^2)
//   jittered, plain       O(1) of the divergence, as sum V F r (x) r is not the unit matrix; O(1/h)
//                         of the pressure gradient, as sum V grad W is not zero and pressure has a
//                         mean, and of the viscous force, which is a second derivative
//   jittered, corrected   O(h)
// Quinlan, Basa and Lastiwka 2006, Int. J. Numer. Methods Eng. 66, 2064, on the plain sums.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "unit/sph/pair_setup.hpp"

using namespace gannet;

namespace {

constexpr double rho = 1000;  // [kg/m^3]
constexpr double mu = 3;      // [Pa s]

/// Fields of a place and what the sums should give there.
struct Fields {
  Vec3 (*v)(const Vec3& x);
  double (*p)(const Vec3& x);
  double (*div_v)(const Vec3& x);
  Vec3 (*grad_p)(const Vec3& x);
  Vec3 (*lap_v)(const Vec3& x);
};

/// v = (sin 3x cos 2y, cos(2x + y)), p = 2 + sin 2x cos 3y.
const Fields smooth = {
    [](const Vec3& x) {
      return Vec3(std::sin(3 * x[0]) * std::cos(2 * x[1]), std::cos(2 * x[0] + x[1]), 0);
    },
    [](const Vec3& x) { return 2 + std::sin(2 * x[0]) * std::cos(3 * x[1]); },
    [](const Vec3& x) {
      return 3 * std::cos(3 * x[0]) * std::cos(2 * x[1]) - std::sin(2 * x[0] + x[1]);
    },
    [](const Vec3& x) {
      return Vec3(2 * std::cos(2 * x[0]) * std::cos(3 * x[1]),
                  -3 * std::sin(2 * x[0]) * std::sin(3 * x[1]), 0);
    },
    [](const Vec3& x) {
      return Vec3(-13 * std::sin(3 * x[0]) * std::cos(2 * x[1]), -5 * std::cos(2 * x[0] + x[1]), 0);
    }};

const Fields linear = {
    [](const Vec3& x) { return Vec3(1 + 3 * x[0] - 2 * x[1], 2 - x[0] + 0.5 * x[1], 0); },
    [](const Vec3& x) { return 7 + 2 * x[0] - 5 * x[1]; }, [](const Vec3&) { return 3.5; },
    [](const Vec3&) { return Vec3(2, -5, 0); }, [](const Vec3&) { return Vec3(0, 0, 0); }};

/// A kernel and its h/dx: those that a case has where it does not say.
struct KernelChoice {
  const char* name;
  KernelType kernel;
  double ratio;
};

const std::vector<KernelChoice> choices = {
    {"cubic spline, h/dx 1.3", KernelType::cubic_spline, 1.3},
    {"Wendland C2, h/dx 1.5", KernelType::wendland_c2, 1.5},
    {"Wendland C4, h/dx 1.7", KernelType::wendland_c4, 1.7},
    {"quintic spline, h/dx 1", KernelType::quintic_spline, 1.0}};

/// Particles of the unit square, n across; jitter: largest displacement over dx in x and y.
Fluid square(int n, double jitter, const KernelChoice& choice, const Fields& fields) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-jitter, jitter);
  const double dx = 1.0 / n;
  Fluid fluid;
  fluid.k = {.dimension = 2,
             .h = choice.ratio * dx,
             .m = rho * dx * dx,
             .kernel = choice.kernel,
             .rho0 = rho,
             .dx = dx,
             .mu = mu};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5 + u(random)) * dx;
      const double y = (j + 0.5 + u(random)) * dx;
      fluid.add({x, y, 0}, fields.v({x, y, 0}), rho, fields.p({x, y, 0}));
    }
  }
  return fluid;
}

/// Of one sum over the particles in the middle of the square, against its exact values.
struct Error {
  double difference = 0, exact = 0, product = 0;
  void add(const Vec3& found, const Vec3& wanted) {
    difference += (found - wanted).squaredNorm();
    exact += wanted.squaredNorm();
    product += found.dot(wanted);
  }
  /// Root of the mean square over that of the exact values; of the error where these are zero.
  [[nodiscard]] double size() const { return std::sqrt(difference / (exact > 0 ? exact : 1)); }
  /// By which share what is found is too large, with its sign.
  [[nodiscard]] double bias() const { return product / exact - 1; }
};

struct Errors {
  Error divergence, gradient, viscous, corrected_divergence, corrected_gradient;
};

Errors errors_of(int n, double jitter, const KernelChoice& choice, const Fields& fields) {
  const Fluid fluid = square(n, jitter, choice, fields);
  const Results r = vectorised(isa(), fluid, {.all = true});
  Errors e;
  for (std::size_t i = 0; i < fluid.x.size(); ++i) {
    const Vec3 x = xyz(fluid.x[i]);
    if (std::abs(x[0] - 0.5) > 0.22 || std::abs(x[1] - 0.5) > 0.22) continue;
    const Vec3 f = xyz(r.f[i]) - xyz(r.f_laminar[i]);  // pressure, corrected
    const Vec3 div_v(fields.div_v(x), 0, 0);
    const double volume = fluid.k.m / rho;
    e.divergence.add({-(r.drho_dt[i] - r.drho_correction[i]) / rho, 0, 0}, div_v);
    e.corrected_divergence.add({-r.drho_dt[i] / rho, 0, 0}, div_v);
    e.gradient.add(-(f - xyz(r.f_correction[i])) / volume, fields.grad_p(x));
    e.corrected_gradient.add(-f / volume, fields.grad_p(x));
    e.viscous.add(xyz(r.f_laminar[i]) / (mu * volume), fields.lap_v(x));
  }
  return e;
}

using Series = std::vector<Errors>;

Series series(const KernelChoice& choice, double jitter) {
  Series all;
  for (const int n : {32, 64, 128}) all.push_back(errors_of(n, jitter, choice, smooth));
  return all;
}

/// Prints the errors of one sum and returns the last observed order.
double order_of(const KernelChoice& choice, const char* what, const Series& all,
                Error Errors::*error) {
  double e[3];
  for (std::size_t k = 0; k < 3; ++k) e[k] = (all[k].*error).size();
  const double order = std::log2(e[1] / e[2]);
  WARN(fmt::format("{}, {}: {:.2e}, {:.2e}, {:.2e}, orders {:.2f}, {:.2f}", choice.name, what, e[0],
                   e[1], e[2], std::log2(e[0] / e[1]), order));
  return order;
}

/// A bias e0 + C h^order through the three resolutions.
struct Limit {
  double e0 = 0, order = 0;
};

Limit limit_of(const KernelChoice& choice, const char* what, const Series& all,
               Error Errors::*error) {
  double e[3];
  for (std::size_t k = 0; k < 3; ++k) e[k] = (all[k].*error).bias();
  const double ratio = (e[0] - e[1]) / (e[1] - e[2]);
  const Limit limit{e[2] - (e[1] - e[2]) / (ratio - 1), std::log2(ratio)};
  WARN(fmt::format("{}, {}: bias {:+.2e}, {:+.2e}, {:+.2e}, order {:.2f} to {:+.2e}", choice.name,
                   what, e[0], e[1], e[2], limit.order, limit.e0));
  return limit;
}

}  // namespace

TEST_CASE("operators: corrected gradients are exact for linear fields", "[convergence][sph]") {
  for (const KernelChoice& c : choices) {
    const Errors e = errors_of(24, 0.2, c, linear);
    WARN(fmt::format("{}: divergence {:.1e}, gradient {:.1e}; plain {:.1e}, {:.1e}", c.name,
                     e.corrected_divergence.size(), e.corrected_gradient.size(),
                     e.divergence.size(), e.gradient.size()));
    CHECK(e.corrected_divergence.size() < 1e-13);
    CHECK(e.corrected_gradient.size() < 1e-13);
    CHECK(e.divergence.size() > 1e-2);  // the plain sums are not
    CHECK(e.gradient.size() > 1e-2);
  }
}

TEST_CASE("operators: order 2 on a lattice, to what the lattice leaves", "[convergence][sph]") {
  for (const KernelChoice& c : choices) {
    const Series all = series(c, 0);
    const double of_lattice = errors_of(24, 0, c, linear).divergence.bias();
    for (const auto error : {&Errors::divergence, &Errors::gradient}) {
      const Limit limit =
          limit_of(c, error == &Errors::gradient ? "gradient" : "divergence", all, error);
      CHECK(limit.order == Approx(2).margin(0.1));
      CHECK(limit.e0 == Approx(of_lattice).margin(1e-4));
      CHECK(std::abs(limit.e0) < 0.012);
    }
    const Limit viscous = limit_of(c, "viscous force", all, &Errors::viscous);
    CHECK(viscous.order == Approx(2).margin(0.1));
    CHECK(std::abs(viscous.e0) < 0.02);
    CHECK(order_of(c, "corrected divergence", all, &Errors::corrected_divergence) > 1.9);
    CHECK(order_of(c, "corrected gradient", all, &Errors::corrected_gradient) > 1.9);
  }
}

TEST_CASE("operators: order 1 out of order, with correction", "[convergence][sph]") {
  for (const KernelChoice& c : choices) {
    const Series all = series(c, 0.1);
    CHECK(order_of(c, "jittered divergence", all, &Errors::divergence) == Approx(0).margin(0.2));
    CHECK(order_of(c, "jittered gradient", all, &Errors::gradient) == Approx(-1).margin(0.2));
    CHECK(order_of(c, "jittered viscous force", all, &Errors::viscous) == Approx(-1).margin(0.2));
    CHECK(order_of(c, "jittered corrected divergence", all, &Errors::corrected_divergence) > 0.9);
    CHECK(order_of(c, "jittered corrected gradient", all, &Errors::corrected_gradient) > 0.9);
  }
}
