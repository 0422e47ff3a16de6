// gannet: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "app/commands.hpp"
#include "app/revision.hpp"
#include "base/error.hpp"
#include "study/bench.hpp"

namespace {

using namespace gannet;

void add_case(CLI::App& command, RunOptions& options) {
  command.add_option("case", options.case_file, "the case file")->required();
  command.add_option("--set", options.set, "override a key: key.path=value (may be repeated)");
}

void add_run(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* run = app.add_subcommand("run", "run a case to its end");
  add_case(*run, options);
  run->add_option("--out", options.out, "output folder (default: beside the case)");
  run->add_option("--threads", options.threads, "number of threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  run->add_option("--until", options.until, "end time, overrides output.until");
  run->add_option("--restart", options.restart, "go on from this checkpoint");
  run->add_flag("--force", options.force,
                "overwrite results; with --restart, accept a changed case");
  run->callback([&] { code = run_command(options); });
}

void add_looks(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* check = app.add_subcommand("check", "read and check a case; run nothing");
  add_case(*check, options);
  check->callback([&] { code = check_command(options); });
  CLI::App* explain = app.add_subcommand("explain", "print the plan of a case, with reasons");
  add_case(*explain, options);
  explain->callback([&] { code = explain_command(options); });
}

void add_bench(CLI::App& app, BenchOptions& options, int& code) {
  CLI::App* bench = app.add_subcommand("bench", "measure the rates of kernels on this machine");
  bench->add_option("name", options.name, "only benchmarks whose name begins so");
  bench->add_flag("--json", options.json, "print JSON");
  bench->add_option("--threads", options.threads, "number of threads (default: 1)");
  bench->callback([&] { code = bench_command(options); });
}

int run_program(int argc, char** argv) {
  CLI::App app{"Gannet: an explicit hydrocode of finite elements and particles"};
  app.require_subcommand(1);
  const std::string revision_text = *revision() != '\0' ? fmt::format(" ({})", revision()) : "";
  app.set_version_flag("--version", fmt::format("gannet {}{}", version(), revision_text));
  RunOptions options;
  BenchOptions bench;
  int code = 0;
  add_run(app, options, code);
  add_looks(app, options, code);
  add_bench(app, bench, code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const gannet::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const gannet::RunError& e) {
    fmt::print(stderr, "gannet: the run was stopped: {}\n", e.what());
    return 3;
  } catch (const std::exception& e) {
    fmt::print(stderr, "gannet: {}\n", e.what());
    return 1;
  }
}
