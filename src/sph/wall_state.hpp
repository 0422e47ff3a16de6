// Walls of dummy particles: what they are, how they move, what the fluid does to them.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "base/time_table.hpp"
#include "plan/link.hpp"
#include "plan/plan.hpp"
#include "scene/carrier.hpp"
#include "scene/scene.hpp"
#include "scene/wave_field.hpp"
#include "sph/sph_state.hpp"
#include "sph/wall_pass.hpp"

namespace gannet {

/// How a wall moves: as a rigid body, whatever pushes it.
struct WallMotion {
  Vec3 velocity = Vec3::Zero();  ///< of the centre, times factor(t) [m/s]
  Vec3 omega = Vec3::Zero();     ///< times factor(t) [rad/s]
  Vec3 centre = Vec3::Zero();    ///< at t = 0 [m]
  TimeTable factor;
  [[nodiscard]] bool moves() const { return !velocity.isZero(0) || !omega.isZero(0); }
};

/// One part that is a wall.
struct Wall {
  int part = -1;   ///< number of the part
  int fluid = -1;  ///< part whose equation of state it has
  std::string name;
  Location where;
  bool slips = true;
  WallMotion motion;
  int plane = -1;  ///< number in scene.planes of the plane that it backs, and whose motion it has
  std::shared_ptr<const WaveField> waves;  ///< whose water it moves as; none: it does not
  bool on_body = false;                    ///< it rides on the body of its name
  Carrier* carrier = nullptr;              ///< that body, once it is made
  const Link* link = nullptr;              ///< to a body of a faster model (sph/linked_walls.hpp)
  // Of a wall on a body, tracked: how the body is taken to accelerate (sph/carried_walls.hpp).
  Vec3 a = Vec3::Zero();      ///< its centre [m/s^2]
  Vec3 alpha = Vec3::Zero();  ///< its rotation [rad/s^2]
  int n_layers = 0;           ///< of particles below the skin
  // Within a step:
  double ease = 0;                   ///< sum of 1/M + r^2/I_min over wet particles [1/kg]
  double share = 0;                  ///< theta
  Vec3 v_before = Vec3::Zero();      ///< of the centre, in the step before the level [m/s]
  Vec3 omega_before = Vec3::Zero();  ///< [rad/s]
  Quaternion q_level = Quaternion::Identity();  ///< of the body, at the level
  // What the last step says, at level n:
  Vec3 force = Vec3::Zero();          ///< of the fluid on the wall [N]
  Vec3 moment = Vec3::Zero();         ///< the same about the centre of the body that it is on [N m]
  Vec3 viscous_force = Vec3::Zero();  ///< the viscous part of it [N]
};

/// A term of the force pass whose work is measured: its array, its entry in the ledger.
struct WallTerm {
  Array<Line> SphState::*of_particles = nullptr;
  const char* entry = "";
  bool viscous = false;
  Array<Line> f;  ///< of the fluid on wall particles [N]
};

/// All walls of a scene: scene.store.get<Walls>(). Arrays over particles mean something for those
/// of walls alone.
struct Walls {
  std::vector<Wall> list;
  std::deque<Link> links;       ///< to bodies of faster models
  std::vector<int> of_part;     ///< which wall a part is; -1: none
  std::int64_t built = -1;      ///< SphState::n_builds of the lists below
  Array<std::uint8_t> is_wall;  ///< one a source
  ClusterList near;             ///< the fluid near clusters that hold wall particles
  Array<Index> clusters;        ///< which of them are not empty
  Array<WallSums> sums;
  ClusterList beside;  ///< the walls near clusters that hold fluid; where there is XSPH
  Array<Index> clusters_beside;
  Array<Line> X_beside;  ///< what walls add to X [m/s]
  Array<double> drho_dt_beside;
  Array<Line> f_before;  ///< what acted on a particle before the pair pass [N]
  Array<Line> f;         ///< force of the fluid [N]
  std::vector<WallTerm> terms;
  Array<Line> reaction;    ///< what keeps a particle to the motion of its wall [N]
  Array<double> p_rho2;    ///< tracked: p/rho^2 at level n [m^5/(kg s^2)]
  Array<Line> rest_place;  ///< tracked: X of particles that follow waves [m]; empty without them
  Array<Line> arm;        ///< tracked: of particles on bodies, from the centre, in the frame of the
                          ///< body [m]; empty without them
  Array<double> drho_dt;  ///< tracked: that the fluid alone would cause, at n-1/2 [kg/(m^3 s)]

