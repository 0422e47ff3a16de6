// Clamped square plates against Kirchhoff's theory.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/math.hpp"
#include "fe/shell.hpp"
#include "scene/draft.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

/// A clamped square plate of side 1 m, 10 mm thick, E = 210 GPa, rho = 7800 kg/m^3, nu = 0.3.
struct Plate {
  Scene scene;
  Models models;
  ShellBlock block;
  Index centre = 0;
  double centre_weight = 0;

  explicit Plate(int n) {
    PartDraft p;
    p.name = "plate";
    p.rotations = true;
    p.cell = Cell::quad;
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) p.points.emplace_back(1.0 * i / n, 1.0 * j / n, 0.0);
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Index a = j * (n + 1) + i;
        for (const Index node : {a, a + 1, a + n + 2, a + n + 1}) p.connectivity.push_back(node);
      }
    }
    Draft draft;
    draft.parts.push_back(p);
    assemble(draft, scene);
    const ElasticPlastic steel{.rho = 7800, .E = 210e9, .nu = 0.3};
    block = make_shell_block(scene.parts[0].connectivity, scene.nodes.x, steel,
                             {.thickness = 0.01, .points = 3});
    add_shell_masses(block, scene.nodes);
    finish_masses(scene);
    Model& model = models.list.emplace_back();
    model.ranges = {{0, scene.nodes.n_owned}};
    add_leapfrog(scene, model, models.ledger);
    model.plan.add({.name = "shell",
                    .stage = Stage::force,
                    .run = [this](const Step& s) { shell_pass(block, scene.nodes, s.dt_old); },
                    .stable_dt = [this] { return stable_step(block); }});
    for (Index k = 0; k < scene.nodes.n_owned; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3 x = xyz(scene.nodes.x[i]);
      if (std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()}) < 1e-9) {
        scene.nodes.v[i].w = 0;  // clamped: neither moves nor turns
        scene.nodes.omega[i].w = 0;
      }
      if ((x - Vec3(0.5, 0.5, 0)).norm() < 1e-9) centre = k;
    }
  }

  void run(double until, std::vector<double>& t, std::vector<double>& w) {
    Model* const level[] = {&models.list.front()};
    while (models.list.front().step.t < until) {
      t.push_back(models.list.front().step.t);
      w.push_back(scene.nodes.x[static_cast<std::size_t>(centre)].z);
      step(level);
    }
  }
};

/// First frequency [Hz] from the zero crossings of the centre, started in nearly the first mode.
double first_frequency(int n) {
  Plate plate(n);
  for (std::size_t i = 0; i < plate.scene.nodes.v.size(); ++i) {
    const Line& x = plate.scene.nodes.x[i];
    const double s = std::sin(std::numbers::pi * x.x) * std::sin(std::numbers::pi * x.y);
    if (plate.scene.nodes.v[i].w > 0) plate.scene.nodes.v[i].z = 1e-4 * s * s;
  }
  std::vector<double> t;
  std::vector<double> w;
  plate.run(0.060, t, w);
  std::vector<double> zeros;
  for (std::size_t k = 2; k < t.size(); ++k) {
    if (w[k - 1] * w[k] >= 0) continue;
    zeros.push_back(t[k - 1] + (t[k] - t[k - 1]) * w[k - 1] / (w[k - 1] - w[k]));
  }
  REQUIRE(zeros.size() > 5);
  return 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
}

}  // namespace

TEST_CASE("plate: first frequency of a clamped square plate", "[cases]") {
  // Leissa 1973, J. Sound Vib. 31: a^2 omega sqrt(rho h/D) = 35.985; here 89.928 Hz.
  const double exact = 89.928008;
  const double f_16 = first_frequency(16);
  const double f_32 = first_frequency(32);
  CAPTURE(f_16, f_32);
  CHECK(f_16 == Approx(exact).epsilon(0.02));
  CHECK(f_32 == Approx(exact).epsilon(0.005));
}

TEST_CASE("plate: deflection of a clamped plate under a step of pressure", "[cases]") {
  // Centre deflection [m] at t [s] for 1000 Pa: modal sum of Kirchhoff's plate, undamped. Small
  // deflections: w/h stays below 0.014.
  const std::vector<std::pair<double, double>> theory{
      {0.00033333333, 6.9605719e-07}, {0.00066666667, 2.8771128e-06}, {0.001, 5.7712044e-06},
      {0.0013333333, 1.1369157e-05},  {0.0016666667, 2.1264049e-05},  {0.002, 3.4693723e-05},
      {0.0023333333, 4.8898448e-05},  {0.0026666667, 6.392768e-05},   {0.003, 7.8591753e-05},
      {0.0033333333, 9.0430303e-05},  {0.0036666667, 9.9419799e-05},  {0.004, 0.00010769382},
      {0.0043333333, 0.00011589421},  {0.0046666667, 0.00012301157},  {0.005, 0.00012911346},
      {0.0053333333, 0.00013401643},  {0.0056666667, 0.00013757314},  {0.006, 0.00013697817},
      {0.0063333333, 0.00013163015},  {0.0066666667, 0.00012263437},  {0.007, 0.00011215509},
      {0.0073333333, 9.9540934e-05},  {0.0076666667, 8.7251142e-05},  {0.008, 7.6615325e-05},
      {0.0083333333, 6.6807297e-05},  {0.0086666667, 5.5612642e-05},  {0.009, 4.382861e-05},
      {0.0093333333, 3.2147419e-05},  {0.0096666667, 2.0457517e-05},  {0.01, 9.1674034e-06}};
  Plate plate(24);
  Nodes& nodes = plate.scene.nodes;
  plate.models.list.front().plan.add(
      {.name = "pressure", .stage = Stage::force, .run = [&nodes](const Step&) {
         // m = rho h A, so p A = m p/(rho h)
         for (std::size_t i = 0; i < nodes.f.size(); ++i) {
           nodes.f[i].z += nodes.x[i].w * 1000 / (7800 * 0.01);
         }
       }});
  std::vector<double> t;
  std::vector<double> w;
  plate.run(0.0103, t, w);
  double peak = 0;
  double worst = 0;
  for (const auto& [time, deflection] : theory) {
    std::size_t k = 1;
    while (t[k] < time) ++k;
    const double here = w[k - 1] + (w[k] - w[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
    worst = std::max(worst, std::abs(here - deflection));
    peak = std::max(peak, deflection);
  }
  const double reached = *std::max_element(w.begin(), w.end());
  CAPTURE(reached, worst / peak);
  // The theory's own peak between its samples, by a parabola: 1.3784e-4 m.
  CHECK(reached == Approx(1.3784e-4).epsilon(0.02));
  CHECK(worst < 0.02 * peak);
}
