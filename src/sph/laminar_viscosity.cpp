// The effect `laminar_viscosity`: the viscosity of a Newtonian fluid,
//   f_i = sum_j m^2 2 mu/(rho_i rho_j) (r_ij . grad_i W_ij)/(r_ij^2 + 0.01 h^2) v_ij
// Morris, Fox and Zhu 1997, J. Comput. Phys. 136, 214, eq. 22. Pairs push with equal and opposite
// forces along v_ij, so linear momentum is kept, angular momentum only as the spacing goes to 0.
// Inside the fluid it is mu times the Laplacian of v; at a free surface it dissipates mu |grad
// v|^2, for potential flow half of what a Newtonian fluid does. The other form,
//   f_i = sum_j m^2 2 (d + 2) mu/(rho_i rho_j) (v_ij . r_ij)/(r_ij^2 + 0.01 h^2) grad_i W_ij
// (Monaghan and Gingold 1983, J. Comput. Phys. 52, 374; its factor and what it does at a free
// surface: Colagrossi, Antuono, Souto-Iglesias and Le Touze 2011, Phys. Rev. E 84, 026705), acts
// along the line of a pair: it keeps angular momentum, and dissipates 2 mu e : e, with a bulk
// viscosity of 5/3 mu (in the plane 2 mu) for what compresses. The sum is a term of the force pass
// (sph/pair_pass.hpp).
#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace laminar_viscosity {

Schema schema() {
  Key laminar{.name = "laminar_viscosity",
              .kind = Kind::map,
              .text = "viscosity of a Newtonian fluid made of particles"};
  laminar.keys = {
      {.name = "mu",
       .unit = dim::dynamic_viscosity,
       .text = "dynamic viscosity (water: 1 mPa*s)",
       .required = true,
       .limits = at_least(0)},
      {.name = "form",
       .kind = Kind::choice,
       .text = "forces along the velocity of a pair (laplacian: right between walls) or "
               "along its line (central: keeps angular momentum, right at free surfaces)",
       .fallback = "laplacian",
       .choices = {"laplacian", "central"}}};
  return {{"effects", laminar}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "laminar_viscosity", scene)) return;
  auto& sph = scene.store.get<SphState>();
  const Keys keys = root.map("effects").map("laminar_viscosity");
  sph.terms.mu = keys.number("mu");
  sph.terms.central = keys.word("form") == "central";
  if (sph.terms.mu > 0) make_force_term(sph.f_laminar, "f_laminar", "laminar_viscosity", scene);
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (sph.terms.mu == 0) return;
  add_work_of_term(sph.f_laminar, "laminar_viscosity", "f_laminar",
                   asked_for_at(root.map("effects").where("laminar_viscosity")), scene, models);
}

}  // namespace laminar_viscosity
}  // namespace

Effect laminar_viscosity_effect() {
  return {.name = "laminar_viscosity",
          .schema = laminar_viscosity::schema,
          .state = laminar_viscosity::make_state,
          .operations = laminar_viscosity::add_operations};
}

}  // namespace gannet
