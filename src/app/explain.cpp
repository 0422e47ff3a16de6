#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/effect_lines.hpp"
#include "app/effect_prices.hpp"
#include "app/effects_csv.hpp"
#include "app/first_steps.hpp"
#include "app/simulation.hpp"
#include "base/parallel.hpp"
#include "output/report.hpp"
#include "study/bench.hpp"

namespace gannet {

namespace {

void print_operation(const Operation& op) {
  fmt::print("    {:<44} {}\n", op.name, op.reason);
  if (!op.reads.empty() || !op.writes.empty()) {
    fmt::print("      reads {}; writes {}{}\n",
               op.reads.empty() ? "nothing" : fmt::format("{}", fmt::join(op.reads, ", ")),
               op.writes.empty() ? "nothing" : fmt::format("{}", fmt::join(op.writes, ", ")),
               op.stable_dt ? "; votes on the time step" : "");
  }
}

void print_plan(const Model& model) {
  fmt::print("model {}: the operations of a step, in order\n", model.name);
  for (int s = 0; s < n_stages; ++s) {
    const auto stage = static_cast<Stage>(s);
    fmt::print("  {}\n", name_of(stage));
    for (const Operation& op : model.plan.at(stage)) print_operation(op);
    if (stage == Stage::force) {
      fmt::print("  choose dt\n    {:<44} smallest vote, times {}\n", "time step", model.dt_scale);
    }
  }
}

void print_fields(const Scene& scene) {
  fmt::print("tracked fields\n");
  std::size_t total = 0;
  for (const Field& f : scene.fields) {
    const std::size_t bytes = bytes_of(f);
    total += bytes;
    fmt::print("    {:<28} {:<10} {:>12} B  {}\n", f.name, f.unit.empty() ? "-" : f.unit, bytes,
               f.effect);
  }
  fmt::print("    {:<28} {:<10} {:>12} B\n", "total", "", total);
}

/// Effects with what they hold and what they take of a step. A pair term counts for the effect that
/// asks for it, not for the pass that it rides in, which has the effect `sph`.
void print_effects(Simulation& simulation, const FirstSteps& first) {
  const std::vector<EffectLine> lines = effect_lines(simulation);
  std::vector<std::string> present;
  for (const EffectLine& l : lines) {
    if (l.presence.state != Presence::State::off) present.push_back(l.name);
  }
  const auto prices = term_prices(simulation.scene, present, fma_rate(1));
  const double step = flowing_step(first);
  const double particles = simulation.scene.particles.size();
  double inside = 0;
  for (const TermPrice& p : prices) inside += 1e-9 * p.ns * particles / threads();
  fmt::print("effects\n    {:<20} {:<10} {:>7} {:>12}  {}\n", "", "", "share", "bytes", "why");
  for (const EffectLine& l : lines) {
    double seconds = l.seconds / first.steps;
    if (l.name == "sph" && seconds > 0) seconds += step - first.per_step() - inside;
    for (const TermPrice& p : prices) {
      if (p.effect == l.name) seconds += 1e-9 * p.ns * particles / threads();
    }
    const bool off = l.presence.state == Presence::State::off;
    fmt::print("    {:<20} {:<10} {:>7} {:>12}  {}\n", l.name, name_of(l.presence.state),
               off ? "-" : fmt::format("{:.1f} %", 100 * seconds / step), off ? 0 : l.bytes,
               l.presence.why);
  }
  fmt::print(
      "  share: of a step on {} threads without output, as {} first steps took it in memory "
      "({} a step)\n",
      threads(), first.steps, time_text(step));
  if (first.list_seconds > 0) {
    fmt::print("  of that, neighbour lists: {} to make them anew, every {} steps as water flows\n",
               time_text(first.list_seconds), steps_per_list);
  }
  for (const TermPrice& p : prices) {
    fmt::print("  of that, {} inside the pair passes: {:.2f} ns a particle, {:.1f} % ({})\n",
               p.effect, p.ns, 100e-9 * p.ns * particles / threads() / step, p.source);
  }
}

void print_choices(const std::vector<Choice>& choices) {
  fmt::print("chosen automatically, by rules alone; the key in front overrides\n");
  for (const Choice& c : choices) {
    fmt::print("    {} = {}: {}\n", c.key, c.chosen, c.rule);
  }
}

void print_defaults(const Value& map) {
  for (const Value& v : map.children) {
    if (v.is_map) {
      print_defaults(v);
    } else if (!v.given) {
      fmt::print("    {} = {}\n", v.path, v.text);
    }
  }
}

}  // namespace

int explain_command(const RunOptions& options) {
  set_threads(options.threads);
  const auto simulation = make_simulation(options.case_file, options.set);
  const std::vector<Choice> choices = all_choices(*simulation);  // of the start
  const FirstSteps first = make_first_steps(*simulation, 0.5, 3, FirstShares::steps);
  fmt::print("{}\n", simulation->scene.title);
  print_effects(*simulation, first);
  print_choices(choices);
  for (const Model& model : simulation->models.list) print_plan(model);
  print_fields(simulation->scene);
  fmt::print("defaults taken\n");
  print_defaults(simulation->source->root);
  return 0;
}

}  // namespace gannet
