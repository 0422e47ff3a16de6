// The general J2 law, point by point in double precision: returns by hand, in three dimensions and
// in plane stress. Pure shear is the path where both have the same answer in closed form:
// sqrt(3) tau = vm, d eps_p = d gamma_p/sqrt(3).
#include "material/j2.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "material/elastic_plastic.hpp"

using namespace gannet;

namespace {

const double root3 = std::sqrt(3.0);

ElasticPlastic steel() { return {.rho = 7800, .E = 210e9, .nu = 0.3, .sigma_y = 300e6}; }

/// Copper after Johnson and Cook 1985 (materials/copper_ofhc.yaml), with damage of our own.
ElasticPlastic copper() {
  ElasticPlastic m{.rho = 8960, .E = 124e9, .nu = 0.34, .sigma_y = 90e6};
  m.power_factor = 292e6;
  m.power = 0.31;
  m.rate_law = RateLaw::johnson_cook;
  m.rate_power = 0.025;
  m.heating = {.specific_heat = 383, .fraction = 0.9, .range = 1033, .power = 1.09};
  return m;
}

/// One point of either kind that is strained step by step.
struct Strained {
  J2Law law;
  PlaneStressLaw plane;
  bool solid = true;
  Symmetric<double> sigma{0, 0, 0, 0, 0, 0};
  Symmetric<double> alpha{0, 0, 0, 0, 0, 0};
  PlaneStress<double> flat{0, 0, 0};
  PlaneStress<double> flat_alpha{0, 0, 0};
  J2State<double> state{0};
  J2Work<double> total{0, 0, 0};

  Strained(const ElasticPlastic& m, bool in_space)
      : law(j2_law(m)), plane(plane_stress_law(m)), solid(in_space) {}

  void add(const J2Work<double>& w) {
    total.internal += w.internal;
    total.plastic += w.plastic;
    total.eroded += w.eroded;
  }
  /// exx, eyy, gamma in the plane; in space ezz as well.
  void strain(double exx, double eyy, double ezz, double gamma, double dt) {
    const double inverse_dt = dt > 0 ? 1 / dt : 0;
    if (solid) {
      const Symmetric<double> old = sigma;
      add(j2_step(law, old, old, Symmetric<double>{exx, eyy, ezz, 0.5 * gamma, 0, 0}, inverse_dt,
                  alpha, state, sigma));
    } else {
      const PlaneStress<double> old = flat;
      add(j2_step(law, plane, old, exx, eyy, gamma, inverse_dt, flat_alpha, state, flat));
    }
  }
  void shear(double gamma, double dt = 0) { strain(0, 0, 0, gamma, dt); }
  [[nodiscard]] double tau() const { return solid ? sigma.xy : flat.xy; }
  [[nodiscard]] double vm() const {
    return std::sqrt(solid ? von_mises_squared(sigma) : von_mises_squared(flat));
  }
  [[nodiscard]] double held() const {
    const double squared = solid ? contraction(sigma, sigma)
                                 : flat.xx * flat.xx + flat.yy * flat.yy + 2 * flat.xy * flat.xy;
    return elastic_energy(law, squared, solid ? sigma.xx + sigma.yy + sigma.zz : flat.xx + flat.yy);
  }
};

}  // namespace

TEST_CASE("j2: linear hardening as the laws that have nothing else", "[material]") {
  ElasticPlastic m = steel();
  m.H = 2e9;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-3e-4, 3e-4);
  Strained solid(m, true);
  Strained shell(m, false);
  const SolidLaw fast = solid_law(m);
  Symmetric<double> s{0, 0, 0, 0, 0, 0};
  double eps_s = 0;
  PlaneStress<double> p{0, 0, 0};
  double eps_p = 0;
  for (int k = 0; k < 300; ++k) {
    const double exx = u(random) + 1e-4;
    const double eyy = u(random);
    const double ezz = u(random);
    const double g = u(random);
    solid.strain(exx, eyy, ezz, g, 1e-3);
    add_elastic(fast, Symmetric<double>{exx, eyy, ezz, 0.5 * g, 0, 0}, s);
    eps_s += return_to_yield(fast, m.sigma_y + m.H * eps_s, s);
    shell.strain(exx, eyy, 0, g, 1e-3);
    add_elastic(shell.plane, exx, eyy, g, p);
    eps_p += return_to_yield(shell.plane, m.sigma_y + m.H * eps_p, p);
  }
  CHECK(eps_s > 0.01);
  CHECK(solid.state.eps_p == Approx(eps_s).epsilon(1e-12));
  CHECK(solid.sigma.xx == Approx(s.xx).epsilon(1e-12));
  CHECK(solid.sigma.xy == Approx(s.xy).epsilon(1e-11));
  // The fast law stops after two iterations: 1e-13 for overstresses of some percent.
  CHECK(shell.state.eps_p == Approx(eps_p).epsilon(1e-10));
  CHECK(shell.flat.xx == Approx(p.xx).epsilon(1e-10));
}

