// The effect `renormalisation`: every n steps the density of each particle becomes the mean of what
// is around it, by the sum that is exact for a constant (Shepard 1968),
//   rho_i = sum_j m W_ij / sum_j (m/rho_j) W_ij
// It takes the noise out of densities, and with it some of what compression holds: the entry
// `renormalisation` collects sum m (e(rho before) - e(rho after)). It does not know of gravity: the
// density of water at rest, which grows with depth, is flattened a little near walls and surface;
// effects.density_diffusion leaves it alone.
#include <vector>

#include "plan/effect.hpp"
#include "sph/effects.hpp"
#include "sph/force_term.hpp"
#include "sph/sph_operations.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace renormalisation {

struct Renormalisation {
  std::int64_t every = 0;  ///< steps; 0: never
  Array<double> sum_mW, sum_VW;
};

Schema schema() {
  Key renormalisation{.name = "renormalisation",
                      .kind = Kind::map,
                      .text = "every few steps densities become the mean of their surroundings"};
  renormalisation.keys = {{.name = "every",
                           .kind = Kind::integer,
                           .text = "steps from one time to the next",
                           .fallback = "30",
                           .limits = at_least(1)}};
  return {{"effects", renormalisation}};
}

void make_state(const Keys& root, Scene& scene) {
  if (!particles_asked_for(root, "renormalisation", scene)) return;
  auto& state = scene.store.get<Renormalisation>();
  state.every = root.map("effects").map("renormalisation").integer("every");
  const auto n = static_cast<std::size_t>(scene.particles.size());
  for (auto [array, name, unit] :
       {std::tuple{&state.sum_mW, "sum_mW", "kg/m^3"}, std::tuple{&state.sum_VW, "sum_VW", ""}}) {
    array->assign(n, 0);
    Field field = plain_field(name, unit, "", Over::particles, *array, 1, GhostRule::none);
    field.owner = "renormalisation";
    field.checkpoint = false;  // read right after they are summed
    scene.fields.push_back(std::move(field));
  }
}

void renormalise(SphState& sph, const Scene& scene, const Renormalisation& state) {
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      sph.rho[k] = state.sum_mW[k] / state.sum_VW[k];
      sph.p[k] = pressure(eos_of(sph, scene, k), sph.rho[k]);
    }
  });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (scene.particles.empty()) return;
  auto& state = scene.store.get<Renormalisation>();
  if (state.every == 0) return;
  auto& sph = scene.store.get<SphState>();
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("renormalisation", scene.parts[part].name));
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "renormalisation of densities",
                 .reason = asked_for_at(root.map("effects").where("renormalisation")),
                 .stage = Stage::drift,
                 .reads = {"x", "rho"},
                 .writes = {"rho", "p"},
                 .run = [&, entries](const Step& step) {
                   if ((step.n + 1) % state.every != 0) return;
                   std::vector<double> before;
                   for (const int part : sph.parts) {
                     before.push_back(internal_energy_of_part(sph, scene, part));
                   }
                   sum_shepard(sph, scene, state.sum_mW.data(), state.sum_VW.data());
                   renormalise(sph, scene, state);
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->value +=
                         before[k] - internal_energy_of_part(sph, scene, sph.parts[k]);
                   }
                 }});
}

}  // namespace renormalisation
}  // namespace

Effect renormalisation_effect() {
  return {.name = "renormalisation",
          .schema = renormalisation::schema,
          .state = renormalisation::make_state,
          .operations = renormalisation::add_operations};
}

}  // namespace gannet
