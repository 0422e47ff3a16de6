// The one-point solid: patch test, hand-made volumes and hourglass forces, momentum, objectivity.
#include "fe/solid.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <random>

#include "fe_testing.hpp"
#include "mesh/volume_shapes.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

const ElasticPlastic soft{.rho = 1000, .E = 1e6, .nu = 0.25};
const SolidSection inviscid{.linear_viscosity = 0, .quadratic_viscosity = 0};

SolidSection with_points(int points, SolidSection section = {}) {
  section.points = points;
  return section;
}

/// n x n x n cubes of 0.1 m, inner points moved at random by up to noise.
Solid lattice(int n, double noise, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  return bricks({n, n, n}, [&](int i, int j, int k) {
    const bool inner = i % n != 0 && j % n != 0 && k % n != 0;
    const double s = inner || n == 1 ? noise : 0;
    return Vec3(0.1 * i + s * u(random), 0.1 * j + s * u(random), 0.1 * k + s * u(random));
  });
}

/// The same of tetrahedra.
Solid tetrahedra(int n, double noise) {
  const Solid bricks = lattice(n, noise);
  VolumeMesh mesh{.cells = bricks.cells};
  for (const Line& x : bricks.nodes.x) mesh.points.push_back(xyz(x));
  const VolumeMesh split = tetrahedra_of(mesh);
  return solid_of(split.points, split.cells);
}

const SolidSection of_tetrahedra{
    .shape = SolidShape::tetrahedron, .linear_viscosity = 0, .quadratic_viscosity = 0};

void linear_motion(Nodes& nodes, const Mat3& L) {
  for (std::size_t i = 0; i < nodes.x.size(); ++i) set_xyz(nodes.v[i], L * xyz(nodes.x[i]));
}

}  // namespace

TEST_CASE("solid: the volume of a warped element is that of its tetrahedra", "[fe]") {
  // The trilinear volume is the mean of the two ways to split each face, so the mean of the two
  // polyhedra whose warped faces are cut along one or the other diagonal.
  const Solid s = lattice(1, 0.03, 5);
  const SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, {});
  const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  double volume = 0;
  const auto p = [&](int a) { return xyz(s.nodes.x[static_cast<std::size_t>(s.cells[a])]); };
  const auto cone = [&](int a, int b, int c) { return p(a).dot(p(b).cross(p(c))) / 6; };
  for (const auto& f : faces) {
    volume += 0.5 * (cone(f[0], f[1], f[2]) + cone(f[0], f[2], f[3]) + cone(f[0], f[1], f[3]) +
                     cone(f[1], f[2], f[3]));
  }
  CHECK(volume_of(block, 0, s.nodes.x) == Approx(volume).epsilon(1e-13));
}

TEST_CASE("solid: a rod of the shapes has the volume of its polygon and no element inside out",
          "[fe]") {
  const VolumeMesh mesh = rod_volume({1, 0, 0}, {1, 3, 4}, 0.5, {4, 3, 5});
  REQUIRE(mesh.cells.size() == 8 * (16 + 3 * 16) * 5);
  const Solid s = solid_of(mesh.points, mesh.cells);
  const SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, {});
  double volume = 0;
  for (Index e = 0; e < block.n_elements; ++e) volume += volume_of(block, e, s.nodes.x);
  // A regular polygon of 16 corners on the circle, times the length 5.
  CHECK(volume == Approx(5 * 8 * 0.25 * std::sin(std::numbers::pi / 8)).epsilon(1e-12));
}

