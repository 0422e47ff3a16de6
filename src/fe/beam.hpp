// Two-node beams with large rotations and small strains: the frame of each element turns along, and
// what its nodes turn against it is small. Elastic, or of fibres that yield (beam_fibres.hpp);
// damped in proportion to stiffness, and with released ends where asked for.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"
#include "fe/beam_law.hpp"
#include "fe/colouring.hpp"
#include "fe/element_part.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Local forces of an element at level n.
struct BeamForces {
  double N = 0;             ///< axial force, tension positive [N]
  Vec3 M_1 = Vec3::Zero();  ///< moments about x, y, z that the first node puts on it [N m]
  Vec3 M_2 = Vec3::Zero();  ///< the second
};

/// Sums over the elements of one chunk in one pass.
struct BeamSums {
  double energy = 0;   ///< strain energy [J], of elements that yield the work of the step
  double plastic = 0;  ///< plastic work of the step [J]
  double damping = 0;  ///< work of damping in the step [J]
  double eroded = 0;   ///< left with fibres and elements that failed in the step [J]
  double omega2 = 0;   ///< bound of the highest frequency, squared [1/s^2]
  Index element = -1;
};

/// The beams of one part: element k joins ends[2 k] and ends[2 k + 1].
struct BeamBlock {
  std::string name;
  int part = -1;  ///< number of the part in the scene; -1 where there is none
  BeamLaw law;
  Range nodes;        ///< of the part; all have rotations
  Array<Index> ends;  ///< node numbers
  /// Per element: bits 0, 1, 2 where its first end is released about x, y, z, bits 3, 4, 5 where
  /// its second one is; none: no end is.
  std::vector<std::uint8_t> released;
  Array<double> fibres;           ///< fibre_values() an element, where they yield
  Array<double> last;             ///< 14 an element: strain and stress of n-1, where they yield
  Array<double> damage_shown;     ///< share of the fibres that have failed, by show_damage()
  Array<double> damping_last;     ///< 14: strain and damping forces of n-1, where they are damped
  Array<double> damping_time;     ///< see ElementVotes; none: not damped
  Array<double> gone;             ///< 1 where an element has left, where fibres may fail
  Array<double> plastic_shown;    ///< largest eps_p of the fibres, by show_plastic_strain()
  Array<double> inverse_mass;     ///< see ElementVotes; none: no mass was added
  Array<double> l0;               ///< unstrained length of each element [m]
  std::vector<Quaternion> frame;  ///< of each element at the start: x along it, y, z of its section
  Array<Line> turned;  ///< how far each node has turned since the start: quaternion w, x, y, z
                       ///< as x, y, z, w of the line
  std::vector<std::uint8_t> elsewhere;  ///< see add_turns_elsewhere(); none: no node is
  Array<double> energy;                 ///< one number: strain energy of all at the last level [J]
  Array<double> forces;                 ///< 6 an element: N, V_y, V_z, T, M_y, M_z at its middle
  ChunkColours colouring;
  std::vector<BeamSums> sums;  ///< one a chunk, of the last pass
  double omega2 = 0;           ///< of the last pass [1/s^2]
  Index limiting = -1;         ///< the element it belongs to
  [[nodiscard]] Index n_elements() const { return static_cast<Index>(l0.size()); }
  [[nodiscard]] bool has_left(std::size_t k) const { return !gone.empty() && gone[k] != 0; }
};

/// All beams of a scene (scene.store.get<BeamBlocks>()); addresses never change.
struct BeamBlocks {
  std::deque<BeamBlock> list;
};

/// Elements per chunk of the coloured passes.
inline constexpr Index beam_chunk = 256;

/// Sets a block up, stress-free in the positions at hand. ends: 2 nodes an element; range: the
/// nodes of the part; up: direction near which the z axis of the section lies; zero: the z axis of
/// space, and x for elements along that. Throws std::invalid_argument that names the element where
/// one has no length or lies along `up`.
BeamBlock make_beam_block(std::span<const Index> ends, Range range, std::span<const Line> x,
                          const BeamLaw& law, const Vec3& up);

/// One pass: node triads to n, forces and moments at x(n) added to nodes.f and nodes.torque;
/// returns the change of the strain energy, of beams that yield the work by trapezoids. dt_old:
/// t(n) - t(n-1) [s]. The same bits for any number of threads. Throws nothing. A node turns by the
/// midpoint rule, its quaternion by (1, omega dt/2)/|.|: then chords and nodes of a body in rigid
/// rotation turn by the same angle, 2 atan(|omega| dt/2), exactly. The frame of an element has x
/// along the chord, from the mean of its nodes' triads by the smallest rotation. theta_a: rotation
/// vector of node a against it. Strain energy
///   W = EA (l - l0)^2/(2 l0) + GJ (theta_2x - theta_1x)^2/(2 l0) + bending with BendingStiffness;
/// moments are its gradients against spins, M_a = T(theta_a)^T dW/dtheta_a, and the forces across
/// follow from the balance of moments, so that force and moment balance to rounding.
/// At a released end the turn is the one without moment, theta_1 = -(k2/k4) theta_2 in a plane.
/// Damping adds beta K (q(n) - q(n-1))/dt_old, q = (u, theta_1, theta_2). Belytschko and Schwer
/// 1977 (Int. J. Numer. Methods Eng. 11, 65-84) for the corotational element; Crisfield 1990
/// (Comput. Methods Appl. Mech. Eng. 81) for the mean frame.
ElementWork beam_pass(BeamBlock& block, Nodes& nodes, double dt_old);

/// Local forces of an element of length l0 that is stretched by u [m] and whose ends have turned by
/// theta_1, theta_2 against it; energy: strain energy [J].
BeamForces beam_forces(const BeamLaw& law, double l0, double u, const Vec3& theta_1,
                       const Vec3& theta_2, double& energy);

/// The stable step after a pass [s]: dt_factor 2/omega of the element with the highest bound, l0/c
/// where rotary_ratios() chooses the rotary inertia and the beam shears more easily than it
/// stretches, as beams of isotropic solids do.
double stable_step(const BeamBlock& block);

}  // namespace gannet