TEST_CASE("j2: a curve is met exactly, across its bends, in one step", "[material]") {
  ElasticPlastic m = steel();
  m.curve_strain = {0, 0.01, 0.03};
  m.curve_stress = {300e6, 400e6, 450e6};
  for (const bool solid : {true, false}) {
    const double G = m.G();
    // Within the first piece: sqrt(3) G gamma - 3 G x = 300e6 + 1e10 x.
    Strained a(m, solid);
    a.shear(0.01);
    const double x = (root3 * G * 0.01 - 300e6) / (3 * G + 1e10);
    CHECK(x < 0.01);
    CHECK(a.state.eps_p == Approx(x).epsilon(1e-13));
    CHECK(root3 * a.tau() == Approx(300e6 + 1e10 * x).epsilon(1e-13));
    // Into the second: Y = 400e6 + 2.5e9 (x - 0.01).
    Strained b(m, solid);
    b.shear(0.04);
    const double y = (root3 * G * 0.04 - 400e6 + 2.5e7) / (3 * G + 2.5e9);
    CHECK((y > 0.01 && y < 0.03));
    CHECK(b.state.eps_p == Approx(y).epsilon(1e-13));
    // Beyond the last: 450e6.
    Strained c(m, solid);
    for (int k = 0; k < 10; ++k) c.shear(0.01);
    CHECK(root3 * c.tau() == Approx(450e6).epsilon(1e-13));
  }
}

TEST_CASE("j2: the surface moves with kinematic hardening (Bauschinger)", "[material]") {
  for (const bool solid : {true, false}) {
    for (const double share : {1.0, 0.4, 0.0}) {
      ElasticPlastic m = steel();
      m.H = 3e9;
      m.kinematic_fraction = share;
      Strained p(m, solid);
      for (int k = 0; k < 100; ++k) p.shear(2e-4);
      // Forth: sqrt(3) tau = sigma_y + H eps_p whatever the share.
      const double eps = (root3 * m.G() * 0.02 - 300e6) / (3 * m.G() + 3e9);
      CHECK(p.state.eps_p == Approx(eps).epsilon(1e-12));
      const double forth = 300e6 + 3e9 * eps;
      CHECK(root3 * p.tau() == Approx(forth).epsilon(1e-12));
      // Back: it yields when the stress has changed by 2 (sigma_y + (1 - share) H eps_p).
      const double width = 2 * (300e6 + (1 - share) * 3e9 * eps);
      const double elastic = width / (root3 * m.G());
      p.shear(-elastic * (1 - 1e-9));
      CHECK(p.state.eps_p == Approx(eps).epsilon(1e-12));
      CHECK(root3 * p.tau() == Approx(forth - width).epsilon(1e-6));
      p.shear(-1e-3);
      const double more = p.state.eps_p - eps;
      CHECK(more == Approx(root3 * m.G() * 1e-3 / (3 * m.G() + 3e9)).epsilon(1e-5));
      CHECK(root3 * p.tau() == Approx(forth - width - 3e9 * more).epsilon(1e-6));
    }
  }
}