TEST_CASE("solid: patch test on a distorted mesh", "[fe]") {
  const double dt = 1e-12;  // the midpoint is the given shape to 1e-15
  Mat3 L;
  L << 1e-3, 2e-3, -1e-3, 0, -2e-3, 3e-3, 4e-3, 1e-3, 2e-3;
  const int points = GENERATE(1, 8);
  for (const Isa set : sets()) {
    Solid s = lattice(3, 0.02);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, with_points(points, inviscid));
    linear_motion(s.nodes, L);
    solid_pass(block, s.nodes, dt, set);
    // lambda = mu = 4e5: sigma = 4e5 tr(L) + 8e5 sym(L)
    const double lambda_part = 4e5 * L.trace();
    for (Index e = 0; e < block.n_elements; ++e) {
      const Symmetric<double> sigma = stress_at(block, e, points - 1);
      CHECK(sigma.xx / dt == Approx(lambda_part + 8e5 * L(0, 0)).epsilon(1e-10));
      CHECK(sigma.yy / dt == Approx(lambda_part + 8e5 * L(1, 1)).epsilon(1e-10));
      CHECK(sigma.zz / dt == Approx(lambda_part + 8e5 * L(2, 2)).epsilon(1e-10));
      CHECK(sigma.xy / dt == Approx(4e5 * (L(0, 1) + L(1, 0))).epsilon(1e-10));
      CHECK(sigma.yz / dt == Approx(4e5 * (L(1, 2) + L(2, 1))).epsilon(1e-10));
      CHECK(sigma.zx / dt == Approx(4e5 * (L(2, 0) + L(0, 2))).epsilon(1e-10));
    }
    // Inner nodes are in equilibrium; 1000 Pa x 0.01 m^2 is the scale.
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      const bool inner = (x.array() > 0.05).all() && (x.array() < 0.25).all();
      if (inner) CHECK(xyz(s.nodes.f[i]).norm() / dt < 1e-10 * 10);
    }
  }
}

TEST_CASE("solid: hourglass stiffness of a cube by hand", "[fe]") {
  // Side a = 0.1: sum B.B = 1.5 a^4, V = a^3, so k_h = 8 kappa (lambda + 2 mu) 1.5 a and a corner
  // gets k_h q/8 with q = v dt, the coefficient of the pattern.
  const double dt = 1e-9;
  for (const Isa set : sets()) {
    for (int mode = 0; mode < 4; ++mode) {
      Solid s = lattice(1, 0);
      SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, inviscid);
      const auto pattern = [&](std::size_t i) {
        const Vec3 at = xyz(s.nodes.x[i]) / 0.05 - Vec3::Ones();
        const double p[4] = {at.y() * at.z(), at.z() * at.x(), at.x() * at.y(),
                             at.x() * at.y() * at.z()};
        return p[mode];
      };
      for (std::size_t i = 0; i < 8; ++i) s.nodes.v[i].y = pattern(i);
      const ElementWork work = solid_pass(block, s.nodes, dt, set);
      const double k_h = 8 * 0.05 * 1.2e6 * 1.5 * 0.1;
      for (std::size_t i = 0; i < 8; ++i) {
        CHECK(s.nodes.f[i].y == Approx(-k_h * dt / 8 * pattern(i)).epsilon(1e-6));
        CHECK(std::abs(s.nodes.f[i].x) < 1e-6 * k_h * dt);
      }
      CHECK(work.hourglass == Approx(0.5 * k_h * dt * dt).epsilon(1e-6));
      CHECK(std::abs(work.internal) < 1e-9 * work.hourglass);
    }
  }
}

TEST_CASE("solid: viscous hourglass control of a cube by hand", "[fe]") {
  // The stiffness k_h over the time a/c that a wave takes across the cube.
  const double dt = 1e-7;
  Solid s = lattice(1, 0);
  SolidSection section = inviscid;
  section.viscous_hourglass = true;
  SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, section);
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 at = xyz(s.nodes.x[i]) / 0.05 - Vec3::Ones();
    s.nodes.v[i].y = at.x() * at.z();
  }
  const ElementWork work = solid_pass(block, s.nodes, dt);
  const double k_h = 8 * 0.05 * 1.2e6 * 1.5 * 0.1;
  const double C = k_h * 0.1 / std::sqrt(1.2e6 / 1000);
  CHECK(s.nodes.f[0].y == Approx(-C / 8).epsilon(1e-5));
  CHECK(work.hourglass == Approx(C * dt).epsilon(1e-5));
}

TEST_CASE("solid: forces keep momentum and angular momentum, and are the gradient of the work",
          "[fe]") {
  const int points = GENERATE(1, 8);
  for (const Isa set : sets()) {
    Solid s = lattice(3, 0.02);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, with_points(points));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Line& v : s.nodes.v) set_xyz(v, 10 * Vec3(u(random), u(random), u(random)));
    const double dt = 1e-5;
    solid_pass(block, s.nodes, dt, set);
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      force += xyz(s.nodes.f[i]);
      moment += xyz(s.nodes.x[i]).cross(xyz(s.nodes.f[i]));
      scale += xyz(s.nodes.f[i]).norm();
    }
    CHECK(force.norm() < 1e-13 * scale);
    CHECK(moment.norm() < 1e-13 * scale);
    // Steps so small that nothing moves: the work is -f . v dt.
    const double tiny = 1e-14;
    solid_pass(block, s.nodes, tiny, set);
    for (Line& f : s.nodes.f) f = {};
    const ElementWork work = solid_pass(block, s.nodes, tiny, set);
    double power = 0;
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      power -= xyz(s.nodes.f[i]).dot(xyz(s.nodes.v[i]));
    }
    CHECK((work.internal + work.hourglass + work.viscous) / tiny == Approx(power).epsilon(1e-6));
  }
}

