// A block of one-point solids: the elements of one part, their state, and one pass over them.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/isa.hpp"
#include "fe/element_blocks.hpp"
#include "fe/element_part.hpp"
#include "fe/solid_kernel.hpp"
#include "fe/stiffness_damping.hpp"
#include "material/elastic_plastic.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What makes a volume a solid.
struct SolidSection {
  int points = 1;  ///< of integration: 1, or 8 with a mean dilatation
  SolidShape shape = SolidShape::brick;
  bool viscous_hourglass = false;       ///< else a stiffness that remembers
  double hourglass_coefficient = 0.05;  ///< kappa, see solid_element.hpp
  double linear_viscosity = 0.06;       ///< C2 of the bulk viscosity [-], 0: none
  double quadratic_viscosity = 1.5;     ///< C1 [-], 0: none
  StiffnessDamping damping;
  double smallest_ratio = 0.01;  ///< V/V0 at which an element has collapsed
  double dt_factor = 0.9;        ///< share of the stable step that is voted for
};

/// The solids of one part. Made by make_solid_block(); the state changes with every pass.
struct SolidBlock {
  std::string name;
  int part = -1;  ///< number of the part in the scene; -1 where there is none
  ElasticPlastic material;
  SolidSection section;
  SolidConstants constants;
  SolidLayout layout;
  Index n_elements = 0;
  Array<Index> corners;        ///< corner a of lane l at 8 a + l; 8 layout.n_corners() a block of 8
  Array<double> state;         ///< layout.n_values() * 8 a block
  Array<double> damping_time;  ///< see ElementVotes; none: not damped
  Array<double> inverse_mass;  ///< see ElementVotes; none: no mass was added
  Array<Line> nodal;           ///< of tetrahedra: of nodes first_nodal and on, see SolidPass
  Index first_nodal = 0;
  ChunkColours colouring;
  std::vector<SolidSums> sums;  ///< one a chunk, of the last pass
  Array<double> stress_shown;   ///< 6 an element, mean of its points, by show_state() [Pa]
  Array<double> plastic_shown;  ///< largest eps_p of its points [-]
  Array<double> damage_shown;   ///< largest damage of its points [-]
  double omega2 = 0;            ///< of the last pass [1/s^2]
  Index limiting = -1;          ///< the element it belongs to
  double volume_ratio = 1;      ///< smallest V/V0 of the last pass
  Index smallest = -1;          ///< the element it belongs to; -1 where none has shrunk
  bool erodes = false;          ///< collapsed elements leave; else they stop the run
  /// Number k of element e.
  [[nodiscard]] double& value(Index e, int k) {
    return state[place_in_blocks(e, k, layout.n_values())];
  }
  [[nodiscard]] double value(Index e, int k) const {
    return state[place_in_blocks(e, k, layout.n_values())];
  }
};

/// All solids of a scene (scene.store.get<SolidBlocks>()); addresses never change.
struct SolidBlocks {
  std::deque<SolidBlock> list;
};

/// Elements per chunk of the coloured passes.
inline constexpr Index solid_chunk = 512;

/// Sets a block up, stress-free in the positions at hand.
/// connectivity: the node indices of each element, 8, or 4 (of quadrilaterals counter-clockwise),
/// in the order of VTK. x: positions of the nodes [m]. Throws std::invalid_argument that names the
/// element where one has no volume (or a negative one).
SolidBlock make_solid_block(std::span<const Index> connectivity, std::span<const Line> x,
                            const ElasticPlastic& material, const SolidSection& section,
                            Index chunk = solid_chunk);

/// Volume of element e in the positions at hand [m^3]: exact for the trilinear map; of one unit of
/// thickness in a plane case.
double volume_of(const SolidBlock& block, Index e, std::span<const Line> x);

/// rho V0 over the number of corners of element e [kg].
double corner_mass(const SolidBlock& block, Index e);

/// Adds rho V0 over the number of corners to the mass of each corner of each element.
void add_solid_masses(const SolidBlock& block, Nodes& nodes);

/// Squares of the bounds of the frequencies of the elements at rest in the positions at hand,
/// damped as the step is [1/s^2], eight a block. Changes nothing.
Array<double> bounds_of(const SolidBlock& block, const Nodes& nodes);

/// Sets the damping times up that the section asks for, from the frequencies at rest in the
/// positions at hand, bulk viscosity left out.
void prepare_damping(SolidBlock& block, const Nodes& nodes);

/// One pass: stress to n, forces at n added to nodes.f (see solid_kernel.hpp). dt_old: t(n) -
/// t(n-1) [s]. set: instruction set. The bits depend on no number of threads.
ElementWork solid_pass(SolidBlock& block, Nodes& nodes, double dt_old, Isa set = isa());

/// The stable step after a pass [s]: dt_factor 2/omega of the element with the highest bound, the
/// damping of the bulk viscosity in it.
double stable_step(const SolidBlock& block);

/// Takes out of the block the elements that have collapsed (V/V0 at or below smallest_ratio in the
/// positions at hand, or halfway to them): they exert nothing any more, their nodes keep their
/// mass. The pass that saw them collapse has cleared their stress; the work done on them stays
/// where it was counted. Returns how many. Throws nothing.
Index erode_collapsed(SolidBlock& block, std::span<const Line> x);

/// How many elements have left the block, collapsed or with their last point failed.
Index n_eroded(const SolidBlock& block);

/// Stress of a point of element e: xx, yy, zz, xy, yz, zx [Pa].
Symmetric<double> stress_at(const SolidBlock& block, Index e, int point = 0);

/// Fills stress_shown (0 of elements that have left) and, where the material yields or fails,
/// plastic_shown and damage_shown from the state.
void show_state(SolidBlock& block);

}  // namespace gannet
