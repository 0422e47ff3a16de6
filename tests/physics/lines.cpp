// Whole runs of cables and beams against theory: frequencies, catenary, elastica, roll-up, the bend
// of 45 degrees.
#include <numbers>

#include "fe/beam.hpp"
#include "fe/truss.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// The node of a line that starts nearest to x.
Index node_near(const Simulation& s, const Vec3& x) {
  Index best = 0;
  for (Index i = 0; i < s.scene.nodes.n_owned; ++i) {
    const auto off = [&](Index k) {
      return (xyz(s.scene.nodes.x[static_cast<std::size_t>(k)]) - x).norm();
    };
    if (off(i) < off(best)) best = i;
  }
  return best;
}

Vec3 place(const Simulation& s, Index node) {
  return xyz(s.scene.nodes.x[static_cast<std::size_t>(node)]);
}

/// Frequency of z motion in a shape, from its zeros [Hz]. shape: of the places at the start.
template <class F>
double frequency(Simulation& s, double until, F&& shape) {
  std::vector<double> weight;
  for (const Line& x : s.scene.nodes.x) weight.push_back(shape(x.x));
  std::vector<double> zeros;
  Curve q;
  run_until(s, until, [&] {
    double now = 0;
    for (std::size_t i = 0; i < weight.size(); ++i) now += weight[i] * s.scene.nodes.x[i].z;
    if (!q.y.empty() && q.y.back() * now < 0) {
      zeros.push_back(q.t.back() + (time_of(s) - q.t.back()) * q.y.back() / (q.y.back() - now));
    }
    q.add(time_of(s), now);
  });
  return 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
}

}  // namespace

TEST_CASE("physics: a beam held at one end rings at the frequencies of Timoshenko", "[physics]") {
  // Frequencies of Timoshenko beams with kappa = 5/6 and rotary inertia, by Rayleigh-Ritz to 8
  // digits; after Euler and Bernoulli (Blevins, Formulas for Natural Frequency and Mode Shape) they
  // are 16.764, 105.06, 294.16 Hz and 164.50, 1030.9, 2886.6 Hz.
  struct Bar {
    const char* material;
    const char* beam;
    double L;
    double exact[3];
    double tolerance;
  };
  // Steel as it comes: the rotary inertia of the stiff axis also slows down the weak one.
  const Bar bars[] = {{"{density: 7800, young: 210 GPa, poisson: 0.3}",
                       "section: {rectangle: {width: 50 mm, height: 20 mm}}",
                       1,
                       {16.758458, 104.82395, 292.61536},
                       0.015},
                      {"{density: 7800, young: 210 GPa, poisson: 0.3}",
                       "section: {rectangle: {width: 50 mm, height: 20 mm}}, rotary_inertia: 0.16",
                       1,
                       {16.758458, 104.82395, 292.61536},
                       0.01},
                      {"{density: 2700, young: 70 GPa, poisson: 0.33}",
                       "section: {rectangle: {width: 50 mm, height: 50 mm}}",
                       0.5,
                       {163.18786, 977.32278, 2568.1623},
                       0.01}};
  const double beta[] = {1.8751041, 4.6940911, 7.8547574};
  for (const Bar& bar : bars) {
    for (std::size_t n = 0; n < 3; ++n) {
      const double b = beta[n] / bar.L;
      const double sigma =
          (std::cosh(beta[n]) + std::cos(beta[n])) / (std::sinh(beta[n]) + std::sin(beta[n]));
      const auto s = make_simulation_of_text(fmt::format(
          "gannet: 1\n"
          "materials: {{solid: {2}}}\n"
          "parts: {{bar: {{beam: {{material: solid, {3}}}, shape: {{line: {{from: [0, 0, 0], to: "
          "[{4} m, 0, 0], elements: 20}}}}, initial_velocity: [0, 0, "
          "\"1e-3*(cosh({0:.9g}*x)-cos({0:.9g}*x)-{1:.9g}*(sinh({0:.9g}*x)-sin({0:.9g}*x)))\"]}}}}"
          "\n"
          "boundaries: {{clamp: {{nodes: {{nearest: [0, 0, 0], of: bar}}, fix: [x, y, z, rx, ry, "
          "rz]}}}}\n"
          "output: {{until: 1 s}}\n",
          b, sigma, bar.material, bar.beam, bar.L));
      const double f = frequency(*s, 5.3 / bar.exact[n], [&](double x) {
        return std::cosh(b * x) - std::cos(b * x) - sigma * (std::sinh(b * x) - std::sin(b * x));
      });
      WARN(fmt::format("L = {} m, mode {}: {:.3f} Hz ({:+.3f} %), energy error {:.1e}", bar.L,
                       n + 1, f, 100 * (f / bar.exact[n] - 1), energy_error(*s)));
      CHECK(f == Approx(bar.exact[n]).epsilon(bar.tolerance));
      CHECK(energy_error(*s) < 5e-3);
    }
  }
}

