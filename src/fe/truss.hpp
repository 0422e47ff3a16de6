// A chain of elastic two-node elements that carry axial force only: trusses, and cables where they
// carry tension only.
#pragma once

#include <string>
#include <vector>

#include "base/array.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// One chain: element k joins nodes[k] and nodes[k + 1].
struct TrussBlock {
  std::string name;
  double EA = 0;              ///< axial stiffness [N], > 0
  double mu = 0;              ///< mass per length [kg/m], > 0
  bool tension_only = false;  ///< shortened elements carry nothing (a cable)
  double dt_factor = 0.9;     ///< share of the stable step that is voted for
  std::vector<Index> nodes;   ///< along the chain
  Array<double> l0;           ///< unstretched length of each element [m], > 0
  Array<double> force;        ///< axial force of each element at level n, tension positive [N]
  Array<double> energy;       ///< strain energy of each element at level n [J]
  double shortest = 0;        ///< smallest stable step of the last pass [s]
  Index limiting = -1;        ///< the element it belongs to
  [[nodiscard]] Index n_elements() const { return static_cast<Index>(l0.size()); }
};

/// Axial force [N] at length l [m].
///   F = EA (l - l0)/l0 (engineering strain, force per undeformed section), 0 where slack
/// Needs l0 > 0. Throws nothing.
double truss_force(const TrussBlock& block, double l, double l0);

/// Strain energy [J] at length l [m]: the work of truss_force() from l0.
///   W = EA (l - l0)^2 / (2 l0), 0 where slack
double truss_energy(const TrussBlock& block, double l, double l0);

/// Takes the lengths between the nodes as they stand for l0 and sets the arrays up.
/// Throws std::invalid_argument that names the element where two nodes coincide.
void rest_at_present_length(TrussBlock& block, const Nodes& nodes);

/// Adds mu l0/2 to the mass of both nodes of every element.
void add_truss_masses(const TrussBlock& block, Nodes& nodes);

/// One pass: axial forces at x(n), added to nodes.f; returns the strain energy of the chain [J].
/// Sums run along the chain, on one thread: the same bits always. The stable step of an element,
/// from its own lumped mass m = mu l0/2: omega^2 = 2 K/m with K = EA/l0 along it, and F/l across
/// it where that is larger, so dt = 2/omega = l0/c with c^2 = EA/mu in the usual case.
double truss_pass(TrussBlock& block, Nodes& nodes);

/// Adds the force operation with its vote and the ledger entry "internal" of the chain to a model.
/// scene, block and ledger must stay where they are while the model lives. The strain energy is a
/// state function (closed form), so nothing is accumulated and a restart needs no field of its own.
void add_truss_operations(Scene& scene, Model& model, Ledger& ledger, TrussBlock& block);

}  // namespace gannet
