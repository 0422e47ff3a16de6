// The case plate_step_pressure from its file, against Kirchhoff's plate.
#include <algorithm>
#include <numbers>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("physics: plate_step_pressure, deflection under a step of pressure", "[physics]") {
  const auto s = make_simulation("cases/plate_step_pressure/case.yaml", {});
  Curve w;
  double worst_energy = 0;
  run_until(*s, 0.0201, [&] {
    w.add(time_of(*s), std::abs(measured(s->scene, "probe.centre", 2)));
    worst_energy = std::max(worst_energy, energy_error(*s));
  });
  const auto theory = read_table("cases/plate_step_pressure/reference.csv");
  double peak = 0;
  double worst = 0;
  for (const auto& row : theory) {
    peak = std::max(peak, row[1]);
    // the samples below zero lie within the swing back, where |w| is not w
    if (row[1] > 0) worst = std::max(worst, std::abs(w.at(row[0]) - row[1]));
  }
  const double reached = *std::max_element(w.y.begin(), w.y.end());
  WARN(
      fmt::format("peak {:.4e} m, theory {:.4e} m ({:+.2f} %); largest difference over 20 ms "
                  "{:.2f} % of it; energy error {:.1e}",
                  reached, peak, 100 * (reached / peak - 1), 100 * worst / peak, worst_energy));
  CHECK(reached == Approx(peak).epsilon(0.02));
}

TEST_CASE("physics: a clamped plate swings at its first frequency", "[physics]") {
  // The case, without its load, set moving in nearly its first mode.
  const auto s =
      make_simulation("cases/plate_step_pressure/case.yaml", {"loads.step.pressure.value=0 Pa"});
  Nodes& nodes = s->scene.nodes;
  for (Index k = 0; k < nodes.n_owned; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double shape =
        std::cos(std::numbers::pi * nodes.x[i].x) * std::cos(std::numbers::pi * nodes.x[i].y);
    nodes.v[i].z = 1e-4 * shape * shape;
  }
  Curve w;
  std::vector<double> zeros;
  run_until(*s, 0.060, [&] {
    const double now = measured(s->scene, "probe.centre", 2);
    const double t = time_of(*s);
    if (!w.y.empty() && w.y.back() * now < 0) {
      const double before = w.y.back();
      zeros.push_back(w.t.back() + (t - w.t.back()) * before / (before - now));
    }
    w.add(t, now);
  });
  REQUIRE(zeros.size() > 5);
  const double f = 0.5 * static_cast<double>(zeros.size() - 1) / (zeros.back() - zeros.front());
  WARN(fmt::format("first frequency {:.3f} Hz, theory 89.928 Hz ({:+.2f} %)", f,
                   100 * (f / 89.928 - 1)));
  // Leissa 1973: a^2 omega sqrt(rho h/D) = 35.985
  CHECK(f == Approx(89.928).epsilon(0.02));
}
