#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "material/elastic_plastic.hpp"
#include "material/plane_stress.hpp"

using namespace gannet;

namespace {

/// Aluminium with a hardening that is large enough to be seen.
ElasticPlastic aluminium(double H) {
  return {.rho = 2700, .E = 68.9e9, .nu = 0.33, .sigma_y = 276e6, .H = H};
}

struct Point {
  PlaneStress<double> sigma{0, 0, 0};
  double eps_p = 0;
};

double vm(const PlaneStress<double>& s) { return std::sqrt(von_mises_squared(s)); }

void advance(const PlaneStressLaw& law, Point& p, double exx, double eyy, double gxy) {
  add_elastic(law, exx, eyy, gxy, p.sigma);
  p.eps_p += return_to_yield(law, law.yield + law.hardening * p.eps_p, p.sigma);
}

/// Lateral strain increment that keeps sigma_yy = 0, by the secant method on one step.
double lateral(const PlaneStressLaw& law, const Point& p, double exx) {
  const auto syy = [&](double eyy) {
    Point q = p;
    advance(law, q, exx, eyy, 0);
    return q.sigma.yy;
  };
  double a = -0.3 * exx;
  double b = -0.5 * exx;
  double fa = syy(a);
  for (int i = 0; i < 30; ++i) {
    const double fb = syy(b);
    if (std::abs(fb) < 1e-4 || fb == fa) break;
    const double next = b - fb * (b - a) / (fb - fa);
    a = b;
    fa = fb;
    b = next;
  }
  return b;
}

}  // namespace

TEST_CASE("plane stress: elastic constants by hand", "[material]") {
  // E = 1e6, nu = 0.25: c11 = 1e6/0.9375, G = 4e5; MacNeal and Harder's membrane patch:
  // exx = eyy = 1e-3, gxy = 1e-3 gives sxx = syy = 1e6/0.75 1e-3 = 1333.33 and sxy = 400.
  const PlaneStressLaw law = plane_stress_law({.rho = 1, .E = 1e6, .nu = 0.25});
  PlaneStress<double> s{0, 0, 0};
  add_elastic(law, 1e-3, 1e-3, 1e-3, s);
  CHECK(s.xx == Approx(1333.3333333333333).epsilon(1e-14));
  CHECK(s.yy == Approx(1333.3333333333333).epsilon(1e-14));
  CHECK(s.xy == Approx(400).epsilon(1e-14));
  // Free thickness: eps_zz = -nu/(1 - nu) (exx + eyy) = -2e-3/3.
  CHECK(through_thickness_strain(law, 1e-3, 1e-3, s.xx, s.yy) == Approx(-2e-3 / 3).epsilon(1e-13));
}

TEST_CASE("plane stress: inside the yield surface nothing flows", "[material]") {
  const PlaneStressLaw law = plane_stress_law(aluminium(0));
  PlaneStress<double> s{275e6, 0, 0};
  CHECK(return_to_yield(law, 276e6, s) == 0);
  CHECK(s.xx == 275e6);
  PlaneStress<double> zero{0, 0, 0};
  CHECK(return_to_yield(law, 276e6, zero) == 0);
  CHECK(zero.xx == 0);
}

TEST_CASE("plane stress: pure shear returns by hand", "[material]") {
  // Only the deviator counts: sigma_xy = tau with sqrt(3) tau = Y + H eps_p, and
  // sqrt(3) tau_trial - 3 G eps_p = Y + H eps_p, so eps_p = (sqrt(3) tau_trial - Y)/(3 G + H).
  const ElasticPlastic al = aluminium(1e9);
  const PlaneStressLaw law = plane_stress_law(al);
  PlaneStress<double> s{0, 0, 200e6};
  const double eps_p = return_to_yield(law, al.sigma_y, s);
  const double expected = (std::sqrt(3.0) * 200e6 - 276e6) / (3 * al.G() + 1e9);
  CHECK(eps_p == Approx(expected).epsilon(1e-13));
  CHECK(std::sqrt(3.0) * s.xy == Approx(276e6 + 1e9 * expected).epsilon(1e-13));
  CHECK(s.xx == Approx(0).margin(1e-6));
}

