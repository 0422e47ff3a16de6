// A run is killed again and again, with writes slowed so that kills land in them, and resumed.
// What is left must be readable each time, and the end must be that of an unbroken run.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "../support/whole_files.hpp"
#include "../unit/output/small_run.hpp"
#include "output/folder.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

constexpr double until = 0.03;
const Texts every{{"vtk", "every 1.5 ms"}, {"history", "every 1 ms"}, {"checkpoint", "every 2 ms"}};

/// One process of a run: from the newest checkpoint if there is one, to the end.
void run_to_end(const std::string& folder) {
  Run run(folder, until, every);
  const std::string newest = newest_checkpoint(folder);
  // Without a checkpoint the run starts anew over what the killed one left.
  prepare_output_folder(folder, true, !newest.empty());
  if (!newest.empty()) {
    read_checkpoint(newest, run.small.scene, run.small.models, run.record());
    rewind_output(run.small.models, run.record());
  }
  run.go();
}

/// Runs in a process of its own and kills it after a while, if there is one. True where the run
/// ended by itself without an error.
bool run_in_process(const std::string& folder, int kill_after_ms) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      run_to_end(folder);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  if (kill_after_ms > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kill_after_ms));
    kill(child, SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) REQUIRE(WEXITSTATUS(status) == 0);
  return WIFEXITED(status);
}

std::string checkpoint_problem(const std::string& path) {
  Run run("", until, every);
  try {
    read_checkpoint(path, run.small.scene, run.small.models, run.record());
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// Every file under a final name is whole. Returns how many temporaries lie about.
int check_folder(const std::string& folder) {
  const FolderState state = look_into(folder, checkpoint_problem);
  for (const std::string& problem : state.problems) FAIL_CHECK(problem);
  return state.n_temporaries;
}

}  // namespace

TEST_CASE("output: killed at random moments, what is left is whole and the end the same",
          "[output]") {
  const EmptyFolder whole("kill_unbroken");
  const EmptyFolder cut("killed");
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(run_in_process(whole.path, 0));
  const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(
                        std::chrono::steady_clock::now() - start)
                        .count();
  // Short lives, so that ten kills fit into the run; the seed is fixed, the moments are not quite.
  std::mt19937 random(7);
  std::uniform_int_distribution<int> life(10, std::max(20, static_cast<int>(took) / 6));
  int kills = 0;
  int inside_a_write = 0;
  for (int k = 0; k < 10; ++k) {
    if (run_in_process(cut.path, life(random))) continue;
    ++kills;
    inside_a_write += check_folder(cut.path) > 0 ? 1 : 0;
  }
  REQUIRE(run_in_process(cut.path, 0));
  CHECK(kills >= 5);
  CHECK(inside_a_write >= 1);

  const auto a = all_files(whole.path, "checkpoint");
  const auto b = all_files(cut.path, "checkpoint");
  CHECK(a.size() > 60);
  CHECK(b.size() == a.size());
  for (const auto& [name, bytes] : a) {
    INFO(name);
    REQUIRE(b.contains(name));
    CHECK(b.at(name) == bytes);
  }
}
