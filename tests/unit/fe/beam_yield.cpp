// Beams that yield, are damped, or have released ends.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/parallel.hpp"
#include "fe/beam.hpp"
#include "fe/beam_mass.hpp"
#include "fe/beam_releases.hpp"
#include "fe/beam_shown.hpp"

using namespace gannet;

namespace {

struct BeamLine {
  BeamBlock block;
  Nodes nodes;
};

BeamLaw steel(const BeamSection& section, double yield = 0, double H = 0) {
  BeamLaw law{.section = section, .E = 200e9, .G = 80e9, .rho = 7800};
  if (yield > 0) law.yield = {.E = law.E, .sigma_y = yield, .isotropic = H};
  return law;
}

BeamLine beams(const std::vector<Vec3>& points, const BeamLaw& law) {
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
  m.block = make_beam_block(ends, m.nodes.rotating, m.nodes.x, law, Vec3::Zero());
  add_beam_masses(m.block, m.nodes);
  prepare_damping(m.block);
  return m;
}

void clear(Nodes& nodes) {
  for (std::size_t i = 0; i < nodes.f.size(); ++i) {
    nodes.f[i] = {};
    set_xyz(nodes.torque[i], Vec3::Zero());
  }
}

/// Turns the ends of an element against each other about y until the curvature k is reached from
/// k_old, and returns the moment at its middle.
double bend(BeamLine& m, double k_old, double k, ElementWork& work) {
  const double half = 0.5 * (k - k_old) * m.block.l0[0];
  clear(m.nodes);
  m.nodes.omega[0].y = -2 * std::tan(0.5 * half);
  m.nodes.omega[1].y = 2 * std::tan(0.5 * half);
  const ElementWork w = beam_pass(m.block, m.nodes, 1);
  work.internal += w.internal;
  work.plastic += w.plastic;
  work.damping += w.damping;
  return m.block.forces[4];
}

}  // namespace

TEST_CASE("beam fibres: sums are those of the section", "[fe]") {
  const BeamSection sections[] = {rectangle_section(0.05, 0.02), round_section(0.03),
                                  tube_section(0.1, 0.004), box_section(0.1, 0.15, 0.006),
                                  i_section(0.1, 0.2, 0.012, 0.007)};
  for (const BeamSection& s : sections) {
    double sums[6] = {};
    for (const BeamFibre& f : s.fibres) {
      const double part[6] = {1, f.y * f.y, f.z * f.z, f.y, f.z, f.y * f.z};
      for (int k = 0; k < 6; ++k) sums[k] += f.A * part[k];
    }
    CHECK(sums[0] == Approx(s.A).epsilon(1e-12));
    CHECK(sums[1] == Approx(s.I_z).epsilon(1e-12));
    CHECK(sums[2] == Approx(s.I_y).epsilon(1e-12));
    for (int k = 3; k < 6; ++k) CHECK(std::abs(sums[k]) < 1e-12 * s.A);
  }
}

