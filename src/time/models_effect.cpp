// models.NAME.parts: parts that advance at a step of their own (multi-model subcycling). What no
// model names advances with the first, which is the slowest.
#include "time/models_effect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/bonds.hpp"

namespace gannet {

namespace {

Schema schema() {
  return {
      {"",
       {.name = "models",
        .kind = Kind::map,
        .text = "parts at steps of their own, or auto",
        .choices = {"auto"}}},
      {"models.*",
       {.name = "parts",
        .kind = Kind::names,
        .text = "parts and bodies that advance together, at a step of their own; the slowest "
                "model comes first, and has what none names",
        .required = true}},
      {"models.*",
       {.name = "slow_forces",
        .kind = Kind::choice,
        .text = "how forces of slower models act on its bodies: as impulses once a step of the "
                "slower one, or held through its substeps, which is smooth and for heavy bodies",
        .fallback = "impulses",
        .choices = {"impulses", "held"}}}};
}

constexpr int nowhere = -1;

/// Which model each part of a scene belongs to.
struct Division {
  std::vector<int> model_of_part;
  std::vector<int> model_of_node;
  std::vector<Keys> keys;  ///< of the models
};

/// The parts that a name stands for: a group of parts that move as one, or one part, with those
/// that move with it.
std::vector<int> parts_named(const std::string& name, Scene& scene) {
  if (const PartGroup* group = scene.group(name)) return group->parts;
  const int number = scene.part_number(name);
  if (number < 0) return {};
  for (const PartGroup& group : scene.groups) {
    if (std::ranges::find(group.parts, number) != group.parts.end()) return group.parts;
  }
  return {number};
}

std::string all_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const PartGroup& group : scene.groups) names.push_back(group.name);
  for (const Part& part : scene.parts) {
    if (part.cell != Cell::point) names.push_back(part.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

void take(const std::string& name, int model, Scene& scene, Division& division) {
  const Keys& keys = division.keys[static_cast<std::size_t>(model)];
  const std::vector<int> parts = parts_named(name, scene);
  if (parts.empty()) {
    keys.complain("parts", fmt::format("there is no part or body '{}'; there are: {}", name,
                                       all_names(scene)));
  }
  for (const int part : parts) {
    int& chosen = division.model_of_part[static_cast<std::size_t>(part)];
    if (chosen != nowhere && chosen != model) {
      keys.complain("parts", fmt::format("'{}' advances in model '{}' already{}", name,
                                         division.keys[static_cast<std::size_t>(chosen)].name(),
                                         parts.size() > 1 ? " (a body is in one model)" : ""));
      return;
    }
    chosen = model;
  }
}

/// Particles that no model names, as those of walls, advance with the ones that one does.
void follow_particles(const Scene& scene, Division& division) {
  int named = nowhere;
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    if (scene.parts[k].is_particles()) named = std::max(named, division.model_of_part[k]);
  }
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    int& model = division.model_of_part[k];
    if (scene.parts[k].is_particles() && model == nowhere) model = named;
  }
}

/// Particles are sorted among each other, whatever their part.
void keep_particles_together(const Scene& scene, Division& division) {
  int first = nowhere;
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    if (!scene.parts[k].is_particles()) continue;
    if (first == nowhere) first = static_cast<int>(k);
    if (division.model_of_part[k] == division.model_of_part[static_cast<std::size_t>(first)]) {
      continue;
    }
    const auto model = static_cast<std::size_t>(division.model_of_part[k]);
    division.keys[model].complain(
        "parts",
        fmt::format("'{}' and '{}' are made of particles, which all advance in one model",
                    scene.parts[static_cast<std::size_t>(first)].name, scene.parts[k].name));
  }
}

/// A body that no model names advances with the fastest of what is tied to it.
void follow_ties(const PartGroup& group, const Scene& scene, Division& division) {
  const auto model_of = [&](int part) -> int& {
    return division.model_of_part[static_cast<std::size_t>(part)];
  };
  if (model_of(group.parts.front()) != nowhere) return;
  int fastest = nowhere;
  for (const Index node : group.nodes) {
    for (std::size_t k = 0; k < scene.parts.size(); ++k) {
      if (scene.parts[k].nodes.contains(node)) {
        fastest = std::max(fastest, model_of(static_cast<int>(k)));
      }
    }
  }
  for (const int part : group.parts) model_of(part) = fastest;
}

/// The model of each node: that of its part, or the fastest of a bond that holds it; a node that is
/// tied to a body advances with it.
void divide_nodes(const Scene& scene, Division& division) {
  std::vector<int>& of = division.model_of_node;
  of.assign(static_cast<std::size_t>(scene.nodes.n_owned), 0);
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    const Range& nodes = scene.parts[k].nodes;
    std::fill(of.begin() + nodes.begin, of.begin() + nodes.end, division.model_of_part[k]);
  }
  std::vector<Bond> bonds;
  if (const Bonds* asked = scene.store.find<Bonds>()) bonds = asked->list;
  for (const PartGroup& group : scene.groups) {
    bonds.push_back({group.name, group.nodes});
    const auto body = static_cast<std::size_t>(group.parts.back());
    bonds.back().nodes.push_back(scene.parts[body].nodes.begin);
  }
  for (bool again = true; again;) {
    again = false;
    for (const Bond& bond : bonds) {
      int fastest = 0;
      for (const Index i : bond.nodes) {
        fastest = std::max(fastest, of[static_cast<std::size_t>(i)]);
      }
      for (const Index i : bond.nodes) {
        int& mine = of[static_cast<std::size_t>(i)];
        again = again || mine != fastest;
        mine = fastest;
      }
    }
  }
}

