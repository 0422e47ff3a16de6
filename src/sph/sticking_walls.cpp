#include "sph/sticking_walls.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "sph/moving_walls.hpp"

namespace gannet {

namespace {

/// The wall of a list that mirrors images of this kind across an axis; null without any.
const MirrorWall* wall_across(Eigen::Index axis, const std::vector<MirrorWall>& walls,
                              const Halo& halo, const Image& image) {
  const auto found = std::ranges::find_if(walls, [&](const MirrorWall& wall) {
    return wall.axis == axis && is_behind(halo, wall, image);
  });
  return found == walls.end() ? nullptr : &*found;
}

}  // namespace

Vec3 stuck_velocity(const Halo& halo, const Scene& scene, const Image& image, const Vec3& v) {
  Vec3 seen = v;
  for (Eigen::Index d = 0; d < 3; ++d) {
    if (image.sign[d] > 0) continue;
    if (const MirrorWall* wall = wall_across(d, halo.sticking, halo, image)) {
      seen = 2 * scene.planes[wall->plane].velocity - seen;
      continue;
    }
    const MirrorWall* wall = wall_across(d, halo.moving, halo, image);
    const double v_wall = wall == nullptr ? 0 : scene.planes[wall->plane].velocity[d];
    seen[d] = 2 * v_wall - seen[d];
  }
  return seen;
}

void stick_images(const Halo& halo, Scene& scene) {
  if (halo.sticking.empty()) return;
  const Index n = scene.particles.size();
  Line* v = scene.nodes.v.data() + scene.particles.begin;
  for_kinds(halo, 0, halo.n_ghosts(), [&](const Image& image, Index first, Index last) {
    const bool sticks = std::ranges::any_of(
        halo.sticking, [&](const MirrorWall& wall) { return is_behind(halo, wall, image); });
    if (!sticks) return;
    // Linear in v: what v = 0 gives, and what the unit vectors add to it.
    const Vec3 still = stuck_velocity(halo, scene, image, Vec3::Zero());
    const Vec3 sign = stuck_velocity(halo, scene, image, Vec3::Ones()) - still;
    parallel_for(last - first, node_chunk, [&](Index a, Index b) {
      for (Index g = first + a; g < first + b; ++g) {
        set_xyz(v[n + g], sign.cwiseProduct(xyz(v[halo.source[g]])) + still);
      }
    });
  });
}

}  // namespace gannet
