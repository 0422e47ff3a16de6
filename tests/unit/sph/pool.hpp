// Particles as a case makes them, for tests: the effects of the SPH room and the leapfrog.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "input/case.hpp"
#include "mesh/mesh_keys.hpp"
#include "sph/effects.hpp"
#include "sph/sph_state.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

namespace gannet::test {

/// A scene of particles that advances by the one step function.
struct Pool {
  std::unique_ptr<Case> input;
  Scene scene;
  Models models;

  /// text: the case without its first line. change: may alter the nodes of the assembled scene
  /// before the lists are built.
  explicit Pool(const std::string& text, int dimension = 3, const Vec3& gravity = Vec3::Zero(),
                const std::function<void(Scene&)>& change = {}) {
    const std::array<Effect, 8> effects{
        sph_effect(),      rest_effect(),         viscosity_effect(),   xsph_effect(),
        periodic_effect(), mirror_walls_effect(), flow_probes_effect(), sph_probes_effect()};
    Schema schema = mesh_schema();
    for (const Effect& e : effects) {
      if (e.schema == nullptr) continue;
      for (SchemaEntry& entry : e.schema()) schema.push_back(std::move(entry));
    }
    input = read_case_text("gannet: 1\n" + text, "pool.yaml", schema);
    const Keys root = input->keys();
    Draft draft;
    draft.dimension = dimension;
    for (const Effect& e : effects) {
      if (e.parts) e.parts(root, draft);
    }
    input->mistakes.throw_if_any();
    assemble(draft, scene);
    scene.gravity = gravity;
    if (change) change(scene);
    for (const Effect& e : effects) {
      if (e.state) e.state(root, scene);
    }
    input->mistakes.throw_if_any();
    finish_masses(scene);
    Model& model = models.list.emplace_back();
    model.ranges = {{0, scene.nodes.n_owned}};
    add_leapfrog(scene, model, models.ledger);
    add_weight(gravity);
    for (const Effect& e : effects) {
      if (e.operations) e.operations(root, scene, models);
    }
  }

  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  SphState& sph() { return scene.store.get<SphState>(); }
  Plan& plan() { return models.list.front().plan; }
  [[nodiscard]] const Step& at() const { return models.list.front().step; }

  void run(int n_steps) {
    for (int k = 0; k < n_steps; ++k) advance(models);
  }

  /// Index among the particles of each id, in order of ids.
  [[nodiscard]] std::vector<Index> by_id() const {
    std::map<std::int64_t, Index> place;
    for (Index k = 0; k < scene.particles.size(); ++k) {
      place[scene.nodes.id[scene.particles.begin + k]] = k;
    }
    std::vector<Index> order;
    for (const auto& [id, k] : place) order.push_back(k);
    return order;
  }

  [[nodiscard]] Vec3 x(Index k) const { return xyz(scene.nodes.x[scene.particles.begin + k]); }
  [[nodiscard]] Vec3 v(Index k) const { return xyz(scene.nodes.v[scene.particles.begin + k]); }

 private:
  void add_weight(const Vec3& gravity) {
    if (gravity.isZero(0)) return;
    plan().add({.name = "gravity", .stage = Stage::force, .run = [this, gravity](const Step&) {
                  for (Index i = 0; i < scene.computed({0, scene.nodes.n_owned}).end; ++i) {
                    add_xyz(scene.nodes.f[i], scene.nodes.x[i].w * gravity);
                  }
                }});
  }
};

/// The entries of owned nodes and particles, and of the whole scene, in every field that a
/// checkpoint holds, by name.
using Saved = std::map<std::string, std::vector<std::byte>>;

inline Index owned_entries(const Scene& scene, const Field& field) {
  if (field.over == Over::scene) return field.count();
  return field.over == Over::nodes ? scene.nodes.n_owned : scene.particles.size();
}

template <class F>
void for_each_component(const Scene& scene, F&& f) {
  for (const Field& field : scene.fields) {
    if (!field.checkpoint) continue;
    std::size_t at = 0;
    for (Index e = 0; e < owned_entries(scene, field); ++e) {
      for (int c = 0; c < field.components; ++c) {
        f(field, field.at(e, c), at);
        at += static_cast<std::size_t>(size_of(field.type));
      }
    }
  }
}

inline Saved save(const Scene& scene) {
  Saved saved;
  for_each_component(scene, [&](const Field& field, const std::byte* from, std::size_t) {
    saved[field.name].insert(saved[field.name].end(), from, from + size_of(field.type));
  });
  return saved;
}

inline void load(const Saved& saved, Scene& scene) {
  for_each_component(scene, [&](const Field& field, std::byte* to, std::size_t at) {
    std::memcpy(to, saved.at(field.name).data() + at,
                static_cast<std::size_t>(size_of(field.type)));
  });
}

}  // namespace gannet::test