TEST_CASE("solid: yields on the surface of von Mises", "[fe]") {
  const ElasticPlastic metal{.rho = 1000, .E = 1e6, .nu = 0.25, .sigma_y = 500, .H = 1e4};
  Solid s = lattice(1, 0);
  SolidBlock block =
      make_solid_block(s.cells, s.nodes.x, metal, with_points(GENERATE(1, 8), inviscid));
  // Simple shear: tau = G gamma up to sigma_y/sqrt(3), then hardening.
  Mat3 L = Mat3::Zero();
  L(0, 1) = 1;
  linear_motion(s.nodes, L);
  const double gamma = 2e-3;
  ElementWork work;
  for (int k = 0; k < 100; ++k) {
    const ElementWork w = solid_pass(block, s.nodes, gamma / 100);
    work.internal += w.internal;
    work.plastic += w.plastic;
  }
  // G gamma - 3 G eps_p/sqrt(3)... : sqrt(3) tau = sigma_y + H eps_p, tau = G (gamma - sqrt(3)
  // eps_p)
  const double G = 4e5;
  const double eps_p = (std::sqrt(3.0) * G * gamma - 500) / (3 * G + 1e4);
  CHECK(stress_at(block, 0).xy == Approx((500 + 1e4 * eps_p) / std::sqrt(3.0)).epsilon(1e-3));
  CHECK(block.value(0, block.layout.plastic_strain(0)) == Approx(eps_p).epsilon(1e-3));
  CHECK(work.plastic == Approx(1e-3 * eps_p * (500 + 0.5e4 * eps_p)).epsilon(1e-3));
  const double tau = G * (gamma - std::sqrt(3.0) * eps_p);
  CHECK(work.internal == Approx(work.plastic + 1e-3 * 0.5 * tau * tau / G).epsilon(1e-3));
}

TEST_CASE("solid: a stressed element that is turned keeps its stress", "[fe]") {
  // Chords turn by theta exactly: the midpoint spin is 2 tan(theta/2)/dt.
  const int points = GENERATE(1, 8);
  for (const int steps : {100, 1000}) {
    Solid s = lattice(1, 0.02, 3);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, with_points(points, inviscid));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Line& v : s.nodes.v) set_xyz(v, Vec3(u(random), u(random), u(random)));
    solid_pass(block, s.nodes, 1e-4);
    const Symmetric<double> before = stress_at(block, 0);
    const auto hourglass2 = [&] {
      double sum = 0;
      for (int k = block.layout.hourglass(); k < block.layout.n_values(); ++k) {
        sum += block.value(0, k) * block.value(0, k);
      }
      return sum;
    };
    const double Q2 = hourglass2();
    const Vec3 axis = Vec3(1, 2, 2) / 3;
    const double theta = 2 * std::numbers::pi / steps;
    const Mat3 R = Eigen::AngleAxisd(theta, axis).toRotationMatrix();
    const double dt = 1e-3;
    ElementWork work;
    for (int k = 0; k < 10 * steps; ++k) {
      for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 x = xyz(s.nodes.x[i]);
        set_xyz(s.nodes.v[i], (R * x - x) / dt);
        set_xyz(s.nodes.x[i], R * x);
      }
      const ElementWork w = solid_pass(block, s.nodes, dt);
      work.internal += w.internal;
      work.hourglass += w.hourglass;
    }
    const Symmetric<double> after = stress_at(block, 0);
    const double scale = std::sqrt(contraction(before, before));
    CHECK(std::abs(after.xx - before.xx) < 1e-9 * scale);
    CHECK(std::abs(after.yz - before.yz) < 1e-9 * scale);
    CHECK(std::abs(after.zx - before.zx) < 1e-9 * scale);
    CHECK(hourglass2() == Approx(Q2).epsilon(1e-9));
    CHECK(std::abs(work.internal + work.hourglass) < 1e-9 * scale * 1e-3);
  }
}

