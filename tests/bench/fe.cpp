// Rates of the shell pass and of a whole step, one thread: bench_fe [elements per side ...].
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "fe/shell.hpp"
#include "fe/shell_shown.hpp"
#include "scene/draft.hpp"
#include "time/leapfrog.hpp"
#include "time/step.hpp"

using namespace gannet;

namespace {

/// Processor time of this thread [s]: other programs on the machine do not count.
double seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A wavy sheet of n x n elements of 20 mm with slightly irregular nodes.
Draft sheet(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const double l = 0.02;
  PartDraft p;
  p.name = "sheet";
  p.kind = "shell";
  p.rotations = true;
  p.cell = Cell::quad;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = l * (i + 0.05 * u(random));
      const double y = l * (j + 0.05 * u(random));
      p.points.emplace_back(x, y, 0.2 * l * std::sin(0.1 * i) * std::cos(0.1 * j));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      for (const Index node : {a, a + 1, a + n + 2, a + n + 1}) p.connectivity.push_back(node);
    }
  }
  Draft draft;
  draft.parts.push_back(std::move(p));
  return draft;
}

struct Rates {
  double pass = 0;  ///< median seconds of a shell pass
  double best = 0;  ///< the shortest of them
  double step = 0;  ///< median seconds of a whole step
  double plastic_share = 0;
};

Rates measure(int n, const ElasticPlastic& material, const ShellSection& section) {
  Scene scene;
  assemble(sheet(n), scene);
  ShellBlock block =
      make_shell_block(scene.parts[0].connectivity, scene.nodes.x, material, section);
  add_shell_masses(block, scene.nodes);
  finish_masses(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (Index i = 0; i < scene.nodes.n_owned; ++i) {
    const Vec3 x = xyz(scene.nodes.x[static_cast<std::size_t>(i)]);
    // Stretching at 20/s along x, fast enough to yield soon, with some noise.
    set_xyz(scene.nodes.v[static_cast<std::size_t>(i)],
            {20 * x.x() + 0.05 * u(random), 0.05 * u(random), 0.05 * u(random)});
    set_xyz(scene.nodes.omega[static_cast<std::size_t>(i)], {0.5 * u(random), 0.5 * u(random), 0});
  }
  Models models;
  models.list.emplace_back();
  Model& model = models.list.front();
  model.ranges = {{0, scene.nodes.n_owned}};
  add_leapfrog(scene, model, models.ledger);
  std::vector<double> pass_times;
  model.plan.add({.name = "shell",
                  .stage = Stage::force,
                  .run =
                      [&](const Step& s) {
                        const double begin = seconds();
                        shell_pass(block, scene.nodes, s.dt_old);
                        pass_times.push_back(seconds() - begin);
                      },
                  .stable_dt = [&block] { return stable_step(block); }});
  std::vector<double> step_times;
  Model* const level[] = {&model};
  const int n_steps = std::max(40, 8'000'000 / (n * n));
  for (int k = 0; k < n_steps; ++k) {
    const double begin = seconds();
    step(level);
    step_times.push_back(seconds() - begin);
  }
  const auto median = [](std::vector<double> t) {
    t.erase(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.size() / 4));
    std::nth_element(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(t.size() / 2), t.end());
    return t[t.size() / 2];
  };
  Rates rates{median(pass_times), *std::min_element(pass_times.begin(), pass_times.end()),
              median(step_times), 0};
  if (material.plastic()) {
    show_plastic_strain(block);
    rates.plastic_share =
        static_cast<double>(std::count_if(block.plastic_shown.begin(), block.plastic_shown.end(),
                                          [](double e) { return e > 0; })) /
        block.n_elements;
  }
  return rates;
}

}  // namespace

int main(int argc, char** argv) {
  set_threads(1);
  std::vector<int> sides;
  for (int k = 1; k < argc; ++k) sides.push_back(std::atoi(argv[k]));
  if (sides.empty()) sides = {224, 632};
  const ElasticPlastic steel{.rho = 7800, .E = 210e9, .nu = 0.3, .sigma_y = 250e6, .H = 1e9};
  ElasticPlastic elastic = steel;
  elastic.sigma_y = 0;
  ElasticPlastic hard = steel;  // the plastic law, but nothing flows
  hard.sigma_y = 1e12;
  ElasticPlastic soft = steel;  // every point flows in every step
  soft.sigma_y = 0.1e6;
  soft.H = 0;
  fmt::print("instruction set {}, 1 thread, medians\n", name_of(isa()));
  for (const int n : sides) {
    for (const auto& [name, material, points] :
         {std::tuple{"J2, 5 points", steel, 5}, std::tuple{"J2, 5 points, hard", hard, 5},
          std::tuple{"J2, 5 points, soft", soft, 5}, std::tuple{"elastic, 3 points", elastic, 3}}) {
      const Rates r = measure(n, material, {.thickness = 0.005, .points = points});
      const double million = 1e-6 * n * n;
      fmt::print(
          "{:>7} shells, {:18} pass {:6.2f} (best {:6.2f}), step {:6.2f} M element-steps/s, {:.0f} "
          "% yielded\n",
          n * n, name, million / r.pass, million / r.best, million / r.step, 100 * r.plastic_share);
    }
  }
  return 0;
}