Division divide(const Keys& models, Scene& scene) {
  Division division;
  division.model_of_part.assign(scene.parts.size(), nowhere);
  for (const std::string& name : models.names()) {
    division.keys.push_back(models.map(name));
    for (const std::string& part : division.keys.back().words("parts")) {
      take(part, static_cast<int>(division.keys.size()) - 1, scene, division);
    }
  }
  follow_particles(scene, division);
  for (const PartGroup& group : scene.groups) follow_ties(group, scene, division);
  for (int& model : division.model_of_part) model = std::max(model, 0);
  keep_particles_together(scene, division);
  divide_nodes(scene, division);
  return division;
}

/// The nodes of one model as ranges.
std::vector<Range> ranges_of(const Division& division, int model) {
  std::vector<Range> ranges;
  const auto n = static_cast<Index>(division.model_of_node.size());
  for (Index i = 0; i < n; ++i) {
    if (division.model_of_node[static_cast<std::size_t>(i)] != model) continue;
    if (ranges.empty() || ranges.back().end != i) ranges.push_back({i, i});
    ranges.back().end = i + 1;
  }
  return ranges;
}

void note_models_of_parts(Scene& scene, const Division& division) {
  for (const int model : division.model_of_part) {
    scene.store.get<Bonds>().model_of_part.push_back(static_cast<std::size_t>(model));
  }
}

/// Models of one division, whose names and numbers of parts are as given.
void take_chosen(Scene& scene, Models& models) {
  const ChosenModels* chosen = scene.store.find<ChosenModels>();
  if (chosen == nullptr || chosen->list.size() < 2) return;
  Division division;
  division.model_of_part.assign(scene.parts.size(), 0);
  for (std::size_t k = 0; k < chosen->list.size(); ++k) {
    for (const int p : chosen->list[k].parts) {
      division.model_of_part[static_cast<std::size_t>(p)] = static_cast<int>(k);
    }
  }
  divide_nodes(scene, division);
  for (std::size_t k = 0; k < chosen->list.size(); ++k) {
    Model& model = models.list.emplace_back();
    model.name = chosen->list[k].name;
    model.ranges = ranges_of(division, static_cast<int>(k));
  }
  note_models_of_parts(scene, division);
}

void make_models(const Keys& root, Scene& scene, Models& models) {
  if (!root.has("models")) return;
  if (root.word("models") == "auto") return take_chosen(scene, models);
  const Keys keys = root.map("models");
  const Division division = divide(keys, scene);
  int number = 0;
  for (const Keys& one : division.keys) {
    Model& model = models.list.emplace_back();
    model.name = one.name();
    model.ranges = ranges_of(division, number++);
    if (one.word("slow_forces") == "held") scene.store.get<Bonds>().holding.push_back(model.name);
    if (model.ranges.empty()) one.complain("parts", "no nodes are left for this model");
  }
  note_models_of_parts(scene, division);
}

/// Says once where a model that stands before another allows the smaller step: nothing goes wrong
/// then, and nothing is gained.
void warn_of_order(Scene& scene, const Models& models) {
  for (std::size_t k = 1; k < models.list.size(); ++k) {
    const Model& slow = models.list[k - 1];
    const Model& fast = models.list[k];
    if (!(slow.vote.dt < fast.vote.dt)) continue;
    scene.warnings.push_back(fmt::format(
        "models: '{}' stands before '{}', but its first step is smaller ({:.3g} s, {}; {:.3g} s): "
        "list the slowest model first",
        slow.name, fast.name, slow.vote.dt, slow.vote.limited_by(), fast.vote.dt));
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (models.list.size() < 2) return;
  models.list.back().plan.add({.name = "order of models",
                               .reason = asked_for_at(root.where("models")),
                               .stage = Stage::look,
                               .where_all_meet = true,
                               .run = [&scene, &models](const Step&) {
                                 if (models.list.front().step.n == 0) warn_of_order(scene, models);
                               }});
}

/// Which parts went where with `models: auto`, and what that saves.
std::vector<Choice> choices(const Keys& root, Scene& scene) {
  std::vector<Choice> list;
  const ChosenModels* chosen = scene.store.find<ChosenModels>();
  if (chosen == nullptr || root.word("models") != "auto") return list;
  for (const ChosenModels::One& model : chosen->list) {
    std::vector<std::string> names;
    for (const int p : model.parts) {
      const Part& part = scene.parts[static_cast<std::size_t>(p)];
      if (part.cell != Cell::point) names.push_back(part.name);
    }
    list.push_back({"models." + model.name + ".parts", fmt::format("[{}]", fmt::join(names, ", ")),
                    fmt::format("allow a step of {:.3g} s at the start", model.dt)});
  }
  list.push_back(
      {"models", fmt::format("{} models", chosen->list.size()),
       fmt::format("{:.3g} % of the steps of elements and particles that one model would "
                   "make; what is tied or may touch stays together",
                   100 * chosen->share_of_work)});
  return list;
}

}  // namespace

Effect models_effect() {
  return {.name = "models",
          .schema = schema,
          .models = make_models,
          .operations = operations,
          .choices = choices};
}

}  // namespace gannet