TEST_CASE("plane stress: two iterations end on the yield surface", "[material]") {
  const ElasticPlastic al = aluminium(2e9);
  const PlaneStressLaw law = plane_stress_law(al);
  const auto miss = [&](double overstress) {
    double worst = 0;
    for (int k = 0; k < 64; ++k) {
      const double angle = 0.1 * k;
      PlaneStress<double> s{std::cos(angle), std::sin(angle), 0.4 * std::sin(3 * angle)};
      const double scale = al.sigma_y * (1 + overstress) / vm(s);
      s = {s.xx * scale, s.yy * scale, s.xy * scale};
      const double eps_p = return_to_yield(law, al.sigma_y, s);
      const double yield = al.sigma_y + al.H * eps_p;
      worst = std::max(worst, std::abs(vm(s) - yield) / yield);
      CHECK(eps_p > 0);
    }
    return worst;
  };
  // A strain of 4e-5 a step is an overstress of 1 %: exact to rounding there (4e-16 reached).
  CHECK(miss(0.01) < 2e-15);
  CHECK(miss(0.1) < 5e-14);
  // Steps that no run makes: finite, plastic, near the surface (1.2e-7 reached at 3).
  CHECK(miss(1.0) < 1e-6);
  CHECK(miss(3.0) < 1e-6);
  CHECK(miss(30.0) < 1e-6);
  CHECK(miss(1000.0) < 1e-6);
}

TEST_CASE("plane stress: uniaxial tension follows the bilinear curve", "[material]") {
  // sigma = Y + E H/(E + H) (eps - Y/E), the exact answer to any step size as the path is straight.
  const ElasticPlastic al = aluminium(1e9);
  const PlaneStressLaw law = plane_stress_law(al);
  Point p;
  double eps = 0;
  for (int k = 0; k < 200; ++k) {
    const double d = 1e-4;
    advance(law, p, d, lateral(law, p, d), 0);
    eps += d;
  }
  const double tangent = al.E * al.H / (al.E + al.H);
  const double expected = al.sigma_y + tangent * (eps - al.sigma_y / al.E);
  CHECK(p.sigma.xx == Approx(expected).epsilon(1e-9));  // the secant stops at 1e-4 Pa
  CHECK(p.sigma.yy == Approx(0).margin(1));
  CHECK(p.eps_p == Approx((expected - al.sigma_y) / al.H).epsilon(1e-7));
}

TEST_CASE("plane stress: equal biaxial stretch follows the bilinear curve", "[material]") {
  // sxx = syy = s = vm; eps = s/E (1 - nu) + eps_p/2, s = Y + H eps_p.
  const ElasticPlastic al = aluminium(1e9);
  const PlaneStressLaw law = plane_stress_law(al);
  Point p;
  double thickness_strain = 0;
  for (int k = 0; k < 100; ++k) {
    const PlaneStress<double> old = p.sigma;
    advance(law, p, 1e-4, 1e-4, 0);
    thickness_strain +=
        through_thickness_strain(law, 1e-4, 1e-4, p.sigma.xx - old.xx, p.sigma.yy - old.yy);
  }
  const double eps = 0.01;
  const double eps_p = (eps - al.sigma_y * (1 - al.nu) / al.E) / (0.5 + al.H * (1 - al.nu) / al.E);
  const double s = al.sigma_y + al.H * eps_p;
  CHECK(p.sigma.xx == Approx(s).epsilon(1e-12));
  CHECK(p.sigma.yy == Approx(s).epsilon(1e-12));
  CHECK(p.eps_p == Approx(eps_p).epsilon(1e-12));
  CHECK(thickness_strain == Approx(-2 * al.nu * s / al.E - eps_p).epsilon(1e-12));
}

