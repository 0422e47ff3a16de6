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
  auto* restart = run->add_option("--restart", options.restart, "go on from this checkpoint");
  run->add_flag("--resume", options.resume,
                "go on from the newest checkpoint in the output folder; without one, start anew")
      ->excludes(restart);
  run->add_flag("--force", options.force,
                "overwrite results; with --restart, accept a changed case");
  run->callback([&] { code = run_command(options); });
}

void add_looks(CLI::App& app, RunOptions& options, int& code) {
  CLI::App* check = app.add_subcommand("check", "read and check a case; run nothing");
  add_case(*check, options);
  check->add_option("--threads", options.threads, "threads of the run (default: all cores)")
      ->check(CLI::Range(1, 1024));
  check->callback([&] { code = check_command(options); });
  CLI::App* explain =
      app.add_subcommand("explain", "print every effect and the plan of a case, with reasons");
  add_case(*explain, options);
  explain->add_option("--threads", options.threads, "threads of the run (default: all cores)")
      ->check(CLI::Range(1, 1024));
  explain->callback([&] { code = explain_command(options); });
}

void add_bench(CLI::App& app, BenchOptions& options, int& code) {
  CLI::App* bench = app.add_subcommand("bench", "measure the rates of kernels on this machine");
  bench->add_option("name", options.name,
                    "only benchmarks whose name begins so; effects: what each effect adds");
  bench->add_flag("--json", options.json, "print JSON");
  bench->add_flag("--prices", options.prices, "bench effects: print lines of the price list");
  bench->add_option("--threads", options.threads, "number of threads (default: 1)");
  bench->callback([&] { code = bench_command(options); });
}

void add_render(CLI::App& app, RenderOptions& options, int& code) {
  CLI::App* render = app.add_subcommand("render", "draw pictures of a run, without a display");
  render->add_option("folder", options.folder, "output folder of a run, or its .pvd")->required();
  render->add_option("--frame", options.frame, "number of the frame, or last (default)");
  render->add_flag("--all", options.all, "draw every frame; --out is a folder then");
  render->add_option("--out", options.out, "the PNG file (default: RUN_FRAME.png here)");
  render->add_option("--colour,--color", options.colour,
                     "speed (default), pressure, plastic_strain, ... : any array of the files");
  render->add_option("--view", options.view,
                     "iso, x, y, z, or AZIMUTH,ELEVATION in degrees (default: iso; in 2D: z)");
  render->add_option("--size", options.size, "pixels (default: 1280x720)");
  render->add_option("--cut", options.cut, "leave out what is before this plane: \"y=0\"");
  render->add_option("--range", options.range, "LOW:HIGH of the colours, SI (default: all values)");
  render->add_option("--title", options.title, "text at the top (default: name of the run)");
  render->add_option("--opacity", options.opacity, "of faces (default: 1)")
      ->check(CLI::Range(0.0, 1.0));
  render->add_option("--threads", options.threads, "number of threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  render->callback([&] { code = render_command(options); });
}

void add_material(CLI::App& app, MaterialOptions& options, int& code) {
  CLI::App* material =
      app.add_subcommand("material", "stress over strain of a material, as elements answer");
  material->add_option("card", options.card, "a card of the library, or its file")->required();
  material
      ->add_option("--strain-path", options.path,
                   "uniaxial (default), biaxial, plane, uniaxial_strain or shear")
      ->check(CLI::IsMember({"uniaxial", "biaxial", "plane", "uniaxial_strain", "shear"}));
  material->add_option("--to", options.to, "strain at the end, or where it turns: 0.02,-0.02,0.2")
      ->delimiter(',');
  material->add_option("--rate", options.rates, "rate of the strain, a curve each: 1,1000 (1/s)")
      ->delimiter(',');
  material->add_option("--set", options.set, "override a key of the card: key=value");
  material->add_option("--element", options.element, "solid (default) or shell: plane stress")
      ->check(CLI::IsMember({"solid", "shell"}));
  material->add_option("--steps", options.steps, "steps between two turns (default: 400)")
      ->check(CLI::Range(1, 1000000));
  material->add_option("--csv", options.csv, "write the curves into this file");
  material->add_option("--svg", options.svg, "draw them into this file");
  material->callback([&] { code = material_command(options); });
}

void add_hard(CLI::App& app, HardOptions& options, int& code) {
  CLI::App* hard = app.add_subcommand("hard", "hold hard cases to their limits; stability maps");
  hard->add_option("name", options.names, "cases by name or file (default: all of the folder)");
  hard->add_option("--cases", options.folder, "folder of hard cases (default: tests/hard)");
  hard->add_flag("--long", options.long_form, "the long form of the cases");
  hard->add_option("--map", options.maps, "key=lowest..highest: stability over one or two keys");
  hard->add_option("--points", options.points, "values of each key of a map (default: 9)")
      ->check(CLI::Range(2, 1000));
  hard->add_option("--steps", options.steps, "steps of each run of a map (default: the case's)")
      ->check(CLI::Range(1, 1000000000));
  hard->add_option("--out", options.out, "the map's SVG (default: CASE_map.svg here)");
  hard->add_option("--threads", options.threads, "number of threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  hard->callback([&] { code = hard_command(options); });
}

void add_study(CLI::App& app, StudyOptions& options, int& code) {
  CLI::App* study = app.add_subcommand("study", "what accuracy costs: a case with many settings");
  study->add_option("file", options.file, "a study file, or a case")->required();
  study->add_option("--vary", options.vary,
                    "key=value,value: dx=8mm,4mm or xsph=on,off; whole keys, or their ends");
  study->add_option("--set", options.set, "a key in all runs: key.path=value (may be repeated)");
  study->add_option("--measure", options.measure,
                    "KIND:PROBE[:COLUMN][,from=..,until=..,percent=..,shift=..,scale=..,name=..]");
  study->add_option("--reference", options.reference,
                    "finest (default), richardson, a number, or FILE.csv");
  study->add_option("--budget", options.budget, "wall time to spend: 30min");
  study->add_option("--refine", options.refine, "the key along which results converge");
  study->add_option("--out", options.out, "folder of the results (default: beside the file)");
  study->add_option("--repeats", options.repeats, "runs of each setting")
      ->check(CLI::Range(1, 1000));
  study->add_option("--parallel", options.parallel, "runs side by side (default: 1)")
      ->check(CLI::Range(1, 1024));
  study->add_option("--threads", options.threads, "threads of each run (default: cores / parallel)")
      ->check(CLI::Range(1, 1024));
  study->add_flag("--dry", options.dry, "check and print the runs, make none");
  study->add_flag("--collect", options.collect, "make no run; show what those that are done say");
  study->add_option("--slurm", options.slurm,
                    "make no run; write those that are missing as a Slurm job array into DIR");
  study->callback([&] { code = study_command(options); });
}

int run_program(int argc, char** argv) {
  CLI::App app{"Gannet: an explicit hydrocode of finite elements and particles"};
  app.require_subcommand(1);
  const std::string revision_text = *revision() != '\0' ? fmt::format(" ({})", revision()) : "";
  app.set_version_flag("--version", fmt::format("gannet {}{}", version(), revision_text));
  RunOptions options;
  BenchOptions bench;
  RenderOptions render;
  MaterialOptions material;
  HardOptions hard;
  StudyOptions study;
  int code = 0;
  add_run(app, options, code);
  add_looks(app, options, code);
  add_bench(app, bench, code);
  add_render(app, render, code);
  add_material(app, material, code);
  add_hard(app, hard, code);
  add_study(app, study, code);
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
