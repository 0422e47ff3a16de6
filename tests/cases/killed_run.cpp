// The program itself is killed at random moments and resumed, with writes slowed so that kills land
// in them: what is left is whole each time, and in the end nothing shows that it was ever killed.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <set>
#include <thread>

#include "../support/same_bits.hpp"
#include "../support/temporary_folder.hpp"
#include "../support/whole_files.hpp"
#include "output/checkpoint.hpp"
#include "output/folder.hpp"
#include "same_bits_cases.hpp"

using namespace gannet;
using namespace gannet::test;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

/// Panel on coarse water until well after first contact, writing all the time.
const std::vector<std::string> busy_panel{"let.dx=50mm",
                                          "parts.panel.shape.plate.elements=[12, 8]",
                                          "output.until=2.2 ms",
                                          "output.vtk=every 0.05 ms",
                                          "output.history=every 0.1 ms",
                                          "output.checkpoint=every 0.1 ms"};

/// Starts the program with slow writes; returns its process.
pid_t start(const std::string& folder, int n_threads) {
  const std::string newest = newest_checkpoint(folder);
  std::vector<std::string> words{
      GANNET_SLOW_PROGRAM,      "run", panel_slam, "--out", folder, "--threads",
      std::to_string(n_threads)};
  for (const std::string& s : busy_panel) words.insert(words.end(), {"--set", s});
  if (newest.empty()) words.push_back("--force");
  if (!newest.empty()) words.insert(words.end(), {"--restart", newest});
  std::vector<char*> arguments;
  for (std::string& w : words) arguments.push_back(w.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  const int log = open((folder + ".log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

/// How a process ended: its exit code, or minus the signal that ended it.
int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Runs the program, and sends a signal after a while, if there is one.
int run(const std::string& folder, int n_threads, int signal, std::chrono::milliseconds life) {
  const pid_t child = start(folder, n_threads);
  REQUIRE(child > 0);
  if (signal != 0) {
    std::this_thread::sleep_for(life);
    kill(child, signal);
  }
  return wait_for(child);
}

/// A checkpoint read into a simulation made anew.
std::unique_ptr<Simulation> simulation_at(const std::string& checkpoint) {
  auto s = make_simulation(panel_slam, busy_panel);
  // Whose it is, the program asks when it resumes; here any will do.
  read_checkpoint(checkpoint, s->scene, s->models, s->scene.store.get<RunRecord>(), true);
  return s;
}

std::string checkpoint_problem(const std::string& path) {
  try {
    simulation_at(path);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// Names and bytes of all frames, indexes and histories.
std::map<std::string, std::string> results(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::set<std::string> compared{".vtp", ".vtu", ".pvd", ".csv", ".png"};
    if (!compared.contains(entry.path().extension().string())) continue;
    if (entry.path().filename() == "effects.csv") continue;  // says how long things took
    files[fs::relative(entry.path(), folder).string()] = bytes_of_file(entry.path());
  }
  return files;
}

/// Checks that two runs left the same bytes, and checkpoints with the same fields.
void check_same_end(const std::string& a, const std::string& b) {
  const auto files = results(a);
  const auto others = results(b);
  std::size_t bytes = 0;
  CHECK(others.size() == files.size());
  for (const auto& [name, text] : files) {
    INFO(name);
    REQUIRE(others.contains(name));
    CHECK((others.at(name) == text));
    bytes += text.size();
  }
  const std::vector<long long> numbers = checkpoints_in(a);
  REQUIRE(!numbers.empty());
  CHECK(numbers.back() == checkpoints_in(b).back());
  const Bits bits = bits_of(*simulation_at(newest_checkpoint(a)));
  check_same(bits, bits_of(*simulation_at(newest_checkpoint(b))));
  WARN(fmt::format("same: {} files of {} bytes, and {} bytes of the checkpoint of step {}",
                   files.size(), bytes, n_bytes(bits), numbers.back()));
}

struct Kills {
  int made = 0;
  int inside_a_write = 0;  ///< a temporary file was left
  int at_the_start = 0;    ///< there was no checkpoint yet
  int looked_at = 0;       ///< files under final names, all kills together
};

/// Kills runs at random moments, the first early, until `wanted` kills have hit, then lets the last
/// one finish. longest: life of a run [s].
Kills kill_and_resume(const std::string& folder, int signal, int wanted, double longest,
                      std::mt19937& random) {
  std::uniform_real_distribution<double> life(0, longest);
  Kills kills;
  while (kills.made < wanted) {
    const double early = kills.made == 0 ? 0.1 : 1;
    const std::chrono::milliseconds after(static_cast<int>(1000 * early * life(random)));
    const int end = run(folder, 1 + static_cast<int>(random() % 3), signal, after);
    if (end == 0) {  // it was done before: begin again from nothing
      fs::remove_all(folder);
      continue;
    }
    INFO("run " << kills.made << " of " << after.count() << " ms ended with " << end << '\n'
                << bytes_of_file(folder + ".log"));
    REQUIRE((end == -signal || (signal == SIGTERM && end == 130)));
    ++kills.made;
    if (!fs::exists(folder)) continue;
    const FolderState state = look_into(folder, checkpoint_problem);
    for (const std::string& problem : state.problems) FAIL_CHECK(problem);
    kills.inside_a_write += state.n_temporaries > 0 ? 1 : 0;
    kills.at_the_start += newest_checkpoint(folder).empty() ? 1 : 0;
    kills.looked_at += state.n_files;
  }
  REQUIRE(run(folder, 2, 0, {}) == 0);
  return kills;
}

/// The unbroken run that the others are compared with; made once.
struct Unbroken {
  TemporaryFolder parent;
  std::string folder = parent.path() + "/whole";
  double took = 0;  ///< wall time [s]
  Unbroken() {
    const auto begin = Clock::now();
    REQUIRE(run(folder, 2, 0, {}) == 0);
    took = std::chrono::duration<double>(Clock::now() - begin).count();
    CHECK(look_into(folder, checkpoint_problem).problems.empty());
  }
};

const Unbroken& unbroken() {
  static const Unbroken whole;
  return whole;
}

/// The panel must have met the water, or contact was never at stake.
void check_contact_was_made(const std::string& folder) {
  const std::string name = folder + "/history/contact_slam_active.csv";
  const std::string text = bytes_of_file(name);
  const std::size_t comma = text.rfind(',');
  REQUIRE(comma != std::string::npos);
  CHECK(std::stod(text.substr(comma + 1)) > 0);
}

}  // namespace

TEST_CASE("killed run: 10 kills at random moments leave whole files, and the end is the same bits",
          "[kill]") {
  const Unbroken& whole = unbroken();
  check_contact_was_made(whole.folder);
  const TemporaryFolder folder;
  const std::string killed = folder.path() + "/killed";
  std::mt19937 random(20240229);
  const Kills kills = kill_and_resume(killed, SIGKILL, 10, whole.took / 3, random);
  WARN(fmt::format(
      "{} kills, {} inside a write, {} before the first checkpoint; {} files looked "
      "at; an unbroken run takes {:.2f} s",
      kills.made, kills.inside_a_write, kills.at_the_start, kills.looked_at, whole.took));
  CHECK(kills.made == 10);
  CHECK(kills.inside_a_write >= 1);
  CHECK(kills.at_the_start < 10);
  check_same_end(whole.folder, killed);
}

TEST_CASE("killed run: stopped by SIGTERM three times and resumed, the end is the same bits",
          "[kill]") {
  const Unbroken& whole = unbroken();
  const TemporaryFolder folder;
  const std::string stopped = folder.path() + "/stopped";
  std::mt19937 random(7);
  const Kills stops = kill_and_resume(stopped, SIGTERM, 3, whole.took / 2, random);
  CHECK(stops.made == 3);
  check_same_end(whole.folder, stopped);
}

TEST_CASE("killed run: the look at files finds those that are cut off or spoilt", "[kill]") {
  const TemporaryFolder folder;
  const std::string there = folder.path() + "/spoilt";
  int n_spoilt = 0;
  for (const auto& entry : fs::recursive_directory_iterator(unbroken().folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string text = bytes_of_file(entry.path());
    fs::remove_all(there);
    fs::create_directories(there);
    // Cut in the middle. A history may end anywhere, but its lines have as many columns each.
    const bool csv = entry.path().extension() == ".csv";
    std::string spoilt = text.substr(0, text.size() / 2);
    if (csv) spoilt += "\n1,2\n1,2,3,4\n";
    std::ofstream(there + "/" + entry.path().filename().string(), std::ios::binary) << spoilt;
    INFO(entry.path().string());
    CHECK(look_into(there, checkpoint_problem).problems.size() == 1);
    ++n_spoilt;
  }
  CHECK(n_spoilt > 10);
}
