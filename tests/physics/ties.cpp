// Ties between parts that deform: momentum, force, breaking; waves across a tie of two meshes, in
// one model and in two.
#include <fmt/format.h>

#include "../support/temporary_folder.hpp"
#include "fe/beam_inertia.hpp"
#include "output/checkpoint.hpp"
#include "running.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Two blocks that spin about different axes as they are tied, the fine one by its nodes.
std::string spinning_blocks(const std::string& models) {
  return R"case(gannet: 1
materials: {steel: {density: 7800, young: 2 GPa, poisson: 0.3}}
parts:
  coarse:
    solid: {material: steel}
    shape: {block: {from: [0, 0, 0], to: [3, 3, 2], elements: [3, 3, 2]}}
    initial_velocity: ["-20*(y - 1)", "20*x", "3*x"]
  fine:
    solid: {material: steel}
    shape: {block: {from: [0.3, 0.4, 2], to: [2.8, 2.5, 4], elements: [7, 6, 8]}}
    initial_velocity: ["30*z", "-10*z", "5*x"]
ties: {join: {nodes: {plane: {point: [0, 0, 2], normal: [0, 0, 1]}, of: fine}, to: coarse}}
)case" + models +
         "output: {until: 10 s, checkpoint: never}\n";
}

const std::string two_models = "models: {slow: {parts: coarse}, fast: {parts: fine}}\n";

void check_momenta(const std::string& text, int substeps) {
  const auto s = make_simulation_of_text(text);
  const Total p = linear_momentum(s->scene);
  const Total L = angular_momentum(s->scene);
  run_until(*s, 0.05, [] {});
  const Total p1 = linear_momentum(s->scene);
  const Total L1 = angular_momentum(s->scene);
  const double dp = (p1.sum - p.sum).norm() / p.scale;
  const double dL = (L1.sum - L.sum).norm() / L.scale;
  const auto n = s->models.list.front().step.n;
  fmt::print(
      "tied blocks: {} and {} steps, momentum {:.2g}, angular momentum {:.2g}, energy {:.2g}\n", n,
      s->models.list.back().step.n, dp, dL, energy_error(*s));
  CHECK(n > 20);
  CHECK(s->models.list.back().step.n >= substeps * n);
  CHECK(dp < 1e-13);  // rounding
  CHECK(dL < 1e-12);
}

}  // namespace

TEST_CASE("ties: momentum and angular momentum of blocks of different meshes", "[physics]") {
  check_momenta(spinning_blocks(""), 1);
  check_momenta(spinning_blocks(two_models), 2);
}

TEST_CASE("ties: nodes that turn are tied by their rotations", "[physics]") {
  const std::string text = R"case(gannet: 1
materials: {steel: {density: 7800, young: 200 GPa, poisson: 0.3}}
parts:
WING
  strip:
    shell: {material: steel, thickness: 50 mm}
    shape: {plate: {size: [2, 1], elements: [10, 5], centre: [3, 0.5, 0]}}
TIES
boundaries: {root: {nodes: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}, of: wing}, fix: [x, y, z, rx, ry, rz]}}
loads: {tip: {force: {nodes: {plane: {point: [4, 0, 0], normal: [1, 0, 0]}, of: strip}, value: [0, 0, "500*min(t/0.5, 1)"]}}}
MODELS
effects: {guards: off}
probes: {tip: {displacement: {node: {nearest: [4, 0.5, 0], of: strip}}}}
output: {until: 10 s, checkpoint: never}
)case";
  const std::string shell = "    shell: {material: steel, thickness: 50 mm}\n";
  const std::string seam =
      "seam: {nodes: {plane: {point: [2, 0, 0], normal: [1, 0, 0]}, of: strip}, to: ";
  const std::string wing =
      "  wing:\n" + shell +
      "    shape: {plate: {size: [2, 1], elements: [4, 2], centre: [1, 0.5, 0]}}";
  // The same elements, the outer two rows of them in the model of the strip.
  const std::string halves =
      "  wing:\n" + shell +
      "    shape: {plate: {size: [1, 1], elements: [2, 2], centre: [0.5, 0.5, 0]}}\n  buffer:\n" +
      shell + "    shape: {plate: {size: [1, 1], elements: [2, 2], centre: [1.5, 0.5, 0]}}";
  const auto with = [&](const std::string& parts, const std::string& ties,
                        const std::string& models) {
    std::string copy = text;
    copy.replace(copy.find("WING"), 4, parts);
    copy.replace(copy.find("TIES"), 4, "ties: {" + ties + "}");
    copy.replace(copy.find("MODELS"), 6, models);
    const auto s = make_simulation_of_text(copy);
    add_drag(*s, 15);
    run_until(*s, 1.5, [] {});
    return measured(s->scene, "probe.tip", 2);
  };
  // A cantilever of one mesh: F L^3/(3 E I), 500 N over 4 m; a plate is stiffer than a
  // beam by 1/(1 - nu^2) at most.
  const double beam = 500 * 64 / (3 * 2e11 * std::pow(0.05, 3) / 12);
  const double one = with(wing, seam + "wing}", "");
  const double two = with(halves,
                          seam +
                              "buffer}, edge: {nodes: {plane: {point: [1, 0, 0], normal: [1, 0, "
                              "0]}, of: buffer}, to: wing}",
                          "models: {slow: {parts: wing}, fast: {parts: [buffer, strip]}}");
  fmt::print("two plates: tip {:.5g} m, in two models {:.5g} m, of a beam {:.5g} m\n", one, two,
             beam);
  CHECK(one > 0.91 * beam);
  CHECK(one < 1.03 * beam);
  CHECK(two == Approx(one).epsilon(0.01));
}

