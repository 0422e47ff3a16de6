#include "fe/mass_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "base/math.hpp"
#include "base/parallel.hpp"
#include "fe/effects.hpp"
#include "fe/element_blocks.hpp"
#include "fe/element_part.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

namespace {

/// What was added to a node.
struct AddedMass {
  Index node = -1;
  double m = 0;  ///< [kg]
  double I = 0;  ///< [kg m^2]
};

/// What was added to a part.
struct ScaledPart {
  int part = -1;
  double step = 0;        ///< that was wanted [s]
  double own = 0;         ///< mass of the part without it [kg]
  double added = 0;       ///< [kg]
  Index n_scaled = 0;     ///< elements that were made heavier
  double largest = 1;     ///< factor of one of them
  Index cell = -1;        ///< which that is
  Array<double> of_cell;  ///< added to each cell [kg]
  std::vector<AddedMass> nodes;
};

/// Found by scene.store.
struct ScaledParts {
  std::deque<ScaledPart> list;  ///< addresses never change
};

Schema schema() {
  Key scaling{.name = "mass_scaling",
              .kind = Kind::map,
              .text = "elements that limit the step are made heavier before the run"};
  scaling.keys = {{.name = "step",
                   .unit = dim::time,
                   .text = "step that every element shall allow at the start",
                   .required = true,
                   .limits = positive()},
                  {.name = "ceiling",
                   .text = "mass that may be added, over that of the part; more is an error",
                   .fallback = "0.05",
                   .limits = at_least(0)}};
  return {{"parts.*", scaling}};
}

/// Calls f(block, element, factor) for each element that is too light for the step.
template <class F>
void for_light(std::span<ScalableElements> blocks, double step, F&& f) {
  for (ScalableElements& block : blocks) {
    for (Index e = 0; e < block.n_elements; ++e) {
      const double s =
          mass_factor(block.bounds[static_cast<std::size_t>(e)], step, block.dt_factor);
      if (s > 1) f(block, e, s);
    }
  }
}

double own_mass(std::span<ScalableElements> blocks) {
  double sum = 0;
  for (const ScalableElements& block : blocks) {
    for (Index e = 0; e < block.n_elements; ++e) sum += block.n_corners * block.mass(e).m;
  }
  return sum;
}

double added_mass(std::span<ScalableElements> blocks, double step) {
  double sum = 0;
  for_light(blocks, step, [&](const ScalableElements& block, Index e, double s) {
    sum += (s - 1) * block.n_corners * block.mass(e).m;
  });
  return sum;
}

/// The largest step that adds no more than `mass`, to 1 in 1000, rounded down [s].
double step_that_adds(std::span<ScalableElements> blocks, double mass, double too_large) {
  double low = 0;
  double high = too_large;
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (added_mass(blocks, middle) > mass ? high : low) = middle;
  }
  return low;
}

/// "120 elements are too light for it, the lightest by a factor of 3.2, panel: element 17 at ..."
std::string who_is_light(const Scene& scene, const ScaledPart& made) {
  return fmt::format("{} of {} elements are too light for it, by up to a factor of {:.4g} in {}",
                     made.n_scaled, made.of_cell.size(), made.largest,
                     text_of_element(scene, made.part, made.cell));
}

/// Fills what is known of a part before anything is added to it.
ScaledPart look_at(std::span<ScalableElements> blocks, int number, const Scene& scene,
                   double step) {
  ScaledPart made{.part = number, .step = step, .own = own_mass(blocks)};
  const Part& part = scene.parts[static_cast<std::size_t>(number)];
  made.of_cell.assign(static_cast<std::size_t>(part.n_cells()), 0);
  for_light(blocks, step, [&](const ScalableElements& block, Index e, double s) {
    const double mass = (s - 1) * block.n_corners * block.mass(e).m;
    made.of_cell[static_cast<std::size_t>(block.cell(e))] = mass;
    made.added += mass;
    ++made.n_scaled;
    if (s <= made.largest) return;
    made.largest = s;
    made.cell = block.cell(e);
  });
  return made;
}

/// The mistake that passing the ceiling is.
void complain_of_ceiling(const Keys& scaling, std::span<ScalableElements> blocks,
                         const ScaledPart& made, double ceiling, const Scene& scene) {
  scaling.complain(
      "step",
      fmt::format("= {:.4g} s would add {:.4g} kg to the {:.4g} kg of the part, {:.3g} %, and the "
                  "ceiling is {:.3g} %; {}; a step of {:.4g} s is within the ceiling; else make "
                  "the smallest elements larger, or raise the ceiling where the inertia of the "
                  "part does not matter",
                  made.step, made.added, made.own, 100 * made.added / made.own, 100 * ceiling,
                  who_is_light(scene, made),
                  step_that_adds(blocks, ceiling * made.own, made.step)));
}

