#include "app/auto_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "contact/kernel_contact.hpp"
#include "contact/part_contact.hpp"
#include "plan/vote_of_part.hpp"
#include "scene/bonds.hpp"
#include "scene/part_nodes.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

/// A model of its own pays where its step is at most this share of that of the slower one.
constexpr double share_of_slower = 0.5;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

/// Sets of parts that stay together.
struct Units {
  std::vector<int> root;
  explicit Units(std::size_t n) : root(n) { std::iota(root.begin(), root.end(), 0); }
  int find(int p) {
    while (root[at(p)] != p) p = root[at(p)];
    return p;
  }
  void join(int a, int b) {
    const int low = std::min(find(a), find(b));
    root[at(std::max(find(a), find(b)))] = low;
  }
};

Units units_of(Scene& scene) {
  Units units(scene.parts.size());
  int water = -1;
  for (int p = 0; p < static_cast<int>(scene.parts.size()); ++p) {
    if (!scene.parts[at(p)].is_particles()) continue;
    if (water >= 0) units.join(water, p);
    water = p;
  }
  for (const PartGroup& group : scene.groups) {
    for (const int p : group.parts) units.join(group.parts.front(), p);
    for (const Index node : group.nodes) units.join(group.parts.front(), part_of(scene, node));
  }
  if (const Bonds* bonds = scene.store.find<Bonds>()) {
    for (const Bond& bond : bonds->list) {
      for (const Index node : bond.nodes) {
        units.join(part_of(scene, bond.nodes.front()), part_of(scene, node));
      }
    }
  }
  if (const KernelContacts* contacts = scene.store.find<KernelContacts>()) {
    for (const KernelContact& c : contacts->list) units.join(c.particle_part, c.surface_part);
  }
  if (const PartContacts* contacts = scene.store.find<PartContacts>()) {
    for (const PartContact& c : contacts->list) units.join(c.sides[0].part, c.sides[1].part);
  }
  return units;
}

/// The part whose vote an operation casts; -1: that of no single part.
int part_of_vote(const Scene& scene, const Operation& op) {
  const auto found = std::ranges::find_if(
      scene.parts, [&](const Part& part) { return casts_vote_of(op, part.name); });
  return found == scene.parts.end() ? -1 : static_cast<int>(found - scene.parts.begin());
}

int first_particles(const Scene& scene) {
  const auto found = std::ranges::find_if(scene.parts, &Part::is_particles);
  return found == scene.parts.end() ? -1 : static_cast<int>(found - scene.parts.begin());
}

/// The step that each unit allows, by its root; infinite where it limits none.
std::vector<double> steps_of(const Scene& scene, const Models& models, Units& units) {
  std::vector<double> steps(scene.parts.size(), std::numeric_limits<double>::infinity());
  const int water = first_particles(scene);
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : models.list.front().plan.at(static_cast<Stage>(s))) {
      if (!op.stable_dt) continue;
      const int p = part_of_vote(scene, op);
      if (p < 0 && water < 0) continue;
      double& step = steps[at(units.find(p < 0 ? water : p))];
      step = std::min(step, op.stable_dt());
    }
  }
  return steps;
}

/// A unit and its step.
struct Unit {
  int root = -1;
  double dt = 0;
};

/// Largest step first; what goes with the water is as slow as the water.
std::vector<Unit> sorted_units(const Scene& scene, Units& units, const std::vector<double>& steps) {
  const int water = first_particles(scene);
  const double slowest =
      water < 0 ? std::numeric_limits<double>::infinity() : steps[at(units.find(water))];
  std::vector<Unit> list;
  for (int p = 0; p < static_cast<int>(scene.parts.size()); ++p) {
    if (units.find(p) == p) list.push_back({p, std::min(steps[at(p)], slowest)});
  }
  std::ranges::stable_sort(list, [](const Unit& a, const Unit& b) { return a.dt > b.dt; });
  return list;
}

/// What a case has to compute in a time: cells and particles over the steps of their models.
double work_of(const Scene& scene, const std::vector<int>& parts, double dt) {
  double n = 0;
  for (const int p : parts) {
    const Part& part = scene.parts[at(p)];
    n += part.is_particles() ? part.nodes.size() : (part.rigid ? 0 : part.n_cells());
  }
  return n / dt;
}

}  // namespace

bool wants_auto_models(const Keys& root) { return root.word("models") == "auto"; }

ChosenModels choose_models(Simulation& in_one_model) {
  Scene& scene = in_one_model.scene;
  evaluate_start(in_one_model.models);
  Units units = units_of(scene);
  const std::vector<double> steps = steps_of(scene, in_one_model.models, units);
  ChosenModels chosen;
  double largest = 0;
  for (const Unit& unit : sorted_units(scene, units, steps)) {
    if (chosen.list.empty() || unit.dt <= share_of_slower * largest) {
      chosen.list.push_back({fmt::format("model_{}", chosen.list.size() + 1), {}, unit.dt});
      largest = unit.dt;
    }
    ChosenModels::One& model = chosen.list.back();
    model.dt = std::min(model.dt, unit.dt);
    for (int p = 0; p < static_cast<int>(scene.parts.size()); ++p) {
      if (units.find(p) == unit.root) model.parts.push_back(p);
    }
  }
  double one = 0;
  double several = 0;
  for (const ChosenModels::One& model : chosen.list) {
    one += work_of(scene, model.parts, chosen.list.back().dt);
    several += work_of(scene, model.parts, model.dt);
  }
  chosen.share_of_work = one > 0 ? several / one : 1;
  return chosen;
}

}  // namespace gannet
