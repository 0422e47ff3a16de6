#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "app/bench_effects.hpp"
#include "app/commands.hpp"
#include "app/simulation.hpp"
#include "base/parallel.hpp"
#include "contact/gap.hpp"
#include "fe/beam.hpp"
#include "fe/mooring.hpp"
#include "fe/shell.hpp"
#include "fe/solid.hpp"
#include "fe/truss.hpp"
#include "search/cluster_list.hpp"
#include "search/spatial_sort.hpp"
#include "sph/pair_pass.hpp"
#include "sph/sph_state.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

/// A cube of n^3 particles 10 mm apart that shears so fast that lists last for ten steps, as they
/// do in a run of calm and violent parts.
std::unique_ptr<Simulation> cube_of_water(int n, bool single = false) {
  const std::string side = fmt::format("{} m", 0.01 * n);
  const std::string text = fmt::format(
      "gannet: 1\n"
      "materials: {{water: {{card: water, c0: 30 m/s}}}}\n"
      "parts: {{pool: {{sph: {{material: water, spacing: 10 mm, precision: {1}}}, fill: {{box: "
      "{{from: [0, 0, 0], to: [{0}, {0}, {0}]}}}}}}}}\n"
      "effects: {{viscosity: {{alpha: 0.05}}}}\n"
      "output: {{until: 1 s}}\n",
      side, single ? "single" : "double");
  auto simulation = make_simulation_of_text(text);
  Nodes& nodes = simulation->scene.nodes;
  const double speed = 0.3;  // [m/s]
  for (Index i = simulation->scene.particles.begin; i < simulation->scene.particles.end; ++i) {
    const Line& x = nodes.x[i];
    nodes.v[i] = {speed * std::sin(30 * x.y), speed * std::sin(30 * x.z),
                  speed * std::sin(30 * x.x), nodes.v[i].w};
  }
  return simulation;
}

BenchResult particles_result(const Simulation& simulation, double seconds, int steps) {
  const Index n = simulation.scene.particles.size();
  std::size_t bytes = 0;
  for (const Field& f : simulation.scene.fields) bytes += bytes_of(f);
  BenchResult r;
  r.size = n;
  r.median_seconds = seconds / steps;
  r.rate = n * steps / seconds;
  r.unit = "particle-steps/s";
  r.bytes_per_item = static_cast<double>(bytes) / n;
  return r;
}

/// Whole steps as `gannet run` makes them: the same plan, lists made anew when they are stale.
BenchResult bench_sph_step(int n, bool single = false) {
  const auto simulation = cube_of_water(n, single);
  const int steps = 20;
  const double seconds = median_seconds(3, [&] {
    for (int k = 0; k < steps; ++k) advance(simulation->models);
  });
  return particles_result(*simulation, seconds, steps);
}

enum class Pass { rates, force, fused };

/// One pair pass over the lists of a cube, h/dx = 1.3.
BenchResult bench_sph_pass(int n, Pass pass, bool single = false) {
  const auto simulation = cube_of_water(n);
  advance(simulation->models);
  Scene& scene = simulation->scene;
  const SphState& sph = scene.store.get<SphState>();
  const Index first = scene.particles.begin;
  ParticleView view;
  view.x = &scene.nodes.x[first];
  view.v = &scene.nodes.v[first];
  view.rho = sph.rho.data();
  view.p = sph.p.data();
  view.n_sources = sph.list.n_sources;
  Packed packed;
  packed.single = single;
  pack_particles(view, sph.kernel.reach(), packed);
  const auto count = static_cast<std::size_t>(scene.particles.size());
  Array<double> drho_dt(count);
  Array<Line> f(count);
  Array<Line> f_viscous(count);
  const PairParameters parameters{
      .dimension = 3, .h = sph.h, .m = sph.m, .c0 = sph.c0, .alpha = 0.05, .beta = 0.1};
  const RatesOut rates{drho_dt.data(), nullptr};
  const ForceOut force{f.data(), f_viscous.data()};
  const double seconds = median_seconds(9, [&] {
    if (pass == Pass::rates) pair_rates(sph.list, packed, parameters, rates);
    if (pass == Pass::force) pair_force(sph.list, packed, parameters, force);
    if (pass == Pass::fused) pair_fused(sph.list, packed, parameters, rates, force);
  });
  BenchResult r = particles_result(*simulation, seconds, 1);
  r.bytes_per_item =
      (single ? sizeof(PackedSingle) : sizeof(PackedParticle)) + sizeof(double) + 2 * sizeof(Line) +
      sizeof(Index) * static_cast<double>(sph.list.offset.back()) / static_cast<double>(count);
  return r;
}

