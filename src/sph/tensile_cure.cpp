// The effect `tensile_cure`: particles under tension attract and clump, which no real fluid does. A
// short-ranged repulsion keeps them apart,
//   f_i = -epsilon m^2 sum_j (t_i + t_j) (W_ij/W(dx))^4 grad_i W_ij,   t = max(-p/rho^2, 0)
// Monaghan 2000, J. Comput. Phys. 159, 290, for tension alone: where pressure is positive nothing
// changes. The repulsion is stiff: 0.2 is Monaghan's share; with 0.3, alpha = 0.05 and no density
// diffusion a dam break at a/20 runs away. The sum is a term of the force pass; it is no gradient
// of an energy, and what it takes out of the motion stands in the ledger as `tensile_cure`.
#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace tensile_cure {

Schema schema() {
  Key cure{.name = "tensile_cure",
           .kind = Kind::map,
           .text = "short-ranged repulsion of particles under tension, against clumping"};
  cure.keys = {{.name = "epsilon",
                .text = "share of the tension",
                .fallback = "0.2",
                .limits = between(0, 2)}};
  return {{"effects", cure}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "tensile_cure", scene)) return;
  auto& sph = scene.store.get<SphState>();
  sph.terms.tensile = root.map("effects").map("tensile_cure").number("epsilon");
  if (sph.terms.tensile > 0) make_force_term(sph.f_tensile, "f_tensile", "tensile_cure", scene);
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (sph.terms.tensile == 0) return;
  add_work_of_term(sph.f_tensile, "tensile_cure", "f_tensile",
                   asked_for_at(root.map("effects").where("tensile_cure")), scene, models);
}

}  // namespace tensile_cure
}  // namespace

Effect tensile_cure_effect() {
  return {.name = "tensile_cure",
          .schema = tensile_cure::schema,
          .state = tensile_cure::make_state,
          .operations = tensile_cure::add_operations};
}

}  // namespace gannet
