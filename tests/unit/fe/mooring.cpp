#include "fe/mooring.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/math.hpp"
#include "fe/mooring_start.hpp"

using namespace gannet;

namespace {

constexpr double g = 10;

/// A line of n elements of 2 m along a direction in the plane x z, mass 5 kg/m, without elements'
/// forces: what water and bed do alone.
struct Loose {
  MooringLine line;
  Nodes nodes;
  Step step{.dt_old = 0.01, .dt = 0.01};
  Vec3 gravity{0, 0, -g};

  Loose(int n, const Vec3& along) {
    line.n = n;
    line.length = 2 * n;
    line.diameter = 0.1;
    line.block.mu = 5;
    line.water = {.density = 1000, .level = 1e6, .Cdn = 1.2, .Cdt = 0.1, .Can = 0.9, .Cat = 0.2};
    std::vector<Index> order;
    for (int k = 0; k <= n; ++k) {
      const Vec3 at = 2 * k * along.normalized();
      const double m = k == 0 || k == n ? 5 : 10;
      nodes.x.push_back({at.x(), at.y(), at.z(), m});
      nodes.v.push_back({0, 0, 0, 1 / m});
      nodes.f.push_back({});
      order.push_back(k);
    }
    nodes.n_owned = n + 1;
    set_line_nodes(line, order);
  }
  void move(const Vec3& v) {
    for (Line& line_v : nodes.v) set_xyz(line_v, v);
  }
  /// Friction holds all nodes where they are.
  void stick() {
    const std::size_t all = line.stuck.size() / 2;
    for (std::size_t lane = 0; lane < all; ++lane) {
      const Line& x = nodes.x[std::min(lane, nodes.x.size() - 1)];
      line.stuck[lane] = x.x;
      line.stuck[all + lane] = x.y;
    }
  }
  void act() { line_forces(line, nodes, gravity, step); }
  Vec3 f(std::size_t k) const { return xyz(nodes.f[k]); }
};

const double rho_A = 1000 * 0.25 * std::numbers::pi * 0.01;  // 7.854 kg/m

}  // namespace

TEST_CASE("mooring: buoyancy carries the displaced water", "[fe]") {
  Loose a(4, {1, 0, 0});
  a.line.water.Can = a.line.water.Cat = 0;
  a.act();
  CHECK(a.f(2).z() == Approx(2 * rho_A * g).epsilon(1e-12));
  CHECK(a.f(0).z() == Approx(rho_A * g).epsilon(1e-12));
  CHECK(std::abs(a.f(2).x()) < 1e-12);
  Loose dry(4, {1, 0, 0});
  dry.line.water.level = -1;
  dry.act();
  CHECK(dry.f(2).norm() == 0);
  Loose half(4, {1, 0, 0});  // the surface at its axis
  half.line.water.level = 0;
  half.line.water.Can = half.line.water.Cat = 0;
  half.act();
  CHECK(half.f(2).z() == Approx(rho_A * g).epsilon(1e-12));
}

TEST_CASE("mooring: buoyancy of a line that pierces the surface is of its length below", "[fe]") {
  Loose a(10, {0, 0, 1});  // from z = 0 to 20 m
  a.line.water.Can = a.line.water.Cat = 0;
  for (const double level : {3.0, 7.3, 10.0, 20.0}) {
    a.line.water.level = level;
    double sum = 0;
    for (Line& f : a.nodes.f) f = {};
    a.act();
    for (std::size_t k = 0; k < 11; ++k) sum += a.f(k).z();
    CHECK(sum == Approx(level * rho_A * g).epsilon(0.03));
  }
}