/// A case of one part of elements, set moving as a wave of 1 m/s and three steps on its way.
std::unique_ptr<Simulation> moving_elements(const std::string& parts) {
  auto simulation = make_simulation_of_text(fmt::format(
      "gannet: 1\n"
      "materials: {{steel: {{card: steel}}, metal: {{card: al_6061_t6}}, flowing: {{card: "
      "copper_ofhc, johnson_cook: {{A: 1 kPa, B: 1 kPa}}}}, gum: "
      "{{card: gate_rubber_neo_hookean}}}}\n"
      "parts: {}\n"
      "output: {{until: 1 s}}\n",
      parts));
  Nodes& nodes = simulation->scene.nodes;
  for (Index i = 0; i < nodes.n_owned; ++i) {
    const Line& x = nodes.x[i];
    nodes.v[i].z = std::sin(5 * x.x) * std::cos(5 * x.y) * std::cos(3 * x.z);
  }
  for (int k = 0; k < 3; ++k) advance(simulation->models);
  return simulation;
}

/// The rate of pass(block, nodes, dt).
template <class Block, class Pass>
BenchResult elements_result(Simulation& simulation, Block& block, Pass&& pass) {
  const double dt = simulation.models.list.front().step.dt;
  BenchResult r;
  r.size = block.n_elements;
  r.median_seconds = median_seconds(9, [&] { pass(block, simulation.scene.nodes, dt); });
  r.rate = block.n_elements / r.median_seconds;
  r.unit = "element-steps/s";
  r.bytes_per_item =
      8.0 * static_cast<double>(block.state.size()) / static_cast<double>(block.n_elements);
  return r;
}

/// A sheet of n x n shells of 20 mm, 5 points, elastic-plastic, moving. more: keys of the shell.
/// Of "flowing" every point returns to the yield surface in every step.
/// of_shape: of the plate.
BenchResult bench_shell(int n, const char* more = "", const char* material = "metal",
                        const char* of_shape = "") {
  const auto simulation = moving_elements(
      fmt::format("{{sheet: {{shell: {{material: {3}, thickness: 3 mm, points: 5{2}}}, shape: "
                  "{{plate: {{size: [{0} m, {0} m], elements: [{1}, {1}]{4}}}}}}}}}",
                  0.02 * n, n, more, material, of_shape));
  return elements_result(
      *simulation, simulation->scene.store.get<ShellBlocks>().list.front(),
      [](auto& block, Nodes& nodes, double dt) { shell_pass(block, nodes, dt); });
}

/// A block of n x n x n solids of 20 mm, elastic-plastic, moving.
BenchResult bench_solid(int n, const char* formulation = "one_point",
                        const char* material = "metal") {
  const auto simulation = moving_elements(
      fmt::format("{{bulk: {{solid: {{material: {3}, formulation: {2}}}, shape: {{block: {{from: "
                  "[0, 0, 0], to: [{0} m, {0} m, {0} m], elements: [{1}, {1}, {1}]}}}}}}}}",
                  0.02 * n, n, formulation, material));
  return elements_result(
      *simulation, simulation->scene.store.get<SolidBlocks>().list.front(),
      [](auto& block, Nodes& nodes, double dt) { solid_pass(block, nodes, dt); });
}