TEST_CASE("beam fibres: stress goes to the yield stress and back by hand", "[fe]") {
  // E = 200 GPa, Y = 200 MPa, H = 10 GPa: at 3e-3 the flow is (600 - 200)/210 e-3.
  const UniaxialLaw line{.E = 200e9, .sigma_y = 200e6, .isotropic = 10e9};
  FibreState state;
  double lost = 0;
  const double flow = 400.0 / 210e3;
  CHECK(uniaxial_stress(line, 3e-3, state, lost) == Approx(200e6 + 10e9 * flow).epsilon(1e-12));
  CHECK(state.strain == Approx(flow).epsilon(1e-12));
  CHECK(lost == Approx((200e6 + 5e9 * flow) * flow).epsilon(1e-12));
  // Back to the other side: it yields there at the same size, and with back stress 2 Y earlier.
  const double Y = 200e6 + 10e9 * flow;
  double strain = 3e-3 - 2 * Y / 200e9;
  CHECK(uniaxial_stress(line, strain, state, lost) == Approx(-Y).epsilon(1e-9));
  CHECK(lost < 1);
  const UniaxialLaw kinematic{.E = 200e9, .sigma_y = 200e6, .kinematic = 10e9};
  FibreState other;
  uniaxial_stress(kinematic, 3e-3, other, lost);
  strain = 3e-3 - 400e6 / 200e9 - 1e-4;
  const double sigma = uniaxial_stress(kinematic, strain, other, lost);
  CHECK(sigma == Approx(10e9 * other.strain - 200e6).epsilon(1e-9));
  CHECK(other.strain == Approx(flow - 1e-4 * 200 / 210).epsilon(1e-9));
  // Points of a curve and a power end on their curves.
  const UniaxialLaw points{.E = 200e9,
                           .sigma_y = 200e6,
                           .curve_strain = {0, 1e-3, 1e-2},
                           .curve_stress = {200e6, 260e6, 280e6}};
  const UniaxialLaw power{.E = 200e9, .sigma_y = 200e6, .power_factor = 400e6, .power = 0.3};
  for (const UniaxialLaw* law : {&points, &power}) {
    FibreState s;
    for (const double eps : {1.2e-3, 2.5e-3, 4e-3, 2e-2}) {
      const double stress = uniaxial_stress(*law, eps, s, lost);
      CHECK(stress == Approx(yield_stress(*law, s.accumulated)).epsilon(1e-11));
      CHECK(stress == Approx(200e9 * (eps - s.strain)).epsilon(1e-11));
    }
  }
}

TEST_CASE("beam: elastic fibres give the forces of the elastic element", "[fe]") {
  const BeamLaw law = steel(box_section(0.1, 0.15, 0.006), 1e15);
  BeamLaw elastic = law;
  elastic.yield = {};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  BeamLine a = beams({Vec3(0, 0, 0), Vec3(0.2, 0.1, 0.05)}, law);
  BeamLine b = beams({Vec3(0, 0, 0), Vec3(0.2, 0.1, 0.05)}, elastic);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 spin = 0.01 * Vec3(u(random), u(random), u(random));
    for (BeamLine* m : {&a, &b}) set_xyz(m->nodes.omega[i], spin);
  }
  a.nodes.x[1].y = b.nodes.x[1].y = 0.1001;
  const double work_a = beam_pass(a.block, a.nodes, 1).internal;
  const double work_b = beam_pass(b.block, b.nodes, 1).internal;
  CHECK(work_a == Approx(work_b).epsilon(1e-12));
  for (std::size_t i = 0; i < 2; ++i) {
    const double scale = xyz(b.nodes.f[i]).norm() + xyz(b.nodes.torque[i]).norm();
    CHECK((xyz(a.nodes.f[i]) - xyz(b.nodes.f[i])).norm() < 1e-11 * scale);
    CHECK((xyz(a.nodes.torque[i]) - xyz(b.nodes.torque[i])).norm() < 1e-11 * scale);
  }
}