TEST_CASE("mooring: drag and added mass by hand, across and along the line", "[fe]") {
  Loose a(6, {3, 0, 4});
  a.gravity = Vec3::Zero();
  const Vec3 t(0.6, 0, 0.8);
  const Vec3 across(0.8, 0, -0.6);
  a.move(2 * across - 3 * t);
  a.act();
  // C = rho d l/2 (1.2 x 2) = 240, and rho pi d l/2 (0.1 x 3) = 94.25; tau = 0.005 s.
  const double C_n = 0.5 * 1000 * 0.1 * 2 * 1.2 * 2;
  const double C_t = 0.5 * 1000 * std::numbers::pi * 0.1 * 2 * 0.1 * 3;
  const double a_n = -C_n * 2 / (10 + 2 * rho_A * 0.9 + C_n * 0.005);
  const double a_t = C_t * 3 / (10 + 2 * rho_A * 0.2 + C_t * 0.005);
  CHECK(a.f(3).dot(across) == Approx(10 * a_n).epsilon(1e-12));
  CHECK(a.f(3).dot(t) == Approx(10 * a_t).epsilon(1e-12));
  CHECK(std::abs(a.f(3).y()) < 1e-9);
  // The ends: half of the length, drag at the velocity at hand, no added mass.
  CHECK(a.f(6).dot(across) == Approx(-0.5 * C_n * 2).epsilon(1e-12));
  CHECK(a.f(0).dot(t) == Approx(0.5 * C_t * 3).epsilon(1e-12));
}

TEST_CASE("mooring: in a current that goes with it a line feels nothing", "[fe]") {
  Loose a(20, {1, 2, 3});
  a.gravity = Vec3::Zero();
  const Vec3 u(0.5, -1, 0.25);
  a.line.water.flows = true;
  a.line.water.current = u;
  std::vector<Index> order;
  for (Index k = 0; k <= 20; ++k) order.push_back(k);
  set_line_nodes(a.line, order);
  a.move(u);
  a.act();
  for (std::size_t k = 0; k <= 20; ++k) CHECK(a.f(k).norm() < 1e-12);
  a.move(Vec3::Zero());
  a.act();
  CHECK(a.f(7).dot(u) > 0);
}

TEST_CASE("mooring: a stiff drag brings a node to rest and not beyond", "[fe]") {
  Loose a(4, {1, 0, 0});
  a.gravity = Vec3::Zero();
  a.step = {.dt_old = 10, .dt = 10};  // C dt/m = 1200
  a.move({0, 1, 0});
  a.act();
  const double v_new = 1 + a.f(2).y() / 10 * 10;
  CHECK(v_new > -1);
  CHECK(v_new < 1);
}

TEST_CASE("mooring: the bed carries a line at rest, and holds it by friction", "[fe]") {
  Loose a(4, {1, 0, 0});
  a.line.water.density = 0;
  a.line.bed = {.there = true, .level = 0, .stiffness = 5e4, .damping = 100, .friction = 0.5};
  a.stick();
  // It sinks in by w/k = 50/5e3 = 10 mm, and lies 5 mm below the level.
  CHECK(pushing_level(a.line, g) == Approx(5e-3).epsilon(1e-12));
  for (Line& x : a.nodes.x) x.z = -5e-3;
  a.act();  // weight of a node: 10 kg x 10
  CHECK(a.f(2).z() == Approx(100).epsilon(1e-12));
  CHECK(a.f(4).z() == 0);  // the ends are held
  // 2 mm aside: k = 5e4 x 0.1 x 2 = 1e4 N/m, 20 N of 50 N that friction can hold.
  for (Line& f : a.nodes.f) f = {};
  for (Line& x : a.nodes.x) x.y = 2e-3;
  a.act();
  CHECK(a.f(2).y() == Approx(-20).epsilon(1e-12));
  // 2 cm aside: it slides at the limit, and comes to rest with the spring that it took along.
  for (int round = 0; round < 2; ++round) {
    for (Line& f : a.nodes.f) f = {};
    for (Line& x : a.nodes.x) x.y = round == 0 ? 2e-2 : 1.9e-2;
    a.act();
    CHECK(a.f(2).y() == Approx(round == 0 ? -50 : -40).epsilon(1e-9));
  }
  // Lifted off: nothing.
  for (Line& f : a.nodes.f) f = {};
  for (Line& x : a.nodes.x) x.z = 1;
  a.act();
  CHECK(a.f(2).norm() == 0);
}

