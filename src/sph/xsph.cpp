// The effect `xsph`: particles move with a mean velocity of their surroundings,
//   dx_i/dt = v_i + X_i,  X_i = -epsilon sum_j m (v_i - v_j) / ((rho_i + rho_j)/2) W_ij,
// while their own velocity v_i is what carries momentum and kinetic energy. The sum is a term of
// the rates pass (sph/pair_pass.hpp); here are its keys and the drift X dt.
//
// What this does to energy: every work is measured along v, and the density rate uses v alone, so
// kinetic and internal energy change by the same amounts with and without X and the balance closes
// without it. What differs is where the particles are: the weight of a particle that X moved down
// did no work along v. The entry `xsph` says how much, sum m g . X dt; it is shown and not added.
// Linear momentum does not change, for sum m X = 0, nor does angular momentum, for the moment that
// X dt x m v adds up to cancels pair by pair at the midpoint.
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"

namespace gannet {

namespace {
namespace xsph {

Schema schema() {
  Key xsph{.name = "xsph",
           .kind = Kind::map,
           .text = "particles move with the mean velocity of their surroundings"};
  xsph.keys = {{.name = "epsilon",
                .text = "share of the mean velocity",
                .fallback = "0.5",
                .limits = between(0, 1)}};
  return {{"effects", xsph}};
}

bool asked_for(const Keys& root) { return root.has("effects") && root.map("effects").has("xsph"); }

void make_state(const Keys& root, Scene& scene) {
  if (!asked_for(root)) return;
  if (scene.particles.empty()) {
    root.map("effects").complain("xsph", "acts on particles, and no part is made of them");
    return;
  }
  auto& sph = scene.store.get<SphState>();
  sph.terms.epsilon = root.map("effects").map("xsph").number("epsilon");
  if (sph.terms.epsilon == 0) return;
  sph.X.assign(static_cast<std::size_t>(scene.particles.size()), {});
  Field field = line_field("X", "m/s", "", Over::particles, sph.X, 0, 3, GhostRule::none);
  field.owner = "xsph";
  scene.fields.push_back(std::move(field));
}

void drift(const SphState& sph, Scene& scene, double dt) {
  Line* x = scene.nodes.x.data() + scene.particles.begin;
  parallel_for(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) add_xyz(x[k], dt * xyz(sph.X[k]));
  });
}

/// Work of the weight along the drift that no work path holds: sum m g . X dt [J].
double work_of_weight(const SphState& sph, const Scene& scene, int part, double dt) {
  return sph.m * dt *
         sum_over_awake(scene, part, [&](Index k) { return scene.gravity.dot(xyz(sph.X[k])); });
}

void add_operations(const Keys& root, Scene& scene, Models& models) {
  if (!asked_for(root) || scene.particles.empty()) return;
  auto& sph = scene.store.get<SphState>();
  if (sph.terms.epsilon == 0) return;
  std::vector<LedgerEntry*> entries;
  for (const int part : sph.parts) {
    entries.push_back(&models.ledger.entry("xsph", scene.parts[part].name));
    entries.back()->within_other = true;
  }
  models.of_node(scene.particles.begin)
      .plan.add({.name = "XSPH drift",
                 .reason = asked_for_at(root.map("effects").where("xsph")),
                 .stage = Stage::drift,
                 .reads = {"X"},
                 .writes = {"x"},
                 .owns = {"X"},
                 .run = [&, entries](const Step& step) {
                   drift(sph, scene, step.dt);
                   if (scene.gravity.isZero(0)) return;
                   for (std::size_t k = 0; k < entries.size(); ++k) {
                     entries[k]->value += work_of_weight(sph, scene, sph.parts[k], step.dt);
                   }
                 }});
}

}  // namespace xsph
}  // namespace

Effect xsph_effect() {
  return {.name = "xsph",
          .schema = xsph::schema,
          .state = xsph::make_state,
          .operations = xsph::add_operations};
}

}  // namespace gannet
