// A case text, parts made by hand and a few effects, put together as the program does it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "input/case.hpp"
#include "plan/effect.hpp"
#include "scene/draft.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

namespace gannet::test {

/// nx by ny quadrilaterals over [0, lx] x [0, ly] at z = 0, normals along z.
inline PartDraft plate(const std::string& name, int nx, int ny, double lx, double ly,
                       bool rotations = false) {
  PartDraft part;
  part.name = name;
  part.kind = "shell";
  part.rotations = rotations;
  part.cell = Cell::quad;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) part.points.emplace_back(lx * i / nx, ly * j / ny, 0.0);
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      for (const int k : {a, a + 1, a + nx + 2, a + nx + 1}) part.connectivity.push_back(k);
    }
  }
  return part;
}

inline PartDraft particles(const std::string& name, std::vector<Vec3> points) {
  PartDraft part;
  part.name = name;
  part.kind = "sph";
  part.points = std::move(points);
  return part;
}

/// Keys that let a case text name the parts that a test makes by hand.
inline Schema test_schema(const std::vector<Effect>& effects) {
  Schema schema{{"parts.*", {.name = "made", .kind = Kind::flag, .text = "by the test"}},
                {"contacts.*", {.name = "made", .kind = Kind::flag, .text = "by the test"}},
                {"contacts.*", {.name = "between", .kind = Kind::names, .text = "two sides"}}};
  for (const Effect& e : effects) {
    for (SchemaEntry& entry : e.schema()) schema.push_back(std::move(entry));
  }
  return schema;
}

struct World {
  std::unique_ptr<Case> the_case;
  Scene scene;
  Models models;
  double dt = 1e-3;  ///< the step that is taken [s]

  Model& model() { return models.list.front(); }
  double time() { return model().step.t; }
  void take_steps(int n) {
    Model* level[] = {&model()};
    for (int k = 0; k < n; ++k) step(std::span<Model* const>(level));
  }
  Vec3 measure(const std::string& name) {
    Vec3 value = Vec3::Constant(-1e99);
    for (const Measure& m : scene.measures) {
      if (m.name == name) m.sample(value.data());
    }
    return value;
  }
};

/// Every node gets the mass (and inertia, where it rotates) given; one model holds all nodes.
inline std::unique_ptr<World> make_world(const std::string& text, const Draft& draft,
                                         const std::vector<Effect>& effects, double mass = 2,
                                         double inertia = 0.5) {
  auto world = std::make_unique<World>();
  world->the_case = read_case_text("gannet: 1\n" + text, "case.yaml", test_schema(effects));
  const Keys root = world->the_case->keys();
  Scene& scene = world->scene;
  assemble(draft, scene);
  for (Line& x : scene.nodes.x) x.w = mass;
  for (Line& torque : scene.nodes.torque) torque.w = inertia;
  for (const Effect& e : effects) {
    if (e.state != nullptr) e.state(root, scene);
  }
  finish_masses(scene);
  Model& model = world->models.list.emplace_back();
  model.ranges = {{0, scene.nodes.n_owned}};
  add_leapfrog(scene, model, world->models.ledger);
  model.plan.add({.name = "steps of the test",
                  .stage = Stage::force,
                  .run = [](const Step&) {},
                  .stable_dt = [w = world.get()] { return w->dt; }});
  for (const Effect& e : effects) {
    if (e.operations != nullptr) e.operations(root, scene, world->models);
  }
  return world;
}

/// All mistakes noted, one a line.
inline std::string mistakes_of(const World& world) {
  std::string all;
  for (const std::string& m : world.the_case->mistakes.messages()) all += m + "\n";
  return all;
}

}  // namespace gannet::test
