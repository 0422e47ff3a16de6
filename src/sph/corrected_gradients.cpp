// The effect `corrected_gradients`: the corrected smoothed particle method (CSPM). Gradients are
// those of a Taylor expansion about the particle, exact for linear fields also where neighbours are
// out of order,
//   drho_i/dt = -rho_i trace(sum_j F v_ij (x) r_ij S_i^-1),   S_i = sum_j F r_ij (x) r_ij
//   f_i = m/rho_i S_i^-1 sum_j (p_j - p_i) F r_ij
// Chen, Beraun and Jih 1999, Comput. Mech. 23, 279. Where S_i cannot be inverted (few neighbours,
// or all on a line) the usual sums stand. The price: a pair no longer pushes with equal and
// opposite forces, so momentum and energy are kept as well as the fields are smooth. What the
// correction adds to force and rate is kept apart, and its energy stands in the ledger as
// `corrected_gradients`, so that the balance still closes.
#include <vector>

#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace corrected_gradients {

Schema schema() {
  return {
      {"effects",
       {.name = "corrected_gradients",
        .kind = Kind::flag,
        .text = "gradients that are exact for linear fields (CSPM), at the price of momentum"}}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "corrected_gradients", scene)) return;
  auto& sph = scene.store.get<SphState>();
  sph.terms.corrected = root.map("effects").flag("corrected_gradients");
  if (!sph.terms.corrected) return;
  make_force_term(sph.f_correction, "f_correction", "corrected_gradients", scene);
  sph.drho_correction.assign(static_cast<std::size_t>(scene.particles.size()), 0);
  Field field = plain_field("drho_correction", "kg/(m^3 s)", "", Over::particles,
                            sph.drho_correction, 1, GhostRule::none);
  field.owner = "corrected_gradients";
  field.checkpoint = false;  // every rates pass stores it before it is read
  scene.fields.push_back(std::move(field));
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (!sph.terms.corrected) return;
  const std::string reason = asked_for_at(root.map("effects").where("corrected_gradients"));
  add_work_of_term(sph.f_correction, "corrected_gradients", "f_correction", reason, scene, models);
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("corrected_gradients", scene.parts[part].name));
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "energy of the corrected divergence",
                 .reason = reason,
                 .stage = Stage::rates,
                 .reads = {"rho", "drho_dt", "drho_correction"},
                 .owns = {"drho_correction"},
                 .run = [&, entries](const Step& step) {
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->value -=
                         energy_of_rate(sph, sph.drho_correction, scene, sph.parts[k], step.dt);
                   }
                 }});
}

}  // namespace corrected_gradients
}  // namespace

Effect corrected_gradients_effect() {
  return {.name = "corrected_gradients",
          .schema = corrected_gradients::schema,
          .state = corrected_gradients::make_state,
          .operations = corrected_gradients::add_operations};
}

}  // namespace gannet