TEST_CASE("j2: Cowper and Symonds's factor at two rates, and the jump between them", "[material]") {
  ElasticPlastic m = steel();
  m.rate_law = RateLaw::cowper_symonds;
  m.rate = 40.4;
  m.rate_power = 1 / 5.0;
  for (const bool solid : {true, false}) {
    Strained p(m, solid);
    const auto at = [](double rate) { return 300e6 * (1 + std::pow(rate / 40.4, 0.2)); };
    // Without hardening the plastic rate becomes that of the whole strain, gamma/sqrt(3).
    const auto strain_at = [&](double rate) {
      for (int k = 0; k < 200; ++k) p.shear(root3 * 1e-4, 1e-4 / rate);
    };
    strain_at(1);
    CHECK(root3 * p.tau() == Approx(at(1)).epsilon(1e-9));
    strain_at(100);
    CHECK(root3 * p.tau() == Approx(at(100)).epsilon(1e-9));
    strain_at(1);
    CHECK(root3 * p.tau() == Approx(at(1)).epsilon(1e-9));
  }
}

TEST_CASE("j2: the return ends on the surface of Johnson and Cook, whatever the step",
          "[material]") {
  const ElasticPlastic m = copper();
  double worst = 0;
  for (const bool solid : {true, false}) {
    for (const double eps : {0.0, 1e-9, 1e-3, 0.3}) {
      for (const double rise : {0.0, 300.0, 1032.0}) {
        for (const double gamma : {1e-7, 1e-5, 1e-3, 0.1}) {
          for (const double rate : {1e-2, 1e2, 1e6}) {
            Strained p(m, solid);
            p.state.eps_p = eps;
            p.state.rise = rise;
            const double T = rise / 1033;
            const double thermal = T > 0 ? 1 - std::pow(T, 1.09) : 1;
            const double at_rest = (90e6 + 292e6 * std::pow(eps, 0.31)) * thermal;
            // From just inside the surface, along no straight path in plane stress.
            p.sigma.xy = p.flat.xy = 0.999 * at_rest / root3;
            p.strain(0.3 * gamma, -0.1 * gamma, -0.2 * gamma, gamma, gamma / rate);
            const double x = p.state.eps_p - eps;
            if (!(x > 0)) continue;
            const double Y = (90e6 + 292e6 * std::pow(eps + x, 0.31)) * thermal *
                             (1 + 0.025 * std::log(std::max(x * rate / gamma, 1.0)));
            // Digits lost: x is a difference, and so is the stress where the step is huge.
            const double lost = 2.3e-16 * (0.025 * p.state.eps_p / x + 4 * m.G() * gamma / Y);
            worst = std::max(worst, std::abs(p.vm() / Y - 1) - lost);
          }
        }
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("j2: internal work is elastic and plastic work, to rounding", "[material]") {
  ElasticPlastic kinematic = steel();
  kinematic.H = 3e9;
  kinematic.kinematic_fraction = 0.5;
  for (const ElasticPlastic& m : {copper(), kinematic}) {
    for (const bool solid : {true, false}) {
      Strained p(m, solid);
      std::mt19937 random(8);
      std::uniform_real_distribution<double> u(-1e-3, 1e-3);
      for (int k = 0; k < 500; ++k) {
        p.strain(u(random) + 2e-4, u(random), u(random), u(random) + 3e-4, 1e-6);
      }
      CHECK(p.state.eps_p > 0.05);
      CHECK(p.total.internal == Approx(p.held() + p.total.plastic).epsilon(1e-11));
    }
  }
}

TEST_CASE("j2: adiabatic shear of copper against the rate equations", "[material][convergence]") {
  // q = sqrt(3) tau, e = eps_p: dq/dt = 3 G (rate - e'), (1 + C ln e') (A + B e^n) (1 - T*^m) = q,
  // rho c T' = beta q e', by fourth-order Runge-Kutta in steps of 2e-9 s; shares nothing with the
  // return.
  const ElasticPlastic m = copper();
  const double rate = 1e4;
  struct State {
    double q, e, T;
  };
  const auto slope = [&](const State& s) {
    const double at_rest = (90e6 + 292e6 * std::pow(std::max(s.e, 1e-30), 0.31)) *
                           (1 - std::pow(std::max(s.T, 0.0) / 1033, 1.09));
    const double over = s.q / at_rest - 1;
    const double flow = over > 0 ? std::exp(over / 0.025) : 0;
    return State{3 * m.G() * (rate - flow), flow, 0.9 * s.q * flow / (8960 * 383)};
  };
  const auto moved = [](const State& s, const State& d, double h) {
    return State{s.q + h * d.q, s.e + h * d.e, s.T + h * d.T};
  };
  const double end = 0.5 / rate;
  // Elastic up to yield exactly.
  const double start = 90e6 / (3 * m.G() * rate);
  State s{90e6, 1e-12, 0};
  const int n = 400000;
  const double h = (end - start) / n;
  for (int k = 0; k < n; ++k) {
    const State k1 = slope(s);
    const State k2 = slope(moved(s, k1, h / 2));
    const State k3 = slope(moved(s, k2, h / 2));
    const State k4 = slope(moved(s, k3, h));
    s = moved(moved(moved(moved(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }
  for (const bool solid : {true, false}) {
    const auto run = [&](int steps) {
      Strained p(m, solid);
      for (int k = 0; k < steps; ++k) p.shear(root3 * 0.5 / steps, end / steps);
      return p;
    };
    const Strained coarse = run(500);
    const Strained fine = run(1000);
    CAPTURE(s.q, s.T, root3 * fine.tau(), fine.state.rise);
    CHECK(s.T > 30);
    CHECK(root3 * fine.tau() == Approx(s.q).epsilon(1e-4));
    CHECK(fine.state.rise == Approx(s.T).epsilon(1e-3));
    CHECK(fine.state.eps_p == Approx(s.e).epsilon(1e-6));
    // The temperature of a step is that of its start: order 1.
    const double ratio = (root3 * coarse.tau() - s.q) / (root3 * fine.tau() - s.q);
    CHECK(std::log2(ratio) == Approx(1.0).margin(0.15));
    // What became heat is 0.9 of the plastic work, exactly.
    CHECK(8960 * 383 * fine.state.rise == Approx(0.9 * fine.total.plastic).epsilon(1e-12));
  }
}

TEST_CASE("j2: a point fails at its plastic strain and carries nothing any more", "[material]") {
  ElasticPlastic m = steel();
  m.failure.strain[0] = 0.01;
  for (const bool solid : {true, false}) {
    Strained p(m, solid);
    double before = 0;
    while (p.state.damage < 1) {
      before = p.held();
      p.shear(1e-4);
    }
    CHECK(p.state.eps_p == Approx(0.01).margin(1e-4));
    CHECK(p.tau() == 0);
    // The elastic energy left, with the half of the work of the last step that was still done.
    CHECK(before == Approx(0.5 * 1e8 * 300e6 / m.G()).epsilon(1e-9));  // tau^2/(2 G)
    CHECK(p.total.eroded == Approx(before + 0.5 * 300e6 / root3 * 1e-4).epsilon(1e-9));
    CHECK(p.total.internal == Approx(p.total.plastic).epsilon(1e-9));
    const double eps = p.state.eps_p;
    for (int k = 0; k < 5; ++k) p.shear(1e-2);
    CHECK(p.tau() == 0);
    CHECK(p.state.eps_p == eps);
    CHECK(p.total.internal == Approx(p.total.plastic).epsilon(1e-9));
  }
}

TEST_CASE("j2: Johnson and Cook's damage by hand", "[material]") {
  // Uniaxial strain far beyond yield has a mean stress that grows; one step from a given state.
  ElasticPlastic m = copper();
  const double D[5] = {0.54, 4.89, -3.03, 0.014, 1.12};
  for (int k = 0; k < 5; ++k) m.failure.strain[k] = D[k];
  m.failure.rate = 10;
  Strained p(m, true);
  p.state.rise = 200;
  p.strain(2e-3, 0, 0, 0, 1e-5);
  const double x = p.state.eps_p;
  const double mean = (p.sigma.xx + p.sigma.yy + p.sigma.zz) / 3;
  const double strain = (D[0] + D[1] * std::exp(D[2] * mean / p.vm())) *
                        (1 + D[3] * std::log(x / 1e-5 / 10)) * (1 + D[4] * 200 / 1033);
  CHECK(x > 5e-4);
  CHECK(p.state.damage == Approx(x / strain).epsilon(1e-12));
}
