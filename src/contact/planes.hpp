// Penalty contact of particles with rigid planes (of elements: part_planes.hpp). A plane has one
// side only: whatever is nearer to it than the contact distance is pushed along its normal, however
// far it went through. Particles that start nearer than half their spacing are pushed from the
// first step on; ones that start behind a plane are a mistake of the case.
#pragma once

#include <deque>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// What one plane does at this level.
struct PlaneSums {
  Vec3 force = Vec3::Zero();  ///< on the plane [N]
  Work work = Work::Zero();   ///< of the plane on what touches it, along work_path() [J]
  /// Of the same forces along the plane's own path: what moves a plane puts it in [J].
  Work put_in = Work::Zero();
};

/// How particles meet planes: contact distance, and stiffness k = rate2 m.
struct PlaneLaw {
  double distance = 0;  ///< [m]
  double rate2 = 0;     ///< [1/s^2]
};

/// All particles against all planes.
struct ParticlesOnPlanes {
  std::vector<PlaneLaw> law;      ///< per part
  std::vector<char> pushes;       ///< per plane: 0 where the case has its penalty switched off
  std::vector<PlaneSums> sums;    ///< per plane
  std::vector<PlaneSums> chunks;  ///< work space
  /// Particles that touched a plane in the last force stage; chunk c of the loop writes its own
  /// from entry c times the chunk size on.
  std::vector<Index> touching;
  std::vector<Index> n_touching;
};

/// Adds f = k p n with p = d - (x - x_plane) . n > 0 to nodes.f of all particles, and sums up what
/// each plane gets.
void particles_on_planes(Scene& scene, ParticlesOnPlanes& state);

/// Sums up the work of the same forces, sum f . work_path, while positions are still those of the
/// force stage. Work is measured along the velocities as all works are, and not as the energy
/// k p^2/2 of the springs: what moves particles without a velocity of their own (XSPH) changes p.
void work_of_planes(const Scene& scene, ParticlesOnPlanes& state, const Step& step);

/// Path of the point of a plane that is at x, as work_path() is that of a node.
WorkPath path_of_plane(const Plane& plane, const Vec3& x, const Step& step);

/// Step that springs of rate k/m allow beside what else acts on the nodes: 0.4 of 2/sqrt(k/m)
/// (see contact_step()); no limit for 0.
double plane_step(double rate2);

}  // namespace gannet