namespace {

/// A cantilever of length 1 along x whose E I is 1, soft neither along nor in shear: E A = 3e4.
std::unique_ptr<Simulation> elastica(const std::string& load) {
  auto s = make_simulation_of_text(
      "gannet: 1\n"
      "materials: {rod: {density: 1, young: 3e4, poisson: 0}}\n"
      "parts: {rod: {beam: {material: rod, section: {general: {area: 1, I_y: 3.333333333333e-5, "
      "I_z: 3.333333333333e-5, J: 6.666666666667e-5}}}, shape: {line: {from: [0, 0, 0], to: [1 m, "
      "0, 0], elements: 20}}}}\n"
      "boundaries: {clamp: {nodes: {nearest: [0, 0, 0], of: rod}, fix: [x, y, z, rx, ry, rz]}}\n"
      "effects: {guards: off}\n" +
      load + "output: {until: 100 s}\n");
  add_drag(*s, 6);  // twice the lowest frequency, 3.516 rad/s, would be critical
  return s;
}

}  // namespace

TEST_CASE("physics: the elastica under a dead force at its tip", "[physics]") {
  // Bisshopp and Drucker 1945, Quart. Appl. Math. 3, 272-275: P L^2/(E I) = 1, 5, 10.
  const double load[] = {1, 5, 10};
  const double across[] = {0.3017207738, 0.7137915236, 0.8106090249};
  const double shortening[] = {0.0564332363, 0.3876283607, 0.5549955978};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto s = elastica(fmt::format(
        "loads: {{tip: {{force: {{nodes: {{nearest: [1 m, 0, 0], of: rod}}, value: [0, 0, {}]}}}}}}"
        "\n",
        load[k]));
    const Index tip = node_near(*s, {1, 0, 0});
    run_until(*s, 6, [] {});
    const Vec3 x = place(*s, tip);
    WARN(fmt::format("P = {}: w/L off by {:+.3f} %, u/L by {:+.3f} %", load[k],
                     100 * (x.z() - across[k]), 100 * (1 - x.x() - shortening[k])));
    CHECK(std::abs(x.z() - across[k]) < 0.005);
    CHECK(std::abs(1 - x.x() - shortening[k]) < 0.005);
  }
}

TEST_CASE("physics: a moment at its tip rolls a beam up to a circle", "[physics]") {
  for (const double turns : {0.5, 1.0}) {
    const auto s = elastica("");
    const Index tip = node_near(*s, {1, 0, 0});
    const double M = 2 * std::numbers::pi * turns;
    Nodes& nodes = s->scene.nodes;
    s->models.list.front().plan.add(
        {.name = "moment of the test", .stage = Stage::force, .run = [&nodes, tip, M](const Step&) {
           add_xyz(nodes.torque[static_cast<std::size_t>(tip)], Vec3(0, -M, 0));
         }});
    run_until(*s, 6, [] {});
    const Vec3 x = place(*s, tip);
    // A circle of radius E I/M through the clamp.
    const Vec3 exact(std::sin(M) / M, 0, (1 - std::cos(M)) / M);
    WARN(fmt::format("{} turns: tip off by {:.4f} % of the length", turns,
                     100 * (x - exact).norm()));
    CHECK((x - exact).norm() < 0.005);
  }
}