/// A cable of n elements, moving: the pass over its elements, or whole steps of a run.
BenchResult bench_cable(int n, bool whole_step) {
  const auto simulation = moving_elements(
      fmt::format("{{line: {{cable: {{EA: 1 MN, mass_per_length: 1, prestrain: 0.01}}, shape: "
                  "{{line: {{from: [0, 0, 0], to: [{0} m, 0, 0], elements: {0}}}}}}}}}",
                  n));
  TrussBlock& block = simulation->scene.store.get<TrussBlocks>().list.front();
  const double dt = simulation->models.list.front().step.dt;
  constexpr int times = 1000;
  BenchResult r;
  r.size = n;
  r.median_seconds =
      median_seconds(9,
                     [&] {
                       for (int k = 0; k < times; ++k) {
                         whole_step
                             ? advance(simulation->models)
                             : static_cast<void>(truss_pass(block, simulation->scene.nodes, dt));
                       }
                     }) /
      times;
  r.rate = n / r.median_seconds;
  r.unit = "element-steps/s";
  r.bytes_per_item = 8.0 * static_cast<double>(block.state.size()) / n;
  return r;
}

/// A beam of n elements of a rectangular section, moving. Of "steel" it is elastic, of "metal" it
/// may yield, of "flowing" every fibre does in every step.
BenchResult bench_beam(int n, const char* material) {
  const auto simulation = moving_elements(fmt::format(
      "{{bar: {{beam: {{material: {1}, section: {{rectangle: {{width: 20 mm, height: 20 "
      "mm}}}}}}, shape: {{line: {{from: [0, 0, 0], to: [{2} m, 0, 0], elements: {0}}}}}}}"
      "}}",
      n, material, 0.1 * n));
  BeamBlock& block = simulation->scene.store.get<BeamBlocks>().list.front();
  const double dt = simulation->models.list.front().step.dt;
  constexpr int times = 20;
  BenchResult r;
  r.size = n;
  r.median_seconds = median_seconds(9,
                                    [&] {
                                      for (int k = 0; k < times; ++k) {
                                        beam_pass(block, simulation->scene.nodes, dt);
                                      }
                                    }) /
                     times;
  r.rate = n / r.median_seconds;
  r.unit = "element-steps/s";
  r.bytes_per_item = 8.0 * static_cast<double>(block.fibres.size() + block.last.size()) / n;
  return r;
}

/// A mooring line of n elements that lies on the bed for a third, moving in water: the passes over
/// its elements and nodes, or whole steps of a run.
BenchResult bench_mooring(int n, bool whole_step) {
  const auto simulation = make_simulation_of_text(
      fmt::format("gannet: 1\n"
                  "moorings: {{line: {{from: [900 m, 0, 310 m], to: [0, 0, 0], length: 1000 m, EA: "
                  "1336 MN, mass_per_length: 49.6, diameter: 90 mm, elements: {}, water: {{level: "
                  "310 m}}, bed: {{}}, motion: [\"sin(t)\", 0, 0]}}}}\n"
                  "loads: {{gravity: [0, 0, -9.81 m/s^2]}}\n"
                  "output: {{until: 1 s}}\n",
                  n));
  Scene& scene = simulation->scene;
  for (int k = 0; k < 100; ++k) advance(simulation->models);
  MooringLine& line = scene.store.get<MooringLines>().list.front();
  const Step step = simulation->models.list.front().step;
  constexpr int times = 1000;
  const double seconds = median_seconds(9, [&] {
    for (int k = 0; k < times; ++k) {
      if (whole_step) {
        advance(simulation->models);
        continue;
      }
      truss_pass(line.block, scene.nodes, step.dt_old);
      line_forces(line, scene.nodes, scene.gravity, step);
      line_work(line, scene.nodes, scene.gravity, step);
      for (Line& f : scene.nodes.f) f = {};
    }
  });
  BenchResult r;
  r.size = line.n_nodes();
  r.median_seconds = seconds / times;
  r.rate = r.size / r.median_seconds;
  r.unit = "node-steps/s";
  r.bytes_per_item = 8.0 * static_cast<double>(line.state.size() + line.block.state.size()) / n;
  return r;
}

