#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "app/commands.hpp"
#include "app/simulation.hpp"
#include "base/parallel.hpp"
#include "output/report.hpp"
#include "output/run_record.hpp"
#include "scene/part_nodes.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

/// Mass, centre of gravity and extent of a part.
struct Body {
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 highest = -Vec3::Constant(std::numeric_limits<double>::infinity());
};

Body body_of(const Scene& scene, int part) {
  Body b;
  for_nodes_of_part(scene, part, [&](Index i) {
    const Line& x = scene.nodes.x[i];
    b.mass += x.w;
    b.centre += x.w * xyz(x);
    b.lowest = b.lowest.cwiseMin(xyz(x));
    b.highest = b.highest.cwiseMax(xyz(x));
  });
  if (b.mass > 0) b.centre /= b.mass;
  return b;
}

std::string text_of(const Vec3& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
}

void print_parts(const Scene& scene) {
  for (std::size_t k = 0; k < scene.parts.size(); ++k) {
    const Part& part = scene.parts[k];
    const Body b = body_of(scene, static_cast<int>(k));
    const std::string count = part.is_particles() ? fmt::format("{} particles", part.nodes.size())
                                                  : fmt::format("{} nodes, {} elements",
                                                                part.nodes.size(), part.n_cells());
    fmt::print("part {}: {}, mass {:.6g} kg, centre of gravity {}, from {} to {} m\n", part.name,
               count, b.mass, text_of(b.centre), text_of(b.lowest), text_of(b.highest));
  }
}

void print_memory(const Scene& scene) {
  std::size_t bytes = 0;
  for (const Field& f : scene.fields) bytes += bytes_of(f);
  fmt::print("memory: {:.1f} MiB in {} tracked fields\n",
             static_cast<double>(bytes) / (1024.0 * 1024.0), scene.fields.size());
}

void print_steps(Models& models) {
  evaluate_start(models);
  for (const Model& model : models.list) {
    const Vote vote = smallest_vote(model);
    fmt::print("model {}: time step {:.4g} s at the start, limited by {}\n", model.name, vote.dt,
               vote.who);
  }
}

/// Makes the first steps in memory and says what the whole run would take at that pace.
void print_run_time(Simulation& simulation) {
  using Watch = std::chrono::steady_clock;
  const double until = simulation.scene.store.get<RunRecord>().plan.until;
  advance(simulation.models);
  const auto start = Watch::now();
  int steps = 0;
  double seconds = 0;
  while (steps < 5 || (steps < 2000 && seconds < 0.5)) {
    advance(simulation.models);
    ++steps;
    seconds = std::chrono::duration<double>(Watch::now() - start).count();
  }
  const double n = std::ceil(until / simulation.models.list.front().step.dt_old);
  fmt::print("run to {}: about {:.0f} steps, {} on {} threads, at the pace of the first {}\n",
             time_text(until), n, duration_text(n * seconds / steps), threads(), steps + 1);
}

}  // namespace

int check_command(const RunOptions& options) {
  set_threads(options.threads);
  const auto simulation = make_simulation(options.case_file, options.set);
  fmt::print("{}: {}\n", options.case_file, simulation->scene.title);
  print_parts(simulation->scene);
  print_memory(simulation->scene);
  print_steps(simulation->models);
  print_run_time(*simulation);
  fmt::print("the case is sound; nothing was written\n");
  return 0;
}

}  // namespace gannet
