// The case panel_slam from its file: energy, leaks and orders of magnitude.
#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double beta = 25 * std::numbers::pi / 180;
constexpr double V = 6;
constexpr double width = 0.4;

/// Height of a point over the keel line along the panel's upward normal, and where it is over the
/// undeformed panel that sinks with its edges.
struct PanelFrame {
  Vec3 keel = Vec3::Zero();  ///< middle of the lower edge, now [m]
  Vec3 along = Vec3(std::cos(beta), 0, std::sin(beta));
  Vec3 normal = Vec3(-std::sin(beta), 0, std::cos(beta));
};

/// The panel as a grid of normal deflections, to say which side of it a particle is on.
class Panel {
 public:
  explicit Panel(const Scene& scene) : nodes_(scene.parts[scene.part_number("panel")].nodes) {
    frame_.keel = Vec3(-0.27, 0, 0.005);
    for (Index k = nodes_.begin; k < nodes_.end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3 d = xyz(scene.nodes.x[i]) - frame_.keel;
      const double s = d.dot(frame_.along) / ds;
      const double y = (d.y() + 0.5 * width) / ds;
      REQUIRE(std::abs(d.dot(frame_.normal)) < 1e-9);
      REQUIRE(std::abs(s - std::round(s)) + std::abs(y - std::round(y)) < 1e-6);
      at_[static_cast<std::size_t>(std::lround(s))][static_cast<std::size_t>(std::lround(y))] = i;
    }
  }

  void move_to(double t) { frame_.keel.z() = 0.005 - V * t; }

  /// True where the point is over the panel at least `rim` from its edges; then `below` is how far
  /// it is below the mid-surface [m].
  bool over(const Scene& scene, const Vec3& x, double rim, double& below) const {
    const Vec3 d = x - frame_.keel;
    const double s = d.dot(frame_.along);
    const double y = d.y() + 0.5 * width;
    if (s < rim || s > n_s * ds - rim || y < rim || y > width - rim) return false;
    const auto i = std::min(static_cast<std::size_t>(s / ds), n_s - 1);
    const auto j = std::min(static_cast<std::size_t>(y / ds), n_y - 1);
    const double a = s / ds - static_cast<double>(i);
    const double b = y / ds - static_cast<double>(j);
    const double w = (1 - a) * ((1 - b) * rise(scene, i, j) + b * rise(scene, i, j + 1)) +
                     a * ((1 - b) * rise(scene, i + 1, j) + b * rise(scene, i + 1, j + 1));
    below = w - d.dot(frame_.normal);
    return true;
  }

  /// Largest deflection of a node from the plane of the edges [m].
  [[nodiscard]] double largest_rise(const Scene& scene) const {
    double most = 0;
    for (std::size_t i = 0; i <= n_s; ++i) {
      for (std::size_t j = 0; j <= n_y; ++j) most = std::max(most, std::abs(rise(scene, i, j)));
    }
    return most;
  }

 private:
  static constexpr std::size_t n_s = 30;
  static constexpr std::size_t n_y = 20;
  static constexpr double ds = 0.02;

  [[nodiscard]] double rise(const Scene& scene, std::size_t i, std::size_t j) const {
    return (xyz(scene.nodes.x[at_[i][j]]) - frame_.keel).dot(frame_.normal);
  }

  Range nodes_;
  PanelFrame frame_;
  std::array<std::array<std::size_t, n_y + 1>, n_s + 1> at_{};
};

/// Who left the basin or went through the panel, so far.
struct Leaks {
  int beyond_walls = 0;        ///< particles beyond a wall by more than dx/2, most at one time
  int through_panel = 0;       ///< particles that went from below to above it, in its inside
  double deepest_in_wall = 0;  ///< [m]
  std::map<std::int64_t, double> below;  ///< last distance below the panel, by particle

  void look(Scene& scene, const Panel& panel) {
    const double dx = scene.store.get<SphState>().dx;
    int beyond = 0;
    for_particles(scene, [&](std::size_t k, const Vec3& x, const Vec3&) {
      double depth = -1e300;
      for (const Plane& p : scene.planes) depth = std::max(depth, -p.normal.dot(x - p.point));
      deepest_in_wall = std::max(deepest_in_wall, depth);
      beyond += depth > 0.5 * dx ? 1 : 0;
      const std::int64_t id = scene.nodes.id[static_cast<std::size_t>(scene.particles.begin) + k];
      double now = 0;
      if (!panel.over(scene, x, 0.25 * dx, now)) {
        below.erase(id);
        return;
      }
      const auto before = below.find(id);
      if (before != below.end() && before->second > 0 && now <= 0) ++through_panel;
      below[id] = now;
    });
    beyond_walls = std::max(beyond_walls, beyond);
  }
};

