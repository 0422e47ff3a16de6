// Whole runs of shells: a static state by dynamic relaxation, a cap under a step of pressure,
// plates of accurate elements, pressure that follows.
#include <algorithm>
#include <numbers>

#include "body/element_relaxation.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// A quarter of the Scordelis-Lo roof on n x n elements, settling under its weight.
std::string roof(int n, const char* formulation) {
  return fmt::format(
      "gannet: 1\n"
      "materials: {{concrete: {{density: 360, young: 432 MPa, poisson: 0}}}}\n"
      "parts: {{roof: {{shell: {{material: concrete, thickness: 0.25 m, points: 2, formulation: "
      "{1}}}, shape: {{plane: {{corner: [0, 0, 0], along: [25 m, 0, 0], across: [0, 40, 0], "
      "elements: [{0}, {0}]}}}}, map: [\"x\", \"25*sin(y*pi/180)\", \"25*cos(y*pi/180)\"]}}}}\n"
      "boundaries:\n"
      "  diaphragm: {{nodes: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, of: roof}}, fix: "
      "[y, "
      "z]}}\n"
      "  middle: {{nodes: {{plane: {{point: [25 m, 0, 0], normal: [1, 0, 0]}}, of: roof}}, fix: "
      "[x, "
      "ry, rz]}}\n"
      "  crown: {{nodes: {{plane: {{point: [0, 0, 0], normal: [0, 1, 0]}}, of: roof}}, fix: [y, "
      "rx, "
      "rz]}}\n"
      "loads: {{gravity: [0, 0, -0.01 m/s^2]}}\n"
      "effects: {{element_relaxation: {{until: 100 s, motion: 1e-9}}}}\n"
      "probes: {{edge: {{displacement: {{node: {{nearest: [25 m, 16.0697 m, 19.1511 m], of: "
      "roof}}}}}}}}\n"
      "output: {{until: 100 s}}\n",
      n, formulation);
}

}  // namespace

TEST_CASE("physics: dynamic relaxation finds the static state of a roof", "[physics]") {
  // The same elements by linear statics: 1.0048 and 1.0418 times 0.3024 m (test_convergence "shell
  // course*"); under a hundredth of that load the roof is linear to a few parts in a thousand.
  const bool full = GENERATE(true, false);
  const auto s =
      make_simulation_of_text(roof(8, full ? "fully_integrated" : "belytschko_lin_tsay"));
  const auto& relaxation = s->scene.store.get<ElementRelaxation>();
  int steps = 0;
  while (relaxation.phase.over == 0 && time_of(*s) < 100) {
    advance(s->models);
    ++steps;
  }
  const double w = -measured(s->scene, "probe.edge", 2);
  const double settled = time_of(*s);
  // Undamped from here on it stays where it is.
  double moved = 0;
  run_until(*s, 1.2 * settled, [&] {
    moved = std::max(moved, std::abs(-measured(s->scene, "probe.edge", 2) / w - 1));
  });
  WARN(fmt::format(
      "{}: {:.4f} of the reference after {} steps ({:.2f} s); then it moves by {:.1e} "
      "of it; energy error {:.1e}",
      full ? "full" : "one point", w / 0.003024, steps, settled, moved, energy_error(*s)));
  CHECK(w / 0.003024 == Approx(full ? 1.0048 : 1.0418).epsilon(0.005));
  CHECK(moved < 1e-3);
  CHECK(settled < 90);
  CHECK(energy_error(*s) < 1e-4);
}

