// Node-to-segment penalty contact between particles and the surface of a part.
//
// One step runs the passes search -> gaps -> forces -> scatter in the stage `force`, and adds up
// the work of the same forces in the stage `look`. Candidate pairs come from a list that stays
// valid until something has moved by more than its skin (search/segment_search.hpp). The positions
// that the list was made from are tracked fields: after a restart the same list is made again.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "base/keys.hpp"
#include "contact/force.hpp"
#include "contact/gap.hpp"
#include "contact/linked_work.hpp"
#include "contact/surface.hpp"
#include "plan/link.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// One contact of the case: its state, its list, and the results of its passes.
struct NodeToSegment {
  std::string name;
  Location where;
  int particle_part = -1;
  int surface_part = -1;
  const Followers* followers = nullptr;  ///< those of the scene
  const Carriers* carriers = nullptr;    ///< likewise
  const Periods* periods = nullptr;      ///< likewise; of the particles
  GapRange range;
  ContactLaw law;
  Surface surface;

  // Tracked: over particles
  Array<Line> x_search;      ///< positions when the list was made [m]
  Array<std::int32_t> side;  ///< GapMemory::side
  Array<double> offset;      ///< GapMemory::offset [m]
  Array<Line> tangential;    ///< friction spring force [N]; empty without friction
  // Tracked: over the scene
  Array<Line> node_x_search;     ///< surface nodes when the list was made [m]
  Array<double> search_numbers;  ///< {skin [m] (negative: no list yet), overlaps, largest [m]}

  // Made anew
  SegmentCandidates candidates;  ///< rows in order of particles; registered in scene.index_lists
  std::vector<Gap> gaps;
  ContactForces forces;
  std::vector<double> node_stiffness;
  std::vector<WorkPath> point_path, node_path;
  Scattered scattered;
  ContactRate rate;
  std::string limited_by;  ///< of `rate`, from the vote on: particles are sorted later in the step

  /// Of a surface in a faster model: link.nodes are those of the surface, else none.
  Link link;
  std::deque<LinkedForce> linked;
};

/// All contacts of a scene; scene.store.get<NodeToSegments>().
struct NodeToSegments {
  std::deque<NodeToSegment> list;
};

/// Makes a contact between the particles of one part and the surface of another: allocates its
/// state, tracks its fields, registers its list, its measures ("contact.NAME.force",
/// "contact.NAME.active", "contact.NAME.overlaps", "contact.NAME.overlap_depth") and its rebuild
/// after a restart. The address of the result stays.
NodeToSegment& make_node_to_segment(Scene& scene, const std::string& name, int particle_part,
                                    int surface_part, bool friction);

/// Makes sure that the list is complete for this level: makes a new one when there is none or when
/// the relative displacement since the last has passed the skin, and puts rows in order after a
/// sort. Returns true at the first list of a run.
bool search(Scene& scene, NodeToSegment& contact, const Step& step);

/// Gaps, forces and scatter at this level.
void apply_contact(Scene& scene, NodeToSegment& contact, const Step& step, bool first);

/// Adds the operations of the contact to the plan of the particles' model and its entries to the
/// ledger. The surface may be in a faster model.
void add_node_to_segment(Scene& scene, NodeToSegment& contact, Models& models);

}  // namespace gannet