TEST_CASE("solid: the bound of the frequency of a cube and of a slab", "[fe]") {
  // A cube of side a: 8 (a/2)/(rho a^3 a^3) ... by hand, omega^2 = 8 g 3 K/(M V), g = a^4/2.
  Solid s = lattice(1, 0);
  SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft,
                                      {.hourglass_coefficient = 0,
                                       .linear_viscosity = 0,
                                       .quadratic_viscosity = 0,
                                       .dt_factor = 1});
  solid_pass(block, s.nodes, 0);
  const double K = 1e6 / 1.5;
  CHECK(block.omega2 == Approx(4 * 3 * K / (1000 * 0.01)).epsilon(1e-9));
  // A slab 100 times thinner than wide: the thickness over the speed of sound.
  Solid slab = bricks({1, 1, 1}, [](int i, int j, int k) { return Vec3(i, j, 0.01 * k); });
  SolidBlock thin = make_solid_block(slab.cells, slab.nodes.x, soft,
                                     {.hourglass_coefficient = 0,
                                      .linear_viscosity = 0,
                                      .quadratic_viscosity = 0,
                                      .dt_factor = 1});
  solid_pass(thin, slab.nodes, 0);
  CHECK(stable_step(thin) == Approx(0.01 / std::sqrt(1.2e6 / 1000)).epsilon(1e-3));
}

TEST_CASE("solid: the same bits for any number of threads", "[fe]") {
  const int points = GENERATE(1, 8);
  const auto forces = [points](int n_threads) {
    set_threads(n_threads);
    Solid s = lattice(12, 0.02);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, with_points(points), 64);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Line& v : s.nodes.v) set_xyz(v, Vec3(u(random), u(random), u(random)));
    const ElementWork work = solid_pass(block, s.nodes, 1e-5);
    std::vector<double> out{work.internal, work.hourglass, work.viscous, block.omega2};
    for (const Line& f : s.nodes.f) out.insert(out.end(), {f.x, f.y, f.z});
    set_threads(0);
    return out;
  };
  const std::vector<double> one = forces(1);
  for (const int n : {2, 3, 5}) CHECK(forces(n) == one);
}

TEST_CASE("solid: eight points see every pattern, and a nearly incompressible solid does not lock",
          "[fe]") {
  // The bending pattern u_y = xi zeta of a cube of side a, u = v dt at the corners. Its gradients
  // are u_y,x = 2 zeta/a and u_y,z = 2 xi/a, no normal strain, so the energy is that of shear
  // alone: 1/2 G (4/a^2) (1/3 + 1/3) a^3 = (4/3) G a u^2, whatever the bulk modulus.
  const double dt = 1e-9;
  for (const double nu : {0.0, 0.25, 0.4999}) {
    const ElasticPlastic m{.rho = 1000, .E = 1e6, .nu = nu};
    Solid s = lattice(1, 0);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, m, with_points(8, inviscid));
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 at = xyz(s.nodes.x[i]) / 0.05 - Vec3::Ones();
      s.nodes.v[i].y = at.x() * at.z();
    }
    const ElementWork work = solid_pass(block, s.nodes, dt);
    CHECK(work.internal == Approx(4.0 / 3 * m.G() * 0.1 * dt * dt).epsilon(1e-6));
    // u_x = xi zeta has e_xx = 2 zeta/a with dev(e) : e = (2/3) 4 zeta^2/a^2, and the shear 2 xi/a;
    // its mean dilatation is 0, so that nothing depends on K.
    for (std::size_t i = 0; i < 8; ++i) {
      s.nodes.v[i].x = s.nodes.v[i].y;
      s.nodes.v[i].y = 0;
    }
    SolidBlock fresh = make_solid_block(s.cells, s.nodes.x, m, with_points(8, inviscid));
    const ElementWork bent = solid_pass(fresh, s.nodes, dt);
    const double energy = m.G() * (2.0 / 3 * 4 / 3) * 0.1 + 0.5 * m.G() * (4.0 / 3) * 0.1;
    CHECK(bent.internal == Approx(energy * dt * dt).epsilon(1e-6));
  }
}