TEST_CASE("physics: a spherical cap under a step of pressure, elastic and yielding", "[physics]") {
  const bool yields = GENERATE(false, true);
  const std::string formulation = GENERATE("fully_integrated", "belytschko_lin_tsay");
  const auto s =
      make_simulation("cases/spherical_cap/case.yaml",
                      {std::string("parts.cap.shell.material=") + (yields ? "yielding" : "metal"),
                       "parts.cap.shell.formulation=" + formulation});
  Curve w;
  double worst_energy = 0;
  run_until(*s, 1e-3, [&] {
    w.add(time_of(*s), -measured(s->scene, "probe.apex", 2));
    worst_energy = std::max(worst_energy, energy_error(*s));
  });
  const auto reference = read_table("cases/spherical_cap/reference.csv");
  double peak = 0;
  double early = 0;
  double late = 0;
  for (const auto& row : reference) {
    const double right = row[yields ? 2 : 1];
    peak = std::max(peak, right);
    double& worst = row[0] <= 0.5e-3 ? early : late;
    worst = std::max(worst, std::abs(w.at(row[0]) - right));
  }
  const double reached = *std::max_element(w.y.begin(), w.y.end());
  WARN(fmt::format(
      "{}, {}: peak {:.4f} mm against {:.4f} mm ({:+.2f} %); differs by at most {:.1f} % "
      "of it up to 0.5 ms, {:.1f} % up to 1 ms; energy error {:.1e}",
      yields ? "yielding" : "elastic", formulation, 1e3 * reached, 1e3 * peak,
      100 * (reached / peak - 1), 100 * early / peak, 100 * late / peak, worst_energy));
  CHECK(reached == Approx(peak).epsilon(0.03));
}

TEST_CASE("physics: a clamped plate of fully integrated shells: static, frequency, step",
          "[physics]") {
  const std::vector<std::string> full{"parts.plate.shell.formulation=fully_integrated",
                                      "parts.plate.shape.plate.elements=[16, 16]"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), full.begin(), full.end());
    return make_simulation("cases/plate_step_pressure/case.yaml", more);
  };
  // Kirchhoff (Timoshenko & Woinowsky-Krieger): w = 0.00126532 q a^4/D; shear adds 0.3 %.
  const auto settling = with({"effects.element_relaxation.until=1 s",
                              "effects.element_relaxation.motion=1e-9", "output.until=1 s"});
  const auto& relaxation = settling->scene.store.get<ElementRelaxation>();
  while (relaxation.phase.over == 0) advance(settling->models);
  const double D = 210e9 * 1e-6 / (12 * (1 - 0.09));
  const double w = std::abs(measured(settling->scene, "probe.centre", 2)) / (1000 / D);
  // Set moving in nearly its first mode, without load.
  const auto ringing = with({"loads.step.pressure.value=0 Pa"});
  Nodes& nodes = ringing->scene.nodes;
  for (Line& v : nodes.v) {
    const Line& x = nodes.x[static_cast<std::size_t>(&v - nodes.v.data())];
    const double shape = std::cos(std::numbers::pi * x.x) * std::cos(std::numbers::pi * x.y);
    v.z = 1e-4 * shape * shape;
  }
  std::vector<double> zeros;
  Curve swing;
  run_until(*ringing, 0.060, [&] {
    const double now = measured(ringing->scene, "probe.centre", 2);
    const double t = time_of(*ringing);
    if (!swing.y.empty() && swing.y.back() * now < 0) {
      const double before = swing.y.back();
      zeros.push_back(swing.t.back() + (t - swing.t.back()) * before / (before - now));
    }
    swing.add(t, now);
  });
  REQUIRE(zeros.size() > 5);
  const double f = 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
  const auto stepped = with({});
  double peak = 0;
  run_until(*stepped, 0.0201,
            [&] { peak = std::max(peak, std::abs(measured(stepped->scene, "probe.centre", 2))); });
  WARN(
      fmt::format("16 x 16: static {:.3e} at t = {:.3f} s (theory 1.265e-3, {:+.2f} %), frequency "
                  "{:.3f} Hz ({:+.2f} %), peak {:.4e} m ({:+.2f} %)",
                  w, time_of(*settling), 100 * (w / 0.00126532 - 1), f, 100 * (f / 89.928 - 1),
                  peak, 100 * (peak / 1.3757e-4 - 1)));
  CHECK(w == Approx(0.00126532).epsilon(0.01));
  CHECK(f == Approx(89.928).epsilon(0.01));
  CHECK(peak == Approx(1.3757e-4).epsilon(0.02));
}

