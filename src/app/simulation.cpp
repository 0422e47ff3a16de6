#include "app/simulation.hpp"

#include "app/auto_models.hpp"
#include "app/effects.hpp"
#include "scene/draft.hpp"

namespace gannet {

namespace {

Draft draft_parts(const Keys& root, Mistakes& mistakes) {
  Draft draft;
  draft.title = root.has("title") ? root.word("title") : "";
  draft.dimension = root.integer("dimension");
  for (const Effect& e : effects()) {
    if (e.parts != nullptr) e.parts(root, draft);
  }
  mistakes.throw_if_any();
  return draft;
}

/// Notes whose the operations and fields are that an effect just added.
void sign(Simulation& simulation, const std::string& effect) {
  for (Field& f : simulation.scene.fields) {
    if (f.effect.empty()) f.effect = effect;
  }
  for (Model& model : simulation.models.list) {
    for (int s = 0; s < n_stages; ++s) {
      for (Operation& op : model.plan.at(static_cast<Stage>(s))) {
        if (op.effect.empty()) op.effect = effect;
      }
    }
  }
}

/// Runs one part of the building for entry k of simulation.memory, whose the results then are.
template <class F>
void build_for(Simulation& simulation, std::size_t k, F&& part) {
  EffectMemory& memory = simulation.memory[k];
  const std::int64_t before = bytes_in_arrays;
  const std::size_t n_measures = simulation.scene.measures.size();
  part();
  memory.bytes += bytes_in_arrays - before;
  memory.measures += simulation.scene.measures.size() - n_measures;
  sign(simulation, memory.effect);
}

/// Builds scene and plans of a case that was read, divided among models as chosen.
std::unique_ptr<Simulation> build_divided(std::unique_ptr<Case> read, const ChosenModels& chosen) {
  auto simulation = std::make_unique<Simulation>();
  simulation->source = std::move(read);
  simulation->scene.store.get<ChosenModels>() = chosen;
  Case& source = *simulation->source;
  const Keys root = source.keys();
  Scene& scene = simulation->scene;
  simulation->memory.push_back({"nodes"});
  for (const Effect& e : effects()) simulation->memory.push_back({e.name});
  const Draft draft = draft_parts(root, source.mistakes);
  build_for(*simulation, 0, [&] { assemble(draft, scene); });
  std::size_t k = 0;
  for (const Effect& e : effects()) {
    ++k;
    if (e.state != nullptr) build_for(*simulation, k, [&] { e.state(root, scene); });
  }
  source.mistakes.throw_if_any();
  finish_masses(scene);

  for (const Effect& e : effects()) {
    if (e.models != nullptr) e.models(root, scene, simulation->models);
  }
  source.mistakes.throw_if_any();
  if (simulation->models.list.empty()) {
    simulation->models.list.emplace_back().ranges = {{0, scene.nodes.n_owned}};
  }
  k = 0;
  for (const Effect& e : effects()) {
    ++k;
    if (e.operations == nullptr) continue;
    build_for(*simulation, k, [&] { e.operations(root, scene, simulation->models); });
  }
  source.mistakes.throw_if_any();
  return simulation;
}

/// Builds a case; one that leaves its models to the program twice, the first time to see what steps
/// its parts allow.
std::unique_ptr<Simulation> build(std::unique_ptr<Case> read) {
  auto simulation = build_divided(std::move(read), {});
  if (!wants_auto_models(simulation->source->keys())) return simulation;
  const ChosenModels chosen = choose_models(*simulation);
  return build_divided(std::move(simulation->source), chosen);
}

}  // namespace

std::unique_ptr<Simulation> make_simulation(const std::string& file,
                                            const std::vector<std::string>& overrides) {
  return build(read_case(file, whole_schema(), overrides));
}

std::unique_ptr<Simulation> make_simulation_of_text(const std::string& text,
                                                    const std::vector<std::string>& overrides) {
  return build(read_case_text(text, "case.yaml", whole_schema(), overrides));
}

}  // namespace gannet