namespace {

/// A mast and an arm across it in free flight, which turn about different axes; wide sections.
std::string spinning_beams(const std::string& models) {
  return R"case(gannet: 1
materials: {steel: {density: 7800, young: 2 GPa, poisson: 0.3}}
parts:
  mast:
    beam: {material: steel, section: {rectangle: {width: 0.1, height: 0.4}}, up: [0, 0, 1]}
    shape: {line: {from: [0, 0, 0], to: [4, 0, 0], elements: 4}}
    initial_velocity: ["-2*y", "2*x", "1*x"]
  arm:
    beam: {material: steel, section: {rectangle: {width: 0.1, height: 0.2}}, up: [0, 0, 1]}
    shape: {line: {from: [2, 0, 0], to: [2, 2, 0], elements: 20}}
    initial_velocity: ["-2*y", "2*x", "2 + 3*y"]
ties: {join: {nodes: {nearest: [2, 0, 0], of: arm}, to: mast}}
effects: {guards: off}
)case" + models +
         "output: {until: 10 s, checkpoint: never}\n";
}

/// With the spins of the nodes, when all models stand at one time (x at n, v at n-1/2).
Total momentum_of_beams(Simulation& s) {
  Total L = angular_momentum(s.scene);
  const auto& blocks = s.scene.store.get<BeamBlocks>().list;
  const auto& inertias = s.scene.store.get<BeamInertias>().list;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const BeamBlock& block = blocks[b];
    for (Index k = 0; k < block.nodes.size(); ++k) {
      // Elements turn their nodes when the next step begins, a faster model at the end of its own.
      const bool turned =
          !block.elsewhere.empty() && block.elsewhere[static_cast<std::size_t>(k)] != 0;
      const double dt = s.models.of_node(block.nodes.begin + k).step.dt_old;
      L.sum += spin_of(inertias[b], block, s.scene.nodes, k, turned ? dt : -dt);
    }
  }
  return L;
}

/// Largest size of kinetic and stored energy less what they were, over that, and what the momenta
/// are off by.
struct Drifts {
  double energy = 0;
  double momentum = 0;
  double angular = 0;
};

Drifts drifts_of(const std::string& models, int substeps) {
  const auto s = make_simulation_of_text(spinning_beams(models));
  const Total p = linear_momentum(s->scene);
  advance(s->models);
  const Total L = momentum_of_beams(*s);
  const double E = s->models.ledger.held();
  Drifts most;
  run_until(*s, 0.1, [&] {
    const Total p1 = linear_momentum(s->scene);
    const Total L1 = momentum_of_beams(*s);
    most.energy = std::max(most.energy, std::abs(s->models.ledger.held() / E - 1));
    most.momentum = std::max(most.momentum, (p1.sum - p.sum).norm() / p.scale);
    most.angular = std::max(most.angular, (L1.sum - L.sum).norm() / L.scale);
  });
  const auto n = s->models.list.front().step.n;
  fmt::print("spinning beams: {} and {} steps, energy {:.2g}, momentum {:.2g}, angular {:.2g}\n", n,
             s->models.list.back().step.n, most.energy, most.momentum, most.angular);
  CHECK(s->models.list.back().step.n >= substeps * n);
  return most;
}

}  // namespace

