// The case dam_break_2d against the experiment of Martin and Moyce 1952.
#include <algorithm>

#include "running.hpp"
#include "support/gravity.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double a = 0.05715;
using test::g;

struct Fit {
  double shift = 0;     ///< of the experiment's time zero, in T
  double rms = 0;       ///< of Z
  double rms_near = 0;  ///< of Z where Z <= 4.2, with the same shift
  double worst = 0;     ///< largest |Z - Z_experiment| / Z_experiment
};

Fit errors_at(const Curve& front, const std::vector<std::vector<double>>& experiment,
              double shift) {
  Fit fit{.shift = shift};
  int n_near = 0;
  for (const auto& row : experiment) {
    const double error = front.at(row[0] - shift) - row[1];
    fit.rms += error * error;
    fit.worst = std::max(fit.worst, std::abs(error) / row[1]);
    if (row[1] > 4.2) continue;
    fit.rms_near += error * error;
    ++n_near;
  }
  fit.rms = std::sqrt(fit.rms / static_cast<double>(experiment.size()));
  fit.rms_near = std::sqrt(fit.rms_near / n_near);
  return fit;
}

/// The one shift in time, the same for all points, that makes this measure of the fit smallest.
Fit best_fit(const Curve& front, const std::vector<std::vector<double>>& experiment,
             double Fit::*measure = &Fit::worst) {
  Fit best{.rms_near = 1e300, .worst = 1e300};
  for (int k = -200; k <= 200; ++k) {
    const Fit fit = errors_at(front, experiment, 0.005 * k);
    if (fit.*measure < best.*measure) best = fit;
  }
  return best;
}

/// `near` is the largest rms of Z up to 4.2 that is accepted.
void check_front(const std::string& spacing, const std::string& walls, double near) {
  const auto s = make_simulation("cases/dam_break_2d/case.yaml",
                                 {"let.dx=" + spacing, "boundaries.tank.walls=" + walls});
  const double dx = s->scene.store.get<SphState>().dx;
  const double unit = std::sqrt(2 * g / a);
  Curve front;  // of the foremost particle, with the half spacing that it stands for
  Curve crowd;  // of the sixth: a few drops ahead of the rest do not count
  std::vector<double> x;
  int step = 0;
  run_until(*s, 0.5, [&] {
    if (++step % 10 != 0) return;
    x.clear();
    for_particles(s->scene, [&](std::size_t k, const Vec3& at, const Vec3&) {
      if (is_fluid(s->scene, static_cast<Index>(k))) x.push_back(-at.x());
    });
    std::nth_element(x.begin(), x.begin() + 5, x.end());
    const double T = time_of(*s) * unit;
    front.add(T, (measured(s->scene, "probe.front") + 0.5 * dx) / a);
    crowd.add(T, (-x[5] + 0.5 * dx) / a);
  });
  const auto experiment = read_table("cases/dam_break_2d/reference.csv");
  REQUIRE(experiment.size() == 15);
  const Fit fit = best_fit(front, experiment);
  const Fit fit_near = best_fit(front, experiment, &Fit::rms_near);
  const Fit of_crowd = best_fit(crowd, experiment);
  WARN(fmt::format(
      "{} walls, dx {}: {} particles, shift {:.3f} in T: rms of Z {:.4f} (of the points up to "
      "Z = 4.2: {:.4f}), worst {:.1f} %; by the sixth particle: shift {:.3f}, rms "
      "{:.4f}, worst {:.1f} %; fitted up to Z = 4.2: shift {:.3f}, rms {:.4f}; energy error {:.2e}",
      walls, spacing, s->scene.particles.size(), fit.shift, fit.rms, fit.rms_near, 100 * fit.worst,
      of_crowd.shift, of_crowd.rms, 100 * of_crowd.worst, fit_near.shift, fit_near.rms_near,
      energy_error(*s)));
  CHECK(front.t.back() > experiment.back()[0] - fit.shift);  // all points are compared
  CHECK(fit.worst < 0.1);
  CHECK(fit_near.rms_near < near);
  CHECK(energy_error(*s) < 0.02);
}

}  // namespace

TEST_CASE("physics: dam_break_2d, front after Martin and Moyce, 20 particles a width",
          "[physics]") {
  check_front("a/20", "mirror", 0.02);
}

TEST_CASE("physics: dam_break_2d between dummy particles, 20 particles a width", "[physics]") {
  check_front("a/20", "dummy", 0.03);
}

TEST_CASE("physics: dam_break_2d, front after Martin and Moyce, 40 particles a width",
          "[.][physics_long]") {
  check_front("a/40", "mirror", 0.03);
}
