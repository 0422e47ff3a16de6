// Start-up of Couette and Poiseuille flow between walls that water sticks to, dummy particles or
// mirrors, against the series of the exact solution (Morris, Fox and Zhu 1997, J. Comput. Phys.
// 136, 214).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/simulation.hpp"
#include "sph/sph_state.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

using std::numbers::pi;
constexpr double H = 1;     // between the walls [m]
constexpr double nu = 0.5;  // [m^2/s]
constexpr double U = 1;     // of the lid; in the middle of the channel in the end [m/s]
constexpr double G = 8 * nu * U / (H * H);  // what drives the channel [m/s^2]

/// u(y, t) = U y/H + sum (2 U/(n pi)) (-1)^n sin(n pi y/H) exp(-n^2 pi^2 nu t/H^2)
double couette(double y, double t) {
  double u = U * y / H;
  for (int n = 1; n < 60; ++n) {
    u += 2 * U / (n * pi) * (n % 2 == 0 ? 1 : -1) * std::sin(n * pi * y / H) *
         std::exp(-n * n * pi * pi * nu * t / (H * H));
  }
  return u;
}

/// u(y, t) = G y (H - y)/(2 nu) - sum over odd n of (4 G H^2/(nu pi^3 n^3)) sin(n pi y/H)
///           exp(-n^2 pi^2 nu t/H^2)
double poiseuille(double y, double t) {
  double u = G / (2 * nu) * y * (H - y);
  for (int n = 1; n < 60; n += 2) {
    u -= 4 * G * H * H / (nu * pi * pi * pi * n * n * n) * std::sin(n * pi * y / H) *
         std::exp(-n * n * pi * pi * nu * t / (H * H));
  }
  return u;
}

enum class Walls { dummy, mirror };

/// n particles across the channel, half as many along it; h/dx 1.3, where the viscous sum over a
/// lattice has no bias. At the usual 1.25 both flows end 0.1 % of U off with 48 across, and the
/// drag of Couette's is 0.2 % high.
std::string channel(int n, double u_lid, double g_x, Walls walls) {
  const std::string lid = fmt::format(R"(
  lid:
    wall: {{slip: none, velocity: [{} m/s, 0, 0]}}
    fill: {{box: {{from: [0, 1 m, 0], to: [0.5 m, {} m, 0]}}}})",
                                      u_lid, 1 + 3.0 / n);
  const std::string mirror = fmt::format(R"(
  lid: {{plane: {{point: [0, 1 m, 0], normal: [0, -1, 0]}}, slip: none,
         motion: {{velocity: [{} m/s, 0, 0]}}}})",
                                         u_lid);
  const bool mirrored = walls == Walls::mirror;
  return fmt::format(R"(gannet: 1
title: Flow between two plates
dimension: 2
materials: {{oil: {{density: 1000, c0: 12 m/s}}}}
parts:
  oil:
    sph: {{material: oil, spacing: {} m, smoothing_ratio: 1.3}}
    fill: {{box: {{from: [0, 0, 0], to: [0.5 m, 1 m, 0]}}}}{}
boundaries:
  ends: {{periodic: {{x: [0, 0.5 m]}}}}
  bed: {{plane: {{point: [0, 0, 0], normal: [0, 1, 0]}}, walls: {}, slip: none}}{}
loads: {{gravity: [{} m/s^2, 0, 0]}}
effects: {{laminar_viscosity: {{mu: {} Pa*s}}}}
output: {{until: 10 s}}
)",
                     1.0 / n, mirrored ? "" : lid, mirrored ? "mirror" : "dummy",
                     mirrored ? mirror : "", g_x, 1000 * nu);
}

/// Root of the mean square of u_x - u(y, t) over the particles, over U.
double error_of(const Simulation& s, double (*exact)(double, double)) {
  const Scene& scene = s.scene;
  const Step& step = s.models.list.front().step;
  const double t = step.t - 0.5 * step.dt_old;  // v stands half a step back
  double sum = 0;
  int n = 0;
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (!is_fluid(scene, k)) continue;
    const auto i = static_cast<std::size_t>(scene.particles.begin + k);
    const double y = scene.nodes.x[i].y;
    const double e = scene.nodes.v[i].x - exact(y, t);
    sum += e * e;
    ++n;
  }
  return std::sqrt(sum / n) / U;
}

