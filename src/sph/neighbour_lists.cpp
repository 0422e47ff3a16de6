#include "sph/neighbour_lists.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "search/spatial_sort.hpp"

namespace gannet {

namespace {

double reach(const SphState& sph) { return sph.kernel.reach() + sph.skin; }

/// Images and list for the positions x_build of the owned particles; everything
/// that is a function of x_build, so that a restart finds the same.
void build_from_x_build(SphState& sph, Scene& scene) {
  const Index n = scene.particles.size();
  Halo& halo = sph.halo;
  sph.x_build.resize(static_cast<std::size_t>(n));
  if (halo.active()) choose_images(sph.x_build.data(), n, reach(sph), halo);
  resize_ghosts(halo, scene);
  const auto n_ghosts = static_cast<Index>(halo.source.size());
  sph.x_build.resize(static_cast<std::size_t>(n + n_ghosts));
  for (Index g = 0; g < n_ghosts; ++g) {
    Line& x = sph.x_build[n + g];
    x = sph.x_build[halo.source[g]];
    set_xyz(x, halo.image[g].point(xyz(x)));
  }
  copy_out(halo, scene);
  build_cluster_list(sph.x_build, n, reach(sph), sph.list);
  start_ageing(sph.x_build, sph.kernel.reach(), sph.skin, sph.dx, sph.age);
  ++sph.n_builds;
}

/// Sorting needs numbers. Throws RunError that names the first particle without
/// a position.
void require_finite(const Scene& scene) {
  const Index n = scene.particles.size();
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const Index first = parallel_reduce(
      n, node_chunk, n,
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
          if (!xyz(x[k]).allFinite()) return k;
        }
        return n;
      },
      [](Index a, Index b) { return std::min(a, b); });
  if (first == n) return;
  throw RunError({"a particle has no position any more (not a number)",
                  text_of_particle(scene, first),
                  "its velocity or a force on it grew without limit",
                  "look at the last frames near that place; a smaller cfl, a "
                  "larger c0 or some "
                  "viscosity may help"});
}

/// Displacement of particle k since the lists were made, to the end of the step
/// [m].
Vec3 motion_of(const SphState& sph, const Scene& scene, Index k, double dt_half) {
  const std::size_t i = static_cast<std::size_t>(scene.particles.begin + k);
  Vec3 d = xyz(scene.nodes.x[i]) - xyz(sph.x_build[k]) + dt_half * xyz(scene.nodes.v[i]);
  if (!sph.X.empty()) d += 2 * dt_half * xyz(sph.X[k]);
  return d;
}

/// Whether a particle that was too far from a wall to have an image has come
/// within 2 h of it. Water that falls on a floor as a whole does not move
/// relative to itself, so that the age of the lists does not tell.
bool image_is_missing(const SphState& sph, const Scene& scene, double dt_half) {
  const Halo& halo = sph.halo;
  const double near = sph.kernel.reach();
  const auto came_near = [&](const Vec3& from, const Vec3& to) {
    for (Eigen::Index d = 0; d < 3; ++d) {
      const auto at = static_cast<std::size_t>(d);
      const double low = halo.low[d];
      const double high = halo.high[d];
      if (halo.wall_low[at] && from[d] - low > reach(sph) && to[d] - low < near) return true;
      if (halo.wall_high[at] && high - from[d] > reach(sph) && high - to[d] < near) return true;
    }
    return false;
  };
  return parallel_reduce(
      scene.particles.size(), node_chunk, false,
      [&](Index begin, Index end) {
        for (Index k = begin; k < end; ++k) {
          const Vec3 from = xyz(sph.x_build[k]);
          if (came_near(from, from + motion_of(sph, scene, k, dt_half))) return true;
        }
        return false;
      },
      [](bool a, bool b) { return a || b; });
}

}  // namespace

void rebuild_lists(SphState& sph, Scene& scene) {
  const Index n = scene.particles.size();
  require_finite(scene);
  if (sph.halo.active()) {
    sph.halo.source.clear();
    sph.halo.image.clear();
    resize_ghosts(sph.halo, scene);
    wrap_particles(sph.halo, scene);
  }
  sort_particles(scene, sph.dx);
  sph.x_build.resize(static_cast<std::size_t>(n));
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    std::copy(x + begin, x + end, sph.x_build.data() + begin);
  });
  build_from_x_build(sph, scene);
}

void restore_lists(SphState& sph, Scene& scene) { build_from_x_build(sph, scene); }

bool lists_are_stale(SphState& sph, const Scene& scene, double dt_half) {
  const Index n = scene.particles.size();
  measure_motion(sph.age, [&](Index source) -> Vec3 {
    if (source < n) return motion_of(sph, scene, source, dt_half);
    const Index g = source - n;
    return sph.halo.image[g].vector(motion_of(sph, scene, sph.halo.source[g], dt_half));
  });
  return outdated(sph.age) || (sph.halo.has_walls() && image_is_missing(sph, scene, dt_half));
}

}  // namespace gannet