/// Adds the masses to the nodes, and the factors to the blocks.
void add_masses(std::span<ScalableElements> blocks, ScaledPart& made, Nodes& nodes) {
  std::vector<AddedMass> of_node(static_cast<std::size_t>(nodes.n_owned));
  for_light(blocks, made.step, [&](ScalableElements& block, Index e, double s) {
    if (block.inverse_mass->empty()) {
      block.inverse_mass->assign(static_cast<std::size_t>(lanes * blocks_for(block.n_elements)), 1);
    }
    (*block.inverse_mass)[static_cast<std::size_t>(e)] = 1 / s;
    const CornerMass own = block.mass(e);
    for (int a = 0; a < block.n_corners; ++a) {
      const Index node = block.corner(e, a);
      AddedMass& to = of_node[static_cast<std::size_t>(node)];
      to.node = node;
      to.m += (s - 1) * own.m;
      to.I += (s - 1) * own.I;
    }
  });
  for (const AddedMass& added : of_node) {
    if (added.node < 0) continue;
    const auto i = static_cast<std::size_t>(added.node);
    nodes.x[i].w += added.m;
    if (nodes.rotating.contains(added.node)) nodes.torque[i].w += added.I;
    made.nodes.push_back(added);
  }
}

/// Kinetic energy of what was added, at level n [J].
double kinetic_energy(const ScaledPart& made, const Nodes& nodes, double dt) {
  const auto n = static_cast<Index>(made.nodes.size());
  return parallel_sum(n, node_chunk, [&](Index begin, Index end) {
    double sum = 0;
    for (Index k = begin; k < end; ++k) {
      const AddedMass& added = made.nodes[static_cast<std::size_t>(k)];
      sum += 0.5 * added.m * velocity_at_level(nodes, added.node, dt).squaredNorm();
      if (!nodes.rotating.contains(added.node)) continue;
      const auto i = static_cast<std::size_t>(added.node);
      const Vec3 omega = xyz(nodes.omega[i]) - 0.5 * dt * nodes.omega[i].w * xyz(nodes.torque[i]);
      sum += 0.5 * added.I * omega.squaredNorm();
    }
    return sum;
  });
}

/// Particles have no elements to make heavier, and those of rigid parts are not computed.
void state(const Keys& root, Scene& scene) {
  for (const Keys& part : parts_with(root, "mass_scaling")) {
    const int number = scene.part_number(part.name());
    if (number < 0) continue;
    const Part& of = scene.parts[static_cast<std::size_t>(number)];
    if (of.rigid) part.complain("mass_scaling", "has no meaning: the part is rigid");
    if (!of.is_particles()) continue;
    part.complain("mass_scaling", "is for parts of elements; particles have a speed of sound, c0");
  }
}

void operations(const Keys& root, Scene& scene, Models& models) {
  if (!scene.store.has<ScaledParts>()) return;
  for (ScaledPart& made : scene.store.get<ScaledParts>().list) {
    const std::string& name = scene.parts[static_cast<std::size_t>(made.part)].name;
    LedgerEntry& entry = models.ledger.entry("mass_scaling", name);
    entry.within_other = true;  // the nodes' kinetic energy has it
    model_of_part(scene, models, made.part)
        .plan.add({.name = "kinetic energy of mass added to " + name,
                   .reason = asked_for_at(root.map("parts").map(name).where("mass_scaling")),
                   .stage = Stage::look,
                   .reads = {"v", "omega", "f", "torque"},
                   .run = [&made, &scene, &entry](const Step& step) {
                     entry.value = kinetic_energy(made, scene.nodes, step.dt);
                   }});
  }
}

/// What was added, for `explain`.
std::vector<Choice> choices(const Keys&, Scene& scene) {
  std::vector<Choice> list;
  if (!scene.store.has<ScaledParts>()) return list;
  for (const ScaledPart& made : scene.store.get<ScaledParts>().list) {
    list.push_back(
        {"parts." + scene.parts[static_cast<std::size_t>(made.part)].name + ".mass_scaling",
         fmt::format("{:.4g} kg, {:.3g} % of the part", made.added, 100 * made.added / made.own),
         fmt::format("a step of {:.4g} s: {}", made.step, who_is_light(scene, made))});
  }
  return list;
}

}  // namespace

double mass_factor(double omega2, double dt, double dt_factor) {
  const double half = 0.5 * dt / dt_factor;
  return std::max(1.0, omega2 * half * half);
}

void scale_masses(const Keys& part, int number, Scene& scene, std::span<ScalableElements> blocks) {
  if (!part.has("mass_scaling")) return;
  const Keys scaling = part.map("mass_scaling");
  if (!scaling.has("step")) return;  // the reader has complained
  ScaledPart made = look_at(blocks, number, scene, scaling.number("step"));
  const double ceiling = scaling.number("ceiling");
  if (made.added > ceiling * made.own) {
    complain_of_ceiling(scaling, blocks, made, ceiling, scene);
    return;
  }
  if (made.n_scaled == 0) {
    scene.warnings.push_back(
        fmt::format("{}: every element allows a step of {:.4g} s without more mass", scaling.path(),
                    made.step));
    return;
  }
  add_masses(blocks, made, scene.nodes);
  scene.warnings.push_back(
      fmt::format("{}: {:.4g} kg are added to the {:.4g} kg of the part, "
                  "{:.3g} %, for a step of {:.4g} s; {}",
                  scaling.path(), made.added, made.own, 100 * made.added / made.own, made.step,
                  who_is_light(scene, made)));
  ScaledPart& kept = scene.store.get<ScaledParts>().list.emplace_back(std::move(made));
  Field field = plain_field(part.name() + ".added_mass", "kg", "AddedMass", Over::cells,
                            kept.of_cell, 1, GhostRule::none);
  field.owner = "mass_scaling";
  track_shown(scene, number, std::move(field));
}

Effect mass_scaling_effect() {
  return {.name = "mass_scaling",
          .schema = schema,
          .state = state,
          .operations = operations,
          .choices = choices};
}

}  // namespace gannet
