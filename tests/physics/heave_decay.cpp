// A cylinder that floats, let go off its balance: against linear potential theory in the same tank.
#include "linear_tank.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// The case in a tank of 4 R and the given width over R, 10 spacings a radius.
std::unique_ptr<Simulation> heave(double width) {
  return make_simulation("cases/heave_decay/case.yaml",
                         {fmt::format("let.W={} m", width), "output.checkpoint=never"});
}

}  // namespace

TEST_CASE("heave decay: linear theory in a wide and deep tank is that in the open sea",
          "[physics]") {
  const Curve tank = linear_heave(20, 120, 8);
  double most = 0;
  for (const auto& row : read_table("cases/heave_decay/reference.csv")) {
    if (row[0] <= 8) most = std::max(most, std::abs(tank.at(row[0]) - row[1]));
  }
  fmt::print("linear heave, depth 20 R, width 120 R: within {:.4f} of the open sea\n", most);
  CHECK(most < 0.015);
}

TEST_CASE("heave decay: in a tank the cylinder goes as linear theory says", "[physics]") {
  const double width = 16;
  const double until = 7.6;
  const Curve theory = linear_heave(4, width, until);
  const auto s = heave(width);
  const double hold = 0.5;
  Curve run;
  run_until(*s, hold + until / std::sqrt(9.81), [&] {
    const double tau = (time_of(*s) - hold) * std::sqrt(9.81);
    if (tau > 0) run.add(tau, measured(s->scene, "body.cylinder.position", 1) / 0.25);
  });
  const auto extremes = extremes_of(run);
  const auto wanted = extremes_of(theory);
  REQUIRE(extremes.size() >= 2);
  for (std::size_t k = 0; k < 2; ++k) {
    fmt::print(
        "heave in a tank of 4 R x {} R: extreme {:.3f} at tau {:.2f}, linear theory {:.3f} at "
        "{:.2f}\n",
        width, extremes[k].second, extremes[k].first, wanted[k].second, wanted[k].first);
    CHECK(extremes[k].second == Approx(wanted[k].second).epsilon(0.05));
    CHECK(extremes[k].first == Approx(wanted[k].first).epsilon(0.02));
  }
  CHECK(energy_error(*s) < 1e-3);
}

TEST_CASE("heave decay: the table of linear theory in the tank of the case", "[.table]") {
  const Curve tank = linear_heave(4, 24, 12);
  for (int k = 0; k <= 120; ++k) fmt::print("{:.1f},{:.4f}\n", 0.1 * k, tank.at(0.1 * k));
}

TEST_CASE("heave decay: extremes of linear theory in tanks of several sizes", "[.tanks]") {
  for (const auto& [depth, width] : std::vector<std::pair<double, double>>{
           {4, 16}, {4, 24}, {4, 60}, {6, 60}, {8, 60}, {14, 44}, {20, 80}, {20, 120}}) {
    fmt::print("depth {:g} R, width {:g} R:", depth, width);
    for (const auto& [tau, x] : extremes_of(linear_heave(depth, width, 11.5))) {
      fmt::print("  {:.3f} at {:.2f}", x, tau);
    }
    fmt::print("\n");
  }
}
