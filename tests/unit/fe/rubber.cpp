// Rubber in solids: curves in closed form, forces as the gradient of the energy, objectivity.
#include <catch2/catch.hpp>
#include <random>

#include "fe/solid.hpp"
#include "fe_testing.hpp"

using namespace gannet;
using namespace gannet::testing;

namespace {

ElasticPlastic rubber(const HyperelasticLaw& law) {
  ElasticPlastic m{.rho = 1100};
  m.rubber = law;
  const double mu = 2 * (law.C10 + law.C01);
  m.E = 9 * law.bulk * mu / (3 * law.bulk + mu);
  m.nu = (3 * law.bulk - 2 * mu) / (2 * (3 * law.bulk + mu));
  return m;
}

Symmetric<double> left_cauchy_green(const Mat3& F) {
  const Mat3 b = F * F.transpose();
  return {b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(1, 2), b(2, 0)};
}

Mat3 stress_of(const HyperelasticLaw& law, const Mat3& F) {
  const double J = F.determinant();
  const Symmetric<double> s = isochoric(law, left_cauchy_green(F), J).deviator;
  Mat3 S;
  S << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz;
  return S + volume_stress(law, J) * Mat3::Identity();
}

/// Lateral stretch that leaves the sides free at the stretch l.
double free_side(const HyperelasticLaw& law, double l) {
  double t = 1 / std::sqrt(l);
  for (int k = 0; k < 50; ++k) {
    const auto side = [&](double a) { return stress_of(law, Vec3(l, a, a).asDiagonal())(1, 1); };
    const double h = 1e-7 * t;
    t -= side(t) * 2 * h / (side(t + h) - side(t - h));
  }
  return t;
}

Solid block_of(double noise) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-noise, noise);
  return bricks({1, 1, 1}, [&](int i, int j, int k) {
    return Vec3(0.1 * i + u(random), 0.1 * j + u(random), 0.1 * k + u(random));
  });
}

const HyperelasticLaw neo_hookean{.C10 = 0.5e6, .bulk = 1e14};
const HyperelasticLaw mooney_rivlin{.C10 = 0.4e6, .C01 = 0.1e6, .bulk = 1e14};
const HyperelasticLaw yeoh{.C10 = 0.5e6, .C20 = -0.02e6, .C30 = 0.002e6, .bulk = 1e14};

SolidSection plain(int points) {
  return {.points = points,
          .hourglass_coefficient = 0,
          .linear_viscosity = 0,
          .quadratic_viscosity = 0};
}

}  // namespace

TEST_CASE("rubber: nominal stress over stretch as in closed form", "[fe]") {
  // Incompressible: P = 2 (l - l^-2) (W_1 + W_2/l). K = 10^8 mu leaves 1e-8 of that.
  const double stretch[] = {0.5, 0.7, 0.8, 1, 1.1, 1.2, 1.6, 2, 3};
  const double exact[3][9] = {
      {-3500000, -1340816.33, -762500, 0, 273553.719, 505555.556, 1209375, 1750000, 2888888.89},
      {-4200000, -1455743.44, -800625, 0, 268580.015, 488703.704, 1118671.88, 1575000, 2503703.7},
      {-3215625, -1305518.89, -754139.34, 0, 272939.587, 501310.507, 1140529.15, 1554000,
       2888888.89}};
  const HyperelasticLaw laws[3] = {neo_hookean, mooney_rivlin, yeoh};
  const int points = GENERATE(1, 8);
  double worst = 0;
  for (int law = 0; law < 3; ++law) {
    for (int k = 0; k < 9; ++k) {
      const double l = stretch[k];
      const double t = free_side(laws[law], l);
      for (const Isa set : sets()) {
        Solid s = block_of(0.01);
        SolidBlock block = make_solid_block(s.cells, s.nodes.x, rubber(laws[law]), plain(points));
        for (Line& x : s.nodes.x) x = {l * x.x, t * x.y, t * x.z, x.w};
        solid_pass(block, s.nodes, 0, set);
        const Symmetric<double> sigma = stress_at(block, 0, points - 1);
        const double scale = std::max(std::abs(exact[law][k]), 1e6);
        // The sides are free to the rounding of t, which K magnifies.
        worst = std::max(worst, std::abs((sigma.xx - sigma.yy) * t * t - exact[law][k]) / scale);
        CHECK(std::abs(sigma.yy) < 0.2e6);
      }
    }
  }
  CAPTURE(worst);
  CHECK(worst < 1e-7);  // 3.4e-8 reached: rounding of J times K
}