TEST_CASE("ties: beams across models keep energy and momenta as in one", "[physics]") {
  const Drifts one = drifts_of("", 1);
  const Drifts two = drifts_of("models: {slow: {parts: mast}, fast: {parts: arm}}\n", 2);
  CHECK(one.energy < 5e-3);
  CHECK(two.energy < one.energy + 5e-3);
  for (const Drifts& d : {one, two}) {
    CHECK(d.momentum < 1e-12);  // rounding
    CHECK(d.angular < 1e-12);
  }
}

TEST_CASE("ties: a checkpoint of one model goes on in two without a jolt", "[physics]") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/beams.h5";
  const auto one = make_simulation_of_text(spinning_beams(""));
  run_until(*one, 0.05, [] {});
  write_checkpoint(path, one->scene, one->models, one->scene.store.get<RunRecord>());
  const auto two = make_simulation_of_text(
      spinning_beams("models: {slow: {parts: mast}, fast: {parts: arm}}\n"));
  read_checkpoint(path, two->scene, two->models, two->scene.store.get<RunRecord>(), true);
  const double E = one->models.ledger.held();
  double most = 0;
  run_until(*two, 0.1, [&] { most = std::max(most, std::abs(two->models.ledger.held() / E - 1)); });
  fmt::print("one model goes on in two: energy {:.2g}\n", most);
  CHECK(most < 2e-3);  // in two models from the start energy swings by 4e-3
}

TEST_CASE("ties: the force of a tie is what it carries, and it lets go where it is too large",
          "[physics]") {
  // A weight of 2 kg/m x 1 m on a line, drawn up by its other end: the tie carries m (g + a).
  const std::string text = R"case(gannet: 1
parts:
  rope: {cable: {EA: 1 MN, mass_per_length: 2, damping_ratio: 0.5}, shape: {line: {from: [0, 0, 0], to: [0, 0, 1], elements: 10}}}
  load: {cable: {EA: 1 MN, mass_per_length: 2, damping_ratio: 0.5}, shape: {line: {from: [0, 0, -1], to: [0, 0, 0], elements: 4}}}
ties: {hook: {nodes: {nearest: [0, 0, 0], of: load}, to: rope, breaks_at: 100 N}}
boundaries: {crane: {nodes: {nearest: [0, 0, 1], of: rope}, velocity: [0, 0, "5*max(t - 1, 0)^2"]}}
loads: {gravity: [0, 0, "-10*min(t/0.5, 1)"]}
MODELS
output: {until: 10 s, checkpoint: never}
)case";
  for (const char* models : {"", "models: {a: {parts: load}, b: {parts: rope}}"}) {
    std::string copy = text;
    copy.replace(copy.find("MODELS"), 6, models);
    const auto s = make_simulation_of_text(copy);
    run_until(*s, 0.95, [] {});
    CHECK(measured(s->scene, "tie.hook.force", 2) == Approx(-20).epsilon(2e-2));
    run_until(*s, 1.5, [] {});
    CHECK(measured(s->scene, "tie.hook.force", 2) == Approx(-30).epsilon(2e-2));
  }
  std::string harder = text;
  harder.replace(harder.find("MODELS"), 6, "");
  harder.replace(harder.find("100 N"), 5, "27 N");
  const auto s = make_simulation_of_text(harder);
  run_until(*s, 1.5, [] {});
  CHECK(measured(s->scene, "tie.hook.force", 2) == 0);
  const double mass = [&] {
    double sum = 0;
    for (Index i = 0; i < s->scene.nodes.n_owned; ++i) {
      sum += s->scene.nodes.x[static_cast<std::size_t>(i)].w;
    }
    return sum;
  }();
  CHECK(mass == Approx(4).epsilon(1e-12));
  // It falls freely from the moment that it let go, before t = 1.5 s.
  const Part& load = s->scene.parts[static_cast<std::size_t>(s->scene.part_number("load"))];
  const double v = s->scene.nodes.v[static_cast<std::size_t>(load.nodes.begin)].z;
  run_until(*s, 1.7, [] {});
  const double later = s->scene.nodes.v[static_cast<std::size_t>(load.nodes.begin)].z;
  CHECK((later - v) / 0.2 == Approx(-10).epsilon(0.02));
  CHECK(energy_error(*s) < 5e-3);
}

