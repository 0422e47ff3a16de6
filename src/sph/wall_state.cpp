#include "sph/wall_state.hpp"

#include <algorithm>
#include <cmath>

#include "sph/carried_walls.hpp"

namespace gannet {

namespace {

/// (rotation by the vector theta - 1) r, without cancellation for small angles.
Vec3 turned_by(const Vec3& theta, const Vec3& r) {
  const double angle = theta.norm();
  if (angle == 0) return Vec3::Zero();
  const Vec3 axis = theta / angle;
  const Vec3 across = axis.cross(r);
  const double half = std::sin(0.5 * angle);
  return std::sin(angle) * across + 2 * half * half * axis.cross(across);
}

/// Slope of the straight line that holds from time t on; 0 before the first point and from the last
/// one on, and for no points [1/s].
double slope_at(const TimeTable& table, double t) {
  const auto after = std::upper_bound(table.t.begin(), table.t.end(), t);
  if (after == table.t.begin() || after == table.t.end()) return 0;
  const auto k = static_cast<std::size_t>(after - table.t.begin());
  return (table.y[k] - table.y[k - 1]) / (table.t[k] - table.t[k - 1]);
}

Vec3 centre_at(const WallMotion& motion, double t) {
  if (!(t > 0)) return motion.centre;
  return motion.centre + t * mean_over(motion.factor, 0, t) * motion.velocity;
}

/// Calls f(k, wall, sums) for all wall particles that have fluid near.
template <class F>
void for_wet_particles(const Walls& walls, const Scene& scene, F&& f) {
  const auto n = static_cast<Index>(walls.clusters.size());
  parallel_for(n, 512, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      for (Index lane = 0; lane < ClusterList::lanes; ++lane) {
        const Index k = ClusterList::lanes * walls.clusters[c] + lane;
        if (k >= scene.particles.size()) return;
        const WallSums& sums = walls.sums[ClusterList::lanes * c + lane];
        const Wall* wall = walls.of(scene, k);
        if (wall != nullptr && sums.W > 0) f(k, *wall, sums);
      }
    }
  });
}

void refresh_lists(Walls& walls, const SphState& sph, const Scene& scene) {
  if (walls.built == sph.n_builds) return;
  walls.built = sph.n_builds;
  walls.is_wall.resize(static_cast<std::size_t>(sph.list.n_sources));
  for (Index k = 0; k < sph.list.n_sources; ++k) {
    walls.is_wall[k] = walls.of(scene, k) != nullptr ? 1 : 0;
  }
  keep_across(sph.list, walls.is_wall, Across::fluid_near_walls, walls.near, walls.clusters);
  if (sph.X.empty()) return;
  keep_across(sph.list, walls.is_wall, Across::walls_near_fluid, walls.beside,
              walls.clusters_beside);
}

/// Fluid drifts with the mean of the fluid around it, and walls do not drift.
void take_walls_out_of_drift(Walls& walls, SphState& sph, const Scene& scene) {
  const auto n = static_cast<std::size_t>(scene.particles.size());
  walls.X_beside.assign(n, {});
  walls.drho_dt_beside.resize(n);
  if (!walls.clusters_beside.empty()) {
    pair_rates(walls.beside, sph.packed, parameters_of(sph),
               {.drho_dt = walls.drho_dt_beside.data(), .X = walls.X_beside.data()},
               {.clusters = walls.clusters_beside});
  }
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      if (walls.is_wall[k] == 0) {
        add_xyz(sph.X[k], -xyz(walls.X_beside[k]));
      } else {
        sph.X[k] = {};
      }
    }
  });
}

void set_pressure(Walls& walls, SphState& sph, const Scene& scene, Index k, double p) {
  const Murnaghan& eos = eos_of(sph, scene, k);
  // No fluid has a density at p0 - B and below.
  const double rho = density(eos, std::max(p, eos.p0 - 0.9 * eos.B));
  sph.rho[k] = rho;
  sph.p[k] = pressure(eos, rho);
  walls.p_rho2[k] = sph.p[k] / (rho * rho);
}

/// Ghosts of wall particles hold what these held before; ghosts of fluid are right.
void copy_to_images(const Walls& walls, SphState& sph, const Scene& scene) {
  const Index n = scene.particles.size();
  parallel_for(scene.nodes.n_ghosts, node_chunk, [&](Index begin, Index end) {
    for (Index g = begin; g < end; ++g) {
      const Index k = sph.halo.source[g];
      const Image& image = sph.halo.image_of(g);
      set_xyz(sph.v_seen[n + g], image.vector(xyz(sph.v_seen[k])));
      if (walls.is_wall[n + g] == 0) continue;
      sph.p[n + g] = sph.p[k];
      sph.rho[n + g] = sph.rho[k];
    }
  });
}

