#include "study/bench.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/array.hpp"
#include "base/isa.hpp"
#include "base/parallel.hpp"
#include "study/machine.hpp"

namespace gannet {

namespace {

using Watch = std::chrono::steady_clock;

double seconds_of(const std::function<void()>& f) {
  const auto start = Watch::now();
  f();
  return std::chrono::duration<double>(Watch::now() - start).count();
}

/// Best rate of many short bursts on `threads` threads at once: other work on the machine only
/// ever makes a burst slower.
double best_rate(int threads, int bursts, const std::function<double(int)>& burst) {
  double best = 0;
  for (int k = 0; k < bursts; ++k) {
    double work = 0;
    const double seconds = seconds_of(
        [&] { work = parallel_sum(threads, 1, [&](Index t, Index) { return burst(t); }); });
    best = std::max(best, work / seconds);
  }
  return best;
}

double measure_triad(int threads) {
  const long n = 4L << 20;  // 32 MiB an array and thread: out of every cache
  std::vector<Array<double>> memory(static_cast<std::size_t>(threads));
  for (auto& m : memory) m.assign(static_cast<std::size_t>(3 * n), 1.0);
  return best_rate(threads, 15, [&](int t) {
    double* a = memory[static_cast<std::size_t>(t)].data();
    return GANNET_DISPATCH(triad, a, a + n, a + 2 * n, 3.0, n);
  });
}

nlohmann::json to_json(const MachineLimits& m, const std::vector<BenchResult>& results) {
  nlohmann::json benchmarks = nlohmann::json::array();
  for (const BenchResult& r : results) {
    benchmarks.push_back({{"name", r.name},
                          {"threads", r.threads},
                          {"size", r.size},
                          {"rate", r.rate},
                          {"unit", r.unit},
                          {"median_seconds", r.median_seconds},
                          {"bytes_per_item", r.bytes_per_item}});
  }
  return {{"machine",
           {{"fma_f64_gflops", m.fma_f64_gflops},
            {"fma_f32_gflops", m.fma_f32_gflops},
            {"triad_gbs", m.triad_gbs},
            {"cores", m.cores}}},
          {"benchmarks", benchmarks}};
}

void print_table(const MachineLimits& m, const std::vector<BenchResult>& results, int threads) {
  fmt::print(
      "machine: {} cores, {}; {} thread(s): FMA {:.1f} GFLOP/s in double, {:.1f} in "
      "single, triad {:.1f} GB/s\n",
      m.cores, name_of(isa()), threads, m.fma_f64_gflops, m.fma_f32_gflops, m.triad_gbs);
  fmt::print("{:<28} {:>10} {:>8} {:>14} {:>12} {:>8}\n", "benchmark", "size", "threads",
             "million/s", "median ms", "B/item");
  for (const BenchResult& r : results) {
    fmt::print("{:<28} {:>10} {:>8} {:>14.3f} {:>12.3f} {:>8.0f}  {}\n", r.name, r.size, r.threads,
               r.rate * 1e-6, r.median_seconds * 1e3, r.bytes_per_item, r.unit);
  }
}

}  // namespace

double median_seconds(int repetitions, const std::function<void()>& f) {
  f();
  std::vector<double> times;
  for (int k = 0; k < repetitions; ++k) times.push_back(seconds_of(f));
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

double fma_rate(int threads) {
  return 1e-9 * best_rate(threads, 60, [](int) {
           alignas(64) double sink[128];
           return GANNET_DISPATCH(burn_fma_f64, 20000, sink);
         });
}

MachineLimits measure_machine(int threads) {
  MachineLimits m;
  m.cores = tbb::info::default_concurrency();
  m.fma_f64_gflops = fma_rate(threads);
  m.fma_f32_gflops = 1e-9 * best_rate(threads, 60, [](int) {
                       alignas(64) float sink[256];
                       return GANNET_DISPATCH(burn_fma_f32, 20000, sink);
                     });
  m.triad_gbs = 1e-9 * measure_triad(threads);
  return m;
}

int run_benchmarks(const BenchOptions& options, const std::vector<Benchmark>& benchmarks) {
  set_threads(options.threads);
  const MachineLimits machine = measure_machine(options.threads);
  std::vector<BenchResult> results;
  for (const Benchmark& b : benchmarks) {
    if (b.name.rfind(options.name, 0) != 0) continue;
    BenchResult r = b.run();
    r.name = b.name;
    r.threads = options.threads;
    results.push_back(r);
  }
  if (options.json) {
    fmt::print("{}\n", to_json(machine, results).dump(2));
  } else {
    print_table(machine, results, options.threads);
  }
  return 0;
}

}  // namespace gannet
