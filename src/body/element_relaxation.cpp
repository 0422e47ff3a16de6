// effects.element_relaxation: a static state by damped motion. The nodes of all elements are damped
// at twice the lowest frequency of the motion, critically for it; higher ones, which are damped
// less, raise the quotient and with it the rate as long as they are there. With `motion` the phase
// ends once little is left, and the run goes on undamped from the static state.
#include "body/element_relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.hpp"
#include "body/damping.hpp"
#include "body/effects.hpp"
#include "body/prescribed_motion.hpp"
#include "scene/tracked_values.hpp"

namespace gannet {

namespace {
namespace element_relaxation {

Schema schema() {
  Key relaxation{.name = "element_relaxation",
                 .kind = Kind::map,
                 .text = "dynamic relaxation: elements settle towards a static state"};
  relaxation.keys = {
      {.name = "until",
       .unit = dim::time,
       .text = "when the phase ends at the latest",
       .required = true,
       .limits = positive()},
      {.name = "motion",
       .text =
           "ends it before: kinetic energy over its largest so far, where it stays below for the "
           "time 1/rate",
       .limits = {0, 1, true, true}},
      {.name = "rate",
       .unit = dim::frequency,
       .text = "share of the velocity that is taken, per time; unless said twice the lowest "
               "frequency of the motion, which is watched",
       .limits = positive()}};
  return {{"effects", relaxation}};
}

bool asked_for(const Keys& root) {
  return root.has("effects") && root.map("effects").has("element_relaxation");
}

/// Particles are the last of all nodes: what comes before them belongs to elements.
Range nodes_of_elements(const Scene& scene) {
  const bool particles = !scene.particles.empty();
  return {0, particles ? scene.particles.begin : scene.nodes.n_owned};
}

void state(const Keys& root, Scene& scene) {
  if (!asked_for(root)) return;
  const Keys keys = root.map("effects").map("element_relaxation");
  auto& r = scene.store.get<ElementRelaxation>();
  r.nodes = nodes_of_elements(scene);
  if (r.nodes.empty()) {
    keys.complain("", "damps the nodes of elements, and no part is made of them");
    return;
  }
  r.asked_for = true;
  r.turning = {0, std::min(r.nodes.end, scene.nodes.rotating.end)};
  r.automatic = !keys.has("rate");
  r.phase.rate = keys.number_or("rate", 0);
  r.phase.until = keys.number("until");
  r.phase.share = keys.number_or("motion", 0);
  for (Array<Line>* lines : {&r.f, &r.f_old}) lines->assign(r.nodes.size(), {});
  for (Array<Line>* lines : {&r.torque, &r.torque_old}) lines->assign(r.turning.size(), {});
  const auto track = [&](Field field) {
    field.owner = "element_relaxation";
    scene.fields.push_back(std::move(field));
  };
  track(line_field("element_relaxation.f", "N", "", Over::scene, r.f_old, 0, 3, GhostRule::none));
  track(line_field("element_relaxation.torque", "N m", "", Over::scene, r.torque_old, 0, 3,
                   GhostRule::none));
  SettlingPhase& phase = r.phase;
  const auto number = [&](const char* name, const char* unit, double& value) {
    track_values(scene, "element_relaxation", name, unit, 1, [&value] { return &value; });
  };
  number("element_relaxation.rate", "1/s", phase.rate);
  number("element_relaxation.over", "", phase.over);
  number("element_relaxation.largest", "J", phase.largest);
  number("element_relaxation.still_since", "s", phase.still_since);
}

/// f and f_old, torque and torque_old change places with what this level has.
void keep_forces(ElementRelaxation& r, const Nodes& nodes) {
  std::copy_n(nodes.f.begin() + r.nodes.begin, r.nodes.size(), r.f_old.begin());
  std::copy_n(nodes.torque.begin() + r.turning.begin, r.turning.size(), r.torque_old.begin());
}

void relax(ElementRelaxation& r, Nodes& nodes, const Step& step) {
  if (r.automatic && step.dt_old > 0) {
    r.phase.rate = 2 * std::sqrt(frequency_squared(r, nodes, step));
  }
  if (r.automatic) keep_forces(r, nodes);
  damp_elements(r, nodes, step);
}

/// Kinetic energy of the nodes at level n [J].
double kinetic_energy(const ElementRelaxation& r, const Nodes& nodes, const Step& step) {
  return parallel_sum(r.nodes.size(), node_chunk, [&](Index begin, Index end) {
    double e = 0;
    for (Index i = r.nodes.begin + begin; i < r.nodes.begin + end; ++i) {
      e += 0.5 * nodes.x[i].w * velocity_at_level(nodes, i, step.dt).squaredNorm();
    }
    return e;
  });
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<ElementRelaxation>()) return;
  auto& r = scene.store.get<ElementRelaxation>();
  if (!r.asked_for) return;
  if (models.list.size() > 1) {
    root.map("effects").complain("element_relaxation",
                                 "relaxes what advances in one model; leave out 'models' until the "
                                 "elements are at rest");
    return;
  }
  const std::string reason = asked_for_at(root.map("effects").where("element_relaxation"));
  Plan& plan = models.of_node(r.nodes.begin).plan;
  LedgerEntry& lost = models.ledger.entry("relaxation", "elements");
  Nodes& nodes = scene.nodes;
  plan.add({.name = "relaxation of elements",
            .reason = reason,
            .stage = Stage::kick,
            .reads = {"v", "omega", "f", "torque"},
            .writes = {"v", "omega", "f", "torque"},
            .owns = {"element_relaxation.f", "element_relaxation.torque"},
            .run = [&](const Step& step) {
              if (r.phase.over == 0) relax(r, nodes, step);
            }});
  plan.add({.name = "work of the relaxation of elements",
            .reason = reason,
            .stage = Stage::look,
            .reads = {"v", "omega", "f", "torque"},
            .run = [&](const Step& step) {
              if (r.phase.over != 0) {
                lost.add_work(Work::Zero());
                return;
              }
              lost.add_work(work_of(r, nodes, step));
              look_at(r.phase, kinetic_energy(r, nodes, step), step.t);
            }});
}

}  // namespace element_relaxation
}  // namespace

