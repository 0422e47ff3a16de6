#include <fmt/format.h>

#include <limits>

#include "app/commands.hpp"
#include "app/simulation.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

void print_parts(const Scene& scene) {
  for (const Part& part : scene.parts) {
    double mass = 0;
    Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 hi = -lo;
    for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
      mass += scene.nodes.x[i].w;
      lo = lo.cwiseMin(xyz(scene.nodes.x[i]));
      hi = hi.cwiseMax(xyz(scene.nodes.x[i]));
    }
    fmt::print(
        "part {}: {} {}, {} {}, mass {:.6g} kg, from ({:.4g}, {:.4g}, {:.4g}) to "
        "({:.4g}, {:.4g}, {:.4g}) m\n",
        part.name, part.nodes.size(), part.is_particles() ? "particles" : "nodes", part.n_cells(),
        "elements", mass, lo.x(), lo.y(), lo.z(), hi.x(), hi.y(), hi.z());
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

}  // namespace

int check_command(const RunOptions& options) {
  const auto simulation = make_simulation(options.case_file, options.set);
  fmt::print("{}: {}\n", options.case_file, simulation->scene.title);
  print_parts(simulation->scene);
  print_memory(simulation->scene);
  print_steps(simulation->models);
  fmt::print("the case is sound; nothing was written\n");
  return 0;
}

}  // namespace gannet
