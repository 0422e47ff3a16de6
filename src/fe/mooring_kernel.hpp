// The kernel of what acts on the nodes of a mooring line besides its elements: water and sea bed.
// It is compiled once per instruction set (mooring_kernel.isa.cpp); mooring.hpp is the way to call
// it.
#pragma once

#include <cstdint>

namespace gannet {

/// Numbers of a node of a line. Number k of lane l of block b is at state[(b line_values + k) 8 +
/// l]. Empty lanes of the last block repeat its last node with a length of 0.
enum LineValue {
  line_length,    ///< unstretched length that hangs on the node: half of each element there [m]
  line_lies,      ///< the same where the bed carries it; 0 at ends that are held [m]
  line_end,       ///< 1 for the two ends, else 0
  line_buoyancy,  ///< mass of the water that it displaces at this level [kg]
  line_drag_x,    ///< drag [N]
  line_drag_y,
  line_drag_z,
  line_added_x,  ///< of the water that is carried along, against its acceleration [N]
  line_added_y,
  line_added_z,
  line_bed,         ///< push of the bed, upwards [N]
  line_friction_x,  ///< of the bed [N]
  line_friction_y,
  line_values
};

/// Everything that the passes over the nodes of a line read and write. Lines are as in
/// scene/scene.hpp.
struct LinePass {
  double displaced = 0;     ///< rho A, mass of water per length [kg/m]; 0: no water
  double drag_across = 0;   ///< rho d C_dn/2 [kg/m^2]
  double drag_along = 0;    ///< rho pi d C_dt/2 [kg/m^2]
  double added_across = 0;  ///< rho A C_an [kg/m]
  double added_along = 0;   ///< rho A C_at [kg/m]
  double level = 0;         ///< of the water [m]
  double diameter = 0;      ///< [m]
  double g[3] = {0, 0, 0};  ///< gravity [m/s^2]
  const double* current =
      nullptr;  ///< velocity of the water: 24 a block, x y z of eight lanes [m/s]
  bool bed = false;
  double bed_level = 0;       ///< below which nodes are pushed up [m]
  double bed_stiffness = 0;   ///< per length of line [N/m^2]
  double bed_damping = 0;     ///< per length of line [N s/m^2]
  double friction = 0;        ///< coefficient of Coulomb
  const double* x = nullptr;  ///< lines: position at n [m]; mass
  const double* v = nullptr;  ///< lines: velocity [m/s]; inverse mass
  double* f = nullptr;        ///< lines: force [N]
  /// 24 a block: the node before, the node, the node after. Lanes follow each other along the line.
  const std::int32_t* nodes = nullptr;
  double* state = nullptr;
  double* stuck_x = nullptr;  ///< per lane: where friction holds a node [m]
  double* stuck_y = nullptr;
  double dt_old = 0;  ///< t(n) - t(n-1) [s]
  double dt = 0;      ///< t(n+1) - t(n) [s]
};

/// Work of the forces on a line along work_path(): of the half step before the level, and of the
/// half step after it [J].
struct LineSums {
  double buoyancy[2] = {0, 0};
  double drag[2] = {0, 0};
  double current[2] = {0, 0};  ///< of the drag along the way of the water
  double added[2] = {0, 0};
  double bed[2] = {0, 0};
  double friction[2] = {0, 0};
};

/// Passes over blocks [begin, end), see line_forces() and line_work() in fe/mooring.hpp. Need valid
/// node indices in every lane, and arrays aligned to 64 bytes. Throw nothing.
namespace avx2 {
void line_force_pass(const LinePass& pass, std::int32_t begin, std::int32_t end);
void line_work_pass(const LinePass& pass, std::int32_t begin, std::int32_t end, LineSums& sums);
}  // namespace avx2
namespace avx512 {
void line_force_pass(const LinePass& pass, std::int32_t begin, std::int32_t end);
void line_work_pass(const LinePass& pass, std::int32_t begin, std::int32_t end, LineSums& sums);
}  // namespace avx512

}  // namespace gannet
