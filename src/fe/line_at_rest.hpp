// A discrete line at rest: the positions of the nodes of a chain of cable elements in which nothing
// moves, found by minimising its potential energy.
#pragma once

#include <functional>
#include <vector>

#include "base/math.hpp"

namespace gannet {

/// What one element answers to its strain: force [N], its slope [N], energy per unstretched length
/// [J/m]. All 0 for strains below 0.
struct AxialAnswer {
  double force = 0;
  double slope = 0;
  double energy = 0;
};

/// A chain whose first and last node are held.
struct ChainAtRest {
  double l0 = 0;  ///< unstretched length of each element [m]
  std::function<AxialAnswer(double strain)> law;
  std::vector<Vec3> load;  ///< on each node: weight, buoyancy, drag of a current, friction [N]
  bool bed = false;
  double bed_level = 0;               ///< below which nodes are pushed up [m]
  std::vector<double> bed_stiffness;  ///< of each node [N/m]
};

/// How far the solution came.
struct RestResult {
  bool found = false;
  int iterations = 0;
  double largest = 0;  ///< of the forces that are not in balance [N]
};

/// Moves the inner nodes from the guess x to where the potential energy
///   E = sum l0 W(strain) - sum load . x + sum k (z_bed - z)_+^2/2
/// is least. A line that carries no push and a bed that does not pull make E convex, so Newton's
/// method with halved steps gets there from any guess; elements without tension leave directions
/// without stiffness, which a trace of stiffness (1e-8 of EA/l0) holds in place.
RestResult bring_to_rest(const ChainAtRest& chain, std::vector<Vec3>& x);

/// Upward force of the bed on node k at x [N].
double bed_push(const ChainAtRest& chain, std::size_t k, const Vec3& x);

}  // namespace gannet