TEST_CASE("rubber: the work along a path is the change of the energy", "[fe]") {
  // A warped element on a curved way to a large, uneven deformation. One point: the energy is that
  // of its mean F; eight points: that of each, the volume's that of the whole.
  const HyperelasticLaw law{.C10 = 0.3e6, .C01 = 0.1e6, .C20 = 0.02e6, .C30 = 0.01e6, .bulk = 5e6};
  const Solid start = block_of(0.015);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-0.03, 0.03);
  std::vector<Vec3> way;
  for (int i = 0; i < 8; ++i) way.emplace_back(u(random), u(random), u(random));
  const auto place = [&](std::size_t i, double s) {
    Mat3 A;
    A << 0.8, 0.5, 0, -0.2, -0.3, 0.1, 0, 0.2, 0.1;
    const Vec3 X = xyz(start.nodes.x[i]);
    return Vec3(X + std::sin(s) * (A * X + way[i]) + (1 - std::cos(s)) * way[(i + 3) % 8]);
  };
  for (const Isa set : sets()) {
    for (const int points : {1, 8}) {
      const auto error = [&](int n) {
        Solid s = start;
        SolidBlock block = make_solid_block(s.cells, s.nodes.x, rubber(law), plain(points));
        solid_pass(block, s.nodes, 0, set);
        double work = 0;
        for (int k = 1; k <= n; ++k) {
          for (std::size_t i = 0; i < 8; ++i) {
            const Vec3 next = place(i, 1.0 * k / n);
            set_xyz(s.nodes.v[i], (next - xyz(s.nodes.x[i])) / 1e-3);
            set_xyz(s.nodes.x[i], next);
          }
          work += solid_pass(block, s.nodes, 1e-3, set).internal;
        }
        // F at the Gauss points by shape functions; the mean by its own average over 4^3 points is
        // that of dx/dX weighted with the volume at the start, which 2^3 points integrate exactly.
        const double g = 1 / std::sqrt(3.0);
        double energy = 0;
        double V0 = 0;
        Mat3 mean = Mat3::Zero();
        for (int q = 0; q < 8; ++q) {
          const Vec3 at((q & 1) != 0 ? g : -g, (q & 2) != 0 ? g : -g, (q & 4) != 0 ? g : -g);
          Mat3 dX = Mat3::Zero();
          Mat3 dx = Mat3::Zero();
          for (int a = 0; a < 8; ++a) {
            const int corner = a & 3;
            const Vec3 sign(corner == 1 || corner == 2 ? 1 : -1, corner > 1 ? 1 : -1,
                            a > 3 ? 1 : -1);
            const Vec3 h = Vec3::Ones() + at.cwiseProduct(sign);
            const Vec3 dN = 0.125 * Vec3(sign.x() * h.y() * h.z(), sign.y() * h.z() * h.x(),
                                         sign.z() * h.x() * h.y());
            const auto node = static_cast<std::size_t>(s.cells[static_cast<std::size_t>(a)]);
            dX += xyz(start.nodes.x[node]) * dN.transpose();
            dx += xyz(s.nodes.x[node]) * dN.transpose();
          }
          const Mat3 F = dx * dX.inverse();
          const double det0 = dX.determinant();
          V0 += det0;
          mean += det0 * F;
          energy += det0 * isochoric(law, left_cauchy_green(F), F.determinant()).energy;
        }
        if (points == 1) {
          const Mat3 F = mean / V0;
          const double J = F.determinant();
          energy = V0 * (isochoric(law, left_cauchy_green(F), J).energy + volume_energy(law, J));
        } else {
          energy += V0 * volume_energy(law, volume_of(block, 0, s.nodes.x) / V0);
        }
        CHECK(energy > 10);
        return work / energy - 1;
      };
      const double coarse = error(200);
      const double fine = error(400);
      CAPTURE(points, coarse, fine);
      CHECK(std::abs(fine) < 1e-5);
      CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.1));
    }
  }
}

TEST_CASE("rubber: stress turns with the element to rounding, and the start carries none", "[fe]") {
  const HyperelasticLaw law{.C10 = 0.3e6, .C01 = 0.1e6, .C20 = 0.02e6, .C30 = 0.01e6, .bulk = 5e6};
  const int points = GENERATE(1, 8);
  for (const Isa set : sets()) {
    Solid s = block_of(0.015);
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, rubber(law), plain(points));
    solid_pass(block, s.nodes, 0, set);
    for (const Line& f : s.nodes.f) CHECK(xyz(f).norm() < 1e-13 * 1e6 * 0.01);
    Mat3 F;
    F << 1.8, 0.5, 0, -0.2, 0.7, 0.1, 0, 0.2, 1.1;
    const Mat3 Q = Eigen::AngleAxisd(2.5, Vec3(1, -2, 2) / 3).toRotationMatrix();
    std::vector<Vec3> forces;
    Mat3 stresses[2];
    for (const bool turned : {false, true}) {
      Solid t = s;
      for (Line& x : t.nodes.x) set_xyz(x, (turned ? Mat3(Q * F) : F) * xyz(x));
      for (Line& f : t.nodes.f) f = {};
      SolidBlock now = block;
      solid_pass(now, t.nodes, 0, set);
      const Symmetric<double> a = stress_at(now, 0);
      stresses[turned ? 1 : 0] << a.xx, a.xy, a.zx, a.xy, a.yy, a.yz, a.zx, a.yz, a.zz;
      for (const Line& f : t.nodes.f) forces.push_back(xyz(f));
    }
    const Mat3 expected = stress_of(law, F);
    CHECK((stresses[0] - expected).norm() < 1e-12 * expected.norm());
    CHECK((stresses[1] - Q * expected * Q.transpose()).norm() < 1e-12 * expected.norm());
    for (std::size_t i = 0; i < 8; ++i) {
      CHECK((forces[8 + i] - Q * forces[i]).norm() < 1e-12 * expected.norm() * 0.01);
    }
  }
}

