// Nodes of one part that are tied to segments of another part that deforms.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/error.hpp"
#include "base/math.hpp"
#include "plan/link.hpp"
#include "plan/plan.hpp"
#include "scene/followers.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// A node that stays at x = sum N_k x_k of the corners of a segment, sum N_k = 1.
struct TiedNode {
  Index node = -1;
  int n = 0;  ///< corners with N > 0
  std::array<Index, 4> corner{};
  std::array<double, 4> N{};
  bool turns = false;  ///< both sides have rotations, which are tied too
};

/// All nodes of one tie.
struct PartTie {
  std::string name;
  Location where;
  int part = -1;  ///< whose nodes are tied
  int to = -1;    ///< to whose segments
  std::vector<TiedNode> rows;
  double breaks_at = 0;         ///< size of the force at which it lets go [N]; 0: holds
  double farthest = 0;          ///< that a node was moved at the start [m]
  Array<double> mass;           ///< of each tied node, on its corners while it is tied [kg]
  Array<double> inertia;        ///< likewise [kg m^2]
  Array<double> broken;         ///< tracked: 1 once it has let go
  Vec3 force = Vec3::Zero();    ///< that it puts on the part it is tied to, at this level [N]
  LedgerEntry* lost = nullptr;  ///< what leaves with a tie that lets go
  [[nodiscard]] bool holds() const { return broken.empty() || broken[0] == 0; }
};

/// What tied nodes hand to corners at this level beyond the forces that act there [N], as impulses
/// of links are. Corners may be shared by ties.
struct Impulses {
  std::map<std::size_t, Vec3> of_corner;

  void add(std::size_t c, const Vec3& f) {
    of_corner.try_emplace(c, Vec3::Zero()).first->second += f;
  }
  void clear(std::size_t c) { of_corner.erase(c); }
  [[nodiscard]] Vec3 at(std::size_t c) const {
    const auto found = of_corner.find(c);
    return found == of_corner.end() ? Vec3(Vec3::Zero()) : found->second;
  }
};

/// All such ties of a scene, and the links of those between models: scene.store.get<PartTies>().
struct PartTies {
  std::deque<PartTie> list;
  std::deque<Link> links;
  Impulses impulses;
};

/// Moves the masses m_s (and, where both sides turn, rotary inertias) of tied nodes to the corners,
/// N_k m_s each: the lumped form of the mass that moves with them, so that no frequency of either
/// mesh rises. The corners start at the mean velocity of what they carry, which keeps momentum,
/// but for components that are given. Needs the masses of all parts in the node table.
void take_masses(PartTie& tie, Scene& scene);

/// Gives the tied nodes the motion of their corners, and notes in `followers` what pushes at one.
/// Needs the masses of all ties on the corners.
void start_tied(const PartTie& tie, Nodes& nodes, Followers& followers);

/// At level n, when all forces are in f: puts the forces of tied nodes on the corners,
///   f_k += N_k f_s,   torque_k += N_k torque_s
/// which keeps momentum and, since x_s = sum N_k x_k, angular momentum to rounding. The force of
/// the tie is sum_s (f_s + m_s g) so far, where the impulses of links count as the forces that they
/// stand for; what they are beyond those goes to `impulses`.
void gather_tie(PartTie& tie, Scene& scene, Impulses& impulses);

/// After the kick and what boundaries hold back in it, when the forces of all ties are gathered:
/// v_s = sum N_k v_k, omega_s likewise; f_s becomes the acceleration of the node and its 1/m one,
/// as of members of rigid bodies, so that work is seen as on any node. The force of the tie is now
///   R = sum_s (f_s + m_s g - m_s a_s),   a_s = (v_s(n+1/2) - v_s(n-1/2)) / ((dt_old + dt)/2)
/// with a_s as the nodes really get it, less what `impulses` add. A tie whose |R| exceeds
/// breaks_at lets go after level n has been looked at.
void follow_corners(PartTie& tie, Scene& scene, const Impulses& impulses, const Step& step);

/// Adds the operations of the tie to the model that its nodes advance in.
void add_tie_operations(Scene& scene, Model& model, Ledger& ledger, PartTie& tie);

}  // namespace gannet