TEST_CASE("physics: the bend of 45 degrees under a force out of its plane", "[physics]") {
  // Bathe and Bolourchi 1979 (Int. J. Numer. Methods Eng. 14): R = 100, unit square, E = 1e7, nu =
  // 0. Tip after a geometrically exact rod with J = 0.140577 and kappa = 5/6.
  const double load[] = {300, 600};
  const Vec3 exact[] = {{22.112514, 58.535709, 40.480758}, {15.557676, 46.891586, 53.607986}};
  std::string points;
  for (int k = 0; k <= 20; ++k) {
    const double angle = 0.25 * std::numbers::pi * k / 20;
    points += fmt::format("{}[{:.12g}, {:.12g}, 0]", k > 0 ? ", " : "", 100 * (1 - std::cos(angle)),
                          100 * std::sin(angle));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const auto s = make_simulation_of_text(fmt::format(
        "gannet: 1\n"
        "materials: {{rod: {{density: 1, young: 1e7, poisson: 0}}}}\n"
        "parts: {{bend: {{beam: {{material: rod, section: {{rectangle: {{width: 1, height: "
        "1}}}}}}, "
        "shape: {{polyline: {{points: [{}], elements: 1}}}}}}}}\n"
        "boundaries: {{clamp: {{nodes: {{nearest: [0, 0, 0], of: bend}}, fix: [x, y, z, rx, ry, "
        "rz]}}}}\n"
        "loads: {{tip: {{force: {{nodes: {{nearest: [29.289, 70.711, 0], of: bend}}, value: [0, 0, "
        "{}]}}}}}}\n"
        "effects: {{guards: off}}\n"
        "output: {{until: 100 s}}\n",
        points, load[k]));
    add_drag(*s, 1);
    const Index tip = node_near(*s, {29.289, 70.711, 0});
    run_until(*s, 35, [] {});
    const Vec3 x = place(*s, tip);
    WARN(fmt::format("P = {}: tip ({:.4f}, {:.4f}, {:.4f}), off by {:.3f} % of its way", load[k],
                     x.x(), x.y(), x.z(),
                     100 * (x - exact[k]).norm() / (exact[k] - Vec3(29.289, 70.711, 0)).norm()));
    for (int d = 0; d < 3; ++d) CHECK(x[d] == Approx(exact[k][d]).epsilon(0.005));
  }
}

TEST_CASE("physics: a taut string swings at its frequencies", "[physics]") {
  // f = n/(2 L) sqrt(T/m); L = 1000 m, T = 2 MN, m = 49.621456 kg/m of stretched length.
  const double strain = 2e6 / 1.33596e9;
  for (const int n : {1, 3}) {
    const double exact = n * 0.100380707;
    const auto s = make_simulation_of_text(fmt::format(
        "gannet: 1\n"
        "parts: {{string: {{cable: {{EA: 1.33596e9, mass_per_length: {:.9g}, prestrain: {:.9g}}}, "
        "shape: {{line: {{from: [0, 0, 0], to: [1000 m, 0, 0], elements: 60}}}}, "
        "initial_velocity: [0, 0, \"0.01*sin({}*pi*x/1000)\"]}}}}\n"
        "boundaries: {{near: {{nodes: {{nearest: [0, 0, 0], of: string}}, fix: [x, y, z]}}, far: "
        "{{nodes: {{nearest: [1000 m, 0, 0], of: string}}, fix: [x, y, z]}}}}\n"
        "output: {{until: 100 s}}\n",
        49.621456 * (1 + strain), strain, n));
    const double f = frequency(*s, 5.3 / exact,
                               [&](double x) { return std::sin(n * std::numbers::pi * x / 1000); });
    WARN(fmt::format("mode {}: {:.5f} Hz ({:+.3f} %), energy error {:.1e}", n, f,
                     100 * (f / exact - 1), energy_error(*s)));
    CHECK(f == Approx(exact).epsilon(0.005));
    CHECK(energy_error(*s) < 1e-6);
  }
}