/// Two sheets of n x n shells that slide on each other over their whole area: the contact alone,
/// both ways, its lists made anew as they get stale.
BenchResult bench_part_contact(int n) {
  const auto simulation = moving_elements(fmt::format(
      "{{low: {{shell: {{material: steel, thickness: 10 mm}}, shape: {{plate: {{size: [1 m, 1 m], "
      "elements: [{0}, {0}]}}}}}}, high: {{shell: {{material: steel, thickness: 10 mm}}, shape: "
      "{{plate: {{size: [1 m, 1 m], elements: [{0}, {0}], centre: [3 mm, 2 mm, 10 mm]}}}}}}}}\n"
      "contacts: {{slide: {{between: [low, high], friction: 0.1}}}}",
      n));
  Model& model = simulation->models.list.front();
  BenchResult r;
  for (Operation& op : model.plan.at(Stage::force)) {
    if (op.name != "contact: parts") continue;
    r.median_seconds = median_seconds(9, [&] { op.run(model.step); });
  }
  r.size = 2 * (n + 1) * (n + 1);
  r.rate = static_cast<double>(r.size) / r.median_seconds;
  r.unit = "node-steps/s";
  r.bytes_per_item = sizeof(Gap) + 4 * sizeof(Vec3) + 2 * sizeof(Line);
  return r;
}

std::vector<Benchmark> all_benchmarks() {
  return {
      {"fe.shell.pass.50k", [] { return bench_shell(224); }},
      {"fe.shell.pass.400k", [] { return bench_shell(632); }},
      {"fe.shell.flat.50k", [] { return bench_shell(224, ", warping: no"); }},
      {"fe.shell.full.50k", [] { return bench_shell(224, ", formulation: fully_integrated"); }},
      {"fe.shell.full.400k", [] { return bench_shell(632, ", formulation: fully_integrated"); }},
      {"fe.shell.triangles.100k", [] { return bench_shell(224, "", "metal", ", triangles: yes"); }},
      {"fe.shell.flat.400k", [] { return bench_shell(632, ", warping: no"); }},
      {"fe.solid.pass.50k", [] { return bench_solid(37); }},
      {"fe.solid.eight_points.50k", [] { return bench_solid(37, "eight_points"); }},
      {"fe.shell.johnson_cook.50k", [] { return bench_shell(224, "", "flowing"); }},
      {"fe.solid.johnson_cook.50k", [] { return bench_solid(37, "one_point", "flowing"); }},
      {"fe.solid.rubber.50k", [] { return bench_solid(37, "one_point", "gum"); }},
      {"fe.solid.tetrahedra.50k", [] { return bench_solid(20, "tetrahedra"); }},
      {"fe.solid.pass.400k", [] { return bench_solid(74); }},
      {"fe.cable.pass.1k", [] { return bench_cable(1000, false); }},
      {"fe.cable.step.1k", [] { return bench_cable(1000, true); }},
      {"fe.beam.pass.1k", [] { return bench_beam(1000, "steel"); }},
      {"fe.beam.may_yield.1k", [] { return bench_beam(1000, "metal"); }},
      {"fe.beam.flowing.1k", [] { return bench_beam(1000, "flowing"); }},
      {"fe.shell.damped.50k", [] { return bench_shell(224, ", damping_ratio: 0.05"); }},
      {"fe.mooring.pass.1k", [] { return bench_mooring(1000, false); }},
      {"fe.mooring.step.1k", [] { return bench_mooring(1000, true); }},
      {"fe.mooring.step.80", [] { return bench_mooring(80, true); }},
      {"contact.parts.50k", [] { return bench_part_contact(157); }},
      {"sph.pass.rates.100k", [] { return bench_sph_pass(46, Pass::rates); }},
      {"sph.pass.force.100k", [] { return bench_sph_pass(46, Pass::force); }},
      {"sph.pass.fused.100k", [] { return bench_sph_pass(46, Pass::fused); }},
      {"sph.step.100k", [] { return bench_sph_step(46); }},
      {"sph.pass.fused.1M", [] { return bench_sph_pass(100, Pass::fused); }},
      {"sph.pass.fused.1M.single", [] { return bench_sph_pass(100, Pass::fused, true); }},
      {"sph.pass.fused.4M", [] { return bench_sph_pass(159, Pass::fused); }},
      {"sph.step.1M", [] { return bench_sph_step(100); }},
      {"sph.step.1M.single", [] { return bench_sph_step(100, true); }}};
}

}  // namespace

int bench_command(const BenchOptions& options) {
  if (options.name == "effects") return bench_effects(options);
  return run_benchmarks(options, all_benchmarks());
}

}  // namespace gannet