double frequency_squared(const ElementRelaxation& r, const Nodes& nodes, const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  using Two = Eigen::Vector2d;  // v . df, m v . v
  const Two none = Two::Zero();
  const auto add = [dt](const Line& v_new, const Line& f, const Line& f_old, double mass,
                        Two& sum) {
    if (!(v_new.w > 0)) return;
    const Vec3 v = xyz(v_new) - dt * v_new.w * xyz(f);
    sum += Two(v.dot(xyz(f) - xyz(f_old)), mass * v.squaredNorm());
  };
  const Two sum = parallel_sum(r.nodes.size(), node_chunk, none, [&](Index begin, Index end) {
    Two part = none;
    for (Index k = begin; k < end; ++k) {
      const Index i = r.nodes.begin + k;
      add(nodes.v[i], nodes.f[i], r.f_old[k], nodes.x[i].w, part);
      if (!r.turning.contains(i)) continue;
      add(nodes.omega[i], nodes.torque[i], r.torque_old[k], nodes.torque[i].w, part);
    }
    return part;
  });
  return sum[1] > 0 ? std::max(0.0, -sum[0] / (step.dt_old * sum[1])) : 0.0;
}

void damp_elements(ElementRelaxation& r, Nodes& nodes, const Step& step) {
  const double dt = 0.5 * (step.dt_old + step.dt);
  const double rate = r.phase.rate;
  const auto damp = [&](Line& v, Line& f, double mass, Line& damping) {
    damping = {};
    if (!(v.w > 0)) return;
    const Vec3 v_old = xyz(v) - dt * v.w * xyz(f);
    const Vec3 dv = damping_kick(v_old, xyz(v), Vec3::Zero(), rate, dt);
    add_xyz(v, dv);
    set_xyz(damping, mass / dt * dv);
    add_xyz(f, xyz(damping));
  };
  parallel_for(r.nodes.size(), node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index i = r.nodes.begin + k;
      damp(nodes.v[i], nodes.f[i], nodes.x[i].w, r.f[k]);
      if (!r.turning.contains(i)) continue;
      damp(nodes.omega[i], nodes.torque[i], nodes.torque[i].w, r.torque[k]);
    }
  });
}

Work work_of(const ElementRelaxation& r, const Nodes& nodes, const Step& step) {
  const Work none = Work::Zero();
  return parallel_sum(r.nodes.size(), node_chunk, none, [&](Index begin, Index end) {
    Work lost = none;
    for (Index k = begin; k < end; ++k) {
      const Index i = r.nodes.begin + k;
      lost -= work_along(work_path(nodes, i, step), xyz(r.f[k]));
      if (!r.turning.contains(i)) continue;
      lost -= work_along(rotation_path(nodes, i, step), xyz(r.torque[k]));
    }
    return lost;
  });
}

Effect element_relaxation_effect() {
  return {.name = "element relaxation",
          .schema = element_relaxation::schema,
          .state = element_relaxation::state,
          .operations = element_relaxation::operations};
}

}  // namespace gannet
