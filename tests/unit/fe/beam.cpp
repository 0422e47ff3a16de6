#include "fe/beam.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "base/parallel.hpp"
#include "fe/beam_mass.hpp"

using namespace gannet;

namespace {

struct BeamLine {
  BeamBlock block;
  Nodes nodes;
};

/// Beams between points, with the masses of the nodes; a rectangle 0.05 m x 0.02 m of steel.
BeamLine beams(const std::vector<Vec3>& points, double nu = 0.3) {
  BeamLine m;
  const std::size_t n = points.size();
  m.nodes.n_owned = static_cast<Index>(n);
  m.nodes.rotating = {0, m.nodes.n_owned};
  for (auto* lines : {&m.nodes.x, &m.nodes.v, &m.nodes.f, &m.nodes.omega, &m.nodes.torque}) {
    lines->assign(n, {});
  }
  std::vector<Index> ends;
  for (std::size_t i = 0; i < n; ++i) {
    set_xyz(m.nodes.x[i], points[i]);
    if (i > 0) ends.insert(ends.end(), {static_cast<Index>(i) - 1, static_cast<Index>(i)});
  }
  const BeamLaw law{.section = rectangle_section(0.05, 0.02),
                    .E = 210e9,
                    .G = 0.5 * 210e9 / (1 + nu),
                    .rho = 7800};
  m.block = make_beam_block(ends, m.nodes.rotating, m.nodes.x, law, Vec3::Zero());
  add_beam_masses(m.block, m.nodes);
  return m;
}

void clear(Nodes& nodes) {
  for (std::size_t i = 0; i < nodes.f.size(); ++i) {
    nodes.f[i] = {};
    set_xyz(nodes.torque[i], Vec3::Zero());
  }
}

/// Turns node i by the angle about an axis, in a pass of its own.
void turn(BeamLine& m, std::size_t i, const Vec3& axis, double angle) {
  for (Line& omega : m.nodes.omega) set_xyz(omega, Vec3::Zero());
  set_xyz(m.nodes.omega[i], 2 * std::tan(0.5 * angle) * axis);
  beam_pass(m.block, m.nodes, 1);
  for (Line& omega : m.nodes.omega) set_xyz(omega, Vec3::Zero());
  clear(m.nodes);
}

void check_vector(const Vec3& got, const Vec3& wanted, double tolerance) {
  INFO("got " << got.transpose() << ", wanted " << wanted.transpose());
  CHECK((got - wanted).norm() < tolerance);
}

}  // namespace

TEST_CASE("beam sections: numbers of handbooks", "[fe]") {
  // Square: J = 0.140577 a^4; 2 : 1: J = 0.228682 t^3 a (0.2287 in handbooks).
  CHECK(rectangle_section(1, 1).J == Approx(0.140577).epsilon(2e-6));
  CHECK(rectangle_section(2, 1).J == Approx(0.22868 * 2).epsilon(1e-4));
  CHECK(rectangle_section(0.05, 0.02).I_y == Approx(0.05 * 8e-6 / 12).epsilon(1e-14));
  CHECK(rectangle_section(0.05, 0.02).I_z == Approx(0.02 * 125e-6 / 12).epsilon(1e-14));
  CHECK(round_section(0.2).I_y == Approx(std::numbers::pi * 1e-4 / 4).epsilon(1e-12));
  CHECK(round_section(0.2).A_y / round_section(0.2).A == Approx(0.886).epsilon(1e-3));
  const BeamSection tube = tube_section(0.2, 0.001);
  CHECK(tube.A == Approx(std::numbers::pi * 0.199 * 0.001).epsilon(1e-12));
  CHECK(tube.J == Approx(2 * std::numbers::pi * std::pow(0.0995, 3) * 0.001).epsilon(1e-4));
  CHECK(tube.A_z / tube.A == Approx(0.5306).epsilon(1e-3));
  const BeamSection box = box_section(0.1, 0.2, 0.01);
  CHECK(box.A == Approx(0.02 - 0.08 * 0.18).epsilon(1e-12));
  CHECK(box.J == Approx(2 * 0.01 * std::pow(0.09 * 0.19, 2) / 0.28).epsilon(1e-12));
  // An IPE 200 without its fillets, by parallel axes: they add 5 % to I_y = 1943 cm^4 (EN 10365).
  const BeamSection ipe = i_section(0.1, 0.2, 0.0085, 0.0056);
  CHECK(ipe.A == Approx(2 * 0.1 * 0.0085 + 0.183 * 0.0056).epsilon(1e-12));
  const double flange = 0.1 * std::pow(0.0085, 3) / 12 + 0.1 * 0.0085 * std::pow(0.09575, 2);
  CHECK(ipe.I_y == Approx(2 * flange + 0.0056 * std::pow(0.183, 3) / 12).epsilon(1e-12));
  CHECK(ipe.I_y == Approx(1943e-8).epsilon(0.06));
  CHECK(ipe.I_z == Approx(142.4e-8).epsilon(0.01));
}

