// A link: forces that operations of a slow model put on nodes of a faster one.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Nodes of a fast model that a slow model's operations push. The slow model evaluates its force
/// f_s once a coarse step, at its own level n; the node takes it as the impulse
/// f_s (dT_old + dT)/2 at that level, in one kick with the fast forces of the same level, and
/// moves with the fast model in between. The scheme is symplectic (asynchronous variational
/// integrator: Lew, Marsden, Ortiz & West 2003) and was found neutral where the node is a massive
/// body and only gentle forces are slow.
///
/// Held, the force acts on through the substeps instead, and its change in one kick at the next
/// level: there the node takes f_s(n-1) dt_old/2 + f_s(n) dt/2 + (f_s(n) - f_s(n-1)) dT_old/2. A
/// node that nothing else pushes moves as with impulses, which is Verlet's scheme in both forms;
/// stiff lines on it see a jump of (f_s(n) - f_s(n-1)) dT/2 in place of f_s dT. Beside fast forces
/// it is not symplectic: for a body of the mass of 45,000 nodes of a line the energy grew by 1e-9
/// to 1e-6 a coarse step, for one of 10 nodes by up to 4e-3.
struct Link {
  std::string name;
  Model* slow = nullptr;
  Model* fast = nullptr;
  Array<Index> nodes;   ///< nodes of the fast model
  Array<Line> force;    ///< slow slot: force at the slow model's level n [N]
  Array<Line> moment;   ///< slow slot: moment [N m], for rotating nodes
  Array<Line> x_level;  ///< position at the slow model's last level [m]
  Array<Line> f_level;  ///< slow force at that level [N]
  double ratio =
      0;  ///< what `force` was multiplied by in this step of the fast model; 0: not applied
  bool held = false;          ///< the slow forces are held through the substeps
  Array<Line> force_old;      ///< held: slow force at the level before [N]
  Array<Line> moment_old;     ///< [N m]
  Array<Line> beyond;         ///< held: what acts in this step of the fast model beyond `force` [N]
  Array<Line> moment_beyond;  ///< [N m]
  std::vector<std::pair<Index, std::size_t>> places;  ///< of the nodes in the list, in rising order
  Array<Line> path;  ///< displacement from the last level to this one, in the slow model's step [m]
  /// The nodes belong to elements of the slow model, which take strains from velocities: while its
  /// forces are computed the nodes have their mean velocities over its last step.
  bool of_elements = false;
  /// The nodes are centres of rigid bodies, and the slow model knows what pushes them in its stage
  /// accelerate only: there the forces are collected, and what the fast model has put on the nodes
  /// by then is kept for it.
  bool of_bodies = false;
  Array<Line> moment_level;  ///< slow moment at the last level [N m]
  Array<Line> turned;        ///< sum of omega dt since then [rad]
  Array<Line> v_kept;        ///< the nodes' own velocities meanwhile [m/s]
  Array<Line> omega_kept;    ///< [rad/s]; of bodies: before the last kick
  Array<Line> f_kept;        ///< of bodies: force of the fast model [N]
  Array<Line> torque_kept;   ///< [N m]

  /// Where the slow model pushes the nodes.
  [[nodiscard]] Stage stage() const { return of_bodies ? Stage::accelerate : Stage::force; }
  /// Whether moments act through the link, whose work is along what the nodes turn by.
  [[nodiscard]] bool turns() const { return of_elements || of_bodies; }
};

/// All links of a scene, as they were opened: scene.store.get<Links>().
struct Links {
  std::vector<const Link*> list;
};

/// What the impulses of slow forces add to f beyond these forces themselves, sum (ratio - 1) f_s
/// over the linked nodes that `counts` says [N], and the same about a point, with moments [N m].
/// Off f, it leaves the force that acts at a coinciding level. Between accelerate and the end of
/// the step.
struct Excess {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};
Excess excess_of_impulses(const Scene& scene, const Vec3& about,
                          const std::function<bool(Index)>& counts);

/// The same on one node [N]: off its f, it leaves the force that acts at this level, also between
/// the levels of the slow model.
Vec3 excess_on_node(const Scene& scene, Index node);

/// Opens the link: in the slow model's force stage, of bodies in its stage accelerate, clears the
/// forces of the linked nodes. Call it before the operations of the slow model that push them are
/// added.
void open_link(Scene& scene, Link& link);

/// Closes the link, after all operations that push the linked nodes were added: at the end of that
/// stage of the slow model the forces move to the slow slot; in the fast model's accelerate stage
/// they are applied at coinciding levels; the ledger's entry "link" holds what the impulses and
/// the paths differ by. The link must stay where it is.
/// Operations of the slow model measure the work of their forces on the linked nodes along
/// link.path, as a trapezoid of the forces at its ends: work_path() knows nothing of the substeps.
void close_link(Scene& scene, Link& link, Ledger& ledger);

}  // namespace gannet