  /// The wall of particle k; nullptr for fluid.
  [[nodiscard]] const Wall* of(const Scene& scene, Index k) const {
    const int w = of_part[static_cast<std::size_t>(scene.particle_part[k])];
    return w < 0 ? nullptr : &list[static_cast<std::size_t>(w)];
  }
};

/// Calls f(k, wall) for the particles of walls that are computed.
template <class F>
void for_wall_particles(const Walls& walls, const Scene& scene, F&& f) {
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Wall* wall = walls.of(scene, k);
      if (wall != nullptr) f(k, *wall);
    }
  });
}

/// Whether a wall ever moves.
bool moves(const Wall& wall, const Scene& scene);

/// Velocity that takes a particle at x from level n to its place at n+1 on the wall [m/s]: the mean
/// over the step of v = V(t) + omega(t) x (x - c(t)), along the chord of its circle. x: 3 [m]. A
/// wall behind a plane takes what the plane's own motion chose for the step.
Vec3 mean_velocity(const Wall& wall, const Scene& scene, const Vec3& x, const Step& step);

/// The same for a particle that follows waves from its place of rest X: 3 [m].
Vec3 mean_velocity_of(const WaveField& waves, const Vec3& X, const Step& step);

/// Velocity of a point x of the wall at t = 0 [m/s].
Vec3 velocity_at_start(const Wall& wall, const Scene& scene, const Vec3& x);

/// Acceleration of a point x of the wall at level n [m/s^2]; jumps of the factor have none. Behind
/// a plane, whose motion is known by mean velocities of steps, that of half a step before.
Vec3 acceleration_at(const Wall& wall, const Scene& scene, const Vec3& x, const Step& step);

/// Gives wall particles p_w, rho_w = rho(p_w) and the velocity that viscous terms see, from the
/// fluid near them at level n:
///   no slip: 2 v_w - v~_w,  free slip: v~_w
/// With no fluid near p_w = p0 and v_w is seen. Images of wall particles get the same. Reads
/// rho, p, x, v of all sources; writes sph.rho, sph.p, sph.v_seen, walls.p_rho2, walls.f_before.
void set_wall_pressure(Walls& walls, SphState& sph, Scene& scene, const Step& step);

/// The terms that the pass for the force has; after the state of all effects is made.
void make_terms(Walls& walls, const SphState& sph);

/// Puts the force of the fluid alone on wall particles, in place of what the pair pass gave them
/// (other walls push them too), and sums it up for each wall. Needs the packed particles of the
/// force pass.
void set_wall_force(Walls& walls, SphState& sph, Scene& scene);

/// Density rate of wall particles that the fluid alone causes; and takes out of X what walls put
/// into it: fluid drifts with fluid, and walls do not drift. Needs the packed particles of the
/// rates pass.
void set_wall_rates(Walls& walls, SphState& sph, const Scene& scene);

/// Moves wall particles with their wall, after the free kick: R = (v_w - v)/(dt/m), f += R. Those
/// on bodies are left to sph/carried_walls.hpp.
void kick_walls(Walls& walls, Scene& scene, const Step& step);

/// sum m p_w/rho_w^2 drho_w/dt of a wall [W]: what the pressure of the wall takes out of the motion
/// by the compression that the wall does not keep.
double wall_power(const Walls& walls, const SphState& sph, const Scene& scene, const Wall& wall);

}  // namespace gannet
