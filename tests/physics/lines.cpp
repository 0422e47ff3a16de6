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
  // are 16.764, 105.06, 294.16 Hz and 164.50, 1030.9, 2886.6 Hz. The 5 : 2 section is bent about
  // either axis.
  struct Bar {
    const char* material;
    const char* beam;
    double L;
    double exact[3];
  };
  const Bar bars[] = {{"{density: 7800, young: 210 GPa, poisson: 0.3}",
                       "section: {rectangle: {width: 50 mm, height: 20 mm}}",
                       1,
                       {16.758458, 104.82395, 292.61536}},
                      {"{density: 7800, young: 210 GPa, poisson: 0.3}",
                       "section: {rectangle: {width: 20 mm, height: 50 mm}}",
                       1,
                       {41.826213, 259.06761, 712.31861}},
                      {"{density: 2700, young: 70 GPa, poisson: 0.33}",
                       "section: {rectangle: {width: 50 mm, height: 50 mm}}",
                       0.5,
                       {163.18786, 977.32278, 2568.1623}}};
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
      for (Index i = 0; i < s->scene.nodes.rotating.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double bx = b * s->scene.nodes.x[k].x;
        if (bx == 0) continue;  // the clamp
        s->scene.nodes.omega[k].y =
            -1e-3 * b * (std::sinh(bx) + std::sin(bx) - sigma * (std::cosh(bx) - std::cos(bx)));
      }
      const double f = frequency(*s, 5.3 / bar.exact[n], [&](double x) {
        return std::cosh(b * x) - std::cos(b * x) - sigma * (std::sinh(b * x) - std::sin(b * x));
      });
      WARN(fmt::format("L = {} m, mode {}: {:.3f} Hz ({:+.3f} %), energy error {:.1e}", bar.L,
                       n + 1, f, 100 * (f / bar.exact[n] - 1), energy_error(*s)));
      CHECK(f == Approx(bar.exact[n]).epsilon(0.01));
      CHECK(energy_error(*s) < 5e-3);
    }
  }
}