TEST_CASE("beam: axial force, torsion and step by hand", "[fe]") {
  BeamLine m = beams({{0, 0, 0}, {0.5, 0, 0}});
  CHECK(m.nodes.x[0].w == Approx(7800 * 1e-3 * 0.25).epsilon(1e-14));
  m.nodes.x[1].x = 0.5005;  // strain 1e-3
  const ElementWork work = beam_pass(m.block, m.nodes, 0);
  CHECK(m.nodes.f[0].x == Approx(210e9 * 1e-3 * 1e-3).epsilon(1e-9));
  CHECK(m.nodes.f[1].x == Approx(-210e9 * 1e-3 * 1e-3).epsilon(1e-9));
  CHECK(work.internal == Approx(0.5 * 210e3 * 0.0005).epsilon(1e-9));
  m.nodes.x[1].x = 0.5;
  beam_pass(m.block, m.nodes, 0);
  // Rotations do not limit the step: l/c.
  CHECK(stable_step(m.block) == Approx(0.9 * 0.5 / std::sqrt(210e9 / 7800)).epsilon(1e-9));
  turn(m, 1, Vec3::UnitX(), 0.1);
  beam_pass(m.block, m.nodes, 0);
  const double T = m.block.law.G * m.block.law.section.J / 0.5 * 0.1;
  check_vector(xyz(m.nodes.torque[0]), {T, 0, 0}, 1e-9 * T);
  check_vector(xyz(m.nodes.torque[1]), {-T, 0, 0}, 1e-9 * T);
  check_vector(xyz(m.nodes.f[1]), Vec3::Zero(), 1e-9 * T);
}

TEST_CASE("beam: a cantilever of one element has the stiffness of Timoshenko", "[fe]") {
  // Tip displacement w and rotation psi under a force P across: w = P l^3/(3 E I) + P l/(G A_s),
  // psi = P l^2/(2 E I); small, so that lengths change by nothing that counts.
  const double l = 0.1;
  const double P = 0.1;
  for (const bool along_z : {true, false}) {
    BeamLine m = beams({{0, 0, 0}, {l, 0, 0}});
    const BeamSection s = m.block.law.section;
    const double EI = m.block.law.E * (along_z ? s.I_y : s.I_z);
    const double GA = m.block.law.G * (along_z ? s.A_z : s.A_y);
    const double w = P * l * l * l / (3 * EI) + P * l / GA;
    const double psi = P * l * l / (2 * EI);
    const Vec3 across = along_z ? Vec3::UnitZ() : Vec3::UnitY();
    turn(m, 1, Vec3::UnitX().cross(across), psi);
    set_xyz(m.nodes.x[1], Vec3(l, 0, 0) + w * across);
    beam_pass(m.block, m.nodes, 0);
    check_vector(xyz(m.nodes.f[1]), -P * across, 1e-6);
    check_vector(xyz(m.nodes.torque[1]), Vec3::Zero(), 1e-7);
    check_vector(xyz(m.nodes.f[0]), P * across, 1e-6);
    check_vector(xyz(m.nodes.torque[0]), P * l * Vec3::UnitX().cross(across), 1e-7);
  }
}

