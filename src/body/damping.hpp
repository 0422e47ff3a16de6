// Damping of velocity towards a given one, as sponges and relaxation use it: a force on particles
// of fluid, centred in the kick, and its work.
#pragma once

#include <vector>

#include "base/parallel.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace gannet {

/// Force of one damping and what it acts on.
struct DampingForce {
  std::vector<bool> of_part;  ///< whether particles of a part feel it
  Array<Line> f;              ///< one a particle, made in the kick and read at the same level [N]
};

/// Makes room for the force; all parts of fluid feel it, walls of particles do not.
void prepare_damping(DampingForce& damping, const Scene& scene);

/// Velocity that damping at the rate gamma towards u adds in a kick, centred in time:
///   dv = -gamma dt (v_mid - u),  v_mid = (v(n-1/2) + v(n+1/2))/2,  v(n+1/2) = v* + dv
/// and so dv = -gamma dt ((v(n-1/2) + v*)/2 - u)/(1 + gamma dt/2).
/// v_old = v(n-1/2), v_free = v* after the kick without it: 3 [m/s]; gamma >= 0 [1/s]; dt: length
/// of the kick [s]. |v - u| never grows by it, whatever gamma dt.
inline Vec3 damping_kick(const Vec3& v_old, const Vec3& v_free, const Vec3& u, double gamma,
                         double dt) {
  return (-gamma * dt / (1 + 0.5 * gamma * dt)) * (0.5 * (v_old + v_free) - u);
}

/// Work of the force at level n, along the path towards u and along u itself.
struct DampingWork {
  Work lost = Work::Zero();   ///< -sum f . (v - u) dt: taken out of the motion [J]
  Work drive = Work::Zero();  ///< sum f . u dt: put in by what moves with u [J]
};

/// Damps particles after the free kick of level n: v += dv, f += m dv/dt. rate(x): 3 [m] -> [1/s];
/// zero lets a particle alone. u: [m/s].
template <class Rate>
void damp(DampingForce& damping, Scene& scene, const Step& step, const Vec3& u, Rate&& rate) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  Nodes& nodes = scene.nodes;
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      damping.f[k] = {};
      if (!damping.of_part[scene.particle_part[k]]) continue;
      const auto i = static_cast<std::size_t>(scene.particles.begin + k);
      const double gamma = rate(xyz(nodes.x[i]));
      if (!(gamma > 0)) continue;
      const Vec3 v = xyz(nodes.v[i]);
      const Vec3 v_old = v - (dt * nodes.v[i].w) * xyz(nodes.f[i]);
      const Vec3 dv = damping_kick(v_old, v, u, gamma, dt);
      add_xyz(nodes.v[i], dv);
      set_xyz(damping.f[k], nodes.x[i].w / dt * dv);
      add_xyz(nodes.f[i], xyz(damping.f[k]));
    }
  });
}

/// Work of the force that damp() gave at this level.
DampingWork work_of(const DampingForce& damping, const Scene& scene, const Step& step,
                    const Vec3& u);

}  // namespace gannet