TEST_CASE("physics: a bar held at one end rings in torsion", "[physics]") {
  // f = c_t/(4 L), c_t^2 = G J/(rho (I_y + I_z)): a tube, and a flat bar whose polar inertia is far
  // from its torsion constant.
  struct Bar {
    const char* section;
    double c2;  ///< c_t^2 rho/G
  };
  for (const Bar& bar : {Bar{"{tube: {diameter: 40 mm, wall: 4 mm}}", 1},
                         Bar{"{general: {area: 1000 mm^2, I_y: 33000 mm^4, I_z: 208000 mm^4, J: "
                             "100000 mm^4}}",
                             100.0 / 241}}) {
    const auto s = make_simulation_of_text(fmt::format(
        "gannet: 1\n"
        "materials: {{steel: {{density: 7800, young: 210 GPa, poisson: 0.3}}}}\n"
        "parts: {{bar: {{beam: {{material: steel, section: {}}}, shape: {{line: {{from: [0, 0, 0], "
        "to: [1 m, 0, 0], elements: 20}}}}}}}}\n"
        "boundaries: {{clamp: {{nodes: {{nearest: [0, 0, 0], of: bar}}, fix: [x, y, z, rx, ry, "
        "rz]}}}}\n"
        "output: {{until: 1 s}}\n",
        bar.section));
    Nodes& nodes = s->scene.nodes;
    for (std::size_t i = 0; i < nodes.omega.size(); ++i) {
      nodes.omega[i].x = std::sin(0.5 * std::numbers::pi * nodes.x[i].x);
    }
    const double f = std::sqrt(bar.c2 * 210e9 / 2.6 / 7800) / 4;
    const Index tip = node_near(*s, {1, 0, 0});
    std::vector<double> zeros;
    Curve rate;
    run_until(*s, 5.3 / f, [&] {
      const double now = nodes.omega[static_cast<std::size_t>(tip)].x;
      if (!rate.y.empty() && rate.y.back() * now < 0) {
        zeros.push_back(rate.t.back() +
                        (time_of(*s) - rate.t.back()) * rate.y.back() / (rate.y.back() - now));
      }
      rate.add(time_of(*s), now);
    });
    const double found =
        0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
    WARN(fmt::format("torsion: {:.2f} Hz ({:+.3f} %), energy error {:.1e}", found,
                     100 * (found / f - 1), energy_error(*s)));
    CHECK(found == Approx(f).epsilon(0.005));
    CHECK(energy_error(*s) < 5e-3);
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

namespace {

/// A place at a time.
struct Passing {
  double t, x, z;
};

/// Ten trusses or more between the points; every node but the first, which is held, weighs `mass`.
std::unique_ptr<Simulation> chain_of(const std::vector<Vec3>& points, double mass) {
  std::string text;
  for (const Vec3& p : points) {
    text +=
        fmt::format("{}[{:.15g}, {:.15g}, {:.15g}]", text.empty() ? "" : ", ", p.x(), p.y(), p.z());
  }
  // EA: strains below 1e-4 under some times the weight of all.
  const auto n = static_cast<double>(points.size() - 1);
  auto s = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "parts: {{chain: {{cable: {{EA: {:.9g}, mass_per_length: {:.9g}, tension_only: no}}, shape: "
      "{{polyline: {{points: [{}], elements: 1}}}}}}}}\n"
      "boundaries: {{pin: {{nodes: {{nearest: [0, 0, 0], of: chain}}, fix: [x, y, z]}}}}\n"
      "loads: {{gravity: [0, 0, -9.81 m/s^2]}}\n"
      "output: {{until: 10 s}}\n",
      1e5 * n * mass * 9.81, n * mass, text));
  Nodes& nodes = s->scene.nodes;
  const Index end = node_near(*s, points.back());
  nodes.x[static_cast<std::size_t>(end)].w = mass;
  nodes.v[static_cast<std::size_t>(end)].w = 1 / mass;
  return s;
}

/// The hanging shape of n equal links of total length 1 whose ends are `span` apart at one height.
std::vector<Vec3> hanging_links(int n, double span) {
  const auto direction = [n](int k, double H) {
    const double V = k - 0.5 * (n - 1);
    return Vec3(H, 0, V).normalized();
  };
  double low = 0;
  double high = 1e3;
  for (int round = 0; round < 200; ++round) {
    const double H = 0.5 * (low + high);
    double x = 0;
    for (int k = 0; k < n; ++k) x += direction(k, H).x() / n;
    (x < span ? low : high) = H;
  }
  std::vector<Vec3> points{Vec3::Zero()};
  for (int k = 0; k < n; ++k) points.push_back(points.back() + direction(k, low) / n);
  return points;
}

/// Largest distance of the last point of a chain from where rigid links would have it.
double worst_off(Simulation& s, const Vec3& end, const std::vector<Passing>& exact) {
  const Index tip = node_near(s, end);
  double worst = 0;
  Vec3 before = place(s, tip);
  double t_before = 0;
  std::size_t next = 0;
  run_until(s, exact.back().t, [&] {
    const Vec3 now = place(s, tip);
    for (; next < exact.size() && exact[next].t <= time_of(s); ++next) {
      const double share = (exact[next].t - t_before) / (time_of(s) - t_before);
      const Vec3 at = before + share * (now - before);
      worst = std::max(worst, (at - Vec3(exact[next].x, 0, exact[next].z)).norm());
    }
    before = now;
    t_before = time_of(s);
  });
  CHECK(next == exact.size());
  CHECK(energy_error(s) < 1e-3);
  return worst;
}

}  // namespace

TEST_CASE("physics: chains of rigid links swing and fall as they should", "[physics]") {
  // Rigid links between equal point masses, by a Runge-Kutta method of order 8 to 1e-10, up to the
  // first whip; the folded chain hangs from both ends until one is let go (Tomaszewski, Pieranski
  // and Geminard 2006, doi 10.1119/1.2204074).
  const std::vector<Passing> ten{{0.05, 0.999286, -0.012263}, {0.1, 0.991985, -0.049050},
                                 {0.15, 0.973150, -0.110363}, {0.2, 0.938451, -0.196200},
                                 {0.25, 0.882459, -0.306563}, {0.3, 0.798150, -0.441450},
                                 {0.35, 0.675025, -0.600855}, {0.4, 0.494256, -0.784310},
                                 {0.45, 0.207079, -0.970205}, {0.5, -0.156402, -0.915683}};
  const std::vector<Passing> twenty{{0.05, 0.700729, -0.712992},  {0.1, 0.680567, -0.729617},
                                    {0.15, 0.645132, -0.755495},  {0.2, 0.592862, -0.789062},
                                    {0.25, 0.521997, -0.828559},  {0.3, 0.430402, -0.871852},
                                    {0.35, 0.315257, -0.916120},  {0.4, 0.172368, -0.957149},
                                    {0.45, -0.005307, -0.986778}, {0.5, -0.219463, -0.971257}};
  const std::vector<Passing> folded{
      {0.02, 0.249997, -0.002005}, {0.04, 0.249986, -0.008028}, {0.06, 0.249965, -0.018096},
      {0.08, 0.249932, -0.032250}, {0.1, 0.249881, -0.050550},  {0.12, 0.249806, -0.073075},
      {0.14, 0.249699, -0.099926}, {0.16, 0.249549, -0.131229}, {0.18, 0.249342, -0.167162},
      {0.2, 0.249059, -0.207931},  {0.22, 0.248675, -0.253837}, {0.24, 0.248157, -0.305242},
      {0.26, 0.247452, -0.362686}, {0.28, 0.246486, -0.426898}, {0.3, 0.245136, -0.498978},
      {0.32, 0.243181, -0.580704}, {0.34, 0.240157, -0.675293}, {0.36, 0.234686, -0.790043},
      {0.38, 0.208560, -0.952363}};
  std::vector<Vec3> points;
  for (int k = 0; k <= 10; ++k) points.emplace_back(0.1 * k, 0, 0);
  const double level = worst_off(*chain_of(points, 0.1), points.back(), ten);
  points.clear();
  for (int k = 0; k <= 20; ++k) points.push_back(std::numbers::sqrt2 / 40 * k * Vec3(1, 0, -1));
  const double slanted = worst_off(*chain_of(points, 0.05), points.back(), twenty);
  points = hanging_links(30, 0.25);
  const double fall = worst_off(*chain_of(points, 1.0 / 30), points.back(), folded);
  WARN(
      fmt::format("off by {:.3f} % of the length (level), {:.3f} % (45 degrees), {:.3f} % (folded)",
                  100 * level, 100 * slanted, 100 * fall));
  CHECK(level < 0.01);
  CHECK(slanted < 0.01);
  CHECK(fall < 0.01);
}

