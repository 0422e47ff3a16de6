// The effect `free_surface`: which particles lie at the free surface. Inside the water
//   div r = -sum_j V r_ij . grad_i W_ij
// is the dimension of the space; at the surface, where neighbours are missing, it is less. A
// particle is at the surface where div r < threshold times the dimension.
// Lee, Moulinec, Xu, Violeau, Laurence and Stansby 2008, J. Comput. Phys. 227, 8417 (with 0.75).
// Shown as FreeSurface (1 or 0). The sum is a term of the rates pass, at x(n+1/2).
#include "plan/effect.hpp"
#include "sph/concentration.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace free_surface {

/// The field that the output shows.
struct FreeSurface {
  double threshold = 0;
  Array<std::uint8_t> at_surface;  ///< 1 or 0, of the last rates pass
};

Schema schema() {
  Key surface{
      .name = "free_surface", .kind = Kind::map, .text = "finds the particles at the free surface"};
  surface.keys = {{.name = "threshold",
                   .text = "a particle is at the surface below this share of a full neighbourhood",
                   .fallback = "0.75",
                   .limits = between(0.1, 1)}};
  return {{"effects", surface}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "free_surface", scene)) return;
  auto& sph = scene.store.get<SphState>();
  auto& surface = scene.store.get<FreeSurface>();
  want_concentration(sph, scene, "free_surface");
  surface.threshold = root.map("effects").map("free_surface").number("threshold");
  surface.at_surface.assign(static_cast<std::size_t>(scene.particles.size()), 0);
  Field field = plain_field("free_surface", "", "FreeSurface", Over::particles, surface.at_surface,
                            1, GhostRule::none);
  field.owner = "free_surface";
  field.checkpoint = false;  // derived from div r
  field.prepare = [&sph, &surface] {
    for (std::size_t k = 0; k < surface.at_surface.size(); ++k) {
      surface.at_surface[k] = sph.concentration[k].w < surface.threshold * sph.kernel.dimension;
    }
  };
  scene.fields.push_back(std::move(field));
}

}  // namespace free_surface
}  // namespace

Effect free_surface_effect() {
  return {
      .name = "free_surface", .schema = free_surface::schema, .state = free_surface::make_state};
}

}  // namespace gannet
