// effects.relaxation: a phase of settling at the start of a run. Until a time, or until little
// motion is left, the velocity of particles of fluid is damped towards rest at one rate; then the
// phase is over for good and costs nothing.
//   v(n+1/2) -= gamma dt (v(n-1/2) + v(n+1/2))/2            `damping_kick()` in body/damping.hpp
#include <algorithm>
#include <string>

#include "body/damping.hpp"
#include "body/effects.hpp"
#include "body/relaxation.hpp"
#include "scene/tracked_values.hpp"

namespace gannet {

namespace {
namespace relaxation {

/// Found by scene.store.
struct Relaxation {
  bool asked_for = false;
  SettlingPhase phase;
  DampingForce damping;
};

Schema schema() {
  Key relaxation{.name = "relaxation",
                 .kind = Kind::map,
                 .text = "water settles at the start: its velocity is damped for a while"};
  relaxation.keys = {
      {.name = "rate",
       .unit = dim::frequency,
       .text = "share of the velocity that is taken, per time",
       .required = true,
       .limits = positive()},
      {.name = "until",
       .unit = dim::time,
       .text = "when the phase ends at the latest",
       .required = true,
       .limits = positive()},
      {.name = "motion",
       .text = "ends it before: kinetic energy over its largest so far, where it stays "
               "below for the time 1/rate",
       .limits = {0, 1, true, true}}};
  return {{"effects", relaxation}};
}

bool asked_for(const Keys& root) {
  return root.has("effects") && root.map("effects").has("relaxation");
}

void state(const Keys& root, Scene& scene) {
  if (!asked_for(root)) return;
  const Keys keys = root.map("effects").map("relaxation");
  if (scene.particles.empty()) {
    keys.complain("", "damps the velocity of particles, and no part is made of 'sph'");
    return;
  }
  auto& relaxation = scene.store.get<Relaxation>();
  relaxation.asked_for = true;
  SettlingPhase& phase = relaxation.phase;
  phase.rate = keys.number("rate");
  phase.until = keys.number("until");
  phase.share = keys.number_or("motion", 0);
  prepare_damping(relaxation.damping, scene);
  track_values(scene, "relaxation", "relaxation.over", "", 1, [&phase] { return &phase.over; });
  track_values(scene, "relaxation", "relaxation.largest", "J", 1,
               [&phase] { return &phase.largest; });
  track_values(scene, "relaxation", "relaxation.still_since", "s", 1,
               [&phase] { return &phase.still_since; });
}

/// Kinetic energy at level n of what is damped [J].
double kinetic_energy(const DampingForce& damping, const Scene& scene, const Step& step) {
  return parallel_sum(scene.awake().size(), node_chunk, [&](Index begin, Index end) {
    double e = 0;
    for (Index k = begin; k < end; ++k) {
      if (!damping.of_part[scene.particle_part[k]]) continue;
      const Index i = scene.particles.begin + k;
      e += 0.5 * scene.nodes.x[i].w * velocity_at_level(scene.nodes, i, step.dt).squaredNorm();
    }
    return e;
  });
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<Relaxation>()) return;
  auto& relaxation = scene.store.get<Relaxation>();
  if (!relaxation.asked_for) return;
  const std::string reason = asked_for_at(root.map("effects").where("relaxation"));
  Plan& plan = models.of_node(scene.particles.begin).plan;
  LedgerEntry& lost = models.ledger.entry("relaxation", "");
  plan.add({.name = "relaxation",
            .reason = reason,
            .stage = Stage::kick,
            .reads = {"v", "f"},
            .writes = {"v", "f"},
            .run = [&](const Step& step) {
              const SettlingPhase& phase = relaxation.phase;
              if (phase.over != 0) return;
              damp(relaxation.damping, scene, step, Vec3::Zero(),
                   [&](const Vec3&) { return phase.rate; });
            }});
  plan.add({.name = "work of relaxation",
            .reason = reason,
            .stage = Stage::look,
            .reads = {"v", "f"},
            .run = [&](const Step& step) {
              SettlingPhase& phase = relaxation.phase;
              if (phase.over != 0) {
                lost.add_work(Work::Zero());
                return;
              }
              lost.add_work(work_of(relaxation.damping, scene, step, Vec3::Zero()).lost);
              const double kinetic =
                  phase.share > 0 ? kinetic_energy(relaxation.damping, scene, step) : 0;
              look_at(phase, kinetic, step.t);
            }});
}

}  // namespace relaxation
}  // namespace

void look_at(SettlingPhase& phase, double kinetic, double t) {
  phase.largest = std::max(phase.largest, kinetic);
  if (phase.share == 0 || kinetic >= phase.share * phase.largest) phase.still_since = t;
  if (t >= phase.until || t - phase.still_since >= 1 / phase.rate) phase.over = 1;
}

Effect relaxation_effect() {
  return {.name = "relaxation",
          .schema = relaxation::schema,
          .state = relaxation::state,
          .operations = relaxation::operations};
}

}  // namespace gannet