/// Errors at nu t/H^2 = 0.05, 0.1 and 0.3, and the force on the lid over mu U/H at the last.
struct Result {
  std::vector<double> errors;
  double drag = 0;
};

Result run(int n, double u_lid, double g_x, double (*exact)(double, double), Walls walls) {
  const auto s = make_simulation_of_text(channel(n, u_lid, g_x, walls));
  Result result;
  for (const double T : {0.05, 0.1, 0.3}) {
    while (s->models.list.front().step.t < T * H * H / nu) advance(s->models);
    result.errors.push_back(error_of(*s, exact));
  }
  for (const Measure& m : s->scene.measures) {
    if (m.name != "wall.lid.viscous_force" && m.name != "plane.lid.viscous_force") continue;
    double f[3];
    m.sample(f);
    result.drag = f[0] / (1000 * nu * U / H * 0.5);
  }
  return result;
}

void check_drag(const std::string& name, const std::vector<double>& drags, double exact) {
  WARN(fmt::format("{}: drag on the lid {:.4f}, exact {:.4f} of mu U/H", name,
                   fmt::join(drags, ", "), exact));
  for (std::size_t k = 1; k < drags.size(); ++k) CHECK(drags[k] == Approx(exact).epsilon(0.01));
}

/// Runs 12, 24 and 48 particles across; least: the order from 12 to 24 at each of the three times.
/// They were set below what was observed. Couette flow stops to converge at about 0.1 % of U and
/// its drag stays 0.8 % high at every spacing. Most of it is the bias of the viscous sum where rows
/// slide past one another, 0.6 % (docs/theory.md); where the rest comes from has not been found
/// out.
void compare(const char* name, double u_lid, double g_x, double (*exact)(double, double),
             const std::vector<double>& least, double exact_drag) {
  std::vector<Result> results;
  for (const int n : {12, 24, 48}) results.push_back(run(n, u_lid, g_x, exact, Walls::dummy));
  for (std::size_t k = 0; k < least.size(); ++k) {
    const double e[3] = {results[0].errors[k], results[1].errors[k], results[2].errors[k]};
    WARN(
        fmt::format("{}: rms of u/U {:.5f}, {:.5f}, {:.5f} with 12, 24, 48 across: order {:.2f}, "
                    "{:.2f}",
                    name, e[0], e[1], e[2], std::log2(e[0] / e[1]), std::log2(e[1] / e[2])));
    CHECK(std::log2(e[0] / e[1]) > least[k]);
    CHECK(e[1] < 0.003);
    CHECK(e[2] < 0.003);
  }
  check_drag(name, {results[0].drag, results[1].drag, results[2].drag}, exact_drag);
}

/// The same between mirrors, 12 and 24 across.
void compare_mirrors(const char* name, double u_lid, double g_x, double (*exact)(double, double),
                     double exact_drag) {
  std::vector<Result> results;
  for (const int n : {12, 24}) results.push_back(run(n, u_lid, g_x, exact, Walls::mirror));
  for (std::size_t k = 0; k < results[0].errors.size(); ++k) {
    const double e[2] = {results[0].errors[k], results[1].errors[k]};
    WARN(fmt::format(
        "{} between mirrors: rms of u/U {:.5f}, {:.5f} with 12, 24 across: order {:.2f}", name,
        e[0], e[1], std::log2(e[0] / e[1])));
    CHECK(e[1] < 0.003);
  }
  check_drag(name, {results[0].drag, results[1].drag}, exact_drag);
}

}  // namespace

TEST_CASE("convergence: Couette flow starts between walls that water sticks to", "[order]") {
  // -du/dy at the lid: 1 + 2 sum exp(-n^2 pi^2 0.3)
  const double drag = -(1 + 2 * std::exp(-0.3 * pi * pi));
  compare("Couette", U, 0, couette, {1, 1, 0}, drag);
  compare_mirrors("Couette", U, 0, couette, drag);
}

TEST_CASE("convergence: Poiseuille flow starts between walls that water sticks to", "[order]") {
  // -du/dy at the lid: 4 - (32/pi^2) sum over odd n of exp(-n^2 pi^2 0.3)/n^2
  const double drag = 4 - 32 / (pi * pi) * std::exp(-0.3 * pi * pi);
  compare("Poiseuille", 0, G, poiseuille, {1.5, 1.5, 1.5}, drag);
  compare_mirrors("Poiseuille", 0, G, poiseuille, drag);
}
