#include "sph/force_term.hpp"

#include <algorithm>
#include <vector>

#include "sph/sph_state.hpp"

namespace gannet {

namespace {

/// "artificial_viscosity" as one says it.
std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Energy that a force took from the motion of a part along the path of level n [J].
Work taken(const Array<Line>& force, const Scene& scene, int part, const Step& step) {
  return -sum_over_awake(scene, part, [&](Index k) -> Work {
    return work_along(work_path(scene.nodes, scene.particles.begin + k, step), xyz(force[k]));
  });
}

}  // namespace

void make_force_term(Array<Line>& force, const std::string& name, const std::string& owner,
                     Scene& scene) {
  force.assign(static_cast<std::size_t>(scene.particles.size()), {});
  Field field = line_field(name, "N", "", Over::particles, force, 0, 3, GhostRule::none);
  field.owner = owner;
  field.checkpoint = false;  // every force pass stores it before look reads it
  scene.fields.push_back(std::move(field));
}

void add_work_of_term(const Array<Line>& force, const std::string& entry, const std::string& field,
                      const std::string& reason, Scene& scene, Models& models) {
  const auto& sph = scene.store.get<SphState>();
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry(entry, scene.parts[part].name));
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "work of " + in_words(entry),
                 .reason = reason,
                 .stage = Stage::look,
                 .reads = {field, "v", "f"},
                 .owns = {field},
                 .run = [&force, &scene, &sph, entries](const Step& step) {
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->add_work(taken(force, scene, sph.parts[k], step));
                   }
                 }});
}

double energy_of_rate(const SphState& sph, const Array<double>& rate, const Scene& scene, int part,
                      double dt) {
  const Murnaghan& eos = sph.eos[part];
  return sph.m * dt * sum_over_awake(scene, part, [&](Index k) {
           const double rho = sph.rho[k] - 0.5 * dt * sph.drho_dt[k];
           return pressure(eos, rho) / (rho * rho) * rate[k];
         });
}

bool particles_asked_for(const Keys& root, const char* name, const Scene& scene) {
  if (!root.has("effects") || !root.map("effects").has(name)) return false;
  if (!scene.particles.empty()) return true;
  root.map("effects").complain(name, "acts on particles, and no part is made of them");
  return false;
}

}  // namespace gannet
