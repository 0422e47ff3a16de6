#include "study/study_runs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "output/folder.hpp"
#include "study/study_plan.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

nlohmann::json json_of(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) return {};
  return nlohmann::json::parse(stream, nullptr, false);
}

double number_in(const nlohmann::json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : unknown;
}

/// A child process that makes a run.
struct Child {
  pid_t pid = -1;
  std::size_t run = 0;
  Clock::time_point start;
  bool told_to_stop = false;
};

/// In the child: what it says goes to a log beside its folder, then it becomes the program.
[[noreturn]] void become(const std::string& program, const std::vector<char*>& words,
                         const std::string& log) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0) {
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
  }
  execv(program.c_str(), words.data());
  _exit(127);
}

Child start_child(const StudySpec& spec, const StudyProgram& program, const StudyRun& run,
                  std::size_t number) {
  Child child;
  child.run = number;
  std::vector<std::string> words = words_of(spec, run);
  std::string name = "gannet";
  std::vector<char*> pointers = {name.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string log = run.folder + ".log";
  child.start = Clock::now();
  child.pid = fork();
  if (child.pid < 0) {
    throw std::runtime_error(fmt::format("no process could be made: {}", std::strerror(errno)));
  }
  if (child.pid == 0) become(program.path, pointers, log);
  return child;
}

std::string last_line(const std::string& file) {
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

void finish_run(const Child& child, int status, StudyRun& run) {
  read_run(run);
  if (run.state == StudyState::done || run.state == StudyState::failed) return;
  if (child.told_to_stop) {
    run.state = StudyState::not_run;
    run.reason = "stopped before its end; its checkpoint is kept, the next study goes on from it";
    return;
  }
  run.state = StudyState::failed;
  run.reason = WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                                   : fmt::format("exit code {}: {}", WEXITSTATUS(status),
                                                 last_line(run.folder + ".log"));
}

void say_end(const StudySpec& spec, const StudyRun& run, std::size_t number, std::size_t of) {
  std::string what = run.reason;
  if (run.state == StudyState::done) {
    what = fmt::format("{}{}", wall_text(run.wall), run.was_there ? ", done before" : "");
    if (run.predicted > 0) what += fmt::format(" (predicted {})", wall_text(run.predicted));
  } else if (run.state == StudyState::failed) {
    what = "failed: " + run.reason;
  }
  fmt::print("[{}/{}] {}{}: {}\n", number + 1, of, setting_text(spec.axes, run.choices),
             spec.repeats > 1 ? fmt::format(" #{}", run.repeat + 1) : "", what);
  std::fflush(stdout);
}

/// The state of the study while its runs are made.
struct Driver {
  const StudySpec& spec;
  const StudyProgram& program;
  std::vector<StudyRun>& runs;
  Clock::time_point start = Clock::now();
  std::vector<Child> children;
  StudyOutcome outcome;

  [[nodiscard]] double left() const { return spec.budget - seconds_since(start); }

  /// Starts the next run that fits in the budget. Returns false where there is none to start.
  bool start_next() {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      StudyRun& run = runs[i];
      if (run.state != StudyState::waiting || is_running(i)) continue;
      run.predicted = predict_wall(runs, run);
      // With nothing to predict from, one run goes first; the others wait for what it tells.
      if (!(run.predicted > 0) && !children.empty()) return false;
      const double time = run.predicted > 0 ? run.predicted : 0;
      if (time <= left()) {
        children.push_back(start_child(spec, program, run, i));
        return true;
      }
      run.state = StudyState::not_run;
      run.reason = fmt::format("not run: predicted to take {}, {} of the budget left",
                               wall_text(time), wall_text(std::max(0.0, left())));
      outcome.out_of_budget = true;
      say_end(spec, run, i, runs.size());
    }
    return false;
  }

  [[nodiscard]] bool is_running(std::size_t i) const {
    return std::any_of(children.begin(), children.end(),
                       [i](const Child& c) { return c.run == i; });
  }

  void collect() {
    for (std::size_t k = 0; k < children.size();) {
      int status = 0;
      if (waitpid(children[k].pid, &status, WNOHANG) != children[k].pid) {
        ++k;
        continue;
      }
      StudyRun& run = runs[children[k].run];
      finish_run(children[k], status, run);
      if (run.state == StudyState::not_run) outcome.out_of_budget = true;
      say_end(spec, run, children[k].run, runs.size());
      children.erase(children.begin() + static_cast<long>(k));
    }
  }

  void tell_to_stop() {
    for (Child& child : children) {
      if (!child.told_to_stop) kill(child.pid, SIGTERM);
      child.told_to_stop = true;
    }
  }
};

}  // namespace

int threads_of(const StudySpec& spec) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return spec.threads > 0 ? spec.threads : std::max(1, cores / spec.parallel);
}

std::vector<std::string> words_of(const StudySpec& spec, const StudyRun& run) {
  std::vector<std::string> words = {"run", spec.case_file, "--out", run.folder, "--resume"};
  for (const std::string& set : run.set) {
    words.emplace_back("--set");
    words.push_back(set);
  }
  words.insert(words.end(), {"--threads", std::to_string(threads_of(spec))});
  return words;
}

void read_run(StudyRun& run) {
  const nlohmann::json summary = json_of(run.folder + "/summary.json");
  if (!summary.is_object()) return;
  const std::string status = summary.value("status", "");
  if (status != "completed" && status != "failed") return;
  run.state = status == "completed" ? StudyState::done : StudyState::failed;
  if (run.state == StudyState::failed) run.reason = summary.value("exit_reason", "unknown");
  run.wall = number_in(summary, "wall_time") + number_in(summary, "wall_time_before");
  run.steps = number_in(summary, "steps");
  run.particle_rate = number_in(summary, "particle_steps_per_second");
  run.element_rate = number_in(summary, "element_steps_per_second");
  run.memory = number_in(summary, "peak_memory_bytes");
  run.energy_error = number_in(summary, "energy_error");
  run.version = summary.value("version", "");
  run.cpu = number_in(summary, "cpu_time") + number_in(summary, "cpu_time_before");
  run.lost_particles = number_in(summary, "lost_particles");
  run.deepest_penetration = number_in(summary, "deepest_penetration");
}

StudyOutcome make_runs(const StudySpec& spec, const StudyProgram& program,
                       std::vector<StudyRun>& runs, const std::atomic<int>& stop) {
  fs::create_directories(spec.out + "/runs");
  Driver driver{spec, program, runs};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    read_run(runs[i]);
    runs[i].was_there = runs[i].state != StudyState::waiting;
    if (runs[i].was_there) say_end(spec, runs[i], i, runs.size());
  }
  while (!spec.collect) {
    driver.collect();
    if (stop != 0 || seconds_since(driver.start) > 1.1 * spec.budget + 2) driver.tell_to_stop();
    const bool room = driver.children.size() < static_cast<std::size_t>(spec.parallel);
    if (stop == 0 && room && driver.start_next()) continue;
    if (driver.children.empty()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    StudyRun& run = runs[i];
    if (run.state != StudyState::waiting) continue;
    run.state = StudyState::not_run;
    run.reason = spec.collect ? "not there yet" : "not run: the study was stopped";
    if (spec.collect) say_end(spec, run, i, runs.size());
  }
  driver.outcome.stopped = stop != 0;
  driver.outcome.wall = seconds_since(driver.start);
  return driver.outcome;
}

}  // namespace gannet
