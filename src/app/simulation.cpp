#include "app/simulation.hpp"

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

/// Builds scene and plans of a case that was read.
std::unique_ptr<Simulation> build(std::unique_ptr<Case> read) {
  auto simulation = std::make_unique<Simulation>();
  simulation->source = std::move(read);
  Case& source = *simulation->source;
  const Keys root = source.keys();
  Scene& scene = simulation->scene;
  assemble(draft_parts(root, source.mistakes), scene);
  for (const Effect& e : effects()) {
    if (e.state != nullptr) e.state(root, scene);
  }
  source.mistakes.throw_if_any();
  finish_masses(scene);

  Model& model = simulation->models.list.emplace_back();
  model.ranges = {{0, scene.nodes.n_owned}};
  for (const Effect& e : effects()) {
    if (e.operations != nullptr) e.operations(root, scene, simulation->models);
  }
  source.mistakes.throw_if_any();
  return simulation;
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