TEST_CASE("plane stress: order 1 and small errors on a curved path", "[material][convergence]") {
  // Stretch along x, then shear while x is held: the stress turns along the yield surface. The
  // reference is the same rate equations d sigma = C (d eps - P sigma s) by fourth-order
  // Runge-Kutta in fine steps, which shares no code with the return.
  const ElasticPlastic al = aluminium(1e9);
  const PlaneStressLaw law = plane_stress_law(al);
  const double start = 0.01;  // strain along x, uniaxial strain
  const double shear = 0.02;

  const auto rate = [&](const Point& p, double exx, double gxy, Point& out) {
    // n = d(vm)/d sigma; flow = n.C.e / (n.C.n + H) where it is positive
    const double v = vm(p.sigma);
    const double nx = (p.sigma.xx - 0.5 * p.sigma.yy) / v;
    const double ny = (p.sigma.yy - 0.5 * p.sigma.xx) / v;
    const double ng = 3 * p.sigma.xy / v;
    const auto C = [&](double x, double y, double g) {
      return PlaneStress<double>{law.c11 * x + law.c12 * y, law.c12 * x + law.c11 * y,
                                 law.shear * g};
    };
    const PlaneStress<double> Cn = C(nx, ny, ng);
    const double nCe = Cn.xx * exx + Cn.xy * gxy;
    const double flow = nCe / (Cn.xx * nx + Cn.yy * ny + Cn.xy * ng + al.H);
    const PlaneStress<double> s = C(exx - flow * nx, -flow * ny, gxy - flow * ng);
    out.sigma = s;
    out.eps_p = flow;
  };
  const auto moved = [](Point p, const Point& d, double h) {
    p.sigma = {p.sigma.xx + h * d.sigma.xx, p.sigma.yy + h * d.sigma.yy,
               p.sigma.xy + h * d.sigma.xy};
    p.eps_p += h * d.eps_p;
    return p;
  };
  // Elastic up to yield exactly, then flow.
  const double vm_per_strain = [&] {
    PlaneStress<double> s{0, 0, 0};
    add_elastic(law, 1.0, 0.0, 0.0, s);
    return vm(s);
  }();
  Point ref;
  const double elastic = al.sigma_y / vm_per_strain;
  add_elastic(law, elastic, 0.0, 0.0, ref.sigma);
  const auto runge_kutta = [&](double exx, double gxy, int n) {
    for (int k = 0; k < n; ++k) {
      Point k1, k2, k3, k4;
      rate(ref, exx, gxy, k1);
      rate(moved(ref, k1, 0.5 / n), exx, gxy, k2);
      rate(moved(ref, k2, 0.5 / n), exx, gxy, k3);
      rate(moved(ref, k3, 1.0 / n), exx, gxy, k4);
      ref = moved(moved(moved(moved(ref, k1, 1.0 / (6 * n)), k2, 1.0 / (3 * n)), k3, 1.0 / (3 * n)),
                  k4, 1.0 / (6 * n));
    }
  };
  runge_kutta(start - elastic, 0, 2000);
  runge_kutta(0, shear, 4000);

  const auto error = [&](int n) {
    Point p;
    for (int k = 0; k < n; ++k) advance(law, p, start / n, 0, 0);
    for (int k = 0; k < n; ++k) advance(law, p, 0, 0, shear / n);
    const PlaneStress<double> d{p.sigma.xx - ref.sigma.xx, p.sigma.yy - ref.sigma.yy,
                                p.sigma.xy - ref.sigma.xy};
    return vm(d) / vm(ref.sigma);
  };
  const double coarse = error(200);
  const double fine = error(400);
  CAPTURE(coarse, fine);
  CHECK(fine < 1e-3);  // 0.84e-3 reached: backward Euler at 5e-5 shear strain a step
  CHECK(std::log2(coarse / fine) == Approx(1.0).margin(0.1));
}