TEST_CASE("physics: a beam that is spun up lags and stretches as Simo and Vu-Quoc's", "[physics]") {
  // Simo & Vu-Quoc 1986 (doi 10.1115/1.3171871). Tip along and across the turning root, after a
  // geometrically exact rod, to 1e-3 of the peak.
  const std::vector<Passing> exact{
      {1, -2.43637e-05, -0.0205437}, {2, -0.000605892, -0.10238},    {3, -0.00272828, -0.217267},
      {4, -0.00676593, -0.342277},   {5, -0.0126545, -0.468475},     {6, -0.0169711, -0.543594},
      {7, -0.0186179, -0.571307},    {8, -0.0166297, -0.542838},     {9, -0.0117449, -0.460264},
      {10, -0.00707187, -0.362804},  {11, -0.00329801, -0.257341},   {12, -0.000803788, -0.15089},
      {13, 0.000233472, -0.0692014}, {14, 0.000490085, -0.0202802},  {15, 0.000513988, 0.00131328},
      {16, 0.000513918, 0.00309129}, {17, 0.000514143, -0.00252091}, {18, 0.000513875, -0.00205923},
      {19, 0.000513586, 0.00336992}, {20, 0.000514533, 0.00074197}};
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "let: {T: 15}\n"
      "materials: {rod: {density: 1.2, young: 2.8e7, poisson: 0}}\n"
      "parts: {arm: {beam: {material: rod, section: {general: {area: 1, I_y: 5e-4, I_z: 5e-4, J: "
      "1e-3, shear_area_y: 0.714285714, shear_area_z: 0.714285714}}}, shape: {line: {from: [0, 0, "
      "0], to: [10 m, 0, 0], elements: 20}}}}\n"
      "boundaries: {hub: {nodes: {nearest: [0, 0, 0], of: arm}, fix: [x, y, z, rx, ry], "
      "angular_velocity: [free, free, \"t<T ? 0.4*(t-T/(2*pi)*sin(2*pi*t/T)) : 6\"]}}\n"
      "output: {until: 20 s}\n");
  const Index tip = node_near(*s, {10, 0, 0});
  const auto angle = [](double t) {
    const double k = 2 * std::numbers::pi / 15;
    return t < 15 ? 0.4 * (t * t / 2 + (std::cos(k * t) - 1) / (k * k)) : 6 * t - 45;
  };
  double along = 0;
  double across = 0;
  double last = 0;
  std::size_t next = 0;
  run_until(*s, exact.back().t, [&] {
    if (time_of(*s) < exact[next].t) return;
    const double psi = angle(time_of(*s));
    const Vec3 x = place(*s, tip);
    const double u1 = std::cos(psi) * x.x() + std::sin(psi) * x.y() - 10;
    const double u2 = std::cos(psi) * x.y() - std::sin(psi) * x.x();
    along = std::max(along, std::abs(u1 - exact[next].x));
    across = std::max(across, std::abs(u2 - exact[next].z));
    last = u1;
    ++next;
  });
  // The peaks are 0.0187 and 0.573; 5.146e-4 is the steady stretch.
  WARN(fmt::format(
      "off by {:.2f} % of the peak along, {:.2f} % across; steady stretch {:+.2f} %; "
      "energy error {:.1e}",
      100 * along / 0.0187, 100 * across / 0.573, 100 * (last / 5.146e-4 - 1), energy_error(*s)));
  CHECK(across < 0.005 * 0.573);
  CHECK(along < 0.02 * 0.0187);
}