void set_dry_values(Walls& walls, SphState& sph, const Scene& scene) {
  const Line* v = scene.nodes.v.data() + scene.particles.begin;
  const Line* f = scene.nodes.f.data() + scene.particles.begin;
  const auto n = static_cast<std::size_t>(sph.list.n_sources);
  sph.v_seen.resize(n);
  parallel_for(scene.seen().size(), node_chunk, [&](Index begin, Index end) {
    std::copy(v + begin, v + end, sph.v_seen.data() + begin);
  });
  for_wall_particles(walls, scene, [&](Index k, const Wall&) {
    set_pressure(walls, sph, scene, k, eos_of(sph, scene, k).p0);
    walls.f_before[k] = f[k];
  });
}

}  // namespace

bool moves(const Wall& wall, const Scene& scene) {
  if (wall.waves || wall.on_body) return true;
  return wall.plane >= 0 ? scene.planes[static_cast<std::size_t>(wall.plane)].moves
                         : wall.motion.moves();
}

Vec3 mean_velocity(const Wall& wall, const Scene& scene, const Vec3& x, const Step& step) {
  if (wall.waves) return mean_velocity_of(*wall.waves, rest_place_of(*wall.waves, x, step.t), step);
  if (wall.plane >= 0) {
    const Plane& plane = scene.planes[static_cast<std::size_t>(wall.plane)];
    return plane.velocity + turned_by(step.dt * plane.spin, x - plane.point) / step.dt;
  }
  const WallMotion& motion = wall.motion;
  const double factor = mean_over(motion.factor, step.t, step.t + step.dt);
  Vec3 v = factor * motion.velocity;
  if (motion.omega.isZero(0)) return v;
  const Vec3 theta = factor * step.dt * motion.omega;
  return v + turned_by(theta, x - centre_at(motion, step.t)) / step.dt;
}

Vec3 mean_velocity_of(const WaveField& waves, const Vec3& X, const Step& step) {
  return (displacement_at(waves, X, step.t + step.dt) - displacement_at(waves, X, step.t)) /
         step.dt;
}

Vec3 velocity_at_start(const Wall& wall, const Scene& scene, const Vec3& x) {
  if (wall.waves) return velocity_of(*wall.waves, rest_place_of(*wall.waves, x, 0), 0);
  if (wall.plane >= 0) {
    const Plane& plane = scene.planes[static_cast<std::size_t>(wall.plane)];
    return plane.velocity + plane.spin.cross(x - plane.point);
  }
  const WallMotion& motion = wall.motion;
  return value_at(motion.factor, 0) * (motion.velocity + motion.omega.cross(x - motion.centre));
}

Vec3 acceleration_at(const Wall& wall, const Scene& scene, const Vec3& x, const Step& step) {
  if (wall.waves) {
    return acceleration_of(*wall.waves, rest_place_of(*wall.waves, x, step.t), step.t);
  }
  if (wall.plane >= 0) {
    const Plane& plane = scene.planes[static_cast<std::size_t>(wall.plane)];
    if (!(step.dt_old > 0)) return Vec3::Zero();
    const Vec3 r = x - plane.point;
    return (plane.velocity - plane.velocity_old) / step.dt_old +
           ((plane.spin - plane.spin_old) / step.dt_old).cross(r) +
           plane.spin.cross(plane.spin.cross(r));
  }
  const WallMotion& motion = wall.motion;
  const double factor = value_at(motion.factor, step.t);
  const double slope = slope_at(motion.factor, step.t);
  const Vec3 r = x - centre_at(motion, step.t);
  const Vec3 omega = factor * motion.omega;
  return slope * (motion.velocity + motion.omega.cross(r)) + omega.cross(omega.cross(r));
}

void set_wall_pressure(Walls& walls, SphState& sph, Scene& scene, const Step& step) {
  refresh_lists(walls, sph, scene);
  set_dry_values(walls, sph, scene);
  ParticleView view = view_of(sph, scene);
  view.p = sph.p.data();
  wall_sums(walls.near, walls.clusters, view, scene.dimension, sph.kernel.reach(), walls.sums);
  note_ease(walls, scene);
  for_wet_particles(walls, scene, [&](Index k, const Wall& wall, const WallSums& sums) {
    Vec3 g_minus_a = scene.gravity;
    if (wall.waves) {
      g_minus_a -= acceleration_of(*wall.waves, xyz(walls.rest_place[k]), step.t);
    } else if (wall.carrier != nullptr) {
      g_minus_a -= acceleration_on_body(wall, scene, xyz(walls.arm[k]));
    } else if (moves(wall, scene)) {
      g_minus_a -= acceleration_at(wall, scene, xyz(view.x[k]), step);
    }
    const WallValues values = wall_values(sums, g_minus_a);
    set_pressure(walls, sph, scene, k, values.p);
    set_xyz(sph.v_seen[k], wall.slips ? values.v : Vec3(2 * xyz(view.v[k]) - values.v));
  });
  copy_to_images(walls, sph, scene);
}