TEST_CASE("beam: forces are the gradient of the energy", "[fe]") {
  // Central differences of W over displacements and spins of one element that is well bent and
  // twisted: the share of the frame's own spin that is left out is of second order in theta.
  BeamLine m = beams({{0, 0, 0}, {0.3, 0.1, 0.2}});
  turn(m, 0, Vec3(1, 2, 2) / 3, 0.03);
  turn(m, 1, Vec3(2, -1, 2) / 3, 0.02);
  const auto energy = [](BeamLine model) {
    return beam_pass(model.block, model.nodes, 1).internal;
  };
  BeamLine here = m;
  beam_pass(here.block, here.nodes, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    Vec3 f;
    Vec3 torque;
    for (int d = 0; d < 3; ++d) {
      const double h = 1e-6;
      const auto moved = [&](double sign, bool spin) {
        BeamLine other = m;
        Line& line = spin ? other.nodes.omega[i] : other.nodes.x[i];
        (d == 0 ? line.x : d == 1 ? line.y : line.z) += sign * h;
        return energy(other);
      };
      f[d] = -(moved(1, false) - moved(-1, false)) / (2 * h);
      torque[d] = -(moved(1, true) - moved(-1, true)) / (2 * h);
    }
    check_vector(xyz(here.nodes.f[i]), f, 2e-3 * f.norm());
    check_vector(xyz(here.nodes.torque[i]), torque, 2e-3 * torque.norm());
  }
}

TEST_CASE("beam: forces and moments balance to rounding, whatever the motion", "[fe]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vec3(any(random), any(random), any(random)); };
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) points.push_back(Vec3(0.1 * i, 0, 0) + 0.02 * vector());
  BeamLine m = beams(points);
  for (int k = 0; k < 20; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      add_xyz(m.nodes.x[i], 0.002 * vector());
      set_xyz(m.nodes.omega[i], 0.3 * vector());
    }
    clear(m.nodes);
    beam_pass(m.block, m.nodes, 0.1);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      force += xyz(m.nodes.f[i]);
      moment += xyz(m.nodes.x[i]).cross(xyz(m.nodes.f[i])) + xyz(m.nodes.torque[i]);
      scale += xyz(m.nodes.f[i]).norm();
    }
    CHECK(force.norm() < 1e-13 * scale);
    CHECK(moment.norm() < 1e-13 * 4 * scale);  // the line is 4 m long
  }
}

TEST_CASE("beam: a stressed beam keeps its forces over ten turns of 1,000 steps", "[fe]") {
  BeamLine m = beams({{0, 0, 0}, {0.2, 0, 0}, {0.4, 0.05, 0}, {0.5, 0.2, 0.1}});
  turn(m, 1, Vec3(1, 2, 2) / 3, 0.02);
  turn(m, 3, Vec3(2, -1, 2) / 3, 0.03);
  beam_pass(m.block, m.nodes, 0);
  const Array<double> start = m.block.forces;
  double largest = 0;
  for (const double f : start) largest = std::max(largest, std::abs(f));
  const double angle = 2 * std::numbers::pi / 1000;
  const Vec3 axis = Vec3(1, -2, 2) / 3;
  const double dt = 1e-3;
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (int k = 0; k < 10000; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      set_xyz(m.nodes.x[i], R * xyz(m.nodes.x[i]));
      set_xyz(m.nodes.omega[i], 2 * std::tan(0.5 * angle) / dt * axis);
    }
    beam_pass(m.block, m.nodes, dt);
  }
  double worst = 0;
  for (std::size_t k = 0; k < start.size(); ++k) {
    worst = std::max(worst, std::abs(m.block.forces[k] - start[k]));
  }
  // 1e4 roundings of positions, 1e-16 each and mostly random, over strains of 1e-2.
  CHECK(worst < 1e-9 * largest);
}

TEST_CASE("beam: the same bits for any number of threads", "[fe]") {
  std::vector<Vec3> points;
  for (int i = 0; i <= 1500; ++i) points.emplace_back(0.01 * i, 0.02 * std::sin(0.1 * i), 0);
  Array<Line> f[2];
  for (int k = 0; k < 2; ++k) {
    set_threads(k == 0 ? 1 : 3);
    BeamLine m = beams(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      m.nodes.omega[i].x = std::sin(0.3 * static_cast<double>(i));
      m.nodes.x[i].z = 1e-4 * std::cos(0.7 * static_cast<double>(i));
    }
    beam_pass(m.block, m.nodes, 0.01);
    f[k] = m.nodes.torque;
  }
  set_threads(1);
  bool same = true;
  for (std::size_t i = 0; i < points.size(); ++i) same = same && xyz(f[0][i]) == xyz(f[1][i]);
  CHECK(same);
}