namespace {

/// A weight of 2 kg under a line that boundaries hold everywhere.
std::string weight_under_held_line(const std::string& tie, const std::string& more) {
  return R"case(gannet: 1
parts:
  rope: {cable: {EA: 1 MN, mass_per_length: 2, damping_ratio: 0.5}, shape: {line: {from: [0, 0, 0], to: [0, 0, 1], elements: 4}}}
  load: {cable: {EA: 1 MN, mass_per_length: 2, damping_ratio: 0.5}, shape: {line: {from: [0, 0, -1], to: [0, 0, 0], elements: 4}}}
ties: {hook: {nodes: {nearest: [0, 0, 0], of: load}, to: rope)case" +
         tie + R"case(}}
boundaries: {crane: {nodes: {part: rope}, fix: [x, y, z]}}
loads: {gravity: [0, 0, "-10*min(t/0.5, 1)"]}
output: {until: 10 s, checkpoint: never}
)case" + more;
}

}  // namespace

TEST_CASE("ties: the force of a tie to what is held is the weight", "[physics]") {
  for (const char* models : {"", "models: {a: {parts: load}, b: {parts: rope}}\n",
                             "models: {a: {parts: rope}, b: {parts: load}}\n"}) {
    const auto s = make_simulation_of_text(weight_under_held_line("", models));
    double largest = 0;  // g rises slowly, and impulses of the link count as forces
    run_until(*s, 0.95, [&] {
      largest = std::max(largest, std::abs(measured(s->scene, "tie.hook.force", 2)));
    });
    CHECK(measured(s->scene, "tie.hook.force", 2) == Approx(-20).epsilon(1e-4));
    CHECK(largest < 20.2);
  }
  const auto holds = make_simulation_of_text(weight_under_held_line(", breaks_at: 21 N", ""));
  run_until(*holds, 0.95, [] {});
  CHECK(measured(holds->scene, "tie.hook.force", 2) == Approx(-20).epsilon(1e-4));
  const auto breaks = make_simulation_of_text(weight_under_held_line(", breaks_at: 15 N", ""));
  run_until(*breaks, 0.95, [] {});
  CHECK(measured(breaks->scene, "tie.hook.force", 2) == 0);
  CHECK(energy_error(*breaks) < 5e-3);
}

TEST_CASE("ties: no jolt comes from what moves at the start", "[physics]") {
  std::string text = weight_under_held_line("", "");
  text.replace(text.find("fix: [x, y, z]"), 14, "velocity: [0, 0, 1]");
  const auto s = make_simulation_of_text(text);
  double largest = 0;
  run_until(*s, 2e-3, [&] {
    largest = std::max(largest, std::abs(measured(s->scene, "tie.hook.force", 2)));
  });
  // A wave of the load, sqrt(EA mu) v = 1414 N, twice that where it comes back; m_s v/(dt/2) of
  // a node that is set off in one kick is more.
  CHECK(largest > 1000);
  CHECK(largest < 2 * 1414);
}

TEST_CASE("ties: the order of ties that share corners changes no force", "[physics]") {
  // 20 kg under, and a line of 20 kg that holds them, at the middle of a bar of 0.4 kg.
  const std::string one = "  one: {nodes: {nearest: [0, 0, 0], of: under}, to: bar}\n";
  const std::string two = "  two: {nodes: {nearest: [0, 0, 0], of: over}, to: bar}\n";
  const auto forces = [&](const std::string& ties) {
    const auto s = make_simulation_of_text(R"case(gannet: 1
parts:
  bar: {cable: {EA: 10 MN, mass_per_length: 2, damping_ratio: 0.5}, shape: {line: {from: [0, 0, -0.1], to: [0, 0, 0.1], elements: 1}}}
  under: {cable: {EA: 1 MN, mass_per_length: 20, damping_ratio: 0.5}, shape: {line: {from: [0, 0, -1], to: [0, 0, 0], elements: 4}}}
  over: {cable: {EA: 1 MN, mass_per_length: 20, damping_ratio: 0.5}, shape: {line: {from: [0, 0, 1], to: [0, 0, 0], elements: 4}}}
ties:
)case" + ties + R"case(boundaries: {up: {nodes: {nearest: [0, 0, 1], of: over}, fix: [x, y, z]}}
loads: {gravity: [0, 0, "-10*min(t/0.5, 1)"]}
output: {until: 10 s, checkpoint: never}
)case");
    std::array<double, 2> early{};
    run_until(*s, 0.3, [] {});
    early = {measured(s->scene, "tie.one.force", 2), measured(s->scene, "tie.two.force", 2)};
    run_until(*s, 1.5, [] {});
    CHECK(measured(s->scene, "tie.one.force", 2) == Approx(-200).epsilon(1e-3));
    CHECK(measured(s->scene, "tie.two.force", 2) == Approx(204).epsilon(1e-3));
    return early;
  };
  const auto first = forces(one + two);
  const auto second = forces(two + one);
  CHECK(first[0] == Approx(second[0]).epsilon(1e-9));
  CHECK(first[1] == Approx(second[1]).epsilon(1e-9));
}