TEST_CASE("mooring: the bed pushes against approach and never pulls", "[fe]") {
  Loose a(4, {1, 0, 0});
  a.line.water.density = 0;
  a.line.bed = {.there = true, .level = 0, .stiffness = 5e4, .damping = 100, .friction = 0};
  for (Line& x : a.nodes.x) x.z = -5e-3;
  a.move({0, 0, -1});
  a.act();  // c = 100 x 0.1 x 2
  CHECK(a.f(2).z() == Approx(120).epsilon(1e-12));
  for (Line& f : a.nodes.f) f = {};
  a.move({0, 0, 100});
  a.act();
  CHECK(a.f(2).z() == 0);
}

TEST_CASE("mooring: work of water and bed is what the nodes lose", "[fe]") {
  Loose a(30, {1, 1, -0.2});
  a.line.bed = {.there = true, .level = -5, .stiffness = 5e4, .damping = 100, .friction = 0.3};
  a.stick();
  for (std::size_t k = 0; k < a.nodes.v.size(); ++k) {
    const double s = 0.3 * static_cast<double>(k);
    set_xyz(a.nodes.v[k], {std::sin(s), std::cos(2 * s), std::sin(3 * s)});
  }
  const Nodes before = a.nodes;
  a.act();
  const double dt = 0.01;
  double gained = 0;
  double along_path = 0;
  for (std::size_t k = 0; k < a.nodes.v.size(); ++k) {
    Line& v = a.nodes.v[k];
    const Vec3 old = xyz(v);
    set_xyz(v, old + dt * v.w * a.f(k));
    gained += 0.5 / v.w * (xyz(v).squaredNorm() - old.squaredNorm());
    along_path += 0.5 * dt * a.f(k).dot(old + xyz(v));
  }
  CHECK(gained == Approx(along_path).epsilon(1e-10));
  const LineSums s = line_work(a.line, a.nodes, a.gravity, a.step);
  double sum = 0;
  for (const auto* part : {s.buoyancy, s.drag, s.added, s.bed, s.friction})
    sum += part[0] + part[1];
  CHECK(sum == Approx(gained).epsilon(1e-10));
  CHECK(s.drag[0] + s.drag[1] < 0);
  CHECK(s.friction[1] < 0);
}

TEST_CASE("mooring: a line that is much too short is refused with numbers", "[fe]") {
  Loose a(4, {1, 0, 0});
  a.line.block.EA = 1e6;
  a.line.block.unstretched = 2;
  a.line.ends[0].at = {0, 0, 0};
  a.line.ends[1].at = {12, 0, 0};
  CHECK(
      start_of(a.line, a.gravity).trouble ==
      "too short: its ends are 12 m apart, 50 % more than 8 m; a line may start stretched by 20 %, "
      "so at least 10 m are wanted");
  a.line.ends[1].at = {8.1, 0, 0};
  a.line.water.density = 0;
  CHECK(start_of(a.line, a.gravity).trouble.empty());
  a.line.block.strength = 10;
  CHECK(start_of(a.line, a.gravity).trouble.find("breaks at the start") == 0);
}

TEST_CASE("mooring: a line with length to spare hangs down and lies slack", "[fe]") {
  Loose a(40, {1, 0, 0});
  a.line.block.EA = 1e7;
  a.line.water.density = 0;
  a.line.length = 80;
  a.line.bed = {.there = true, .level = 0, .stiffness = 5e5, .damping = 100, .friction = 0};
  a.line.ends[0].at = {0, 0, 0};
  a.line.ends[1].at = {40, 0, 20};
  const LineStart start = start_of(a.line, a.gravity);
  CHECK(start.trouble.empty());
  // The upper element carries the nine nodes that hang below it.
  CHECK(start.largest == Approx(9 * 100).epsilon(1e-6));
}
