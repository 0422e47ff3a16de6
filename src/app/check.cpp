#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/commands.hpp"
#include "app/penetrations.hpp"
#include "app/run_time.hpp"
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

double mebibytes(double bytes) { return bytes / (1024.0 * 1024.0); }

void print_memory(const Simulation& simulation) {
  fmt::print("memory: {:.1f} MiB in arrays, lists and copies included; {} tracked fields\n",
             mebibytes(static_cast<double>(bytes_in_arrays)), simulation.scene.fields.size());
}

void print_overlaps(Scene& scene) {
  for (const StartOverlap& o : start_overlaps(scene)) {
    if (o.count == 0) {
      fmt::print("{}: nothing penetrates at the start\n", o.contact);
    } else {
      fmt::print("{}: {} penetrations at the start, the deepest {:.4g} m\n", o.contact, o.count,
                 o.depth);
    }
  }
}

/// The smallest votes of a model, and the smallest of every operation that votes.
std::vector<Vote> small_votes(const Model& model) {
  constexpr std::size_t n_smallest = 5;
  std::vector<Vote> votes;
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : model.plan.at(static_cast<Stage>(s))) {
      if (!op.stable_dt) continue;
      std::vector<Vote> some;
      if (op.smallest) some = op.smallest(n_smallest);
      if (some.empty()) {
        some.push_back({op.stable_dt(), op.limited_by ? op.limited_by() : op.name});
      }
      votes.insert(votes.end(), some.begin(), some.end());
    }
  }
  std::erase_if(votes, [](const Vote& v) { return !std::isfinite(v.dt); });
  std::stable_sort(votes.begin(), votes.end(),
                   [](const Vote& a, const Vote& b) { return a.dt < b.dt; });
  return votes;
}

/// Warnings from number `first` on; returns how many there are.
std::size_t print_warnings(const Scene& scene, std::size_t first) {
  for (std::size_t k = first; k < scene.warnings.size(); ++k) {
    fmt::print("warning: {}\n", scene.warnings[k]);
  }
  return scene.warnings.size();
}

void print_steps(Models& models) {
  for (const Model& model : models.list) {
    const Vote vote = smallest_vote(model);
    fmt::print("model {}: time step {:.4g} s at the start, limited by {}\n", model.name, vote.dt,
               vote.limited_by());
    for (const Vote& v : small_votes(model)) {
      fmt::print("    {:<12.4g} {}\n", v.dt * model.dt_scale, v.who);
    }
  }
}

void print_run_time(Simulation& simulation) {
  const FirstSteps first = make_first_steps(simulation, 0.5, 3, 500);
  const RunTime t = estimate_run_time(simulation, first);
  const double until = simulation.scene.store.get<RunRecord>().plan.until;
  fmt::print("run to {}: about {} on {} threads\n", time_text(until), duration_text(t.total()),
             threads());
  const auto part = [](const char* what, const Priced& p) {
    if (p.count > 0) {
      fmt::print("    {:>10.0f} {:<16} {:>10} each, {}\n", p.count, what, time_text(p.seconds),
                 duration_text(p.total()));
    }
  };
  part("steps", t.steps);
  part("neighbour lists", t.lists);
  part("VTK frames", t.frames);
  part("history lines", t.lines);
}

}  // namespace

int check_command(const RunOptions& options) {
  set_threads(options.threads);
  const auto simulation = make_simulation(options.case_file, options.set);
  fmt::print("{}: {}\n", options.case_file, simulation->scene.title);
  print_parts(simulation->scene);
  const std::size_t of_case = print_warnings(simulation->scene, 0);
  evaluate_start(simulation->models);
  print_overlaps(simulation->scene);
  print_steps(simulation->models);
  print_memory(*simulation);
  print_run_time(*simulation);
  print_warnings(simulation->scene, of_case);  // of the first steps
  fmt::print("the case is sound; nothing was written\n");
  return 0;
}

}  // namespace gannet
