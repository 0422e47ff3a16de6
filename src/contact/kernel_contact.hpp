// Kernel contact between particles and the nodes of a part of elements (contact/kernel_law.hpp).
//
// Each node of the surface stands for the volume V_j = m_j/rho_j of a layer: its share A_j of the
// area around it times the thickness of a shell, or one spacing of the particles where the part has
// none. A particle stands for V_i = m/rho0: with the density at rest the force has a potential.
// There are no sides and no segments: what a particle feels is a sum over nodes, smooth while nodes
// are no further apart than particles.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "contact/force.hpp"
#include "contact/kernel_law.hpp"
#include "contact/surface.hpp"
#include "plan/plan.hpp"
#include "scene/followers.hpp"
#include "scene/periods.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// One such contact: its state, its list, and the results of its pass.
struct KernelContact {
  std::string name;
  Location where;
  int particle_part = -1;
  int surface_part = -1;
  const Followers* followers = nullptr;
  const Periods* periods = nullptr;
  KernelLaw law;
  double V_particle = 0;        ///< [m^dimension]
  double thickness = 0;         ///< of the layer that nodes stand for [m]
  Surface surface;              ///< its nodes, and which of its elements have left
  std::vector<double> V_share;  ///< of each segment, for each of its corners [m^dimension]

  // Tracked
  Array<Line> x_search;          ///< over particles: positions when the list was made [m]
  Array<Line> node_x_search;     ///< nodes when the list was made [m]
  Array<double> search_numbers;  ///< {skin [m] (negative: no list yet), overlaps, largest [m]}

  // Made anew
  std::vector<Corners> points;    ///< each node as a segment of its own, for the search
  SegmentCandidates candidates;   ///< rows in order of particles; registered in scene.index_lists
  std::vector<double> V_node;     ///< [m^dimension]
  std::vector<Index> node_begin;  ///< pairs of node j: pair_of_node[node_begin[j], node_begin[j+1])
  std::vector<Index> pair_of_node;
  std::vector<Vec3> pair_force;            ///< on the particle [N]
  std::vector<double> pair_stiffness;      ///< [N/m]
  std::vector<double> particle_stiffness;  ///< sum over the pairs of each row [N/m]
  std::vector<double> node_stiffness;      ///< likewise of each node [N/m]
  std::vector<WorkPath> node_path;
  Vec3 on_surface = Vec3::Zero();  ///< sum of the forces on the nodes [N]
  Index active = 0;                ///< particles that are pushed
  ContactRate rate;
  std::string limited_by;  ///< of `rate`, from the vote on: particles are sorted later in the step
};

/// All kernel contacts of a scene: scene.store.get<KernelContacts>().
struct KernelContacts {
  std::deque<KernelContact> list;
};

/// Makes a contact between the particles of one part and the nodes of the surface of another, the
/// outer faces of solids: allocates its state, tracks its fields, registers its list, its measures
/// ("contact.NAME.force" on the surface, "contact.NAME.active", "contact.NAME.overlaps",
/// "contact.NAME.overlap_depth") and its rebuild after a restart.
KernelContact& make_kernel_contact(Scene& scene, const std::string& name, int particle_part,
                                   int surface_part);

/// The longest edge of the segments of a surface at this moment [m].
double longest_edge(const Nodes& nodes, const Surface& surface);

/// Gives the segments their shares of volume from the nodes' places now.
void take_volumes(KernelContact& contact, const Nodes& nodes, double thickness);

/// The pairs within reach at the places of now, without skin, and the volumes of the nodes; what
/// search() goes by stays as it is.
void list_pairs_of_now(Scene& scene, KernelContact& contact);

/// Makes sure that the list is complete for this level.
void search(Scene& scene, KernelContact& contact, const Step& step);

/// Forces of all pairs at this level, added to nodes.f: to particles row by row, to nodes in the
/// order of their pairs, the opposite. Sets the force on the surface and the rate of the contact:
/// with k_ij the bound of a pair's stiffness, Gershgorin's row of i is 2 sum_j k_ij, so
///   omega^2 <= max(max_i 2/m_i sum_j k_ij, max_j 2/m_j sum_i k_ij)
/// and nodes that follow one leader count together, as in largest_rate().
void apply_kernel_contact(Scene& scene, KernelContact& contact);

/// Adds the operations of the contact to a model that holds both sides, and its entry to the
/// ledger: `contact`, minus the work of the pairs along work_path(). It is the energy of the pairs
/// as long as particles move with their own velocities and no node loses its volume; where XSPH or
/// shifting moves them aside, or an element leaves, only the work is what the motion has paid.
void add_kernel_contact(Scene& scene, KernelContact& contact, Model& model, Ledger& ledger);

}  // namespace gannet
