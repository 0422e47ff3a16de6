// Parallel loops and sums whose results do not depend on the number of threads: work is cut into
// chunks of a fixed size, every chunk writes only what is its own, and partial results are joined
// in chunk order. (tbb::parallel_reduce splits by what is idle and gives other bits each time.)
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/array.hpp"

namespace gannet {

/// Sets how many threads all later parallel loops use; 0 takes every core of the machine.
void set_threads(int n);

/// The number of threads in use.
int threads();

/// Where these threads work. Outside of an arena of its own, TBB never takes more threads than
/// the machine has cores, whatever it is asked for.
tbb::task_arena& thread_arena();

/// Calls f(begin, end). Not inlined, so that a chunk is the same machine code with one thread and
/// with several: two inlined copies may contract products and sums differently.
template <class F>
[[gnu::noinline]] void run_chunk(const F& f, Index begin, Index end) {
  f(begin, end);
}

/// Calls f(begin, end) for consecutive chunks of [0, n); chunk > 0 fixes the cuts.
template <class F>
void parallel_for(Index n, Index chunk, F&& f) {
  if (n <= 0) return;
  const Index n_chunks = (n + chunk - 1) / chunk;
  if (n_chunks == 1 || threads() == 1) {
    for (Index c = 0; c < n_chunks; ++c) run_chunk(f, c * chunk, std::min(n, (c + 1) * chunk));
    return;
  }
  const auto body = [&](const tbb::blocked_range<Index>& chunks) {
    for (Index c = chunks.begin(); c < chunks.end(); ++c) {
      run_chunk(f, c * chunk, std::min(n, (c + 1) * chunk));
    }
  };
  thread_arena().execute([&] {
    tbb::parallel_for(tbb::blocked_range<Index>(0, n_chunks, 1), body, tbb::simple_partitioner());
  });
}

/// Joins f(begin, end) of all chunks of [0, n) from first to last: join(join(zero, f0), f1) ...
template <class T, class F, class Join>
T parallel_reduce(Index n, Index chunk, T zero, F&& f, Join&& join) {
  if (n <= 0) return zero;
  const Index n_chunks = (n + chunk - 1) / chunk;
  if (n_chunks == 1) return join(zero, f(Index{0}, n));
  std::vector<T> part(static_cast<std::size_t>(n_chunks), zero);
  parallel_for(n, chunk, [&](Index begin, Index end) {
    part[static_cast<std::size_t>(begin / chunk)] = f(begin, end);
  });
  T total = zero;
  for (const T& p : part) total = join(total, p);
  return total;
}

/// Sum of f(begin, end) over all chunks, in chunk order.
template <class F>
double parallel_sum(Index n, Index chunk, F&& f) {
  return parallel_reduce(n, chunk, 0.0, f, [](double a, double b) { return a + b; });
}

/// The same for sums of another type than double; zero: what an empty sum is.
template <class T, class F>
T parallel_sum(Index n, Index chunk, const T& zero, F&& f) {
  return parallel_reduce(n, chunk, zero, f, [](const T& a, const T& b) -> T { return a + b; });
}

/// Entries per chunk for cheap loops over node tables.
inline constexpr Index node_chunk = 4096;

}  // namespace gannet
