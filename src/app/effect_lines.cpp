#include "app/effect_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/effects.hpp"
#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "scene/particle_material.hpp"

namespace gannet {

namespace {

/// The path in the case language that an effect is known by: the key of its table that has its
/// name, or the first; keys of materials do not count, as many effects share them.
std::string known_by(const Effect& effect) {
  if (effect.schema == nullptr) return "";
  std::string first;
  for (const SchemaEntry& entry : effect.schema()) {
    if (entry.path.starts_with("materials")) continue;
    std::string path = entry.path.empty() ? entry.key.name : entry.path + "." + entry.key.name;
    if (entry.key.name == effect.name) return path;
    if (first.empty()) first = std::move(path);
  }
  return first;
}

/// The first value that the user gave at a path in which * stands for any name; null for none.
const Value* find_given(const Value& map, const std::string& path) {
  const std::size_t dot = path.find('.');
  const std::string head = path.substr(0, dot);
  for (const Value& child : map.children) {
    if (!child.given || (head != "*" && child.name != head)) continue;
    if (dot == std::string::npos) return &child;
    if (const Value* found = find_given(child, path.substr(dot + 1)); found != nullptr) {
      return found;
    }
  }
  return nullptr;
}

/// The operation that says best why an effect is there: the first that the case asked for, or the
/// first; null for none.
const Operation* telling_operation(const Models& models, const std::string& effect) {
  const Operation* first = nullptr;
  for (const Model& model : models.list) {
    for (int s = 0; s < n_stages; ++s) {
      for (const Operation& op : model.plan.at(static_cast<Stage>(s))) {
        if (op.effect != effect) continue;
        if (op.reason.starts_with("asked for")) return &op;
        if (first == nullptr) first = &op;
      }
    }
  }
  return first;
}

std::size_t measures_of(const Simulation& simulation, const std::string& effect) {
  std::size_t n = 0;
  for (const EffectMemory& m : simulation.memory) n += m.effect == effect ? m.measures : 0;
  return n;
}

double seconds_of(const Models& models, const std::string& effect) {
  double sum = 0;
  for (const Model& model : models.list) {
    for (int s = 0; s < n_stages; ++s) {
      for (const Operation& op : model.plan.at(static_cast<Stage>(s))) {
        if (op.effect == effect) sum += op.watch.seconds;
      }
    }
  }
  return sum;
}

/// c0 of the fluids whose card leaves it open.
void add_sound_speeds(Simulation& simulation, std::vector<Choice>& choices) {
  const Keys root = simulation.source->keys();
  Scene& scene = simulation.scene;
  const auto& of_part = scene.store.get<ParticleMaterials>().of_part;
  for (std::size_t k = 0; k < std::min(of_part.size(), scene.parts.size()); ++k) {
    const Part& part = scene.parts[k];
    if (!part.is_particles() || part.material.empty()) continue;
    const Keys material = root.map("materials").map(part.material);
    const bool open = !material.has("c0") || material.word("c0") == "auto";
    if (!open || material.has("bulk")) continue;
    const std::string expected =
        material.has("expected_speed")
            ? fmt::format("the larger of expected_speed = {:.4g} m/s ({}) and what",
                          material.number("expected_speed"),
                          material.where("expected_speed").text())
            : "what";
    choices.push_back({material.path() + ".c0", fmt::format("{:.4g} m/s", of_part[k].c0),
                       fmt::format("10 times {} the start and sqrt(2 g height) of '{}' suggest",
                                   expected, part.name)});
  }
}

}  // namespace

const char* name_of(Presence::State state) {
  switch (state) {
    case Presence::State::off:
      return "off";
    case Presence::State::on:
      return "on";
    case Presence::State::automatic:
      return "automatic";
  }
  return "";
}

Presence presence_of(const Effect& effect, Simulation& simulation) {
  using State = Presence::State;
  if (effect.presence != nullptr) {
    return effect.presence(simulation.source->keys(), simulation.scene);
  }
  if (const Operation* op = telling_operation(simulation.models, effect.name); op != nullptr) {
    const bool rule = op->reason.starts_with("rule") || op->reason.starts_with("always there");
    return {rule ? State::automatic : State::on, op->reason};
  }
  const std::string path = known_by(effect);
  if (path.empty()) return {State::off, "nothing in the scene calls for it"};
  const Value* given = find_given(simulation.source->root, path);
  if (given == nullptr) return {State::off, "the case has no " + path};
  const std::string place = given->path + " at " + given->where.text();
  const bool acts = measures_of(simulation, effect.name) > 0 || effect.operations == nullptr;
  if (!acts) return {State::off, place + " leaves it without effect"};
  return {State::on, place};
}

std::vector<EffectLine> effect_lines(Simulation& simulation) {
  std::vector<EffectLine> lines;
  lines.push_back({"nodes",
                   {Presence::State::automatic, "always there: position, velocity, force, mass"},
                   simulation.memory[0].bytes});
  std::size_t k = 0;
  for (const Effect& effect : effects()) {
    ++k;
    lines.push_back({effect.name, presence_of(effect, simulation), simulation.memory[k].bytes,
                     seconds_of(simulation.models, effect.name)});
  }
  return lines;
}

std::vector<Choice> all_choices(Simulation& simulation) {
  std::vector<Choice> choices;
  add_sound_speeds(simulation, choices);
  for (const Effect& effect : effects()) {
    if (effect.choices == nullptr) continue;
    const auto more = effect.choices(simulation.source->keys(), simulation.scene);
    choices.insert(choices.end(), more.begin(), more.end());
  }
  choices.push_back({"GANNET_ISA (environment)", std::string(name_of(isa())),
                     "the widest that the processor has and the program was built for"});
  choices.push_back({"--threads", std::to_string(threads()), "all cores"});
  return choices;
}

}  // namespace gannet
