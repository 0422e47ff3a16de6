// Elastic two-node elements that carry axial force only: trusses, and cables where they carry
// tension only; damped, prestrained, and broken beyond an ultimate force where asked for.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "fe/colouring.hpp"
#include "fe/element_blocks.hpp"
#include "fe/element_part.hpp"
#include "fe/truss_kernel.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// The elements of one part: element k joins ends[2 k] and ends[2 k + 1].
struct TrussBlock {
  std::string name;
  double EA = 0;  ///< axial stiffness, or the largest slope of the law [N], > 0
  /// Force over strain in straight pieces, the first from (0, 0); none: EA at every strain.
  std::vector<TrussCorner> law;
  double mu = 0;              ///< mass per length [kg/m], > 0
  bool tension_only = false;  ///< shortened elements carry nothing (a cable)
  double dt_factor = 0.9;     ///< share of the stable step that is voted for
  double prestrain = 0;       ///< l/l0 - 1 in the positions at the start, > -1
  double unstretched = 0;     ///< l0 of every element [m]; 0: of its length and the prestrain
  double damping_ratio = 0;   ///< zeta of each element's highest mode, >= 0
  double damping_time = 0;    ///< beta, added to it [s], >= 0
  double strength = 0;        ///< force at which an element breaks [N]; 0: never
  int part = -1;              ///< number of the part in the scene; -1 where there is none
  Array<Index> ends;
  Array<Index> corners;        ///< the same by blocks (fe/element_blocks.hpp)
  Array<double> state;         ///< fe/truss_kernel.hpp
  Array<double> inverse_mass;  ///< see ElementVotes; none: no mass was added
  ChunkColours colouring;
  std::vector<TrussSums> sums;  ///< one a chunk, of the last pass
  double shortest = 0;          ///< smallest stable step of the last pass [s]
  Index limiting = -1;          ///< the element it belongs to
  Index n_broken = 0;           ///< so far
  [[nodiscard]] Index n_elements() const { return static_cast<Index>(ends.size() / 2); }
  [[nodiscard]] double value(Index e, TrussValue k) const {
    return state[place_in_blocks(e, k, truss_values)];
  }
};

/// The corners of a law through (0, 0) and these points of strain and force [N], whose strains rise
/// and forces do not fall. Throws nothing.
std::vector<TrussCorner> law_through(const std::vector<std::array<double, 2>>& points);

/// All trusses of a scene (scene.store.get<TrussBlocks>()); addresses never change.
struct TrussBlocks {
  std::deque<TrussBlock> list;
};

/// Elements per chunk of the coloured passes.
inline constexpr Index truss_chunk = 512;

/// Takes the lengths between the nodes as they stand for (1 + prestrain) l0, or l0 as said, and
/// sets the arrays up. Throws std::invalid_argument that names the element where two nodes
/// coincide.
void rest_at_present_length(TrussBlock& block, const Nodes& nodes);

/// (2/dt)^2 of the steps dt that the elements allow at rest in the positions at hand [1/s^2], eight
/// a block. Changes nothing.
Array<double> bounds_of(const TrussBlock& block, const Nodes& nodes);

/// Adds mu l0/2 to the mass of both nodes of every element.
void add_truss_masses(const TrussBlock& block, Nodes& nodes);

/// One pass: axial forces at x(n), added to nodes.f; returns the energies that it added. dt_old:
/// t(n) - t(n-1) [s]. Chunks of one colour run at the same time: the same bits for any number of
/// threads.
///   F = EA (l - l0)/l0 + EA/l0 (beta + zeta l0/c) (l(n) - l(n-1))/dt_old,  c^2 = EA/mu,
/// (engineering strain, force per undeformed section), a cable never below 0, and without damping
/// where it is slack. With a law of pieces F = sum k_j (eps - eps_j)_+, and EA, its largest slope,
/// stands in damping and stable step. The rate of l is that of the lengths themselves, so that no
/// rigid motion is damped. Internal energy is the strain energy EA (l - l0)^2/(2 l0), a state
/// function; damping takes (F_d(n-1) + F_d(n))/2 (l(n) - l(n-1)). An element with |F| at the
/// strength or above carries nothing from this level on: its strain energy, and what its old force
/// did over the step, leave as "eroded". The stable step of an element, from its own lumped mass m
/// = mu l0/2: omega^2 = 2 K/m with K = EA/l0 along it, and F/l across it where that is larger; dt =
/// (2/omega) (sqrt(1
/// + xi^2) - xi) with xi = (beta + zeta l0/c) omega/2, which is l0/c in the usual case.
ElementWork truss_pass(TrussBlock& block, Nodes& nodes, double dt_old);

/// Adds the force operation with its vote and the ledger entry "internal" of a block that belongs
/// to no part of a case, without damping and strength: its energy is a state function, so nothing
/// is accumulated and a restart needs no field. scene, block and ledger must stay where they are
/// while the model lives.
void add_truss_operations(Scene& scene, Model& model, Ledger& ledger, TrussBlock& block);

}  // namespace gannet
