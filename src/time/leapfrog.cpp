#include "time/leapfrog.hpp"

#include <string>
#include <vector>

#include "base/parallel.hpp"

namespace gannet {

namespace {

/// Calls f(range) for pieces of the ranges, without particles at rest.
template <class F>
void for_nodes(const Scene& scene, const std::vector<Range>& ranges, F&& f) {
  for (const Range& all : ranges) {
    const Range r = scene.computed(all);
    parallel_for(r.size(), node_chunk, [&](Index a, Index b) {
      f(Range{r.begin + a, r.begin + b});
    });
  }
}

/// The part of a range of nodes that has rotations.
Range rotating(const Nodes& nodes, const Range& r) {
  return {std::max(r.begin, nodes.rotating.begin), std::min(r.end, nodes.rotating.end)};
}

void clear_forces(Nodes& nodes, const Range& r) {
  for (Index i = r.begin; i < r.end; ++i) nodes.f[i] = {};
  const Range rot = rotating(nodes, r);
  for (Index i = rot.begin; i < rot.end; ++i) set_xyz(nodes.torque[i], Vec3::Zero());
}

void kick(Nodes& nodes, const Range& r, double dt) {
  for (Index i = r.begin; i < r.end; ++i) {
    Line& v = nodes.v[i];
    const Line& f = nodes.f[i];
    const double s = dt * v.w;
    v.x += s * f.x;
    v.y += s * f.y;
    v.z += s * f.z;
  }
  const Range rot = rotating(nodes, r);
  for (Index i = rot.begin; i < rot.end; ++i) {
    add_xyz(nodes.omega[i], dt * nodes.omega[i].w * xyz(nodes.torque[i]));
  }
}

void drift(Nodes& nodes, const Range& r, double dt) {
  for (Index i = r.begin; i < r.end; ++i) {
    Line& x = nodes.x[i];
    const Line& v = nodes.v[i];
    x.x += dt * v.x;
    x.y += dt * v.y;
    x.z += dt * v.z;
  }
}

double kinetic_of_node(const Nodes& nodes, Index i, double dt) {
  double e = 0.5 * nodes.x[i].w * velocity_at_level(nodes, i, dt).squaredNorm();
  if (nodes.rotating.contains(i)) {
    const Vec3 omega = xyz(nodes.omega[i]) - 0.5 * dt * nodes.omega[i].w * xyz(nodes.torque[i]);
    // A node whose rotation is not moved by its torque (1/I = 0) belongs to a rigid body, which
    // keeps its own account.
    if (nodes.omega[i].w > 0) e += 0.5 * nodes.torque[i].w * omega.squaredNorm();
  }
  return e;
}

double kinetic_of_range(const Nodes& nodes, const Range& r, double dt) {
  return parallel_sum(r.size(), node_chunk, [&](Index a, Index b) {
    double e = 0;
    for (Index i = r.begin + a; i < r.begin + b; ++i) e += kinetic_of_node(nodes, i, dt);
    return e;
  });
}

double kinetic_of_particles(const Scene& scene, int part, double dt) {
  const Range r = scene.awake();
  return parallel_sum(r.size(), node_chunk, [&](Index a, Index b) {
    double e = 0;
    for (Index k = a; k < b; ++k) {
      if (scene.particle_part[k] == part) e += kinetic_of_node(scene.nodes, r.begin + k, dt);
    }
    return e;
  });
}

/// The nodes of a part that advance in one model. What else the part has advances in another
/// model, and has an entry there.
struct KineticShare {
  int part = -1;
  std::vector<Range> nodes;
  LedgerEntry* entry = nullptr;
};

std::vector<KineticShare> kinetic_shares(const Scene& scene, const Model& model, Ledger& ledger) {
  std::vector<KineticShare> shares;
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    const Part& part = scene.parts[k];
    KineticShare share{.part = static_cast<int>(k)};
    Index n = 0;
    for (const Range& r : model.ranges) {
      const Range both{std::max(r.begin, part.nodes.begin), std::min(r.end, part.nodes.end)};
      if (both.begin >= both.end) continue;
      share.nodes.push_back(both);
      n += both.size();
    }
    if (share.nodes.empty()) continue;
    const bool whole = n == part.nodes.size();
    share.entry = &ledger.entry("kinetic", whole ? part.name : part.name + " in " + model.name);
    shares.push_back(std::move(share));
  }
  return shares;
}

void add_kinetic_energy(Scene& scene, Model& model, Ledger& ledger) {
  model.plan.add({.name = "kinetic energy",
                  .reason = "always there: the energy ledger",
                  .stage = Stage::look,
                  .reads = {"v", "f", "m"},
                  .run = [&scene, shares = kinetic_shares(scene, model, ledger)](const Step& step) {
                    const bool several = scene.particles.size() > 0 && scene.parts.size() > 1;
                    for (const KineticShare& share : shares) {
                      const Part& part = scene.parts[static_cast<std::size_t>(share.part)];
                      double value = 0;
                      if (part.is_particles() && several) {
                        value = kinetic_of_particles(scene, share.part, step.dt);
                      } else {
                        for (const Range& r : share.nodes) {
                          value += kinetic_of_range(scene.nodes, scene.computed(r), step.dt);
                        }
                      }
                      share.entry->value = value;
                    }
                  }});
}

}  // namespace

