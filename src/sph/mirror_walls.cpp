// The effect `mirror_walls`: a plane across an axis mirrors the water in front
// of it. Beyond the plane stand images of the particles near it, with the same
// density and pressure and the mirrored velocity, so that sums over neighbours
// are as complete at a wall as within the water:
//   x_image = x - 2 ((x - x_plane) . n) n,   v_image = v - 2 (v . n) n
// Without them the water at a wall is pulled into the gap that the kernel finds
// there, and a tank at rest does not keep its pressure. Water and images
// together are symmetric about the plane: nothing flows through it, it does not
// hold back what slides along, and energy is kept as without it. The penalty of
// the plane (contact/planes.hpp) stays for what comes nearer than half a
// spacing.
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {

/// The axis that a plane stands across; -1 for one that leans or moves, which
/// only pushes.
int axis_of(const Plane& plane, const Scene& scene) {
  if (plane.moves) return -1;
  for (int d = 0; d < scene.dimension; ++d) {
    if (std::abs(plane.normal[d]) == 1) return d;
  }
  return -1;
}

/// The innermost plane of each end of a direction mirrors.
void make_state(const Keys&, Scene& scene) {
  if (scene.particles.empty()) return;
  Halo& halo = scene.store.get<SphState>().halo;
  for (const Plane& plane : scene.planes) {
    const int d = axis_of(plane, scene);
    if (d < 0 || halo.periodic[static_cast<std::size_t>(d)]) continue;
    const bool lower = plane.normal[d] > 0;
    bool& wall = (lower ? halo.wall_low : halo.wall_high)[static_cast<std::size_t>(d)];
    double& at = (lower ? halo.low : halo.high)[d];
    const double here = plane.point[d];
    at = !wall ? here : (lower ? std::max(at, here) : std::min(at, here));
    wall = true;
  }
}

/// Force of one image on the water in front of it along an axis [N]: the
/// pressure terms of the particle pair pass.
double force_of_image(const SphState& sph, const Scene& scene, Index image, int d) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const double reach = sph.kernel.reach();
  const auto p_rho2 = [&](Index k) { return sph.p[k] / (sph.rho[k] * sph.rho[k]); };
  const double own = p_rho2(image);
  double f = 0;
  for (Index k = 0; k < scene.particles.size(); ++k) {
    const Vec3 r_ij = xyz(x[k]) - xyz(x[image]);
    const double r2 = r_ij.squaredNorm();
    if (r2 >= reach * reach) continue;
    const double F = sph.kernel.F(std::sqrt(r2));
    f -= sph.m * sph.m * (p_rho2(k) + own) * F * r_ij[d];
  }
  return f;
}

/// Pressure of the water on a mirror wall along its axis, the reaction to the
/// force of its images [N]. Every image against every particle: for when it is
/// looked at, not for each step.
double pressure_force(const SphState& sph, const Scene& scene, int d, bool lower) {
  const double at = (lower ? sph.halo.low : sph.halo.high)[d];
  const Index first = scene.particles.size();
  return -parallel_sum(scene.nodes.n_ghosts, node_chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index g = begin; g < end; ++g) {
      const Image& image = sph.halo.image_of(g);
      const bool beyond = image.sign[d] < 0 && image.shift[d] == 2 * at;
      if (beyond) sum += force_of_image(sph, scene, first + g, d);
    }
    return sum;
  });
}

/// What the planes already measure is the force of their penalty: adds the
/// pressure.
void add_operations(const Keys&, Scene& scene, Models&) {
  if (scene.particles.empty()) return;
  const SphState& sph = scene.store.get<SphState>();
  for (const Plane& plane : scene.planes) {
    const int d = axis_of(plane, scene);
    if (d < 0) continue;
    const bool lower = plane.normal[d] > 0;
    const auto at = static_cast<std::size_t>(d);
    const bool mirrors = (lower ? sph.halo.wall_low : sph.halo.wall_high)[at] &&
                         (lower ? sph.halo.low : sph.halo.high)[d] == plane.point[d];
    if (!mirrors) continue;
    for (Measure& m : scene.measures) {
      if (m.name != "plane." + plane.name + ".force") continue;
      m.sample = [&sph, &scene, d, lower, penalty = m.sample](double* out) {
        penalty(out);
        out[d] += pressure_force(sph, scene, d, lower);
      };
    }
  }
}

}  // namespace

Effect mirror_walls_effect() {
  return {.name = "mirror_walls", .state = make_state, .operations = add_operations};
}

}  // namespace gannet
