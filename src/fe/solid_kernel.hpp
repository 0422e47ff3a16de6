// The kernel of one-point solids as the rest of the program sees it: plain data in, forces and sums
// out. It is compiled once per instruction set (solid_kernel.isa.cpp); solid.hpp is the way to call
// it.
#pragma once

#include <cstdint>

#include "fe/element_votes.hpp"
#include "material/hyperelastic.hpp"
#include "material/j2.hpp"

namespace gannet {

/// What the elements of one block have in common.
struct SolidConstants {
  SolidLaw law;
  PointLaw point_law = PointLaw::elastic;
  J2Law j2;                          ///< where point_law is general
  J2History history;                 ///< of j2
  HyperelasticLaw rubber;            ///< where point_law is hyperelastic
  double hourglass_modulus = 0;      ///< that `hourglass` is a share of [Pa]
  double hourglass = 0.05;           ///< coefficient, see solid_element.hpp
  double inverse_wave_speed = 0;     ///< 1/c, c^2 = (lambda + 2 mu)/rho0 [s/m]
  double rho0 = 0;                   ///< [kg/m^3]
  double smallest_ratio = 0.01;      ///< V/V0 at which an element has collapsed: it exerts nothing
  double linear_viscosity = 0.06;    ///< C2 of the bulk viscosity [-]
  double quadratic_viscosity = 1.2;  ///< C1 [-]
};

/// Cells that solids are made of.
enum class SolidShape {
  brick,          ///< eight corners
  quadrilateral,  ///< four corners, in plane strain, one unit thick
  tetrahedron     ///< four corners; its dilatation is the mean of its nodes'
};

/// Where the numbers of an element stand in its block: number k of lane l is at
/// state[(block * n_values + k) * 8 + l].
struct SolidLayout {
  int n_history = 0;      ///< numbers of a point behind its stress: 0 elastic, 1 linear hardening
  bool remembers = true;  ///< hourglass forces are kept: control by stiffness
  int n_points = 1;       ///< 1 or 8
  SolidShape shape = SolidShape::brick;
  bool has_start = false;  ///< the shape at the start is kept
  bool damped = false;     ///< in proportion to stiffness: its stress is kept
  [[nodiscard]] bool plastic() const { return n_history > 0; }
  [[nodiscard]] bool plane() const { return shape == SolidShape::quadrilateral; }
  [[nodiscard]] bool tetrahedra() const { return shape == SolidShape::tetrahedron; }
  [[nodiscard]] int n_corners() const { return shape == SolidShape::brick ? 8 : 4; }
  [[nodiscard]] int per_point() const { return 6 + n_history; }
  /// sigma_xx, yy, zz, xy, yz, zx of a point [Pa]
  [[nodiscard]] int stress(int point) const { return point * per_point(); }
  [[nodiscard]] int plastic_strain(int point) const { return stress(point) + 6; }  ///< eps_p [-]
  [[nodiscard]] int viscous_pressure() const { return n_points * per_point(); }    ///< q [Pa]
  /// 1/V0 [1/m^3]; 0 in empty lanes and eroded elements
  [[nodiscard]] int inverse_volume() const { return viscous_pressure() + 1; }
  /// Q of the four hourglass patterns, x, y, z each [N]; where they are remembered
  [[nodiscard]] int hourglass() const { return inverse_volume() + 1; }
  /// Damping stress of a point, as stress() [Pa]
  [[nodiscard]] int damping(int point) const {
    return hourglass() + (remembers ? 12 : 0) + 6 * point;
  }
  /// The seven coefficients of the positions at the start, x, y, z each [m]; where they are kept
  [[nodiscard]] int start() const { return damping(damped ? n_points : 0); }
  /// Mean of ln(V/V0) over the nodes, of tetrahedra [-]
  [[nodiscard]] int dilatation() const { return start() + (has_start ? 21 : 0); }
  [[nodiscard]] int n_values() const { return dilatation() + (tetrahedra() ? 1 : 0); }
};

/// Everything that a pass over blocks reads and writes. Lines are as in scene/scene.hpp.
struct SolidPass {
  const SolidConstants* constants = nullptr;
  SolidLayout layout;
  const double* x = nullptr;              ///< lines: position at n [m]
  const double* v = nullptr;              ///< lines: velocity at n-1/2 [m/s]
  double* f = nullptr;                    ///< lines: forces are added [N]
  const std::int32_t* corners = nullptr;  ///< corner a of lane l at 8 a + l; 8 n_corners() a block
  double* state = nullptr;
  /// Lines, of tetrahedra: x a quarter of the volumes around a node [m^3], y of those at the start,
  /// z ln(x/y).
  double* nodal = nullptr;
  ElementVotes votes;
  double dt = 0;  ///< t(n) - t(n-1) [s]
};

/// What a pass adds up over its elements.
struct SolidSums {
  double internal = 0;         ///< [J], trapezoid of stress over the strain increment
  double plastic = 0;          ///< [J], part of it that plastic flow took
  double hourglass = 0;        ///< [J]
  double viscous = 0;          ///< [J], bulk viscosity
  double damping = 0;          ///< [J], in proportion to stiffness
  double eroded = 0;           ///< [J], left with points that failed
  double omega2 = 0;           ///< largest bound of an element's squared frequency, damped [1/s^2]
  std::int32_t element = -1;   ///< whose it is: 8 block + lane
  double volume_ratio = 1;     ///< smallest V/V0, at n and halfway to it
  std::int32_t smallest = -1;  ///< whose it is
};

/// One fused pass over blocks [begin, end): strain increment from v(n-1/2) in the midpoint
/// configuration x(n) - v dt/2, stress to n, forces at the geometry of n added to f.
/// Needs valid node indices in every lane, arrays aligned to 64 bytes. Throws nothing. The element:
/// solid_element.hpp.
/// Of tetrahedra, before solid_force(): adds their volumes at n and at the start to `nodal`.
namespace avx2 {
void solid_volumes(const SolidPass& pass, std::int32_t begin, std::int32_t end);
void solid_force(const SolidPass& pass, std::int32_t begin, std::int32_t end, SolidSums& sums);
void solid_eight_points(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                        SolidSums& sums);  ///< solid_force() of eight points
}  // namespace avx2
namespace avx512 {
void solid_volumes(const SolidPass& pass, std::int32_t begin, std::int32_t end);
void solid_force(const SolidPass& pass, std::int32_t begin, std::int32_t end, SolidSums& sums);
void solid_eight_points(const SolidPass& pass, std::int32_t begin, std::int32_t end,
                        SolidSums& sums);  ///< solid_force() of eight points
}  // namespace avx512

}  // namespace gannet
