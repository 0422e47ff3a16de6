// Penalty contact between two parts of elements: the nodes of each against the surface of the
// other.
//
// Beside the closest point of node-to-segment contact (closest_point.hpp) it has a rule for the
// inside of solids, a stiffness that both sides can bear, and a search that looks at two parts
// again only when they may have come near. Passes as in node_to_segment.hpp.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "contact/force.hpp"
#include "contact/gap.hpp"
#include "contact/part_side.hpp"
#include "plan/plan.hpp"

namespace gannet {

/// The nodes of one side against the surface of the other.
struct PartDirection {
  std::size_t points = 0;    ///< number of the side whose nodes are looked at
  std::size_t segments = 1;  ///< of the other
  GapRange range;

  // Tracked: over the surface nodes of the first side
  Array<std::int32_t> side;  ///< GapMemory::side; surfaces of shells only
  Array<double> offset;      ///< GapMemory::offset [m]
  Array<Line> tangential;    ///< friction spring force [N]; empty without friction

  // Made anew
  SegmentCandidates candidates;
  std::vector<Gap> gaps;
  std::vector<double> stiffness;  ///< of each row [N/m]
  ContactForces forces;
  std::vector<double> node_stiffness;
  std::vector<WorkPath> point_path, node_path;
  Scattered scattered;
};

struct PartContact;
struct PartOnPlanes;

/// What the contacts between parts of one model add to its nodes together, since a node may take
/// part in several of them.
struct PartMeeting {
  /// Per node of the table its row of the stiffness, sum k g_i sum g_j over all near pairs, g = 1
  /// for the point of a pair and N for its corners, j over those that forces move [N/m].
  std::vector<double> stiffness;
  std::vector<Index> touched;  ///< nodes where it is not zero
  std::vector<PartContact*> contacts;
  std::vector<std::size_t> numbers;     ///< theirs
  std::vector<PartContact*> near;       ///< of them, those that have pairs at this level
  std::vector<PartContact*> were_near;  ///< those that had at the last; all of them at first
  std::vector<PartOnPlanes*> on_planes;
  double damping = 0;  ///< the largest of the contacts
  double rate2 = 0;    ///< the least that the vote goes by, see rate_of_all_nodes() [1/s^2]
};

/// One contact of the case.
struct PartContact {
  std::string name;
  Location where;
  std::size_t number = 0;  ///< within the list of all
  std::array<PartSide, 2> sides;
  std::deque<PartDirection> directions;
  ContactLaw law;     ///< friction and damping
  double factor = 1;  ///< on the stiffness that the sides can bear
  const Followers* followers = nullptr;
  LedgerEntry* work = nullptr;
  LedgerEntry* friction_work = nullptr;
  LedgerEntry* damping_work = nullptr;
  /// Tracked: {skin of the list [m] (negative: no list), 1 after the first level, overlaps at the
  /// start, largest of them [m]}.
  Array<double> numbers{-1, 0, 0, 0};
};

/// All contacts between parts of elements; scene.store.get<PartContacts>().
struct PartContacts {
  std::deque<PartContact> list;
  /// Tracked: steps that each contact waits until its next look; close together in memory, so that
  /// contacts of parts far apart cost next to nothing.
  Array<double> waits;
  std::map<Model*, PartMeeting> meetings;
};

/// Gap of a point at the surface of a solid. With D = |x - x_cp| and s = -1 inside, +1 outside,
///   g = s D,   normal = s (x - x_cp)/D,   penetration = d - g,
/// the normal that of the surface where D is nothing against `depth`. [m]. Throws nothing.
Gap gap_of_solid(const Surface& surface, const Nearest& nearest, const Vec3& x, double d,
                 double depth);

/// Penalty of the pair of a node and its foot [N/m]:
///   k = factor min(A, sum N_i A_i)/(1/kappa + 1/(sum N_i kappa_i)),
/// both penalties in a row; of a node on a rigid face 2 kappa, which asks for the same step. A: the
/// area of the node that faces along the gap (solids) or its share of the areas around it (shells):
/// continuous while the foot moves from one segment to the next. i: surface node of `points`.
double pair_stiffness(const PartSide& points, const PartSide& segments, std::size_t i,
                      const Gap& gap, double factor);

/// Makes a contact between two parts, one of which has a surface at least: the nodes of the first
/// against the second, and the other way where `both_ways`; of cables and beams the nodes only.
/// data: of the two. Tracks its fields, registers its measures ("contact.NAME.force": on the second
/// part; .active, .overlaps, .overlap_depth).
PartContact& make_part_contact(Scene& scene, const std::string& name, std::array<int, 2> parts,
                               std::array<ShellSurface, 2> data, bool both_ways, bool friction);

/// Sets the distance at which contact begins [m], and from it the ranges.
void set_distance(PartContact& contact, double d);

/// Search, gaps, forces and scatter of one contact at this level; what it adds to its nodes goes to
/// the meeting. A contact that has pairs is in
/// `near` then.
void part_contact_pass(Scene& scene, PartContact& contact, const Step& step, PartMeeting& meeting);

/// Adds to what meets at a node [N/m]; nothing for 0.
void add_stiffness(PartMeeting& meeting, Index node, double k);

/// The same for all contacts of a meeting that do not wait, those with planes too.
void part_contacts_pass(Scene& scene, PartMeeting& meeting, const Step& step);

/// The largest squared frequency that all contacts of a meeting can add together, by Gershgorin
/// over the sum of their stiffnesses (largest_rate()).
ContactRate rate_of(const Nodes& nodes, const Followers& followers, const PartMeeting& meeting);

/// Adds a contact to those of a model, and its entries to the ledger.
void add_part_contact(Scene& scene, PartContact& contact, Model& model, Ledger& ledger);

/// Adds the operations of all contacts of a model to its plan.
void add_part_contact_operations(Scene& scene, PartMeeting& meeting, Model& model);

}  // namespace gannet