TEST_CASE("rubber: the stable step bounds what a stretched block does", "[fe]") {
  // Largest eigenvalue of M^-1 K by power iteration on differences of forces, against the bound.
  const HyperelasticLaw law{.C10 = 0.3e6, .C01 = 0.1e6, .C20 = 0.02e6, .C30 = 0.01e6, .bulk = 5e6};
  for (const int points : {1, 8}) {
    for (const Vec3& stretch : {Vec3(1, 1, 1), Vec3(3, 0.6, 0.55), Vec3(0.4, 1.6, 1.5)}) {
      Solid s = block_of(0.005);
      SolidBlock block = make_solid_block(s.cells, s.nodes.x, rubber(law), plain(points));
      const double mass = 1100 * volume_of(block, 0, s.nodes.x) / 8;
      for (Line& x : s.nodes.x) set_xyz(x, xyz(x).cwiseProduct(stretch));
      const auto forces = [&](const std::vector<Vec3>& u, double scale) {
        Solid t = s;
        SolidBlock b = block;
        for (std::size_t i = 0; i < 8; ++i) add_xyz(t.nodes.x[i], scale * u[i]);
        solid_pass(b, t.nodes, 0);
        return t.nodes.f;
      };
      std::mt19937 random(2);
      std::uniform_real_distribution<double> uniform(-1, 1);
      std::vector<Vec3> u;
      for (int i = 0; i < 8; ++i) u.emplace_back(uniform(random), uniform(random), uniform(random));
      double largest = 0;
      for (int k = 0; k < 100; ++k) {
        double norm = 0;
        for (const Vec3& a : u) norm += a.squaredNorm();
        for (Vec3& a : u) a /= std::sqrt(norm);
        const double h = 1e-6;
        const Array<Line> plus = forces(u, h);
        const Array<Line> minus = forces(u, -h);
        largest = 0;
        for (std::size_t i = 0; i < 8; ++i) {
          const Vec3 Ku = (xyz(minus[i]) - xyz(plus[i])) / (2 * h * mass);
          largest += u[i].dot(Ku);
          u[i] = Ku;
        }
      }
      solid_pass(block, s.nodes, 0);
      CAPTURE(points, stretch.transpose(), largest, block.omega2);
      CHECK(block.omega2 > largest);
      CHECK(block.omega2 < 9 * largest);  // the sum of bounds of a very uneven element
    }
  }
}

TEST_CASE("rubber: a plane case is the solid whose faces are held", "[fe]") {
  const HyperelasticLaw law{.C10 = 0.3e6, .C01 = 0.1e6, .bulk = 5e6};
  const int points = GENERATE(1, 8);
  for (const Isa set : sets()) {
    std::vector<Vec3> corners{{0, 0, 0}, {0.1, 0.01, 0}, {0.11, 0.1, 0}, {-0.01, 0.09, 0}};
    Solid s = solid_of(corners, {0, 1, 2, 3});
    SolidSection section = plain(points);
    section.shape = SolidShape::quadrilateral;
    SolidBlock block = make_solid_block(s.cells, s.nodes.x, rubber(law), section);
    Mat3 F;
    F << 1.4, 0.3, 0, -0.2, 0.8, 0, 0, 0, 1;
    for (Line& x : s.nodes.x) set_xyz(x, F * xyz(x));
    solid_pass(block, s.nodes, 0, set);
    const Mat3 expected = stress_of(law, F);
    const Symmetric<double> sigma = stress_at(block, 0, points - 1);
    CHECK(sigma.xx == Approx(expected(0, 0)).epsilon(1e-11));
    CHECK(sigma.xy == Approx(expected(0, 1)).epsilon(1e-11));
    CHECK(sigma.zz == Approx(expected(2, 2)).epsilon(1e-11));
  }
}