TEST_CASE("physics: a rope under its weight takes the elastic catenary", "[physics]") {
  // Irvine 1981, Cable Structures: X = 1200 m, Z = 900 m, L = 1480 m, E A = 60 MN, w = 245.25 N/m:
  // H = 809.2040216 kN, V = 794.7347127 kN at the upper end.
  const double w = 245.25;
  const int n = 80;
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "parts: {rope: {cable: {EA: 60 MN, mass_per_length: 25, prestrain: 0.0135135135135}, shape: "
      "{line: {from: [0, 0, 0], to: [1200 m, 0, 900 m], elements: 80}}}}\n"
      "boundaries: {ends: {nodes: {nearest: [0, 0, 0], of: rope}, fix: [x, y, z]}, top: {nodes: "
      "{nearest: [1200 m, 0, 900 m], of: rope}, fix: [x, y, z]}}\n"
      "loads: {gravity: [0, 0, -9.81 m/s^2]}\n"
      "effects: {guards: off}\n"
      "output: {until: 1000 s}\n");
  add_drag(*s, 0.7);
  run_until(*s, 60, [] {});
  // The uppermost element carries the force half its length below the end.
  const double V = 794734.7127 - 0.5 * w * 1480 / n;
  const double exact = std::hypot(809204.0216, V);
  const double top = measured(s->scene, "cable.rope.tension");
  WARN(fmt::format("force at the top {:.1f} N ({:+.4f} %)", top, 100 * (top / exact - 1)));
  CHECK(top == Approx(exact).epsilon(2e-4));
}

TEST_CASE("physics: a line that is pulled breaks, and its energy is accounted for", "[physics]") {
  // The pull sends a force of EA v/c = 6 kN along the line; the end that is held doubles it.
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "parts: {line: {cable: {EA: 1 MN, mass_per_length: 1, strength: 10 kN, damping_ratio: 0.1}, "
      "shape: {line: {from: [0, 0, 0], to: [10 m, 0, 0], elements: 100}}}}\n"
      "boundaries:\n"
      "  hold: {nodes: {nearest: [0, 0, 0], of: line}, fix: [x, y, z]}\n"
      "  pull: {nodes: {nearest: [10 m, 0, 0], of: line}, velocity: [6 m/s, 0, 0]}\n"
      "output: {until: 1 s}\n");
  double worst = 0;
  double t_break = 0;
  run_until(*s, 0.018, [&] {
    // The end is jerked into motion; little energy is there before the front has gone some way.
    if (time_of(*s) > 2e-3) worst = std::max(worst, energy_error(*s));
    if (t_break == 0 && measured(s->scene, "cable.line.broken") > 0) t_break = time_of(*s);
  });
  WARN(
      fmt::format("broken at {:.2f} ms, {} in all, energy error at most {:.1e}, at the end {:.1e}; "
                  "eroded {:.2f} J of {:.2f} J",
                  1e3 * t_break, measured(s->scene, "cable.line.broken"), worst, energy_error(*s),
                  ledger_sum(*s, "eroded"), s->models.ledger.external()));
  CHECK(t_break == Approx(10e-3).epsilon(0.06));  // L/c, and the front rises over a few elements
  CHECK(ledger_sum(*s, "eroded") > 0);
  CHECK(ledger_sum(*s, "damping") > 0);
  CHECK(worst < 5e-3);
}