TEST_CASE("beam: moment over curvature of a rectangle and a tube", "[fe]") {
  // Rectangle: M/M_y = 3/2 - (k_y/k)^2/2. Fully plastic over first yield: 3/2, and for a tube of
  // radii r, R: 16/(3 pi) (1 - m^3)/(1 - m^4), m = r/R.
  const double Y = 250e6;
  const double h = 0.02;
  BeamLine bar = beams({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, steel(rectangle_section(0.05, h), Y));
  const double M_y = Y * 0.05 * h * h / 6;
  const double k_y = 2 * Y / (200e9 * h);
  ElementWork work;
  double k = 0;
  double worst = 0;
  for (int i = 1; i <= 80; ++i) {
    const double next = 0.25 * i * k_y;
    const double M = bend(bar, k, next, work);
    k = next;
    const double exact = k < k_y ? k / k_y : 1.5 - 0.5 * (k_y / k) * (k_y / k);
    worst = std::max(worst, std::abs(M / M_y - exact));
  }
  WARN("rectangle: moment off by at most " << worst << " M_y, at 20 k_y "
                                           << bar.block.forces[4] / M_y);
  CHECK(worst < 0.025);
  CHECK(bar.block.forces[4] / M_y == Approx(1.5 - 0.5 / 400).epsilon(1e-3));

  const double m = 0.9;
  BeamLine tube = beams({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, steel(tube_section(0.1, 0.005), Y));
  const double first = Y * tube.block.law.section.I_y / 0.05;
  k = 0;
  for (int i = 1; i <= 80; ++i) {
    const double next = 0.25 * i * Y / (200e9 * 0.05);
    bend(tube, k, next, work);
    k = next;
  }
  const double full = 16 / (3 * std::numbers::pi) * (1 - m * m * m) / (1 - m * m * m * m);
  WARN("tube: fully plastic over first yield " << tube.block.forces[4] / first << ", exact "
                                               << full);
  CHECK(tube.block.forces[4] / first == Approx(full).epsilon(0.01));
}

TEST_CASE("beam: a cycle of bending takes the area of its loop", "[fe]") {
  // Without hardening, between -k and k, both far beyond yield: the work of a cycle is the integral
  // of M over k, and all of it is plastic once the cycle is closed.
  const double Y = 250e6;
  const double h = 0.02;
  BeamLine bar = beams({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, steel(rectangle_section(0.05, h), Y));
  const double amplitude = 8 * 2 * Y / (200e9 * h);
  ElementWork work;
  double k = 0;
  double M = 0;
  double loop = 0;
  const auto go = [&](double to) {
    const double from = k;
    for (int i = 1; i <= 200; ++i) {
      const double next = from + (to - from) * i / 200;
      const double M_next = bend(bar, k, next, work);
      loop += 0.5 * (M + M_next) * (next - k) * bar.block.l0[0];
      M = M_next;
      k = next;
    }
  };
  go(amplitude);
  go(-amplitude);
  go(amplitude);
  loop = 0;
  work = {};
  go(-amplitude);
  go(amplitude);
  CHECK(work.internal == Approx(loop).epsilon(1e-9));
  CHECK(work.plastic == Approx(loop).epsilon(2e-3));
  // Branches are the first one doubled, so the loop is 8 int_0^k M dk - 4 k M(k), at k = 8
  // k_y 36.75 M_y k_y.
  const double M_y = Y * 0.05 * h * h / 6;
  CHECK(loop == Approx(36.75 * M_y * amplitude / 8 * bar.block.l0[0]).epsilon(0.02));
}

TEST_CASE("beam: released ends carry no moment, the other end what is left", "[fe]") {
  // One end released: 3 E I/(l (1 + phi/4)) in place of (4 + phi)/(1 + phi) E I/l.
  const BeamLaw law = steel(rectangle_section(0.05, 0.02));
  BeamLine m = beams({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, law);
  REQUIRE(release(m.block, 0, 2U | 4U));
  CHECK(!release(m.block, 7, 2U));
  m.nodes.omega[1] = {0, 1e-4, 2e-4, 0};
  beam_pass(m.block, m.nodes, 1);
  const auto stiffness = [&](double I, double A_s) {
    const double phi = 12 * law.E * I / (law.G * A_s * 0.01);
    return 3 * law.E * I / (0.1 * (1 + 0.25 * phi));
  };
  const BeamSection& s = law.section;
  CHECK(xyz(m.nodes.torque[0]).norm() < 1e-9);
  CHECK(m.nodes.torque[1].y == Approx(-1e-4 * stiffness(s.I_y, s.A_z)).epsilon(1e-6));
  CHECK(m.nodes.torque[1].z == Approx(-2e-4 * stiffness(s.I_z, s.A_y)).epsilon(1e-6));
  // The released node turns as it likes.
  m.nodes.omega[0] = {0.3, -0.8, 0.5, 0};
  m.nodes.omega[1] = {};
  clear(m.nodes);
  const double before = m.block.energy[0];
  REQUIRE(release(m.block, 0, 1U));
  CHECK(std::abs(beam_pass(m.block, m.nodes, 1).internal) < 1e-9 * before);
}

TEST_CASE("beam: forces and moments balance with yield, damping and hinges", "[fe]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  BeamLaw law = steel(i_section(0.1, 0.2, 0.012, 0.007), 250e6, 1e9);
  law.damping = {.ratio = 0.1, .time = 1e-7};
  BeamLine m = beams({Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(2, 0.5, 0.3), Vec3(2.4, 1.4, 0.2)}, law);
  release(m.block, 1, 2U);
  release(m.block, 2, 7U);
  ElementWork work;
  for (int k = 0; k < 50; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      add_xyz(m.nodes.x[i], 1e-3 * Vec3(u(random), u(random), u(random)));
      set_xyz(m.nodes.omega[i], 20 * Vec3(u(random), u(random), u(random)));
    }
    clear(m.nodes);
    const ElementWork w = beam_pass(m.block, m.nodes, 1e-4);
    work.plastic += w.plastic;
    work.damping += w.damping;
    Vec3 F = Vec3::Zero();
    Vec3 M = Vec3::Zero();
    double scale_f = 0;
    double scale_m = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 f = xyz(m.nodes.f[i]);
      F += f;
      M += xyz(m.nodes.x[i]).cross(f) + xyz(m.nodes.torque[i]);
      scale_f += f.norm();
      scale_m += xyz(m.nodes.x[i]).cross(f).norm() + xyz(m.nodes.torque[i]).norm();
    }
    CHECK(F.norm() < 1e-13 * scale_f);
    CHECK(M.norm() < 1e-13 * scale_m);
  }
  CHECK(work.plastic > 0);
  CHECK(work.damping > 0);
}

TEST_CASE("beam fibres: rate, heat and failure are those of other metals", "[fe]") {
  // Cowper and Symonds: once all strain is plastic, Y (1 + (rate/D)^(1/p)).
  ElasticPlastic metal;
  metal.E = 200e9;
  metal.nu = 0.3;
  metal.sigma_y = 200e6;
  metal.rate_law = RateLaw::cowper_symonds;
  metal.rate = 40;
  metal.rate_power = 0.2;
  metal.failure.strain[0] = 0.05;
  const UniaxialLaw law = uniaxial_law(metal);
  REQUIRE(law.full);
  FibreState state;
  double lost = 0;
  double strain = 0;
  double sigma = 0;
  for (int k = 0; k < 300; ++k) {  // 100/s
    strain += 1e-4;
    sigma = uniaxial_stress(law, strain, state, lost, 1e6);
  }
  CHECK(sigma == Approx(200e6 * (1 + std::pow(100.0 / 40, 0.2))).epsilon(1e-8));
  CHECK(lost == Approx(sigma * 1e-4).epsilon(1e-6));
  // Slowed down to nothing it comes back to the static yield stress.
  FibreState slow = state;
  CHECK(uniaxial_stress(law, strain + 1e-4, slow, lost, 1e-9) == Approx(200e6).epsilon(1e-2));
  for (int k = 0; k < 300; ++k) {
    strain += 1e-4;
    sigma = uniaxial_stress(law, strain, state, lost, 1e6);
    if (state.accumulated < 0.0499) CHECK(sigma > 200e6);
  }
  CHECK(state.damage >= 1);
  CHECK(sigma == 0);
  // Johnson and Cook with heat: the state says the stress.
  metal.rate_law = RateLaw::johnson_cook;
  metal.rate = 1;
  metal.rate_power = 0.02;
  metal.power_factor = 300e6;
  metal.power = 0.3;
  metal.rho = 8000;
  metal.heating.specific_heat = 400;
  metal.heating.range = 1000;
  metal.heating.power = 1;
  metal.heating.fraction = 0.9;
  metal.failure = {};
  const UniaxialLaw jc = uniaxial_law(metal);
  FibreState hot;
  double heat = 0;
  for (int k = 1; k <= 1000; ++k) {
    sigma = uniaxial_stress(jc, 2e-4 * k, hot, lost, 1e6);
    heat += lost;
  }
  CHECK(hot.rise == Approx(0.9 * heat / (8000.0 * 400)).epsilon(1e-12));
  CHECK(sigma == Approx((200e6 + 300e6 * std::pow(hot.accumulated, 0.3)) *
                        (1 + 0.02 * std::log(200.0)) * (1 - hot.rise / 1000))
                     .epsilon(1e-3));
}

namespace {

BeamLaw brittle(const BeamSection& section) {
  BeamLaw law = steel(section);
  ElasticPlastic metal;
  metal.E = law.E;
  metal.nu = 0.25;
  metal.sigma_y = 200e6;
  metal.failure.strain[0] = 0.02;
  law.yield = uniaxial_law(metal);
  return law;
}

}  // namespace

TEST_CASE("beam: an element pulled until its fibres fail leaves with what it held", "[fe]") {
  BeamLine m =
      beams({Vec3(0, 0, 0), Vec3(0.2, 0, 0), Vec3(0.5, 0, 0)}, brittle(round_section(0.02)));
  ElementWork sum;
  double work = 0;
  double force = 0;
  int k = 0;
  for (; k < 400 && m.block.gone[0] == 0; ++k) {
    m.nodes.x[0].x -= 0.2 * 1e-4;
    clear(m.nodes);
    const ElementWork w = beam_pass(m.block, m.nodes, 1e-3);
    const double now = m.nodes.f[0].x;
    work += 0.5 * (force + now) * 0.2 * 1e-4;
    force = now;
    sum.internal += w.internal;
    sum.plastic += w.plastic;
    sum.eroded += w.eroded;
  }
  // A strain of 0.02 + 0.001 and a step.
  CHECK(k == Approx(211).margin(2));
  const double A = m.block.law.section.A;
  CHECK(force == 0);
  CHECK(xyz(m.nodes.f[1]).norm() == 0);
  CHECK(sum.internal + sum.eroded == Approx(work).epsilon(1e-12));
  CHECK(sum.plastic == Approx(A * 0.2 * 200e6 * 0.02).epsilon(0.01));
  CHECK(sum.internal == Approx(sum.plastic).epsilon(1e-3));  // nothing elastic is left behind
  CHECK(sum.eroded == Approx(A * 0.2 * 0.5 * 200e6 * 1e-3).epsilon(0.15));  // and half a step
  clear(m.nodes);
  m.nodes.x[0].x -= 0.1;
  CHECK(beam_pass(m.block, m.nodes, 1e-3).internal == 0);
  CHECK(m.block.limiting == 1);  // what has left limits no step
}

TEST_CASE("beam: bent until it breaks, the fibres farthest out fail first", "[fe]") {
  BeamLine m = beams({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, brittle(rectangle_section(0.02, 0.04)));
  ElementWork work;
  double most = 0;
  double last = 0;
  int between = 0;
  for (int k = 1; k <= 4000 && m.block.gone[0] == 0; ++k) {
    last = std::abs(bend(m, 2e-3 * (k - 1), 2e-3 * k, work));
    most = std::max(most, last);
    show_damage(m.block);
    if (m.block.damage_shown[0] > 0.1 && m.block.damage_shown[0] < 0.9) ++between;
  }
  CHECK(most == Approx(200e6 * 0.02 * 0.04 * 0.04 / 4).epsilon(0.02));
  CHECK(between > 10);
  CHECK(last < 0.5 * most);
}
