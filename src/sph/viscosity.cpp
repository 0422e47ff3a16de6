// The effect `viscosity`: Monaghan's artificial viscosity between particles that approach each
// other. The force itself is a term of the particle pair pass (sph/pair_pass.hpp); here are its
// keys and the account of the energy that it takes out of the motion.
#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace viscosity {

Schema schema() {
  Key viscosity{
      .name = "viscosity", .kind = Kind::map, .text = "artificial viscosity of particles"};
  viscosity.keys = {
      {.name = "type",
       .kind = Kind::choice,
       .text = "form of the viscosity",
       .fallback = "monaghan",
       .choices = {"monaghan"}},
      {.name = "alpha", .text = "linear coefficient", .fallback = "0.05", .limits = between(0, 2)},
      {.name = "beta",
       .text = "quadratic coefficient, against particles running through each other",
       .fallback = "0",
       .limits = between(0, 4)}};
  return {{"effects", viscosity}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "viscosity", scene)) return;
  const Keys viscosity = root.map("effects").map("viscosity");
  auto& sph = scene.store.get<SphState>();
  sph.terms.alpha = viscosity.number("alpha");
  sph.terms.beta = viscosity.number("beta");
  if (sph.terms.viscous()) make_force_term(sph.f_viscous, "f_viscous", "viscosity", scene);
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (!sph.terms.viscous()) return;
  add_work_of_term(sph.f_viscous, "artificial_viscosity", "f_viscous",
                   asked_for_at(root.map("effects").where("viscosity")), scene, models);
}

}  // namespace viscosity
}  // namespace

Effect viscosity_effect() {
  return {.name = "viscosity",
          .schema = viscosity::schema,
          .state = viscosity::make_state,
          .operations = viscosity::add_operations};
}

}  // namespace gannet
