// Water at rest: particles where nothing above a stated disturbance happens are not computed.
//
// Space is cut into cells as wide as the neighbour lists reach. A cell is disturbed while the flow
// in it, the mean velocity of its particles smoothed over quiet/4, is faster than u = tolerance *
// speed, while one particle is faster than 20 u, while something in it moves as it was told (a
// wall, a plane) or a part of elements is in it. So what sound that goes to and fro and particles
// that find their places do does not count. A cell is in motion from when it, or one up to two
// cells away, is disturbed, until that was not so for the time `quiet`. Particles of cells that are
// not in motion rest: they keep place and density, v = f = 0, and are neighbours of the others.
//
// Disturbances are looked for every four steps; sound crosses 2.8 h in that time, and two cells are
// more than 4 h wide: what comes is computed before it arrives. In equilibrium frozen pressures do
// no work; what rests wrongly is slower than u, and a force that is not balanced would have made it
// faster within `quiet`: |a| < u/quiet on the mean.
//
// Sorting keeps the particles at rest behind all others (scene/scene.hpp, Resting), so that every
// loop over particles stops where they begin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

/// Cells that never move. The outermost ones reach to infinity; in directions that repeat the first
/// is beside the last.
struct RestCells {
  Vec3 low = Vec3::Zero();   ///< [m]
  Vec3 edge = Vec3::Ones();  ///< [m]
  std::array<Index, 3> n{1, 1, 1};
  std::array<bool, 3> repeats{};
  [[nodiscard]] Index size() const { return n[0] * n[1] * n[2]; }
  [[nodiscard]] std::array<Index, 3> place_of(const Vec3& x) const;
  [[nodiscard]] Index cell_of(const Vec3& x) const;
};

/// One mark a cell, 1 or 0.
using CellMarks = std::vector<std::uint8_t>;

/// Cells over a box [low, high] [m], at least `edge` wide, as few as `most` at the least.
/// Where a direction repeats, whole cells divide the box.
RestCells cells_over(const Vec3& low, const Vec3& high, double edge,
                     const std::array<bool, 3>& repeats, Index most);

/// Marks all cells up to `steps` away from a marked one along each axis.
void widen(const RestCells& cells, Index steps, CellMarks& marks);

/// What a particle does; values of the tracked field "rest".
enum RestState : std::uint8_t {
  rest_awake = 0,
  rest_woken = 1,  ///< awake, since the half step before the next level
  rest_seen = 2,   ///< at rest, and awake ones may have it near
  rest_unseen = 3  ///< at rest among others at rest
};

/// The effect's state: scene.store.get<Rest>().
struct Rest {
  bool asked_for = false;
  double tolerance = 0;          ///< [-]
  double speed = 0;              ///< [m/s]
  double quiet = 0;              ///< [s]
  RestCells cells;               ///< of the scene at the start
  Array<std::uint8_t> state;     ///< tracked: RestState of each particle
  Array<double> disturbed_at;    ///< tracked: when each cell was last in motion [s]
  Array<double> flow;            ///< tracked: smoothed velocity in each cell, x y z [m/s]
  double looked_at = 0;          ///< tracked: when disturbances were last looked for [s]
  std::vector<Index> n_resting;  ///< particles at rest in each cell
  bool woken = false;            ///< a particle is `rest_woken`
  // Work space.
  CellMarks marks;
  std::vector<Index> n_awake;  ///< particles in motion in each cell
  std::vector<Line> sum_v;     ///< of the fluid in motion in each cell; w: how many particles
  Array<Index> place;          ///< cell of each particle in motion; -1 - cell where it is too fast
  Array<Index> border;         ///< clusters of particles at rest that are seen
  Array<double> drho_dt;       ///< that these would have [kg/(m^3 s)]
};

/// Steps from one look for disturbances to the next; how many cells from one water may not rest,
/// and how many more wake with it: the next ones in its way, so that lists need not be made at each
/// cell.
inline constexpr Index rest_every = 4;
inline constexpr Index rest_margin = 2;
inline constexpr Index rest_ahead = 2;

/// How much faster than the flow one particle may be, for itself.
inline constexpr double rest_jitter = 20;

/// Marks the cells that are disturbed at time t [s], where it was last looked at rest.looked_at;
/// fills place and n_awake and brings the flow to t:
///   u_c += (1 - exp(-4 (t - t_last)/quiet)) (mean of v - u_c)
void find_disturbed(Rest& rest, const SphState& sph, const Scene& scene, double t);

/// Looks for disturbances at time t [s] and notes which cells are in motion. True where particles
/// have to wake, or where a sixteenth of those in motion may rest.
bool look_for_rest(Rest& rest, const SphState& sph, const Scene& scene, double t);

/// Chooses who rests at time t, after look_for_rest(); whole clusters of eight are awake, and at
/// least one. Sets v = f = 0 (and what else would move it) of who comes to rest, sorts the
/// particles and counts scene.resting. Lists have to be made anew after it.
/// Returns the energy that was taken, at the half step after level n:
///   1/2 m |v(n+1/2)|^2 + |f(n)|^2 dt^2/(8 m) + m p/rho^2 drho/dt dt/2,
/// which is T(n) and the work of the half step, and what that work did to compression, which does
/// not follow any more; drho/dt is that of the last step.
double choose_rest(Rest& rest, SphState& sph, Scene& scene, double t, double dt);

/// Counts what follows from the tracked fields.
void count_rest(Rest& rest, SphState& sph, Scene& scene);

/// Energy [J] that the particles woken since the last level have there: 1/2 m |v(n)|^2, out of no
/// work, for they had no velocity before. They count as awake from then on.
double energy_of_woken(Rest& rest, const Scene& scene, double dt);

/// Power [W] that water in motion puts into the compression of water at rest,
///   sum m p/rho^2 drho/dt,  drho_i/dt = -sum_j m v_j . grad_i W_ij,
/// and that this does not store: its density stands. Needs the packed particles of the rates pass.
double power_at_border(Rest& rest, const SphState& sph, const Scene& scene);

}  // namespace gannet
