// Follower pressure: it keeps pushing along the normal of a surface that moves and turns.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/function.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Forces of a uniform pressure p on the corners of a bilinear quadrilateral, pushing along its
/// normal (right-hand rule over x[0..3]; p < 0 pushes the other way). Exact:
///   F_a = p integral N_a (x_xi cross x_eta) dxi deta,   x = x0 + b xi + c eta + d xi eta,
///   F_a = p [b cross c + (xi_a/3) b cross d + (eta_a/3) d cross c],
/// from integrating (b + d eta) cross (c + d xi) against N_a = (1 + xi_a xi)(1 + eta_a eta)/4 over
/// [-1, 1]^2. The sum is p/2 (diagonal 1 cross diagonal 2), and the forces do the work p dV on
/// whatever motion of the corners.
/// p: [Pa]; x: corners [m]; returns [N]. Throws nothing. A triangle repeats its last corner.
std::array<Vec3, 4> pressure_on_quad(double p, const std::array<Vec3, 4>& x);

/// The same on a flat triangle: p A n/3 on each corner.
std::array<Vec3, 3> pressure_on_triangle(double p, const std::array<Vec3, 3>& x);

/// One pressure on all cells of a part.
struct PressureLoad {
  std::string name;
  Location where;
  int part = 0;
  double side = -1;   ///< +1 pushes along the normals, -1 against them
  Function pressure;  ///< p(t, x), x the centre of a cell [Pa]
  /// Per cell whether it has left, which nothing pushes any more; nullptr where none can.
  const std::vector<std::uint8_t>* gone = nullptr;
  // Built by prepare():
  std::vector<Index> first;  ///< of node k of the part: entries first[k] .. first[k+1] of `corners`
  std::vector<Index> corners;  ///< cell * nodes_per(cell) + corner, in rising order
  Array<Line> corner_force;    ///< by cell and corner [N]
  Array<Line> force;           ///< by node of the part, at level n [N]; w unused
};

/// Builds the lists by which nodes gather from their cells. Needs quadrilaterals or triangles.
void prepare(PressureLoad& load, const Scene& scene);

/// Adds the forces of level n to nodes.f and keeps them in load.force. Each node gathers from its
/// cells in rising order: the same bits for any number of threads.
void add_pressure(PressureLoad& load, Scene& scene, double t);

/// Sum over nodes of force . work_path [J].
Work work_of_pressure(const PressureLoad& load, const Scene& scene, const Step& step);

/// Prepares the load and adds its operations to the model of its part.
void add_pressure_load(PressureLoad& load, Scene& scene, Models& models);

}  // namespace gannet
