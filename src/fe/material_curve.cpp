#include "fe/material_curve.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/math.hpp"
#include "fe/shell.hpp"
#include "fe/solid.hpp"

namespace gannet {

namespace {

/// Logarithmic strains along the axes, or shear alone.
struct Strain {
  double x = 0, y = 0, z = 0, gamma = 0;
};

/// Where the point that was at X is [m].
Vec3 place_of(const Vec3& X, const Strain& s) {
  return {std::exp(s.x) * X.x() + s.gamma * X.y(), std::exp(s.y) * X.y(), std::exp(s.z) * X.z()};
}

constexpr Index n_cube_corners = 8;
constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                              {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// Cauchy stress along the axes [Pa] and the history of the point.
struct Answer {
  double xx = 0, yy = 0, zz = 0, xy = 0;
  double plastic_strain = 0, heating = 0, damage = 0;
};

/// A unit cube or a unit square and its block, without bulk viscosity.
struct Element {
  bool is_shell = false;
  Nodes nodes;
  SolidBlock solid;
  ShellBlock shell;

  Element(const ElasticPlastic& material, bool as_shell) : is_shell(as_shell) {
    const Index n = is_shell ? 4 : n_cube_corners;
    nodes.n_owned = n;
    nodes.rotating = {0, is_shell ? n : 0};
    for (auto* lines : {&nodes.x, &nodes.v, &nodes.f}) lines->assign(n, {});
    if (is_shell) {
      for (auto* lines : {&nodes.omega, &nodes.torque}) lines->assign(n, {});
    }
    std::vector<Index> cell;
    for (Index i = 0; i < n; ++i) {
      cell.push_back(i);
      set_xyz(nodes.x[i], start_of(i));
    }
    if (is_shell) {
      shell = make_shell_block(cell, nodes.x, material, {.thickness = 0.01, .points = 1});
    } else {
      solid = make_solid_block(
          cell, nodes.x, material,
          {.viscous_hourglass = true, .linear_viscosity = 0, .quadratic_viscosity = 0});
    }
  }

  static Vec3 start_of(Index i) {
    return {double(corner[i][0]), double(corner[i][1]), double(corner[i][2])};
  }

  /// Leads the element to s within dt [s].
  Answer lead(const Strain& s, double dt) {
    for (Index i = 0; i < nodes.n_owned; ++i) {
      const Vec3 next = place_of(start_of(i), s);
      set_xyz(nodes.v[i], (next - xyz(nodes.x[i])) / dt);
      set_xyz(nodes.x[i], next);
    }
    if (is_shell) {
      shell_pass(shell, nodes, dt);
      const PlaneStress<double> stress = stress_at(shell, 0, 0);
      return with_history(shell, 3, shell.constants.history, {stress.xx, stress.yy, 0, stress.xy});
    }
    solid_pass(solid, nodes, dt);
    const Symmetric<double> stress = stress_at(solid, 0);
    return with_history(solid, 6, solid.constants.history,
                        {stress.xx, stress.yy, stress.zz, stress.xy});
  }

 private:
  template <class Block>
  static Answer with_history(const Block& block, int first, const J2History& h, Answer a) {
    if (!block.material.plastic()) return a;
    a.plastic_strain = block.value(0, first);
    if (h.temperature >= 0) a.heating = block.value(0, first + h.temperature);
    if (h.damage >= 0) a.damage = block.value(0, first + h.damage);
    return a;
  }
};

/// The strain of the path at `e`, its free sides at `side`.
Strain strain_of(const CurvePlan& plan, double e, double side) {
  switch (plan.path) {
    case StrainPath::uniaxial:
      return {e, side, plan.shell ? 0 : side, 0};
    case StrainPath::biaxial:
      return {e, e, plan.shell ? 0 : side, 0};
    case StrainPath::plane:
      return {e, 0, plan.shell ? 0 : side, 0};
    case StrainPath::uniaxial_strain:
      return {e, 0, 0, 0};
    case StrainPath::shear:
      return {0, 0, 0, e};
  }
  return {};
}

/// True where a side has to be found that carries nothing; a shell sees to its thickness itself.
bool has_free_side(const CurvePlan& plan) {
  if (plan.path == StrainPath::uniaxial) return true;
  return !plan.shell && (plan.path == StrainPath::biaxial || plan.path == StrainPath::plane);
}

/// Leads the element to e with its sides free: their strain by the secant method, which `side`
/// brings from the step before and takes to the next.
Answer lead_freely(Element& element, const CurvePlan& plan, double e, double de, double dt,
                   double modulus, double& side) {
  if (!has_free_side(plan)) return element.lead(strain_of(plan, e, 0), dt);
  const bool y = plan.path == StrainPath::uniaxial;
  Answer answer;
  const auto carried = [&](double s) {
    Element next = element;
    answer = next.lead(strain_of(plan, e, s), dt);
    return y ? answer.yy : answer.zz;
  };
  double a = side - 0.3 * de;
  double fa = carried(a);
  double b = side - 0.5 * de;
  for (int k = 0; k < 60; ++k) {
    const double fb = carried(b);
    // Rounding of the strain, which the stiffness magnifies, or of the stress.
    const bool done = std::abs(fb) < 1e-10 * std::abs(answer.xx) + 1e-15 * modulus || fb == fa;
    if (done || std::abs(b - a) < 1e-16) {
      side = b;
      return element.lead(strain_of(plan, e, b), dt);
    }
    const double next = b - fb * (b - a) / (fb - fa);
    a = b;
    fa = fb;
    b = next;
  }
  throw std::runtime_error(fmt::format("no equilibrium of the free sides at strain {:.6g}", e));
}

CurvePoint point_of(const CurvePlan& plan, double e, double side, const Answer& a) {
  if (plan.path == StrainPath::shear) {
    return {e, a.xy, a.xy, a.plastic_strain, a.heating, a.damage};
  }
  // The area across x: that of a shell counts its thickness at the start.
  const Strain s = strain_of(plan, e, side);
  return {e, a.xx, a.xx * std::exp(s.y + s.z), a.plastic_strain, a.heating, a.damage};
}

}  // namespace

std::vector<CurvePoint> material_curve(const ElasticPlastic& material, const CurvePlan& plan) {
  assert(plan.rate > 0 && plan.steps > 0 && !(plan.shell && material.hyperelastic()));
  Element element(material, plan.shell);
  const double modulus = solid_law(material).bulk + material.E;
  std::vector<CurvePoint> curve{{}};
  double e = 0;
  double side = 0;
  for (const double end : plan.to) {
    const double start = e;
    for (int k = 1; k <= plan.steps; ++k) {
      const double next = start + (end - start) * k / plan.steps;
      const double de = next - e;
      if (de == 0) continue;
      const Answer a =
          lead_freely(element, plan, next, de, std::abs(de) / plan.rate, modulus, side);
      e = next;
      curve.push_back(point_of(plan, e, side, a));
      if (a.damage >= 1) return curve;
    }
  }
  return curve;
}

}  // namespace gannet