TEST_CASE("solid: a quadrilateral in plane strain is a brick one unit thick", "[fe]") {
  const int points = GENERATE(1, 8);
  const double yield = GENERATE(0.0, 2e3);
  ElasticPlastic metal = soft;
  metal.sigma_y = yield;
  metal.H = 1e4;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Vec3> flat;
  for (int k = 0; k < 20; ++k) {
    flat.emplace_back(0.1 * (k % 5) + 0.02 * u(random), 0.1 * (k / 5) + 0.02 * u(random), 0);
  }
  Solid thick = bricks({4, 3, 1}, [&](int i, int j, int k) {
    return Vec3(flat[static_cast<std::size_t>(5 * j + i)] + Vec3(0, 0, k));
  });
  std::vector<Index> quads;
  for (std::size_t c = 0; c < thick.cells.size(); c += 8) {
    quads.insert(quads.end(), thick.cells.begin() + static_cast<std::ptrdiff_t>(c),
                 thick.cells.begin() + static_cast<std::ptrdiff_t>(c) + 4);
  }
  Solid thin = solid_of(flat, quads);
  // Bulk viscosity and hourglass control look at the size of an element, which has no thickness.
  SolidSection section = with_points(points, inviscid);
  section.hourglass_coefficient = 0;
  SolidBlock bricks_block = make_solid_block(thick.cells, thick.nodes.x, metal, section);
  section.shape = SolidShape::quadrilateral;
  SolidBlock block = make_solid_block(thin.cells, thin.nodes.x, metal, section);
  const double dt = 1e-4;
  for (std::size_t i = 0; i < 20; ++i) {
    const Vec3 v(5 * u(random), 5 * u(random), 0);
    for (Line* line : {&thin.nodes.v[i], &thick.nodes.v[i], &thick.nodes.v[i + 20]}) {
      set_xyz(*line, v);
    }
  }
  for (int step = 0; step < 3; ++step) {
    for (Solid* s : {&thin, &thick}) {
      for (std::size_t i = 0; i < s->nodes.x.size(); ++i) {
        set_xyz(s->nodes.f[i], Vec3::Zero());
        add_xyz(s->nodes.x[i], dt * xyz(s->nodes.v[i]));
      }
    }
    const ElementWork of_thin = solid_pass(block, thin.nodes, dt);
    const ElementWork of_thick = solid_pass(bricks_block, thick.nodes, dt);
    CHECK(of_thin.internal == Approx(of_thick.internal).epsilon(1e-10));
    CHECK(of_thin.plastic == Approx(of_thick.plastic).epsilon(1e-10));
    CHECK((yield == 0 || of_thin.plastic > 0));
  }
  double worst = 0;
  double largest = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    const Vec3 both = xyz(thick.nodes.f[i]) + xyz(thick.nodes.f[i + 20]);
    worst = std::max(worst, (xyz(thin.nodes.f[i]) - both).norm());
    largest = std::max(largest, both.norm());
    CHECK(thin.nodes.f[i].z == 0);
  }
  CHECK(worst < 1e-12 * largest);
}

namespace {

/// Largest squared frequency of one element, from its stiffness column by column: forces after a
/// small step of one node along one axis, over the displacement.
double exact_omega2(const std::vector<Vec3>& corners, const SolidSection& section, int dimension,
                    double& bound, const ElasticPlastic& material = soft) {
  const auto n = static_cast<int>(corners.size());
  std::vector<Index> cell;
  for (int a = 0; a < n; ++a) cell.push_back(a);
  Eigen::MatrixXd K(dimension * n, dimension * n);
  for (int column = 0; column < K.cols(); ++column) {
    Solid s = solid_of(corners, cell);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, material, section);
    add_solid_masses(block, s.nodes);
    const double dt = 1e-6;
    Vec3 v = Vec3::Zero();
    v[column % dimension] = 1;
    Line& x = s.nodes.x[static_cast<std::size_t>(column / dimension)];
    set_xyz(s.nodes.v[static_cast<std::size_t>(column / dimension)], v);
    set_xyz(x, xyz(x) + dt * v);
    solid_pass(block, s.nodes, dt);
    for (int row = 0; row < K.rows(); ++row) {
      const Vec3 f = xyz(s.nodes.f[static_cast<std::size_t>(row / dimension)]);
      K(row, column) = -f[row % dimension] / (dt * s.nodes.x[0].w);
    }
    bound = block.omega2;
  }
  const Eigen::MatrixXd even = 0.5 * (K + K.transpose());
  return even.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
}

}  // namespace

