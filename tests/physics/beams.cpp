// Whole runs of beams that yield, and of beams with hinges, against theory.
#include <numbers>

#include "fe/beam_inertia.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Force at which a clamped beam of 2 m collapses under its middle, over 8 M_p/L. n: elements.
double collapse_force(int n) {
  // 50 mm x 50 mm, 250 MPa: M_p = 7812.5 N m. One end slides, so that nothing stretches.
  const auto s = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{steel: {{density: 7800, young: 200 GPa, poisson: 0.3, yield_stress: 250 "
      "MPa}}}}\n"
      "parts: {{bar: {{beam: {{material: steel, section: {{rectangle: {{width: 50 mm, height: 50 "
      "mm}}}}}}, damping: 200 1/s, shape: {{line: {{from: [0, 0, 0], to: [2 m, 0, 0], elements: "
      "{}}}}}}}}}\n"
      "boundaries:\n"
      "  left: {{nodes: {{nearest: [0, 0, 0], of: bar}}, fix: [x, y, z, rx, ry, rz]}}\n"
      "  right: {{nodes: {{nearest: [2 m, 0, 0], of: bar}}, fix: [y, z, rx, ry, rz]}}\n"
      "  middle: {{nodes: {{nearest: [1 m, 0, 0], of: bar}}, velocity: [free, free, \"t < 0.06 ? "
      "-0.6*(1-cos(2*pi*t/0.06)) : 0\"]}}\n"
      "probes: {{push: {{boundary_force: middle}}}}\n"
      "output: {{until: 1 s}}\n",
      n));
  double sum = 0;
  int count = 0;
  run_until(*s, 0.11, [&] {
    if (time_of(*s) < 0.09) return;
    sum += std::abs(measured(s->scene, "probe.push", 2));
    ++count;
  });
  CHECK(energy_error(*s) < 1e-3);
  CHECK(ledger_sum(*s, "plastic") > 0);
  return sum / count / (8 * 7812.5 / 2);
}

/// First frequency of a steel bar of 1 m whose ends are clamped, with what `more` says of it [Hz].
double first_frequency(const std::string& more) {
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "materials: {steel: {density: 7800, young: 210 GPa, poisson: 0.3}}\n"
      "parts: {bar: {beam: {material: steel, section: {rectangle: {width: 20 mm, height: 20 mm}}" +
      more +
      "}, shape: {line: {from: [0, 0, 0], to: [1 m, 0, 0], elements: 40}}, initial_velocity: [0, "
      "0, \"1e-3*sin(pi*x)\"]}}\n"
      "boundaries:\n"
      "  left: {nodes: {nearest: [0, 0, 0], of: bar}, fix: [x, y, z, rx, ry, rz]}\n"
      "  right: {nodes: {nearest: [1 m, 0, 0], of: bar}, fix: [y, z, rx, ry, rz]}\n"
      "output: {until: 1 s}\n");
  std::vector<double> zeros;
  Curve q;
  run_until(*s, 0.08, [&] {
    double now = 0;
    for (const Line& x : s->scene.nodes.x) now += std::sin(std::numbers::pi * x.x) * x.z;
    if (!q.y.empty() && q.y.back() * now < 0) {
      zeros.push_back(q.t.back() + (time_of(*s) - q.t.back()) * q.y.back() / (q.y.back() - now));
    }
    q.add(time_of(*s), now);
  });
  CHECK(energy_error(*s) < 1e-3);
  return 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
}

}  // namespace

TEST_CASE("beams: a clamped beam collapses at 8 M_p/L", "[physics]") {
  // A hinge has the length of an element, and its middle is half of that off the clamp and the
  // load: 1/(1 - 2/n) with n elements.
  const double coarse = collapse_force(55);
  const double fine = collapse_force(110);
  WARN(fmt::format("over 8 M_p/L: {:.4f} with 55 elements, {:.4f} with 110, {:.4f} beyond", coarse,
                   fine, 2 * fine - coarse));
  CHECK(fine == Approx(1).epsilon(0.02));
  CHECK(2 * fine - coarse == Approx(1).epsilon(0.005));
}