TEST_CASE("physics: pressure follows a shell that turns", "[physics]") {
  // A stiff square flies and is pushed along its normal while it turns by a rate w about y: its
  // middle gets v = p A/(m w) (1 - cos wt, sin wt) across and along the first normal, not p A t/m.
  const std::string formulation = GENERATE("belytschko_lin_tsay", "fully_integrated");
  const auto s = make_simulation_of_text(
      fmt::format("gannet: 1\n"
                  "materials: {{steel: {{density: 7800, young: 210 GPa, poisson: 0.3}}}}\n"
                  "parts: {{plate: {{shell: {{material: steel, thickness: 10 mm, formulation: "
                  "{}}}, shape: {{plate: "
                  "{{size: [0.2 m, 0.2 m], elements: [4, 4]}}}}, initial_velocity: [\"100*z\", 0, "
                  "\"-100*x\"]}}}}\n"
                  "loads: {{push: {{pressure: {{on: plate, value: 100 kPa, side: back}}}}}}\n"
                  "output: {{until: 1 s}}\n",
                  formulation));
  Nodes& nodes = s->scene.nodes;
  for (Line& omega : nodes.omega) omega.y = 100;
  run_until(*s, std::numbers::pi / 100, [] {});
  const Total p = linear_momentum(s->scene);
  double m = 0;
  for (const Line& x : nodes.x) m += x.w;
  const double v = 1e5 * 0.04 / (m * 100);  // after half a turn: 2 v across, 0 along
  WARN(fmt::format("{}: ({:.4f}, {:.4f}) of p A/(m w), theory (2, 0)", formulation,
                   p.sum.x() / m / v, p.sum.z() / m / v));
  CHECK(p.sum.x() / m == Approx(2 * v).epsilon(0.01));
  CHECK(std::abs(p.sum.z() / m) < 0.02 * v);
}

namespace {

/// Two rows of shells on a wall; their far edge is driven down in their plane, faster than they
/// give way, with what holds them in it.
std::string crushed_sheet(const std::string& more, bool triangles) {
  return fmt::format(
      "gannet: 1\n"
      "materials: {{foam: {{density: 1000, young: 1 MPa, poisson: 0.3}}}}\n"
      "parts: {{sheet: {{shell: {{material: foam, thickness: 20 mm, collapse_ratio: 0.2, "
      "dt_factor: 0.5, {0}}}, "
      "shape: "
      "{{plane: {{corner: [0, 0, 0], along: [0.1 m, 0, 0], across: [0, 0.2 m, 0], elements: [1, 2]"
      "{1}}}}}}}}}\n"
      "boundaries:\n"
      "  plane: {{nodes: {{part: sheet}}, fix: [x, z, rx, ry, rz]}}\n"
      "  wall: {{nodes: {{plane: {{point: [0, 0, 0], normal: [0, 1, 0]}}, of: sheet}}, fix: [y]}}\n"
      "  press: {{nodes: {{plane: {{point: [0, 0.2 m, 0], normal: [0, 1, 0]}}, of: sheet}}, "
      "velocity: "
      "[free, -30 m/s, free]}}\n"
      "effects: {{guards: off}}\n"
      "output: {{until: 10 ms}}\n",
      more, triangles ? ", triangles: yes" : "");
}

}  // namespace

TEST_CASE("physics: a shell that is crushed stops the run, or leaves, and nothing is NaN",
          "[physics]") {
  const bool triangles = GENERATE(false, true);
  const std::string formulation =
      std::string("formulation: ") +
      (triangles ? "belytschko_lin_tsay" : GENERATE("belytschko_lin_tsay", "fully_integrated"));
  const auto stops = make_simulation_of_text(crushed_sheet(formulation, triangles));
  CHECK_THROWS_WITH(run_until(*stops, 10e-3, [] {}), Catch::Contains("an element has collapsed") &&
                                                         Catch::Contains("sheet: element"));
  const auto erodes =
      make_simulation_of_text(crushed_sheet(formulation + ", collapse: erode", triangles));
  run_until(*erodes, 8e-3, [] {});  // the press has gone through the wall
  CHECK(measured(erodes->scene, "shell.sheet.eroded") > 0);
  for (const Line& x : erodes->scene.nodes.x) CHECK(xyz(x).allFinite());
  for (const Line& w : erodes->scene.nodes.omega) CHECK(xyz(w).allFinite());
}
