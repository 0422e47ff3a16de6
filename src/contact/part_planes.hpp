// Penalty contact of parts of elements with rigid planes: all nodes of the part, whatever it is
// made of, deforming or rigid. A plane has one side only, so no search is needed; a node behind it
// is pushed out however far it went through.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "contact/force.hpp"
#include "contact/part_side.hpp"
#include "plan/plan.hpp"

namespace gannet {

struct PartMeeting;

/// A node that touches a plane at this level.
struct PlaneTouch {
  std::size_t plane = 0;  ///< within PartOnPlanes::planes
  std::size_t point = 0;  ///< within the nodes of the side
  double stiffness = 0;   ///< [N/m]
  double mass = 0;        ///< that damping goes by [kg]
  Gap gap;
  Vec3 normal = Vec3::Zero();  ///< forces on the node [N]
  Vec3 friction = Vec3::Zero();
  Vec3 damping = Vec3::Zero();
};

/// One contact of a part with the planes of a boundary.
struct PartOnPlanes {
  std::string name;
  Location where;
  PartSide side;
  std::vector<std::size_t> planes;           ///< numbers in scene.planes
  const std::vector<Plane>* seen = nullptr;  ///< those of its model, or the scene's
  double distance = 0;                       ///< of the nodes from a plane where contact begins [m]
  double factor = 1;                         ///< on the stiffness that the elements can bear
  double kappa = 0;  ///< penalty per area and depth of the case [Pa/m]; 0: that of the elements
  ContactLaw law;    ///< friction and damping
  const Followers* followers = nullptr;
  LedgerEntry* work = nullptr;
  LedgerEntry* friction_work = nullptr;
  LedgerEntry* damping_work = nullptr;
  LedgerEntry* put_in = nullptr;  ///< by what moves the planes
  // Tracked: planes after planes, nodes in the order of the side
  Array<double> offset;            ///< penetration of the start, stress-free; shrinks [m]
  Array<Line> tangential;          ///< friction spring force [N]; empty without friction
  Array<double> numbers{0, 0, 0};  ///< 1 after the first level, overlaps at the start, largest [m]
  std::vector<double> area;        ///< of the nodes at the start [m^2]
  double rate2 = -1;               ///< rate_of_all_nodes(); below 0: not found yet
  // Of this level
  std::vector<PlaneTouch> touches;
  Vec3 on_planes = Vec3::Zero();  ///< [N]
};

/// All such contacts; scene.store.get<PartsOnPlanes>().
struct PartsOnPlanes {
  std::deque<PartOnPlanes> list;
};

/// Makes a contact: the nodes of part `number` against planes of the scene. data: of the part.
/// Tracks its fields and registers its measures ("contact.NAME.force": on the part; .active,
/// .overlaps, .overlap_depth).
PartOnPlanes& make_part_on_planes(Scene& scene, const std::string& name, int number,
                                  const ShellSurface& data, std::vector<std::size_t> planes,
                                  bool friction);

/// Forces at this level, added to nodes.f: with p = d - (x - x_plane) . n > 0
///   f = k p n + damping_force() + friction_force(),   k = 2 factor kappa A (or kappa A of the
///   case),
/// A the area of the node that faces the plane, the velocity that of the node less that of the
/// plane at its place. Damping of a node that follows a body takes its share, by area, of the mass
/// that a force there moves. What touches adds k to the meeting: planes do not give way.
void part_on_planes_pass(Scene& scene, PartOnPlanes& contact, const Step& step,
                         PartMeeting& meeting);

/// The largest squared frequency that a body could have on planes, sum k w over all its nodes in
/// the contact [1/s^2]; 0 of parts that deform. The vote goes by it also while nothing touches, so
/// that a body lands within a fraction of its period, and a case of bodies alone has a step.
double rate_of_all_nodes(const PartOnPlanes& contact);

/// Adds the works of the forces of this level to the ledger: along the way of the nodes against the
/// planes to contact, friction and damping, along that of the planes to what moves them.
void add_work_on_planes(const Scene& scene, PartOnPlanes& contact, const Step& step);

/// Adds the contact to a meeting, and its entries to the ledger.
void add_part_on_planes(Scene& scene, PartOnPlanes& contact, PartMeeting& meeting, Ledger& ledger);

}  // namespace gannet
