// A block of shells: the elements of one part, their state, and one pass over them.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/isa.hpp"
#include "fe/element_blocks.hpp"
#include "fe/element_part.hpp"
#include "fe/shell_kernel.hpp"
#include "fe/stiffness_damping.hpp"
#include "material/elastic_plastic.hpp"
#include "scene/scene.hpp"

namespace gannet {

enum class HourglassForm { stiffness, viscous };

/// What makes a surface a shell.
struct ShellSection {
  ShellKind kind = ShellKind::one_point;
  double thickness = 0;  ///< [m], > 0
  int points = 5;        ///< Gauss points through the thickness, 1..7
  HourglassForm hourglass = HourglassForm::stiffness;
  double hourglass_coefficient = 0.03;  ///< r, see shell_element.hpp
  double shear_factor = 5.0 / 6.0;      ///< kappa
  bool thickness_changes = false;
  bool warping = true;  ///< of the one-point element: fibres, see shell_element.hpp
  double offset = 0;    ///< of the middle of the shell from its nodes, along the normal [m]
  StiffnessDamping damping;
  double smallest_ratio = 0.01;  ///< A/A0 at which an element has collapsed, > 0
  double dt_factor = 0.9;        ///< share of the stable step that is voted for
};

/// The shells of one part. Made by make_shell_block(); the state changes with every pass.
struct ShellBlock {
  std::string name;
  int part = -1;  ///< number of the part in the scene; -1 where there is none
  ElasticPlastic material;
  ShellSection section;
  ShellConstants constants;
  ShellLayout layout;
  Index n_elements = 0;
  std::vector<Index> cells;    ///< of the part that the elements are; none: in their order
  Array<Index> corners;        ///< of a block of 8 in a row: corner a of lane l at 8 a + l
  Array<double> damping_time;  ///< see ElementVotes; none: not damped
  Array<double> inverse_mass;  ///< see ElementVotes; none: no mass was added
  Array<double> state;         ///< layout.n_values() * 8 a block
  ChunkColours colouring;
  std::vector<ShellSums> sums;  ///< one a chunk, of the last pass
  double omega2 = 0;            ///< of the last pass [1/s^2]
  Index limiting = -1;          ///< the element it belongs to
  double area_ratio = 1;        ///< smallest A/A0 of the last pass
  Index smallest = -1;          ///< the element it belongs to
  Array<double> stress_shown;   ///< 6 an element, filled by show_stress() [Pa]
  Array<double> plastic_shown;  ///< largest eps_p over the points [-]
  Array<double> damage_shown;   ///< largest damage over the points [-]
  Array<double> forces_shown;   ///< 15 an element, filled by show_section_forces()
  [[nodiscard]] Index cell(Index e) const {
    return cells.empty() || e < 0 ? e : cells[static_cast<std::size_t>(e)];
  }
  [[nodiscard]] int n_corners() const { return corners_per(section.kind); }
  [[nodiscard]] Index n_blocks() const { return blocks_for(n_elements); }
  /// Number k of element e.
  [[nodiscard]] double& value(Index e, int k) {
    return state[place_in_blocks(e, k, layout.n_values())];
  }
  [[nodiscard]] double value(Index e, int k) const {
    return state[place_in_blocks(e, k, layout.n_values())];
  }
};

/// All shell blocks of a scene (scene.store.get<ShellBlocks>()); addresses never change.
struct ShellBlocks {
  std::deque<ShellBlock> list;
};

/// Elements per chunk of the coloured passes.
inline constexpr Index shell_chunk = 512;

/// Sets a block up, stress-free in the positions at hand.
/// connectivity: 4 (triangles: 3) node indices an element, counter-clockwise seen from the positive
/// side. x: positions of the nodes [m]. fibre: as of fibres_of(), as many as there are indices;
/// none: those of these elements alone. Needs thickness > 0, 1 to 7 points. Throws
/// std::invalid_argument that names the element where one has no area.
ShellBlock make_shell_block(std::span<const Index> connectivity, std::span<const Line> x,
                            const ElasticPlastic& material, const ShellSection& section,
                            Index chunk = shell_chunk, std::span<const Vec3> fibre = {});

/// rho t A over the number of corners of element e [kg].
double corner_mass(const ShellBlock& block, Index e);

/// Rotary inertia of a corner of element e over its mass, alpha of add_shell_masses() [m^2].
double corner_alpha(const ShellBlock& block, Index e);

/// Adds the mass (rho t A/4, /3) and the rotary inertia (mass times alpha) of each element to its
/// corners: nodes.x.w and nodes.torque.w. alpha = max(t^2/12, A/8), of triangles A/6, replaces the
/// true t^2/12 of thin shells, so that rotations do not limit the step; what it adds acts on wave
/// lengths of the size of an element only.
void add_shell_masses(const ShellBlock& block, Nodes& nodes);

/// One pass: stress to n, forces at n added to nodes.f and nodes.torque (see shell_kernel.hpp).
/// dt_old: t(n) - t(n-1) [s]. set: instruction set. The bits depend on no number of threads.
ElementWork shell_pass(ShellBlock& block, Nodes& nodes, double dt_old, Isa set = isa());

/// The stable step after a pass [s]: dt_factor 2/omega of the element with the highest bound.
double stable_step(const ShellBlock& block);

/// Squares of the bounds of the frequencies of the elements at rest in the positions at hand
/// [1/s^2], eight a block. Changes nothing.
Array<double> bounds_of(const ShellBlock& block, const Nodes& nodes);

/// Sets the damping times up that the section asks for, from the frequencies at rest in the
/// positions at hand.
void prepare_damping(ShellBlock& block, const Nodes& nodes);

/// The n elements that allow the smallest steps in the state at hand, the smallest first, by
/// bounds_of().
std::vector<ElementStep> smallest_steps(const ShellBlock& block, const Nodes& nodes, std::size_t n);

/// Takes out the elements that have collapsed by the last pass: their thickness is 0 from now on.
/// x: positions of the nodes [m].
void erode_collapsed(ShellBlock& block, std::span<const Line> x);

/// How many elements have left the block, collapsed or with their last point failed.
Index n_eroded(const ShellBlock& block);

/// Stress of point k (0 is the lowest; points of the plane one after the other) of element e in the
/// frame of the element: xx, yy, xy [Pa].
PlaneStress<double> stress_at(const ShellBlock& block, Index e, int k);

}  // namespace gannet
