// The shell kernel as the rest of the program sees it: plain data in, forces and sums out. It is
// compiled once per instruction set (shell_kernel.isa.cpp); shell.hpp is the way to call it.
#pragma once

#include <cstdint>

#include "fe/element_votes.hpp"
#include "material/j2.hpp"

namespace gannet {

inline constexpr int max_shell_points = 7;

/// What kind of element a block is made of.
enum class ShellKind {
  one_point,  ///< Belytschko, Lin and Tsay: shell_element.hpp
  quad,       ///< 2 x 2 points in the plane: shell_assumed.hpp
  triangle    ///< likewise, one point
};

constexpr int corners_per(ShellKind kind) { return kind == ShellKind::triangle ? 3 : 4; }

/// What the elements of one block have in common.
struct ShellConstants {
  PlaneStressLaw law;
  PointLaw point_law = PointLaw::elastic;
  J2Law j2;           ///< where point_law is general
  J2History history;  ///< of j2
  bool thickness_changes = false;
  bool viscous_hourglass = false;
  int n_points = 5;                      ///< through the thickness
  double point[max_shell_points] = {};   ///< z / (t/2) of the points, in (-1, 1)
  double weight[max_shell_points] = {};  ///< of the points, adding up to 1
  double shear_factor = 5.0 / 6.0;       ///< kappa
  /// Hourglass stiffness per unit of geometry (see hourglass() in shell_element.hpp) [Pa].
  double hourglass_membrane = 0;
  double hourglass_warp = 0;
  double hourglass_bending = 0;
  double inverse_wave_speed = 0;  ///< for the viscous form: sqrt(rho (1 - nu^2) / E) [s/m]
  double membrane_modulus = 0;    ///< largest eigenvalue of C: E / (1 - |nu|) [Pa]
  double nodal_mass_factor = 0;   ///< rho t0 / corners [kg/m^2]: nodal mass = factor * A0
  double thickness = 0;           ///< t0 [m]
  double offset = 0;              ///< height of the middle of the shell over its nodes [m]
  double smallest_ratio = 0.01;   ///< A/A0 at which an element has collapsed: it exerts nothing
  double smallest_alpha = 0;      ///< t0^2/12 + offset^2 [m^2]
};

/// Where the numbers of an element stand in its block: number k of lane l is at
/// state[(block * n_values + k) * 8 + l].
struct ShellLayout {
  int n_points = 5;
  int per_point = 4;  ///< sigma_xx, sigma_yy, sigma_xy [Pa] and, but where elastic, the history
  bool has_fibres = false;  ///< always but in the one-point element without warping correction
  ShellKind kind = ShellKind::one_point;
  bool damped = false;  ///< in proportion to stiffness: its forces are kept
  [[nodiscard]] int in_plane() const { return kind == ShellKind::quad ? 4 : 1; }
  /// The points above point g of the plane.
  [[nodiscard]] int stress(int g) const { return g * n_points * per_point; }
  /// sigma_xz, sigma_yz of the points of the plane [Pa]
  [[nodiscard]] int shear() const { return stress(in_plane()); }
  /// One point: Q1..Q3 [N], Q4, Q5 [N m]; triangle: G sum g_ij [N/m]
  [[nodiscard]] int hourglass() const { return shear() + 2 * in_plane(); }
  [[nodiscard]] int n_hourglass() const {
    return kind == ShellKind::one_point ? 5 : (kind == ShellKind::triangle ? 1 : 0);
  }
  /// t [m]; 0 in empty lanes and in elements that have failed
  [[nodiscard]] int thickness() const { return hourglass() + n_hourglass(); }
  [[nodiscard]] int inverse_area() const { return thickness() + 1; }  ///< 1/A0 [1/m^2]
  /// tx, ty of the corners [-], where there are fibres
  [[nodiscard]] int fibres() const { return inverse_area() + 1; }
  /// Damping forces of point g of the plane: Nxx, Nyy, Nxy [N/m], Mxx, Myy, Mxy [N], Qx, Qy [N/m]
  [[nodiscard]] int damping(int g) const {
    return fibres() + (has_fibres ? 2 * corners_per(kind) : 0) + 8 * g;
  }
  [[nodiscard]] int n_values() const { return damping(damped ? in_plane() : 0); }
};

/// Everything that a pass over blocks reads and writes. Lines are as in scene/scene.hpp.
struct ShellPass {
  const ShellConstants* constants = nullptr;
  ShellLayout layout;
  const double* x = nullptr;              ///< lines: position at n [m]
  const double* v = nullptr;              ///< lines: velocity at n-1/2 [m/s]
  const double* omega = nullptr;          ///< lines: angular velocity at n-1/2 [rad/s]
  double* f = nullptr;                    ///< lines: forces are added [N]
  double* torque = nullptr;               ///< lines: moments are added [N m]
  const std::int32_t* corners = nullptr;  ///< of a block in a row: corner a of lane l at 8 a + l
  double* state = nullptr;
  ElementVotes votes;
  double dt = 0;  ///< t(n) - t(n-1) [s]
};

/// What a pass adds up over its elements.
struct ShellSums {
  double internal = 0;        ///< [J], trapezoid of stress over the strain increment
  double plastic = 0;         ///< [J], part of it that plastic flow took
  double hourglass = 0;       ///< [J]
  double damping = 0;         ///< [J], in proportion to stiffness
  double eroded = 0;          ///< [J], left with points that failed
  double omega2 = 0;          ///< largest bound of an element's squared frequency [1/s^2]
  std::int32_t element = -1;  ///< whose it is: 8 block + lane
  /// Smallest A/A0, at n and halfway to it (quadrilaterals with four points: of their parts)
  double area_ratio = 1;
  std::int32_t smallest = -1;  ///< whose it is
};

/// One fused pass over blocks [begin, end): strain increment from v(n-1/2) in the midpoint
/// configuration x(n) - v dt/2, stress to n, forces at the geometry of n added to f and torque.
/// Needs valid node indices in every lane (empty lanes repeat an element and have thickness 0),
/// arrays aligned to 64 bytes. Throws nothing. The elements: shell_element.hpp, shell_assumed.hpp.
namespace avx2 {
void shell_force(const ShellPass& pass, std::int32_t begin, std::int32_t end, ShellSums& sums);
void shell_quad_force(const ShellPass& pass, std::int32_t begin, std::int32_t end, ShellSums& sums);
void shell_triangle_force(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                          ShellSums& sums);
}  // namespace avx2
namespace avx512 {
void shell_force(const ShellPass& pass, std::int32_t begin, std::int32_t end, ShellSums& sums);
void shell_quad_force(const ShellPass& pass, std::int32_t begin, std::int32_t end, ShellSums& sums);
void shell_triangle_force(const ShellPass& pass, std::int32_t begin, std::int32_t end,
                          ShellSums& sums);
}  // namespace avx512

}  // namespace gannet
