// The effect `density_diffusion`: evens out density between neighbours, so that pressures do not
// jump from particle to particle,
//   drho_i/dt += 2 delta h c0 sum_j V (s_j - s_i) |F_ij|,   V = m/rho0,
// and leaves water at rest alone: s is a density that is the same everywhere in hydrostatic
// equilibrium, whatever the equation of state,
//   s = rho0 (w(rho) - g . x)/c0^2,   w = int dp/rho (material/murnaghan.hpp).
// Molteni and Colagrossi 2009, Comput. Phys. Commun. 180, 861 (s = rho); Fourtakas et al. 2019,
// Comput. Fluids 190, 346 take the hydrostatic part off, for one equation of state and to first
// order. The term is a part of the rates pass; pairs exchange equal amounts, so the sum of m rho is
// kept.
//
// It changes the energy of compression without work: the entry `density_diffusion` collects what it
// took, -sum m p/rho^2 D dt. Images at a wall have the s of what they mirror: nothing flows
// through.
#include <vector>

#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace density_diffusion {

Schema schema() {
  Key diffusion{
      .name = "density_diffusion",
      .kind = Kind::map,
      .text = "evens out density between neighbouring particles; leaves water at rest alone"};
  diffusion.keys = {{.name = "delta",
                     .text = "coefficient of the diffusion",
                     .fallback = "0.1",
                     .limits = between(0, 1)}};
  return {{"effects", diffusion}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "density_diffusion", scene)) return;
  auto& sph = scene.store.get<SphState>();
  sph.terms.delta = root.map("effects").map("density_diffusion").number("delta");
  if (sph.terms.delta == 0) return;
  const auto n = static_cast<std::size_t>(scene.particles.size());
  sph.s.assign(n, 0);
  sph.drho_diffusion.assign(n, 0);
  // Both are computed before they are read, in every step.
  for (auto [array, name, unit, rule] :
       {std::tuple{&sph.s, "s", "kg/m^3", GhostRule::copy},
        std::tuple{&sph.drho_diffusion, "drho_diffusion", "kg/(m^3 s)", GhostRule::none}}) {
    Field field = plain_field(name, unit, "", Over::particles, *array, 1, rule);
    field.owner = "density_diffusion";
    field.checkpoint = false;
    scene.fields.push_back(std::move(field));
  }
}

void find_potential(SphState& sph, const Scene& scene) {
  const Line* x = scene.nodes.x.data() + scene.particles.begin;
  const double c2 = sph.c0 * sph.c0;
  parallel_for(scene.seen().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Murnaghan& eos = eos_of(sph, scene, k);
      sph.s[k] = eos.rho0 * (enthalpy(eos, sph.rho[k]) - scene.gravity.dot(xyz(x[k]))) / c2;
    }
  });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (sph.terms.delta == 0) return;
  const std::string reason = asked_for_at(root.map("effects").where("density_diffusion"));
  Plan& plan = models.of_node(scene.particles.begin).plan;
  plan.add({.name = "density against hydrostatic equilibrium",
            .reason = reason,
            .stage = Stage::half_drift,
            .reads = {"x", "rho"},
            .writes = {"s"},
            .owns = {"s"},
            .run = [&](const Step&) { find_potential(sph, scene); }});
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("density_diffusion", scene.parts[part].name));
  }
  plan.add({.name = "energy of density diffusion",
            .reason = reason,
            .stage = Stage::rates,
            .reads = {"rho", "drho_dt", "drho_diffusion"},
            .owns = {"drho_diffusion"},
            .run = [&, entries](const Step& step) {
              for (std::size_t k = 0; k < entries.size(); ++k) {
                entries[k]->value -=
                    energy_of_rate(sph, sph.drho_diffusion, scene, sph.parts[k], step.dt);
              }
            }});
}

}  // namespace density_diffusion
}  // namespace

Effect density_diffusion_effect() {
  return {.name = "density_diffusion",
          .schema = density_diffusion::schema,
          .state = density_diffusion::make_state,
          .operations = density_diffusion::add_operations};
}

}  // namespace gannet
