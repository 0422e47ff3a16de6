// Mass and rotary inertia of beams at their nodes, and the frequencies that follow from them.
#pragma once

#include "fe/beam.hpp"

namespace gannet {

/// Rotary inertia of a node about y and z over m I_y/A and m I_z/A of an element of length l0:
/// law.rotary_inertia; where that is 0 the least one, from 1 on, with which rotations do not limit
/// the step (see omega2_of()):
///   max(1, 3/max(1, 1 + phi - 12 I/(A l0^2)))
struct RotaryRatios {
  double y = 1;
  double z = 1;
};
RotaryRatios rotary_ratios(const BeamLaw& law, double l0);

/// Mass [kg] and rotary inertia about the axes of the section [kg m^2] that element e gives to each
/// of its nodes: m (I_y + I_z)/A about x, rotary_ratios() m I/A about y and z.
struct BeamNodeMass {
  double m = 0;
  Vec3 I = Vec3::Zero();
  [[nodiscard]] double largest() const { return I.maxCoeff(); }
};
BeamNodeMass node_mass(const BeamBlock& block, Index e);

/// Adds to both nodes of each element m = rho A l0/2, and the largest of its rotary inertias: what
/// the nodes' tensor is less about other axes is the matter of beam_inertia.hpp.
void add_beam_masses(const BeamBlock& block, Nodes& nodes);

/// The highest frequency of a free element, squared, from its own lumped mass m = rho A l0/2 and
/// rotary inertia J_x, J_y, J_z; l: present length [m], N: axial force [N].
///   along it    2 E A/(l0 m)
///   torsion     2 G J/(l0 J_x)
///   bending     12 E I/(l0 (1 + phi)) (2/(m l^2) + 1/(2 J_r)) with both ends turned alike, or
///               2 E I/(l0 J_r) against each other; a tension adds 4 N/(l m) to the former
double omega2_of(const BeamLaw& law, double l0, double l, double N);

/// Squares of the bounds of the frequencies of the unstrained elements [1/s^2], eight a block.
Array<double> bounds_of(const BeamBlock& block);

/// Sets the damping times up that the law asks for.
void prepare_damping(BeamBlock& block);

}  // namespace gannet