TEST_CASE("solid: the bound of the frequency of an element holds and is near", "[fe]") {
  double bound = 0;
  for (const double skew : {0.0, 0.03}) {
    for (const int points : {1, 8}) {
      SolidSection section = with_points(points, inviscid);
      section.shape = SolidShape::quadrilateral;
      const double exact = exact_omega2(
          {{0, 0, 0}, {0.2, 0, 0}, {0.2 + skew, 0.1, 0}, {skew, 0.1, 0}}, section, 2, bound);
      CHECK(bound >= 0.9999 * exact);
      CHECK(bound < 1.6 * exact);
    }
    const double exact = exact_omega2({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {skew, 0.02, 0.05}},
                                      of_tetrahedra, 3, bound);
    CHECK(bound >= 0.9999 * exact);
    CHECK(bound < 1.6 * exact);
  }
}

TEST_CASE("solid: the bound of the frequency holds where Poisson's ratio is below 0", "[fe]") {
  const ElasticPlastic auxetic{.rho = 1000, .E = 1e6, .nu = -0.4};
  const Solid cube = lattice(1, 0);
  std::vector<Vec3> corners;
  for (const Index node : cube.cells) {
    corners.push_back(xyz(cube.nodes.x[static_cast<std::size_t>(node)]));
  }
  for (const int points : {1, 8}) {
    double bound = 0;
    const double exact = exact_omega2(corners, with_points(points, inviscid), 3, bound, auxetic);
    CHECK(bound >= 0.9999 * exact);
  }
}

TEST_CASE("solid: bricks are cut into tetrahedra that meet", "[fe]") {
  const VolumeMesh rod = rod_volume({0, 0, 0}, {0, 0, 1}, 0.3, {2, 2, 3});
  const VolumeMesh mesh = tetrahedra_of(rod);
  REQUIRE(mesh.cells.size() == 3 * rod.cells.size());
  double volume = 0;
  std::map<std::array<Index, 3>, int> faces;
  for (std::size_t c = 0; c < mesh.cells.size(); c += 4) {
    const auto p = [&](std::size_t a) {
      return mesh.points[static_cast<std::size_t>(mesh.cells[c + a])];
    };
    const double one = (p(1) - p(0)).dot((p(2) - p(0)).cross(p(3) - p(0))) / 6;
    CHECK(one > 0);
    volume += one;
    for (std::size_t left = 0; left < 4; ++left) {
      std::array<Index, 3> face{};
      for (std::size_t a = 0; a < 3; ++a) face[a] = mesh.cells[c + (left + 1 + a) % 4];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  // Two triangles on each of the 8 + 12 faces of each end and of the 3 layers of 8 around.
  int outside = 0;
  for (const auto& [face, count] : faces) {
    CHECK(count <= 2);
    outside += count == 1 ? 1 : 0;
  }
  CHECK(outside == 2 * (2 * 20 + 3 * 8));
  CHECK(volume == Approx(4 * 0.09 * std::sin(std::numbers::pi / 4)).epsilon(1e-12));
}

TEST_CASE("solid: tetrahedra pass the patch test, and their mean stress is K ln J", "[fe]") {
  Mat3 L;
  L << 1e-3, 2e-3, -1e-3, 0, -2e-3, 3e-3, 4e-3, 1e-3, 2e-3;
  for (const Isa set : sets()) {
    Solid s = tetrahedra(3, 0.02);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, of_tetrahedra);
    linear_motion(s.nodes, L);
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      set_xyz(s.nodes.x[i], xyz(s.nodes.x[i]) + xyz(s.nodes.v[i]));
    }
    solid_pass(block, s.nodes, 1, set);
    const double K = 1e6 / 1.5;
    const Symmetric<double> first = stress_at(block, 0);
    // What Hooke says, but for squares of the strain.
    CHECK(first.xy == Approx(4e5 * 2e-3).epsilon(1e-2));
    for (Index e = 0; e < block.n_elements; ++e) {
      const Symmetric<double> sigma = stress_at(block, e);
      CHECK(sigma.xx + sigma.yy + sigma.zz ==
            Approx(3 * K * std::log((Mat3::Identity() + L).determinant())).epsilon(1e-10));
      CHECK(sigma.xx == Approx(first.xx).epsilon(1e-10));
      CHECK(sigma.xy == Approx(first.xy).epsilon(1e-10));
      CHECK(sigma.zx == Approx(first.zx).epsilon(1e-10));
    }
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      const Vec3 x = xyz(s.nodes.x[i]);
      const bool inner = (x.array() > 0.05).all() && (x.array() < 0.25).all();
      if (inner) CHECK(xyz(s.nodes.f[i]).norm() < 1e-10 * 10);
    }
  }
}

