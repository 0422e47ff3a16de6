#include "app/bench_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/simulation.hpp"
#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

/// The scenes that effects are switched on over, without any top-level key but these.
const std::map<std::string, std::string> bases = {{"water", R"(gannet: 1
materials: {water: {card: water, c0: 30 m/s}, skin: {card: al_6061_t6}}
parts:
  pool: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [240 mm, 240 mm, 240 mm]}}}
output: {until: 1 s}
)"},
                                                  {"water_2d", R"(gannet: 1
dimension: 2
materials: {water: {card: water, c0: 30 m/s}}
parts:
  pool: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [1.2 m, 1.2 m, 0]}}}
output: {until: 1 s}
)"},
                                                  {"sheet", R"(gannet: 1
materials: {skin: {card: al_6061_t6}}
parts:
  sheet: {shell: {material: skin, thickness: 3 mm, points: 5}, shape: {plate: {size: [1.2 m, 1.2 m], elements: [60, 60]}}}
output: {until: 1 s}
)"},
                                                  {"water_and_sheet", R"(gannet: 1
materials: {water: {card: water, c0: 30 m/s}, skin: {card: al_6061_t6}}
parts:
  pool: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [240 mm, 240 mm, 240 mm]}}}
  sheet: {shell: {material: skin, thickness: 3 mm}, shape: {plate: {size: [240 mm, 240 mm], elements: [12, 12], lowest_point: [0, 0, 246 mm]}}}
output: {until: 1 s}
)"},
                                                  {"water_and_fine_sheet", R"(gannet: 1
materials: {water: {card: water, c0: 30 m/s}, skin: {card: al_6061_t6}}
parts:
  pool: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [240 mm, 240 mm, 240 mm]}}}
  sheet: {shell: {material: skin, thickness: 3 mm}, shape: {plate: {size: [240 mm, 240 mm], elements: [24, 24], lowest_point: [0, 0, 252 mm]}}}
output: {until: 1 s}
)"}};

struct EffectCase {
  const char* effect;      ///< its name in the table of effects
  const char* base;        ///< scene to switch it on over
  const char* snippet;     ///< what the case file says then, beside the base
  bool pair_term = false;  ///< rides inside a pair pass: belongs to the price list
};

/// One line a price: name, base, and the YAML that switches the effect on.
constexpr EffectCase cases[] = {
    {"viscosity", "water", "effects: {viscosity: {alpha: 0.05}}", true},
    {"viscosity", "water_2d", "effects: {viscosity: {alpha: 0.05}}", true},
    {"xsph", "water", "effects: {xsph: {epsilon: 0.5}}", true},
    {"xsph", "water_2d", "effects: {xsph: {epsilon: 0.5}}", true},
    {"laminar_viscosity", "water", "effects: {laminar_viscosity: {mu: 1 mPa*s}}", true},
    {"laminar_viscosity", "water_2d", "effects: {laminar_viscosity: {mu: 1 mPa*s}}", true},
    {"tensile_cure", "water", "effects: {tensile_cure: {epsilon: 0.2}}", true},
    {"tensile_cure", "water_2d", "effects: {tensile_cure: {epsilon: 0.2}}", true},
    {"density_diffusion", "water", "effects: {density_diffusion: {delta: 0.1}}", true},
    {"density_diffusion", "water_2d", "effects: {density_diffusion: {delta: 0.1}}", true},
    {"corrected_gradients", "water", "effects: {corrected_gradients: on}", true},
    {"corrected_gradients", "water_2d", "effects: {corrected_gradients: on}", true},
    {"shifting", "water", "effects: {shifting: {coefficient: 0.5}}", true},
    {"shifting", "water_2d", "effects: {shifting: {coefficient: 0.5}}", true},
    {"renormalisation", "water", "effects: {renormalisation: {every: 30}}"},
    {"gravity", "water", "loads: {gravity: [0, 0, -9.81 m/s^2]}"},
    {"sponge", "water",
     "boundaries: {beach: {sponge: {box: {from: [-9, -9, -9], to: [9, 9, 9]}, ramp: 1, rate: 1}}}"},
    {"rest", "water", "effects: {rest: {tolerance: 0, quiet: 1 s}}"},
    {"relaxation", "water", "effects: {relaxation: {rate: 1, until: 9 s}}"},
    {"element relaxation", "sheet", "effects: {element_relaxation: {until: 9 s}}"},
    {"acceleration", "water",
     "loads: {pull: {acceleration: [\"-0.1*x\", \"-0.1*y\", \"-0.1*z\"]}}"},
    {"gravity", "sheet", "loads: {gravity: [0, 0, -9.81 m/s^2]}"},
    {"contact with planes", "water", "boundaries: {floor: {planes: {z: -1 m}}}"},
    {"mirror_walls", "water", "boundaries: {floor: {planes: {z: 0}}}"},
    {"periodic", "water", "boundaries: {b: {periodic: {x: [0, 0.24 m]}}}"},
    {"contacts", "water_and_sheet", "contacts: {touch: {between: [pool, sheet]}}"},
    {"kernel contact", "water_and_fine_sheet",
     "contacts: {touch: {between: [pool, sheet], type: kernel}}"},
    {"pressure", "sheet", "loads: {push: {pressure: {on: sheet, value: 1 kPa}}}"},
    {"prescribed motion", "sheet", "boundaries: {edge: {nodes: {edge_of: sheet}, fix: [x, y, z]}}"},
};

