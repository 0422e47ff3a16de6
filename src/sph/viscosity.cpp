// The effect `viscosity`: Monaghan's artificial viscosity between particles that approach each
// other. The force itself is a term of the particle pair pass (sph/pair_pass.hpp); here are its
// keys and the account of the energy that it takes out of the motion.
#include <string>
#include <vector>

#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {

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

bool asked_for(const Keys& root) {
  return root.has("effects") && root.map("effects").has("viscosity");
}

void make_state(const Keys& root, Scene& scene) {
  if (!asked_for(root)) return;
  if (scene.particles.empty()) {
    root.map("effects").complain("viscosity", "acts on particles, and no part is made of them");
    return;
  }
  const Keys viscosity = root.map("effects").map("viscosity");
  auto& sph = scene.store.get<SphState>();
  sph.terms.alpha = viscosity.number("alpha");
  sph.terms.beta = viscosity.number("beta");
  if (!sph.terms.viscous()) return;
  sph.f_viscous.assign(static_cast<std::size_t>(scene.particles.size()), {});
  Field field =
      line_field("f_viscous", "N", "", Over::particles, sph.f_viscous, 0, 3, GhostRule::none);
  field.owner = "viscosity";
  field.checkpoint = false;  // every force pass stores it before look reads it
  scene.fields.push_back(std::move(field));
}

/// Energy that viscosity took from the motion of a part along the path of level n [J].
Work dissipated(const SphState& sph, const Scene& scene, int part, const Step& step) {
  return -sum_over_part(scene, part, [&](Index k) -> Work {
    return work_along(work_path(scene.nodes, scene.particles.begin + k, step),
                      xyz(sph.f_viscous[k]));
  });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (!asked_for(root) || scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (!sph.terms.viscous()) return;
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("artificial_viscosity", scene.parts[part].name));
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "work of artificial viscosity",
                 .reason = asked_for_at(root.map("effects").where("viscosity")),
                 .stage = Stage::look,
                 .reads = {"f_viscous", "v", "f"},
                 .owns = {"f_viscous"},
                 .run = [&, entries](const Step& step) {
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->add_work(dissipated(sph, scene, sph.parts[k], step));
                   }
                 }});
}

}  // namespace

Effect viscosity_effect() {
  return {.name = "viscosity", .schema = schema, .state = make_state, .operations = add_operations};
}

}  // namespace gannet