void add_leapfrog(Scene& scene, Model& model, Ledger& ledger) {
  Nodes& nodes = scene.nodes;
  const std::vector<Range> ranges = model.ranges;
  const char* reason = "always there: leapfrog in time";
  model.plan.add({.name = "clear forces",
                  .reason = reason,
                  .stage = Stage::force,
                  .writes = {"f", "torque"},
                  .run = [&scene, &nodes, ranges](const Step&) {
                    for_nodes(scene, ranges, [&](const Range& r) { clear_forces(nodes, r); });
                  }});
  model.plan.add({.name = "kick",
                  .reason = reason,
                  .stage = Stage::kick,
                  .reads = {"f", "torque"},
                  .writes = {"v", "omega"},
                  .run = [&scene, &nodes, ranges](const Step& s) {
                    const double dt = 0.5 * (s.dt_old + s.dt);
                    for_nodes(scene, ranges, [&](const Range& r) { kick(nodes, r, dt); });
                  }});
  const auto drift_half = [&scene, &nodes, ranges](const Step& s) {
    for_nodes(scene, ranges, [&](const Range& r) { drift(nodes, r, 0.5 * s.dt); });
  };
  for (const Stage stage : {Stage::half_drift, Stage::drift}) {
    model.plan.add({.name = stage == Stage::drift ? "drift" : "half drift",
                    .reason = reason,
                    .stage = stage,
                    .reads = {"v"},
                    .writes = {"x"},
                    .run = drift_half});
  }
  add_kinetic_energy(scene, model, ledger);
}

namespace {

Schema time_step_schema() {
  Key step{.name = "time_step", .kind = Kind::map, .text = "how the time step is chosen"};
  step.keys = {{.name = "scale",
                .text = "share of the smallest stable step that is taken",
                .fallback = "1",
                .limits = {0, 10, true, false}}};
  return {{"effects", step}};
}

void leapfrog_operations(const Keys& root, Scene& scene, Models& models) {
  double scale = 1;
  if (root.has("effects") && root.map("effects").has("time_step")) {
    scale = root.map("effects").map("time_step").number_or("scale", 1);
  }
  for (Model& model : models.list) {
    model.dt_scale = scale;
    add_leapfrog(scene, model, models.ledger);
  }
}

}  // namespace

Effect leapfrog_effect() {
  return {.name = "leapfrog", .schema = time_step_schema, .operations = leapfrog_operations};
}

}  // namespace gannet
