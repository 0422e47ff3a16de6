// The kernel of trusses and cables as the rest of the program sees it: plain data in, forces and
// sums out. It is compiled once per instruction set (truss_kernel.isa.cpp); truss.hpp is the way to
// call it.
#pragma once

#include <cstdint>

#include "fe/element_votes.hpp"

namespace gannet {

/// Numbers of an element. Number k of lane l of block b is at state[(b truss_values + k) 8 + l].
/// Empty lanes of the last block have no stiffness.
enum TrussValue {
  truss_l0,         ///< unstretched length [m], > 0
  truss_stiffness,  ///< K = EA/l0 [N/m]
  truss_length,     ///< at level n [m]
  truss_force,      ///< axial force at level n, damping included, tension positive [N]
  truss_damping,    ///< share of damping in it [N]
  truss_energy,     ///< strain energy at level n [J]
  truss_broken,     ///< 1 where the element has broken, else 0
  truss_values
};

/// A corner of a law: beyond this strain the force rises by so much more per strain.
struct TrussCorner {
  double strain = 0;
  double slope = 0;  ///< change of slope [N]
};

/// Everything that a pass over blocks reads and writes. Lines are as in scene/scene.hpp.
struct TrussPass {
  double EA = 0;                                ///< largest slope of the law [N]
  const TrussCorner* corners_of_law = nullptr;  ///< null: EA at every strain
  int n_corners = 0;
  double mu = 0;                          ///< mass per length [kg/m]
  bool tension_only = false;              ///< shortened elements carry nothing
  double damping_ratio = 0;               ///< zeta of each element's highest mode
  double damping_time = 0;                ///< beta, added to it [s]
  double strength = 0;                    ///< force at which an element breaks [N]; 0: never
  const double* x = nullptr;              ///< lines: position at n [m]
  double* f = nullptr;                    ///< lines: forces are added [N]
  const std::int32_t* corners = nullptr;  ///< 16 a block: end a of lane l at 8 a + l
  double* state = nullptr;
  ElementVotes votes;  ///< bounds: (2/dt)^2 of the steps dt that elements allow
  double dt = 0;       ///< t(n) - t(n-1) [s]; 0 before the first step
};

/// What a pass adds up over its elements.
struct TrussSums {
  double internal = 0;        ///< strain energy that was added [J]
  double damping = 0;         ///< work of damping [J]
  double eroded = 0;          ///< what left with elements that broke [J]
  double broken = 0;          ///< elements that have broken so far
  double rate = 0;            ///< largest 2/dt over the stable steps dt of the elements [1/s]
  std::int32_t element = -1;  ///< whose it is: 8 block + lane
};

/// One pass over blocks [begin, end), see truss_pass() in fe/truss.hpp. Needs valid node indices in
/// every lane, and state aligned to 64 bytes. Throws nothing.
namespace avx2 {
void truss_force_pass(const TrussPass& pass, std::int32_t begin, std::int32_t end, TrussSums& sums);
}
namespace avx512 {
void truss_force_pass(const TrussPass& pass, std::int32_t begin, std::int32_t end, TrussSums& sums);
}

}  // namespace gannet
