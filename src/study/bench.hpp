// gannet bench: rates of kernels beside the limits of the machine, measured in short bursts.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gannet {

struct BenchOptions {
  std::string name;  ///< only benchmarks whose name begins so; empty: all
  bool json = false;
  bool prices = false;  ///< `bench effects`: as lines of the price list
  int threads = 1;
};

/// What the machine can do, per thread count asked for.
struct MachineLimits {
  double fma_f64_gflops = 0;
  double fma_f32_gflops = 0;
  double triad_gbs = 0;
  int cores = 0;
};

/// One measured rate.
struct BenchResult {
  std::string name;  ///< "sph.pass.fused"
  int threads = 1;
  long size = 0;     ///< particles, elements
  double rate = 0;   ///< items per second
  std::string unit;  ///< "particle-steps/s"
  double median_seconds = 0;
  double bytes_per_item = 0;
};

/// Measures the machine in bursts of a few milliseconds, best of many: FMA rates and memory triad
/// a = b + s c, on all `threads` at once.
MachineLimits measure_machine(int threads);

/// The FMA rate alone, in double [GFLOP/s]: a few milliseconds.
double fma_rate(int threads);

/// Median seconds of `repetitions` calls of f, after one warm-up.
double median_seconds(int repetitions, const std::function<void()>& f);

/// One benchmark: its name, and what measures it.
struct Benchmark {
  std::string name;
  std::function<BenchResult()> run;
};

/// Runs the benchmarks that match and prints a table, or the JSON that scripts rely on.
int run_benchmarks(const BenchOptions& options, const std::vector<Benchmark>& benchmarks);

}  // namespace gannet