TEST_CASE("beams: clamped ends that are released are supported ones", "[physics]") {
  // Euler and Bernoulli: (lambda/L)^2 sqrt(E I/(rho A))/(2 pi), lambda = pi with supported ends,
  // 4.7300 with clamped ones, 3.9266 with one of each; slenderness 50 takes less than 0.3 %.
  const double unit = std::sqrt(210e9 * 4e-4 / 12 / 7800) / (2 * std::numbers::pi);
  const std::string left =
      ", releases: {left: {nodes: {nearest: [0, 0, 0], of: bar}, axes: [y, z]}";
  const double clamped = first_frequency("");
  const double one = first_frequency(left + "}");
  const double both =
      first_frequency(left + ", right: {nodes: {nearest: [1 m, 0, 0], of: bar}, axes: y}}");
  WARN(fmt::format("{:.3f}, {:.3f}, {:.3f} Hz, off by {:+.2f}, {:+.2f}, {:+.2f} %", clamped, one,
                   both, 100 * (clamped / (22.3733 * unit) - 1), 100 * (one / (15.4182 * unit) - 1),
                   100 * (both / (9.8696 * unit) - 1)));
  CHECK(clamped == Approx(22.3733 * unit).epsilon(0.005));
  CHECK(one == Approx(15.4182 * unit).epsilon(0.005));
  CHECK(both == Approx(9.8696 * unit).epsilon(0.005));
}

TEST_CASE("beams: a chain of two bars with a hinge keeps its momenta and energy", "[physics]") {
  // In free flight; the hinge lets the bars fold about y, and the axes go round with them.
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "materials: {soft: {density: 1000, young: 100 MPa, poisson: 0.3}}\n"
      "parts: {bars: {beam: {material: soft, section: {rectangle: {width: 20 mm, height: 30 mm}}, "
      "releases: {hinge: {nodes: {nearest: [0.5 m, 0, 0], of: bars}, axes: [y]}}}, shape: {line: "
      "{from: [0, 0, 0], to: [1 m, 0, 0], elements: 20}}, initial_velocity: [\"x\", "
      "\"3*sin(2*x)\", \"20*abs(x-0.5)\"]}}\n"
      "output: {until: 1 s}\n");
  const auto momentum = [&] {
    Total L = angular_momentum(s->scene);
    const Nodes& n = s->scene.nodes;
    const BeamBlock& block = s->scene.store.get<BeamBlocks>().list.front();
    const BeamInertia& inertia = s->scene.store.get<BeamInertias>().list.front();
    // The triads are those of the start of the step: the momentum before it is that after it.
    for (Index k = 0; k < block.nodes.size(); ++k) {
      L.sum += spin_of(inertia, block, n, k, -s->models.list.front().step.dt_old);
    }
    return L;
  };
  // x at n, v at n-1/2: m x(n) x v(n-1/2) is kept, for x(n) = x(n-1/2) + v dt/2.
  const Total p = linear_momentum(s->scene);
  advance(s->models);
  const Total L = momentum();
  double worst = 0;
  run_until(*s, 0.05, [&] { worst = std::max(worst, (momentum().sum - L.sum).norm() / L.scale); });
  CHECK((linear_momentum(s->scene).sum - p.sum).norm() < 1e-12 * p.scale);
  WARN(fmt::format("angular momentum off by {:.1e}, energy error {:.1e}", worst, energy_error(*s)));
  CHECK(worst < 1e-9);
  CHECK(energy_error(*s) < 2e-3);
}

TEST_CASE("beams: a bar that is torn breaks, and its energy is accounted for", "[physics]") {
  // Pulled apart at 20 m/s over 0.5 m from rest: it breaks near its ends, at a plastic strain of
  // 0.05.
  const auto s = make_simulation_of_text(
      "gannet: 1\n"
      "materials: {steel: {density: 7800, young: 200 GPa, poisson: 0.3, yield_stress: 250 MPa, "
      "hardening_modulus: 1 GPa, cowper_symonds: {D: 40 1/s, p: 5}, failure: {plastic_strain: "
      "0.05}}}\n"
      "parts: {bar: {beam: {material: steel, section: {solid_round: {diameter: 20 mm}}}, shape: "
      "{line: {from: [0, 0, 0], to: [0.5 m, 0, 0], elements: 20}}}}\n"
      "boundaries:\n"
      "  left: {nodes: {nearest: [0, 0, 0], of: bar}, velocity: [-10 m/s, free, free]}\n"
      "  right: {nodes: {nearest: [0.5 m, 0, 0], of: bar}, velocity: [10 m/s, free, free]}\n"
      "output: {until: 1 s}\n");
  double most = 0;
  const BeamBlock& block = s->scene.store.get<BeamBlocks>().list.front();
  run_until(*s, 3e-3, [&] { most = std::max(most, block.forces[0]); });
  const double A = block.law.section.A;
  const double broken = measured(s->scene, "beam.bar.eroded");
  fmt::print(
      "torn bar: {} of 20 broken, largest stress {:.1f} MPa, plastic {:.1f} J, eroded {:.2f} J; "
      "energy {:.1e}\n",
      broken, 1e-6 * most / A, ledger_sum(*s, "plastic"), ledger_sum(*s, "eroded"),
      energy_error(*s));
  CHECK(broken >= 1);
  CHECK(broken < 20);
  CHECK(most / A > 250e6);
  CHECK(ledger_sum(*s, "eroded") > 0);
  CHECK(energy_error(*s) < 0.01);
}
