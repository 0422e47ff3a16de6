// Curves of materials along paths of strain, against what can be said in closed form.
#include "fe/material_curve.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gannet;

namespace {

const ElasticPlastic steel{.rho = 7800, .E = 210e9, .nu = 0.3, .sigma_y = 300e6, .H = 2e9};

}  // namespace

TEST_CASE("material curve: uniaxial tension is the bilinear curve, in solids and shells", "[fe]") {
  for (const bool shell : {false, true}) {
    const auto curve = material_curve(steel, {.to = {0.05}, .steps = 200, .shell = shell});
    REQUIRE(curve.size() == 201);
    CHECK(curve[0].stress == 0);
    for (const CurvePoint& p : curve) {
      // sigma = E (e - eps_p), and sigma_y + H eps_p beyond yield. The steps are those of the
      // midpoint, e^d/2 - e^-d/2 for d = 2.5e-4: 5e-9 more.
      const double expected =
          std::min(210e9 * p.strain, 300e6 + 210e9 * 2e9 / 212e9 * (p.strain - 300e6 / 210e9));
      CHECK(p.stress == Approx(expected).epsilon(2e-8).margin(10));
      CHECK(p.plastic_strain == Approx(p.strain - p.stress / 210e9).margin(1e-9));
    }
    // Nominal: the sides have shrunk by half of the plastic strain and nu of the elastic one.
    const CurvePoint& end = curve.back();
    const double side = -0.5 * end.plastic_strain - 0.3 * end.stress / 210e9;
    const double area = shell ? side : 2 * side;
    CHECK(end.nominal == Approx(end.stress * std::exp(area)).epsilon(1e-6));
  }
}

TEST_CASE("material curve: other paths, by hand", "[fe]") {
  // Equal biaxial: s = Y + H eps_p, e = (1 - nu) s/E + eps_p/2.
  const CurvePoint b = material_curve(steel, {.path = StrainPath::biaxial, .to = {0.02}}).back();
  CHECK(b.stress == Approx(300e6 + 2e9 * b.plastic_strain).epsilon(1e-6));
  CHECK(0.02 == Approx(0.7 * b.stress / 210e9 + 0.5 * b.plastic_strain).epsilon(1e-6));
  // Uniaxial strain, elastic: K + 4 G/3.
  const CurvePoint u =
      material_curve(steel, {.path = StrainPath::uniaxial_strain, .to = {1e-3}}).back();
  CHECK(u.stress == Approx(210e9 * 0.7 / (1.3 * 0.4) * 1e-3).epsilon(1e-6));
  // Plane strain, elastic: E/(1 - nu^2).
  for (const bool shell : {false, true}) {
    const CurvePoint p =
        material_curve(steel, {.path = StrainPath::plane, .to = {1e-3}, .shell = shell}).back();
    CHECK(p.stress == Approx(210e9 / 0.91 * 1e-3).epsilon(1e-6));
  }
  // Shear of a solid, elastic: Jaumann's G sin(gamma).
  const ElasticPlastic soft{.rho = 1000, .E = 1e6, .nu = 0.25};
  const CurvePoint s =
      material_curve(soft, {.path = StrainPath::shear, .to = {2}, .steps = 2000}).back();
  CHECK(s.stress == Approx(4e5 * std::sin(2.0)).epsilon(1e-5));
}

TEST_CASE("material curve: turns round, warms and fails", "[fe]") {
  ElasticPlastic m = steel;
  m.kinematic_fraction = 1;
  const auto round = material_curve(m, {.to = {0.01, -0.01}, .steps = 1000});
  // Bauschinger: back from 300e6 + H eps_p it yields after a change of 600 MPa.
  const double forth = round[1000].stress;
  const double eps = round[1000].plastic_strain;
  for (std::size_t k = 1001; k < round.size(); ++k) {
    const bool yields = forth - round[k].stress > 600e6 * (1 + 1e-6);
    CHECK((round[k].plastic_strain > eps * (1 + 1e-9)) == yields);
    if (yields) break;
  }
  m = steel;
  m.failure.strain[0] = 0.03;
  const auto failing = material_curve(m, {.to = {0.2}, .steps = 2000});
  CHECK(failing.back().damage >= 1);
  CHECK(failing.back().stress == 0);
  CHECK(failing.back().plastic_strain == Approx(0.03).margin(1e-4));
}
