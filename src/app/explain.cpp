#include <fmt/format.h>

#include <set>

#include "app/commands.hpp"
#include "app/effects.hpp"
#include "app/simulation.hpp"

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
               f.owner);
  }
  fmt::print("    {:<28} {:<10} {:>12} B\n", "total", "", total);
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
  const auto simulation = make_simulation(options.case_file, options.set);
  fmt::print("{}\n", simulation->scene.title);
  for (const Model& model : simulation->models.list) print_plan(model);
  print_fields(simulation->scene);
  fmt::print("defaults taken\n");
  print_defaults(simulation->source->root);
  return 0;
}

}  // namespace gannet