/// Vertical force on half a wedge of the panel's width at constant speed, t after the keel met the
/// water [N]. Full wedge, per length: Wagner (pi^3/4) rho V^3 t/tan^2 beta, with the pile-up of the
/// water; von Karman pi rho V^3 t/tan^2 beta, without it.
double half_wedge(double coefficient, double t) {
  return 0.5 * coefficient * 1000 * V * V * V * t / std::pow(std::tan(beta), 2) * width;
}

const double wagner = std::pow(std::numbers::pi, 3) / 4;
const double von_karman = std::numbers::pi;

void check_slam(const std::vector<std::string>& overrides) {
  const auto s = make_simulation("cases/panel_slam/case.yaml", overrides);
  Panel panel(s->scene);
  Leaks leaks;
  Curve force;
  double worst_energy = 0;
  double largest_rise = 0;
  int step = 0;
  run_until(*s, 0.025, [&] {
    panel.move_to(time_of(*s));
    worst_energy = std::max(worst_energy, energy_error(*s));
    if (++step % 10 == 0) leaks.look(s->scene, panel);
    if (step % 20 != 0) return;
    force.add(time_of(*s), measured(s->scene, "contact.slam.force", 2));
    largest_rise = std::max(largest_rise, panel.largest_rise(s->scene));
  });
  std::string history;
  for (double from = 0.004; from < 0.0245; from += 0.004) {
    double sum = 0;
    int n = 0;
    for (std::size_t k = 0; k < force.t.size(); ++k) {
      if (force.t[k] < from || force.t[k] > from + 0.004) continue;
      sum += force.y[k];
      ++n;
    }
    const double t = from + 0.002 - 0.005 / V;
    const double mean = sum / n;
    const double wetted = std::numbers::pi / 2 * V * t / std::sin(beta) * width;
    history += fmt::format(
        "\n  {:.0f}-{:.0f} ms: {:.2f} kN; Wagner {:.2f}, von Karman {:.2f} kN; over Wagner's "
        "wetted "
        "face {:.1f} kPa",
        1e3 * from, 1e3 * from + 4, 1e-3 * mean, 1e-3 * half_wedge(wagner, t),
        1e-3 * half_wedge(von_karman, t), 1e-3 * mean / std::cos(beta) / wetted);
    if (from < 0.007) continue;  // before: fewer than six spacings are wet
    CHECK(mean > half_wedge(von_karman, t) / 3);
    CHECK(mean < 3 * half_wedge(wagner, t));
  }
  const SphState& sph = s->scene.store.get<SphState>();
  WARN(
      fmt::format("dx {:.0f} mm, {} particles, {} steps: energy error at the end {:.2e}, worst "
                  "{:.2e}; beyond walls by dx/2: {} (deepest {:.2f} dx), through the panel: {}; "
                  "largest deflection {:.2f} mm, plastic work {:.3g} J; vertical force:{}",
                  1e3 * sph.dx, s->scene.particles.size(), step, energy_error(*s), worst_energy,
                  leaks.beyond_walls, leaks.deepest_in_wall / sph.dx, leaks.through_panel,
                  1e3 * largest_rise, ledger_sum(*s, "plastic"), history));
  CHECK(worst_energy < 0.02);
  CHECK(leaks.beyond_walls == 0);
  CHECK(leaks.through_panel == 0);
  CHECK(largest_rise > 0.3e-3);  // a tenth of the thickness: it does bend
  CHECK(largest_rise < 40e-3);   // a tenth of the width: it is not torn open
}

}  // namespace

TEST_CASE("physics: panel_slam, coarse: energy, leaks, size of the force", "[physics]") {
  check_slam({"let.dx=40mm"});
}

TEST_CASE("physics: panel_slam: energy, leaks, size of the force", "[.][physics_long]") {
  check_slam({});
}
