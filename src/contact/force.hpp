// The contact law: from gaps to forces between a point and a segment.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/array.hpp"
#include "base/math.hpp"
#include "contact/gap.hpp"
#include "contact/surface.hpp"
#include "plan/plan.hpp"
#include "scene/carrier.hpp"
#include "scene/followers.hpp"
#include "scene/scene.hpp"
#include "search/segment_search.hpp"

namespace gannet {

/// What the law of one contact is made of. The stiffness of a point of mass m is
///   k = min(rate2 m, stiffest)
struct ContactLaw {
  double rate2 = 0;     ///< k/m of a point [1/s^2]
  double stiffest = 0;  ///< limit of k [N/m]
  double friction = 0;  ///< coefficient of Coulomb
  double damping = 0;   ///< ratio zeta of normal damping to critical, of the point's mass on k
  [[nodiscard]] double stiffness(double m) const {
    const double k = rate2 * m;
    return k < stiffest ? k : stiffest;
  }
};

/// Forces on the points of all rows at this level [N]; the segments get the opposite. `friction`
/// and `damping` are empty where the law has none.
struct ContactForces {
  std::vector<Vec3> normal;
  std::vector<Vec3> friction;
  std::vector<Vec3> damping;
  std::vector<Vec3> total;
};

/// f = k p n for penetration p > 0.
Vec3 penalty_force(double k, const Gap& gap);

/// Damping of the normal approach, f = -c v_n n with c = 2 zeta sqrt(k m), limited so that the
/// normal force k p - c v_n stays between 0 and 2 k p: it never pulls, and it never exceeds what
/// the spring itself carries, so a point entering contact feels no jump.
/// v_n: velocity of the point against the segment along n [m/s]; m: mass of the point [kg].
Vec3 damping_force(double zeta, double k, double m, double v_n, const Gap& gap);

/// Coulomb friction through a tangential spring of stiffness k: t <- (t - k slip) projected on the
/// tangent plane, |t| <= mu f_n. Returns the new force t on the point [N].
/// t: tangential force of the last level [N]; slip: displacement of the point against the segment
/// since then [m]; f_n: normal force [N].
Vec3 friction_force(const Vec3& t, const Vec3& slip, double k, double limit, const Gap& gap);

/// Everything that the law looks at.
struct ContactInput {
  const Nodes* nodes = nullptr;
  Range points;  ///< node range of the points: point i is begin + i
  const Surface* surface = nullptr;
  const SegmentCandidates* candidates = nullptr;
  std::span<const Gap> gaps;
  double dt_old = 0;                     ///< step before this level [s]
  const Followers* followers = nullptr;  ///< surface nodes that are part of something heavier
  const Carriers* carriers = nullptr;    ///< rigid bodies that surface nodes may follow
  std::span<const Index> point_node{};   ///< node of each point, where they are not a range
  std::span<const double> stiffness{};   ///< of each row [N/m], where it does not follow the law
};

/// Forces of all rows. t: tangential spring forces of the particles, updated; empty without
/// friction. Sizes of `forces` must fit the rows.
void contact_forces(const ContactInput& in, const ContactLaw& law, std::span<Line> t,
                    ContactForces& forces);

/// What scattering finds on its way.
struct Scattered {
  Vec3 on_surface = Vec3::Zero();  ///< sum of the forces on the segments [N]
  Index active = 0;                ///< pairs with a force
};

/// Adds the forces to nodes.f: to points row by row, to the corners of segments in order of rows,
/// -N_i f each. stiffness: per surface node, receives S_i = sum k N_i over all near pairs [N/m].
Scattered scatter_forces(const ContactInput& in, const ContactLaw& law, const ContactForces& forces,
                         Nodes& nodes, std::span<double> stiffness);

/// Largest squared frequency that the contact can add, and where.
struct ContactRate {
  double omega2 = 0;  ///< [1/s^2]
  Index node = -1;    ///< of the node table
};

/// Bound of the largest eigenvalue of M^-1 K over all near pairs, by Gershgorin: row p of the
/// contact stiffness K = sum k g g^T, g = (n, -N_1 n, ...), has the absolute sum k (1 + sum N) =
/// 2k, row i of a segment node sum_p k N_i (1 + sum N) = 2 S_i, so
///   omega^2 <= max(max_p 2 k_p / m_p, max_i 2 S_i / m_i).
/// Nodes that follow one leader move together, and count as one. A row's g = e - sum_j B_j, e its
/// point, B_j = sum N_c b_c what its corners of leader j (or one free corner) move, N_j = sum N_c;
/// as sum N_j = 1, k g g^T is at most 2 k (e e^T + sum_j B_j B_j^T/N_j) (Cauchy and Schwarz). For a
/// rigid body that is a matrix of 6 x 6,
///   omega^2 <= 2 lambda_max(sum_p k_p B_p B_p^T/N_p),   b = (d/M^(1/2), R (r x d)),
/// d the normal, or with friction each of three directions, r from the centre, R^2 the inverse
/// inertia. Of other leaders only w_i is known, and the largest eigenvalue of a sum of b b^T is at
/// most its trace,
///   omega^2 <= 2 sum_i S_i w_i   (Followers::inverse_mass).
/// Other nodes that forces do not move (1/m = 0) are left out.
ContactRate largest_rate(const ContactInput& in, const ContactLaw& law,
                         std::span<const double> stiffness);

/// The step that a contact of frequency omega allows: 2/omega (sqrt(1 + zeta^2) - zeta) times a
/// share of 0.4. Contact adds to the stiffness of what it joins: with elements at 0.9 of their own
/// limit and the contact at 0.4 of its own, (omega dt)^2 <= 4 (0.9^2 + 0.4^2) = 3.88 < 4.
double contact_step(double omega2, double zeta);

/// The step t with a contact of frequency omega on top of what allows the step d. Stable is a step
/// with t^2/4 K + t/2 C <= M; elements with a fifth of critical damping at most that use 0.9 of
/// theirs take A (t/d)^2 + B t/d of it, A = 0.81 a^2, B = 0.9 (1 - a^2), a = (1 + 0.2^2)^(1/2) -
/// 0.2, the contact w^2 + 2 zeta w with w = omega t/1.9. Beside that omega t stays below 1.25: the
/// force begins up to a step late, and from about 1.5 on what that gives to nodes that come and go
/// feeds itself. d: the smallest vote of all else [s], may be infinite; omega2 [1/s^2]. Never above
/// d. Throws nothing.
double step_beside(double d, double omega2, double zeta);

/// Work of `force` on points and segments along work_path(), summed over the rows [J].
Work contact_work(const ContactInput& in, std::span<const Vec3> force,
                  std::span<const WorkPath> point_path_of_row, std::span<const WorkPath> node_path);

}  // namespace gannet
