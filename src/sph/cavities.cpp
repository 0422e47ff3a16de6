// Part of every fluid with a smallest pressure (materials.*.cavitation). Such a fluid parts where
// it would be pulled: its pressure stays p_min and its density goes on falling, a mixture of fluid
// and void, which resists again when as much volume has come back. Spray, and sheets that thin out
// over an edge, widen without end; what comes back of them later would have to be compressed by all
// of that before it resists. A void wider than materials.*.void is therefore forgotten:
//   rho >= (1 - void) rho_min
// With p_min = 0 that costs no energy; else the entry `cavities` collects it.
#include "sph/cavities.hpp"

#include <vector>

#include "plan/effect.hpp"
#include "sph/effects.hpp"

namespace gannet {

double forget_voids(SphState& sph, const Scene& scene, int part) {
  const Murnaghan& eos = sph.eos[part];
  const double least = internal_energy(eos, eos.rho_void);
  return sum_over_awake(scene, part, [&](Index k) {
    if (sph.rho[k] >= eos.rho_void) return 0.0;
    const double taken = sph.m * (internal_energy(eos, sph.rho[k]) - least);
    sph.rho[k] = eos.rho_void;
    return taken;
  });
}

namespace {

void add_operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  for (const int part : sph.parts) {
    if (sph.eos[part].rho_void == 0) continue;
    LedgerEntry& entry = models.ledger.entry("cavities", scene.parts[part].name);
    models.of_node(scene.particles.begin)
        .plan.add(
            {.name = "voids of " + scene.parts[part].name,
             .reason = "rule: its fluid has a smallest pressure",
             .stage = Stage::rates,
             .reads = {"rho"},
             .writes = {"rho"},
             .run = [&, part](const Step&) { entry.value += forget_voids(sph, scene, part); }});
  }
}

}  // namespace

Effect cavities_effect() { return {.name = "cavities", .operations = add_operations}; }

}  // namespace gannet
