#include "base/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <memory>

namespace gannet {

namespace {
int n_threads = 0;
std::unique_ptr<tbb::global_control> control;
std::unique_ptr<tbb::task_arena> arena;
}  // namespace

void set_threads(int n) {
  n_threads = n > 0 ? n : tbb::info::default_concurrency();
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(n_threads));
  arena = std::make_unique<tbb::task_arena>(n_threads);
}

int threads() {
  if (n_threads == 0) set_threads(0);
  return n_threads;
}

tbb::task_arena& thread_arena() {
  threads();
  return *arena;
}

}  // namespace gannet