void make_terms(Walls& walls, const SphState& sph) {
  walls.terms.clear();
  for (WallTerm term : {WallTerm{&SphState::f_viscous, "artificial_viscosity", true, {}},
                        WallTerm{&SphState::f_laminar, "laminar_viscosity", true, {}},
                        WallTerm{&SphState::f_tensile, "tensile_cure", false, {}}}) {
    if ((sph.*term.of_particles).empty()) continue;
    term.f.assign((sph.*term.of_particles).size(), {});
    walls.terms.push_back(std::move(term));
  }
}

void set_wall_force(Walls& walls, SphState& sph, Scene& scene) {
  for_wall_particles(walls, scene, [&](Index k, const Wall&) {
    walls.f[k] = {};
    for (WallTerm& term : walls.terms) term.f[k] = {};
  });
  ForceOut out{.f = walls.f.data()};
  for (WallTerm& term : walls.terms) {
    if (term.of_particles == &SphState::f_viscous) out.f_viscous = term.f.data();
    if (term.of_particles == &SphState::f_laminar) out.f_laminar = term.f.data();
    if (term.of_particles == &SphState::f_tensile) out.f_tensile = term.f.data();
  }
  if (!walls.clusters.empty()) {
    pair_force(walls.near, sph.packed, parameters_of(sph), out, {.clusters = walls.clusters});
  }
  Line* f = scene.nodes.f.data() + scene.particles.begin;
  for_wall_particles(walls, scene, [&](Index k, const Wall&) {
    f[k] = walls.f_before[k];
    add_xyz(f[k], xyz(walls.f[k]));
  });
  for (Wall& wall : walls.list) {
    wall.force = sum_over_awake(scene, wall.part, [&](Index k) { return xyz(walls.f[k]); });
    wall.viscous_force = Vec3::Zero();
    for (const WallTerm& term : walls.terms) {
      if (!term.viscous) continue;
      wall.viscous_force +=
          sum_over_awake(scene, wall.part, [&](Index k) { return xyz(term.f[k]); });
    }
  }
}

void set_wall_rates(Walls& walls, SphState& sph, const Scene& scene) {
  refresh_lists(walls, sph, scene);
  for_wall_particles(walls, scene, [&](Index k, const Wall&) { walls.drho_dt[k] = 0; });
  if (!walls.clusters.empty()) {
    pair_rates(walls.near, sph.packed, parameters_of(sph), {.drho_dt = walls.drho_dt.data()},
               {.clusters = walls.clusters});
  }
  if (!sph.X.empty()) take_walls_out_of_drift(walls, sph, scene);
  if (sph.concentration.empty()) return;
  // Nor does anything else that follows from the crowd around them.
  for_wall_particles(walls, scene,
                     [&](Index k, const Wall&) { set_xyz(sph.concentration[k], Vec3::Zero()); });
}

void kick_walls(Walls& walls, Scene& scene, const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  const auto first = static_cast<std::size_t>(scene.particles.begin);
  Nodes& nodes = scene.nodes;
  for_wall_particles(walls, scene, [&](Index k, const Wall& wall) {
    if (wall.on_body) return;
    const std::size_t i = first + static_cast<std::size_t>(k);
    const Vec3 f = xyz(nodes.f[i]);
    if (!moves(wall, scene)) {
      set_xyz(walls.reaction[k], -f);
      set_xyz(nodes.f[i], Vec3::Zero());
      set_xyz(nodes.v[i], Vec3::Zero());
      return;
    }
    const Vec3 v = wall.waves ? mean_velocity_of(*wall.waves, xyz(walls.rest_place[k]), step)
                              : mean_velocity(wall, scene, xyz(nodes.x[i]), step);
    // Before the first level a wall has moved as it does from then on: nothing had to set it going.
    const Vec3 R = step.dt_old > 0 ? Vec3((v - xyz(nodes.v[i])) / (nodes.v[i].w * dt)) : Vec3(-f);
    set_xyz(walls.reaction[k], R);
    set_xyz(nodes.f[i], f + R);
    set_xyz(nodes.v[i], v);
  });
}

double wall_power(const Walls& walls, const SphState& sph, const Scene& scene, const Wall& wall) {
  return sph.m * sum_over_awake(scene, wall.part,
                                [&](Index k) { return walls.p_rho2[k] * walls.drho_dt[k]; });
}

}  // namespace gannet