TEST_CASE("physics: a bar under a sudden pull at its end moves in a triangle", "[physics]") {
  // u goes evenly to 2 F L/(E A) in 2 L/c and back; E A = 21 MN, rho A = 0.78 kg/m, L = 1 m.
  const double peak = 2 * 1e4 / 21e6;
  const double c = std::sqrt(21e6 / 0.78);
  std::vector<double> error;
  for (const int n : {50, 100, 200}) {
    const auto s = make_simulation_of_text(fmt::format(
        "gannet: 1\n"
        "parts: {{bar: {{cable: {{EA: 21 MN, mass_per_length: 0.78, tension_only: no}}, shape: "
        "{{line: {{from: [0, 0, 0], to: [1 m, 0, 0], elements: {}}}}}}}}}\n"
        "boundaries: {{root: {{nodes: {{nearest: [0, 0, 0], of: bar}}, fix: [x, y, z]}}}}\n"
        "loads: {{pull: {{force: {{nodes: {{nearest: [1 m, 0, 0], of: bar}}, value: [10 kN, 0, "
        "0]}}}}}}\n"
        "output: {{until: 1 s}}\n",
        n));
    const Index tip = node_near(*s, {1, 0, 0});
    double worst = 0;
    run_until(*s, 8 / c, [&] {
      const double phase = std::fmod(time_of(*s) * c, 4.0);
      const double u = 0.5 * peak * (phase < 2 ? phase : 4 - phase);
      worst = std::max(worst, std::abs(place(*s, tip).x() - 1 - u));
    });
    error.push_back(worst / peak);
  }
  WARN(fmt::format("off by {:.2f}, {:.2f}, {:.2f} % of the peak with 50, 100, 200 elements",
                   100 * error[0], 100 * error[1], 100 * error[2]));
  CHECK(error[1] < 0.01);
  CHECK(error[2] < 0.8 * error[1]);
}

TEST_CASE("physics: a stressed beam that is turned a thousand times keeps its forces",
          "[physics]") {
  for (const int steps : {100, 1000}) {
    const auto s = make_simulation_of_text(
        "gannet: 1\n"
        "materials: {steel: {density: 7800, young: 210 GPa, poisson: 0.3}}\n"
        "parts: {rod: {beam: {material: steel, section: {rectangle: {width: 50 mm, height: 20 "
        "mm}}}, shape: {polyline: {points: [[0, 0, 0], [0.2 m, 0, 0], [0.4 m, 0.05 m, 0], [0.5 m, "
        "0.2 m, 0.1 m]], elements: 1}}}}\n"
        "output: {until: 1 s}\n");
    BeamBlock& block = s->scene.store.get<BeamBlocks>().list.front();
    Nodes& nodes = s->scene.nodes;
    // Strained by turning two of its nodes.
    const auto spin = [&](std::size_t i, const Vec3& axis, double angle) {
      for (Line& omega : nodes.omega) set_xyz(omega, Vec3::Zero());
      set_xyz(nodes.omega[i], 2 * std::tan(0.5 * angle) * axis);
      beam_pass(block, nodes, 1);
      set_xyz(nodes.omega[i], Vec3::Zero());
    };
    spin(1, Vec3(1, 2, 2) / 3, 0.02);
    spin(3, Vec3(2, -1, 2) / 3, 0.03);
    beam_pass(block, nodes, 0);
    const Array<double> start = block.forces;
    const double angle = 2 * std::numbers::pi / steps;
    const Vec3 axis = Vec3(1, -2, 2) / 3;
    const double dt = 1e-3;
    const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    double gain = 0;
    for (int k = 0; k < 1000 * steps; ++k) {
      for (std::size_t i = 0; i < 4; ++i) {
        set_xyz(nodes.x[i], R * xyz(nodes.x[i]));
        set_xyz(nodes.omega[i], 2 * std::tan(0.5 * angle) / dt * axis);
      }
      gain += beam_pass(block, nodes, dt).internal;
    }
    double worst = 0;
    double largest = 0;
    for (std::size_t k = 0; k < start.size(); ++k) {
      worst = std::max(worst, std::abs(block.forces[k] - start[k]));
      largest = std::max(largest, std::abs(start[k]));
    }
    WARN(fmt::format("{} steps a turn: forces drift by {:.1e} of the largest, energy by {:.1e} J",
                     steps, worst / largest, gain));
    CHECK(worst < 1e-6 * largest);
  }
}