TEST_CASE("solid: tetrahedra keep momentum, and their forces are the gradient of the work",
          "[fe]") {
  for (const Isa set : sets()) {
    Solid s = tetrahedra(3, 0.02);
    SolidSection section = of_tetrahedra;
    section.linear_viscosity = 0.06;
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, section);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Line& v : s.nodes.v) set_xyz(v, Vec3(u(random), u(random), u(random)));
    // To a strained state, then a small step onward: the work is that of the mean force.
    const double dt = 1e-3;
    ElementWork work;
    Array<Line> before;
    for (const double h : {dt, 1e-3 * dt, 1e-3 * dt}) {
      before = s.nodes.f;
      for (Line& f : s.nodes.f) f = {};
      for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
        set_xyz(s.nodes.x[i], xyz(s.nodes.x[i]) + h * xyz(s.nodes.v[i]));
      }
      work = solid_pass(block, s.nodes, h, set);
    }
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    double done = 0;
    for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
      const Vec3 f = xyz(s.nodes.f[i]);
      force += f;
      moment += xyz(s.nodes.x[i]).cross(f);
      scale += f.norm();
      done -= 1e-3 * dt * 0.5 * (f + xyz(before[i])).dot(xyz(s.nodes.v[i]));
    }
    CHECK(force.norm() < 1e-13 * scale);
    CHECK(moment.norm() < 1e-13 * scale);
    CHECK(work.internal + work.viscous == Approx(done).epsilon(1e-5));
  }
}

TEST_CASE("solid: the mean stress of a tetrahedron is that of the volumes around its nodes",
          "[fe]") {
  Solid s = tetrahedra(2, 0.01);
  SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, of_tetrahedra);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (std::size_t i = 0; i < s.nodes.x.size(); ++i) {
    set_xyz(s.nodes.v[i], 0.005 * Vec3(u(random), u(random), u(random)));
    set_xyz(s.nodes.x[i], xyz(s.nodes.x[i]) + xyz(s.nodes.v[i]));
  }
  solid_pass(block, s.nodes, 1);
  std::vector<double> now(s.nodes.x.size());
  std::vector<double> start(s.nodes.x.size());
  for (Index e = 0; e < block.n_elements; ++e) {
    for (int a = 0; a < 4; ++a) {
      const auto node = static_cast<std::size_t>(s.cells[static_cast<std::size_t>(4 * e + a)]);
      now[node] += volume_of(block, e, s.nodes.x);
      start[node] += 1 / block.value(e, block.layout.inverse_volume());
    }
  }
  const double K = 1e6 / 1.5;
  for (Index e = 0; e < block.n_elements; ++e) {
    double sum = 0;
    for (int a = 0; a < 4; ++a) {
      const auto node = static_cast<std::size_t>(s.cells[static_cast<std::size_t>(4 * e + a)]);
      sum += std::log(now[node] / start[node]);
    }
    const Symmetric<double> sigma = stress_at(block, e);
    CHECK((sigma.xx + sigma.yy + sigma.zz) / 3 == Approx(K * sum / 4).epsilon(1e-9).margin(1e-6));
  }
}

TEST_CASE("solid: hourglass stiffness of a square in plane strain by hand", "[fe]") {
  // Side 0.1 m: tr G = V = a^2, so k_h = 8 kappa (lambda + 2 mu) = 0.4 1.2e6 N/m; at u = 1e-5 m
  // in the pattern Q = k_h u, a quarter of it on each corner.
  SolidSection section = with_points(1, inviscid);
  section.shape = SolidShape::quadrilateral;
  Solid s = solid_of({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}, {0, 1, 2, 3});
  SolidBlock block = make_solid_block(s.cells, s.nodes.x, soft, section);
  const double dt = 1e-9;
  for (std::size_t i = 0; i < 4; ++i) s.nodes.v[i].x = i % 2 == 0 ? 1e4 : -1e4;
  const ElementWork work = solid_pass(block, s.nodes, dt);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(s.nodes.f[i].x == Approx(i % 2 == 0 ? -1.2 : 1.2).epsilon(1e-3));
  }
  CHECK(work.hourglass == Approx(0.5 * 4.8 * 1e-5).epsilon(1e-3));
}
