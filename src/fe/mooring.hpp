// Mooring lines: cable elements from an anchor to a fairlead, in water and on a sea bed, with two
// ends that are held or moved.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/function.hpp"
#include "fe/mooring_kernel.hpp"
#include "fe/truss.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Water around a line; coefficients as in Morison's equation for a cylinder of the line's
/// diameter: drag across on d l, along on pi d l, added mass on the displaced water.
struct LineWater {
  double density = 0;  ///< [kg/m^3]; 0: none
  double level = 0;    ///< of the surface [m]
  double Cdn = 1.2;
  double Cdt = 0;
  double Can = 1;
  double Cat = 0;
  bool flows = false;
  VectorFunction current;  ///< velocity of the water [m/s]
};

/// A flat sea bed.
struct LineBed {
  bool there = false;
  double level = 0;      ///< [m]
  double stiffness = 0;  ///< push per area d l and depth [N/m^3]
  double damping = 0;    ///< the same per velocity [N s/m^3]
  double friction = 0;   ///< coefficient of Coulomb
};

/// One end of a line.
struct LineEnd {
  Vec3 at = Vec3::Zero();  ///< at the start [m]
  bool held = true;        ///< else others say how it moves
  VectorFunction way;      ///< from there, where it is moved [m]
  Index node = -1;
  Vec3 force = Vec3::Zero();     ///< of the line on what holds it, at this level [N]
  Vec3 reaction = Vec3::Zero();  ///< of what holds it [N]
};

/// A line. Ends and nodes are counted from the anchor ("to") to the upper end ("from").
struct MooringLine {
  std::string name;
  Location where;
  std::string material;  ///< of its cable elements, where one is named
  TrussBlock block;
  double length = 0;    ///< unstretched [m]
  double diameter = 0;  ///< of a cylinder that displaces as much water [m]
  int n = 0;            ///< elements
  LineWater water;
  LineBed bed;
  std::array<LineEnd, 2> ends;  ///< anchor, upper end

  Array<Index> nodes;          ///< by blocks: before, node, after (LinePass::nodes)
  Array<double> state;         ///< fe/mooring_kernel.hpp
  Array<double> stuck;         ///< tracked: x of all lanes, then y, where friction holds them [m]
  Array<double> current;       ///< LinePass::current
  std::vector<LineSums> sums;  ///< one a chunk
  /// Tracked: largest and smallest tension at the anchor, largest and smallest at the upper end
  /// [N].
  std::array<double, 4> extremes{};
  double begun = 0;  ///< tracked: 1 after the first level

  [[nodiscard]] Index n_nodes() const { return static_cast<Index>(n) + 1; }
  [[nodiscard]] double area() const;       ///< pi d^2/4 [m^2]
  [[nodiscard]] double displaced() const;  ///< mass of water per length under water [kg/m]
};

/// All lines of a scene (scene.store.get<MooringLines>()); addresses never change.
struct MooringLines {
  std::deque<MooringLine> list;
};

/// Node k, counted from the anchor, of a line whose arrays are set up.
Index node_of(const MooringLine& line, Index k);

/// Sets up the arrays over the nodes, given from the anchor to the upper end.
void set_line_nodes(MooringLine& line, const std::vector<Index>& nodes);

/// Height at which the bed begins to push: level + s/2, where s = w/k is how far a line that lies
/// sinks in, so that it lies at level - s/2. Along a line under the tension T that is lifted off, T
/// z'' = w
/// - k p: it leaves the bed with the slope sqrt(w s/T) at p = 0, and the parabola that goes on from
/// there has its lowest point s/2 below, at the level: the line above is that of a rigid bed. g:
/// gravity, downwards [m/s^2].
double pushing_level(const MooringLine& line, double g);

/// Adds to nodes.f what water and bed do to the nodes of a line at level n, on the way to the kick
/// over (dt_old + dt)/2 with all other forces in f:
///   buoyancy  -rho A l s g, s the share of the node's length l that is under water
///   drag      -rho d l s/2 C_dn |v_n| v_n - rho pi d l s/2 C_dt |v_t| v_t, v against the water,
///             split by the direction t from the node before to the node after
///   added mass -rho A l s (C_an (1 - t t') + C_at t t') a
///   bed       (k z_p - c v_z)_+ upwards, z_p the depth, and friction -k (x - x_stuck) - c v along
///             it, at most mu times the push
/// where a, the acceleration that follows, is that of (m + M_a + C tau) a = f - C v(n-1/2): drag is
/// taken at the mean of the velocities before and after the kick, C = rho d l s/2 C_dn |v_n| at
/// v(n-1/2), which is stable for any step. The motion of the two ends is given by others: they
/// carry no added mass, and drag at v(n-1/2); ends that are held do not lie on the bed. Then f is
/// the whole force on a node but for the reaction of what holds it. Morison et al. 1950; lumped as
/// by Hall and Goupee 2015 (Ocean Eng. 104, 590-603).
void line_forces(MooringLine& line, Nodes& nodes, const Vec3& gravity, const Step& step);

/// Work of these forces along the paths of the nodes, after the kick [J].
LineSums line_work(MooringLine& line, Nodes& nodes, const Vec3& gravity, const Step& step);

/// The step that the spring and the damper of the bed allow beside what else acts [s].
double bed_step(const MooringLine& line);

/// Gives the ends that are held the velocity of their way over the step, after the kick; notes the
/// reactions and adds them to f.
void hold_ends(MooringLine& line, Nodes& nodes, const Step& step);

}  // namespace gannet
