#include "sph/moving_walls.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace gannet {

namespace {

double& place_of(Halo& halo, const MirrorWall& wall) {
  return (wall.lower ? halo.low : halo.high)[wall.axis];
}
double place_of(const Halo& halo, const MirrorWall& wall) {
  return (wall.lower ? halo.low : halo.high)[wall.axis];
}

}  // namespace

bool is_behind(const Halo& halo, const MirrorWall& wall, const Image& image) {
  return image.sign[wall.axis] < 0 && image.shift[wall.axis] == 2 * place_of(halo, wall);
}

void follow_walls(Halo& halo, const Scene& scene) {
  for (const MirrorWall& wall : halo.moving) {
    place_of(halo, wall) = scene.planes[wall.plane].point[wall.axis];
  }
}

WallsGone walls_gone(const Halo& halo, const Scene& scene, double dt) {
  WallsGone gone;
  for (const MirrorWall& wall : halo.moving) {
    const Plane& plane = scene.planes[wall.plane];
    const double now = plane.point[wall.axis] + dt * plane.velocity[wall.axis];
    (wall.lower ? gone.low : gone.high)[wall.axis] = now - place_of(halo, wall);
  }
  return gone;
}

Vec3 WallsGone::of_image(const Halo& halo, const Image& image) const {
  Vec3 gone = Vec3::Zero();
  for (const MirrorWall& wall : halo.moving) {
    if (is_behind(halo, wall, image)) gone[wall.axis] = 2 * (wall.lower ? low : high)[wall.axis];
  }
  return gone;
}

void move_images(const Halo& halo, Scene& scene) {
  if (halo.moving.empty()) return;
  const Index n = scene.particles.size();
  Line* x = scene.nodes.x.data() + scene.particles.begin;
  Line* v = scene.nodes.v.data() + scene.particles.begin;
  const WallsGone gone = walls_gone(halo, scene, 0);
  for_kinds(halo, 0, halo.n_ghosts(), [&](const Image& image, Index first, Index last) {
    Vec3 v_walls = Vec3::Zero();
    bool behind = false;
    for (const MirrorWall& wall : halo.moving) {
      if (!is_behind(halo, wall, image)) continue;
      behind = true;
      v_walls[wall.axis] = 2 * scene.planes[wall.plane].velocity[wall.axis];
    }
    if (!behind) return;
    const Vec3 shift = gone.of_image(halo, image);
    parallel_for(last - first, node_chunk, [&](Index a, Index b) {
      for (Index g = first + a; g < first + b; ++g) {
        const Index k = halo.source[g];
        set_xyz(x[n + g], image.point(xyz(x[k])) + shift);
        set_xyz(v[n + g], image.vector(xyz(v[k])) + v_walls);
      }
    });
  });
}

double force_of_images(const SphState& sph, const Scene& scene, const MirrorWall& wall) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const double reach = sph.kernel.reach();
  const Index n = scene.particles.size();
  const auto p_rho2 = [&](Index k) { return sph.p[k] / (sph.rho[k] * sph.rho[k]); };
  const ClusterList& list = sph.list;
  const auto force_on = [&](Index k, Index image) {
    const Vec3 r_ij = xyz(x[k]) - xyz(x[image]);
    const double r2 = r_ij.squaredNorm();
    if (r2 >= reach * reach) return 0.0;
    const double F = sph.kernel.F(std::sqrt(r2));
    return -sph.m * sph.m * (p_rho2(k) + p_rho2(image)) * F * r_ij[wall.axis];
  };
  return parallel_sum(list.n_active, 64, [&](Index begin, Index end) {
    double sum = 0;
    for (Index c = begin; c < end; ++c) {
      const Index last = std::min(list.n_targets, (c + 1) * ClusterList::lanes);
      for (auto e = list.offset[c]; e < list.offset[c + 1]; ++e) {
        const Index source = list.source[static_cast<std::size_t>(e)];
        if (source < n || source >= list.n_sources) continue;
        if (!is_behind(sph.halo, wall, sph.halo.image_of(source - n))) continue;
        for (Index k = c * ClusterList::lanes; k < last; ++k) sum += force_on(k, source);
      }
    }
    return sum;
  });
}

}  // namespace gannet