/// What one line of the table costs, per particle (element where there are no particles).
struct Cost {
  long size = 0;
  double base = 0;   ///< step without it [ns]
  double ratio = 1;  ///< step with it over step without it
  double own = 0;    ///< of the step with it, in the operations of the effect [ns]
  double extra() const { return (ratio - 1) * base; }
  double inside() const { return extra() - own; }
};

/// Processor time on one thread, which other work on the machine does not count for; else wall
/// time [s].
double now() {
  if (threads() > 1) {
    const auto t = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(t).count();
  }
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Slow enough that no lists are made anew while steps are timed: an effect that shortens the step
/// would have fewer of them and look cheaper than it is.
std::unique_ptr<Simulation> moving(const std::string& text) {
  auto simulation = make_simulation_of_text(text);
  Nodes& nodes = simulation->scene.nodes;
  for (Index i = 0; i < nodes.n_owned; ++i) {
    const Line& x = nodes.x[i];
    const double out_of_plane = simulation->scene.dimension == 3 ? std::sin(30 * x.x) : 0;
    const double scale = simulation->scene.particles.contains(i) ? 0.01 : 0.1;
    nodes.v[i] = {scale * std::sin(30 * x.y), scale * std::sin(30 * x.z + 20 * x.x),
                  scale * out_of_plane, nodes.v[i].w};
  }
  for (int k = 0; k < 3; ++k) advance(simulation->models);
  return simulation;
}

/// Seconds of a few steps.
double seconds_of_steps(Simulation& simulation, int steps) {
  const double start = now();
  for (int k = 0; k < steps; ++k) advance(simulation.models);
  return now() - start;
}

/// Share of the measured time that the operations of an effect took, all steps so far.
double own_share(const Simulation& simulation, const std::string& effect) {
  double own = 0;
  double all = 0;
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : simulation.models.list.front().plan.at(static_cast<Stage>(s))) {
      all += op.watch.seconds;
      if (op.effect == effect) own += op.watch.seconds;
    }
  }
  return own / all;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Both scenes are stepped in turns, so that whatever slows the machine slows both.
Cost cost_of(const EffectCase& c) {
  constexpr int rounds = 11;
  constexpr int steps = 8;
  const std::string base = bases.at(c.base);
  const auto without = moving(base);
  const auto with = moving(base + c.snippet + "\n");
  Cost cost;
  for (const Part& part : without->scene.parts) {
    if (part.is_particles() == !without->scene.particles.empty()) {
      cost.size += part.is_particles() ? part.nodes.size() : part.n_cells();
    }
  }
  std::vector<double> plain;
  std::vector<double> ratios;
  for (int k = 0; k < rounds; ++k) {
    plain.push_back(seconds_of_steps(*without, steps));
    ratios.push_back(seconds_of_steps(*with, steps) / plain.back());
  }
  cost.base = 1e9 * median(plain) / steps / static_cast<double>(cost.size);
  cost.ratio = median(ratios);
  cost.own = own_share(*with, c.effect) * cost.ratio * cost.base;
  return cost;
}

void print_table_head(double fma) {
  fmt::print("what an effect adds to a step; {}, {} thread(s), FMA {:.1f} GFLOP/s\n",
             name_of(isa()), threads(), fma);
  fmt::print("{:<20} {:<16} {:>7} {:>10} {:>7} {:>9} {:>9} {:>9}\n", "effect", "over", "size",
             "base ns", "ratio", "added ns", "own ns", "inside ns");
}

void print_line(const EffectCase& c, const Cost& cost) {
  fmt::print("{:<20} {:<16} {:>7} {:>10.2f} {:>7.3f} {:>9.2f} {:>9.2f} {:>9.2f}\n", c.effect,
             c.base, cost.size, cost.base, cost.ratio, cost.extra(), cost.own, cost.inside());
}

/// A line of effect_prices.inc.
void print_price(const EffectCase& c, const Cost& cost, double fma) {
  fmt::print("{{\"{}\", \"{}\", \"{}\", {:.3f}, {:.2f}, {:.2f}, {:.1f}}},\n", c.effect, c.base,
             name_of(isa()), cost.ratio, cost.extra(), cost.inside(), fma);
}

nlohmann::ordered_json json_of(const EffectCase& c, const Cost& cost) {
  return {{"effect", c.effect},  {"base", c.base},
          {"size", cost.size},   {"base_ns", cost.base},
          {"ratio", cost.ratio}, {"added_ns", cost.extra()},
          {"own_ns", cost.own},  {"inside_ns", cost.inside()},
          {"threads", threads()}};
}

}  // namespace

int bench_effects(const BenchOptions& options) {
  set_threads(options.threads);
  const double fma = fma_rate(options.threads);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  if (!options.json && !options.prices) print_table_head(fma);
  for (const EffectCase& c : cases) {
    if (options.prices && !c.pair_term) continue;
    const Cost cost = cost_of(c);
    if (options.json) {
      list.push_back(json_of(c, cost));
    } else if (options.prices) {
      print_price(c, cost, fma);
    } else {
      print_line(c, cost);
    }
  }
  if (options.json) {
    const nlohmann::ordered_json all = {{"instruction_set", std::string(name_of(isa()))},
                                        {"fma_f64_gflops", fma},
                                        {"effects", list}};
    fmt::print("{}\n", all.dump(2));
  }
  return 0;
}

}  // namespace gannet