namespace {

/// A half-sine pulse of 0.2 m that runs along a bar of 1 m (125 elements) into one of half the
/// elements' size (250). `buffer`: elements of the bar that are a part of the fast model.
struct Bar {
  int buffer = 0;
  int ratio = 1;
  bool models = false;
};

std::string bar(const Bar& b) {
  const double h = 1.0 / 125;
  const double end = 1 - b.buffer * h;
  const std::string wave =
      "initial_velocity: [\"max(sin(pi*(x - 0.2)/0.2), 0)*(x > 0.2)*(x < 0.4)\", 0, 0]";
  std::string text = "gannet: 1\nparts:\n";
  const auto part = [&](const char* name, double from, double to, int n, double factor) {
    text += fmt::format(
        "  {}:\n    cable: {{EA: 1 kN, mass_per_length: 1e-3, tension_only: no, dt_factor: {}}}\n"
        "    shape: {{line: {{from: [{}, 0, 0], to: [{}, 0, 0], elements: {}}}}}\n    {}\n",
        name, factor, from, to, n, wave);
  };
  part("coarse", 0, end, 125 - b.buffer, 0.9);
  if (b.buffer > 0) part("buffer", end, 1, b.buffer, 0.9);
  part("fine", 1, 2, 250, b.models ? 1.8 / b.ratio : 0.9);
  text += fmt::format("ties:\n  join: {{nodes: {{nearest: [1, 0, 0], of: fine}}, to: {}}}\n",
                      b.buffer > 0 ? "buffer" : "coarse");
  if (b.buffer > 0) {
    text +=
        fmt::format("  seam: {{nodes: {{nearest: [{}, 0, 0], of: buffer}}, to: coarse}}\n", end);
  }
  if (b.models) {
    text += fmt::format("models: {{slow: {{parts: coarse}}, fast: {{parts: [{}fine]}}}}\n",
                        b.buffer > 0 ? "buffer, " : "");
  }
  return text + "output: {until: 10 s, checkpoint: never}\n";
}

/// The largest velocity in the coarse bar after the right-going half of the pulse (0.5 high) has
/// gone into the fine one, over its height; the left-going half has come back from the free end by
/// then and must not have reached the place: it is 0.2 m + 0.6 m behind.
double reflected(const Bar& b) {
  const auto s = make_simulation_of_text(bar(b));
  const double c = 1000;
  run_until(*s, 0.98 / c, [] {});
  double largest = 0;
  for (const Part& part : s->scene.parts) {
    if (part.name == "fine") continue;
    for (Index i = part.nodes.begin; i < part.nodes.end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double x = s->scene.nodes.x[k].x;
      // The left-going half, turned round at x = 0, stands at 0.58 to 0.78.
      if (x > 0.85) largest = std::max(largest, std::abs(s->scene.nodes.v[k].x));
    }
  }
  return largest / 0.5;
}

}  // namespace

TEST_CASE("ties: a pulse across a tie of two meshes and two steps", "[physics]") {
  const double mesh = reflected({});
  fmt::print("pulse across 125 and 250 elements, one model: {:.3g} comes back\n", mesh);
  CHECK(mesh < 0.02);  // with what trails behind the kinks of a half sine
  for (const int ratio : {2, 10, 100}) {
    const double bare = reflected({.ratio = ratio, .models = true});
    const double with = reflected({.buffer = 3, .ratio = ratio, .models = true});
    fmt::print("  ratio {}: {:.3g}, behind a buffer of 3 elements {:.3g}\n", ratio, bare, with);
    CHECK(bare - mesh < 0.01);
    CHECK(with - mesh < 0.01);
  }
}
