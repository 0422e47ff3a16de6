// gannet study: one case with several settings, and what accuracy costs.
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/effects.hpp"
#include "app/revision.hpp"
#include "app/simulation.hpp"
#include "base/units.hpp"
#include "input/language.hpp"
#include "input/resolved.hpp"
#include "output/folder.hpp"
#include "study/study_analysis.hpp"
#include "study/study_axes.hpp"
#include "study/study_file.hpp"
#include "study/study_plan.hpp"
#include "study/study_report.hpp"
#include "study/study_runs.hpp"
#include "study/study_short_keys.hpp"
#include "study/study_slurm.hpp"
#include "time/step.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

std::atomic<int> study_signal{0};

extern "C" void note_study_signal(int number) { study_signal = number; }

std::string short_version() {
  const std::string text = revision();
  return text.empty() ? version() : fmt::format("{} ({})", version(), text);
}

/// The version, and for a program built from changed files what it is made of: runs of another
/// build are not taken for this one's.
std::string version_of_program() {
  const std::string text = revision();
  const std::string full = short_version();
  if (!text.empty() && text.back() != '+') return full;
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return full + fmt::format(" {:08x}", fnv1a(bytes) & 0xffffffffU);
}

StudyRunSize size_of_run(const std::string& file, const std::vector<std::string>& set) {
  const auto simulation = make_simulation(file, set);
  StudyRunSize size;
  for (const Part& part : simulation->scene.parts) {
    if (part.is_particles()) {
      size.particles += static_cast<double>(part.nodes.size());
    } else {
      size.elements += static_cast<double>(part.n_cells());
    }
  }
  evaluate_start(simulation->models);
  size.dt = smallest_vote(simulation->models.list.back()).dt;
  size.until = simulation->source->keys().map("output").number("until");
  return size;
}

/// Reads one option of the command line; a mistake in it is one of the input.
template <typename F>
auto read_option(const std::string& option, const std::string& text, F read) {
  try {
    return read(text);
  } catch (const std::invalid_argument& e) {
    throw InputError(fmt::format("{} {}: {}", option, text, e.what()));
  }
}

double seconds_of(const std::string& text) {
  const Quantity q = parse_quantity(text);
  if ((!q.bare && q.dimension != dim::time) || !(q.value > 0)) {
    throw std::invalid_argument("a time above 0 is wanted (s, min, h)");
  }
  return q.value;
}

/// What the command line says wins over what a file says.
void apply_options(const StudyOptions& options, const Case& read, StudySpec& spec) {
  const Key keys = language(whole_schema());
  StudySpec asked;
  for (const std::string& text : options.vary) {
    asked.axes.push_back(read_option("--vary", text, parse_axis));
  }
  asked.set = options.set;
  asked.refine = options.refine;
  complete_keys(keys, read.root, spec);
  complete_keys(keys, read.root, asked);
  for (const StudyAxis& axis : asked.axes) {
    std::erase_if(spec.axes, [&](const StudyAxis& a) { return a.key == axis.key; });
    spec.axes.push_back(axis);
  }
  spec.set.insert(spec.set.end(), asked.set.begin(), asked.set.end());
  if (!asked.refine.empty()) spec.refine = asked.refine;
  if (!options.measure.empty()) spec.measures.clear();
  for (const std::string& text : options.measure) {
    spec.measures.push_back(read_option("--measure", text, parse_measure));
  }
  if (!options.reference.empty()) {
    spec.reference = read_option("--reference", options.reference, parse_reference);
  }
  if (!options.budget.empty()) spec.budget = read_option("--budget", options.budget, seconds_of);
  if (options.repeats > 0) spec.repeats = options.repeats;
  if (options.parallel > 0) spec.parallel = options.parallel;
  if (options.threads > 0) spec.threads = options.threads;
  spec.out = options.out;
  spec.collect = options.collect;
  if (spec.out.empty()) {
    const fs::path file = options.file;
    const std::string name = case_name(options.file) + ".study";
    spec.out = (file.has_parent_path() ? file.parent_path() / name : fs::path(name)).string();
  }
}

void check_spec(const StudySpec& spec) {
  std::vector<std::string> mistakes;
  if (spec.axes.empty()) {
    mistakes.emplace_back(
        "study: nothing is varied: --vary let.dx=8mm,4mm,2mm, or vary in the file");
  }
  if (spec.measures.empty()) {
    mistakes.emplace_back(
        "study: nothing is measured: --measure peak:PROBE, or measure in the file");
  }
  if (!mistakes.empty()) throw InputError(mistakes);
}

StudySpec spec_of(const StudyOptions& options) {
  const Schema schema = is_study_file(options.file) ? study_schema() : whole_schema();
  const auto read = read_case(options.file, schema);
  StudySpec spec = study_of(*read);
  read->mistakes.throw_if_any();
  const auto subject = read_case(spec.case_file, whole_schema());
  spec.title = subject->title;
  apply_options(options, *subject, spec);
  check_spec(spec);
  return spec;
}

void print_plan(const StudySpec& spec, const std::vector<StudyRun>& runs) {
  fmt::print("{}: {} runs{}{}; results in {}\n", spec.case_file, runs.size(),
             spec.refine.empty() ? "" : ", refined along " + spec.refine,
             std::isfinite(spec.budget) ? ", budget " + wall_text(spec.budget) : "", spec.out);
  for (const StudyRun& run : runs) {
    fmt::print("  {}: {:.0f} particles, {:.0f} elements, about {:.0f} steps\n",
               setting_text(spec.axes, run.choices), run.size.particles, run.size.elements,
               run.size.until / run.size.dt);
  }
}

int write_array(const StudyResult& result, const StudyProgram& program,
                const StudyOptions& options) {
  const JobArray array = write_job_array(result.spec, program, result.runs, options.slurm);
  if (array.n_runs == 0) {
    fmt::print("all runs are done; no job array was written\n");
    return 0;
  }
  fmt::print("{} runs are to be made: sbatch {}\n", array.n_runs, array.script);
  fmt::print("the same command with --collect instead of --slurm shows what is done so far\n");
  return 0;
}

}  // namespace

int study_command(const StudyOptions& options) {
  StudyResult result;
  result.spec = spec_of(options);
  result.version = version_of_program();
  const StudyProgram program{.version = result.version,
                             .short_version = short_version(),
                             .schema = whole_schema(),
                             .size = size_of_run};
  result.title = result.spec.title;
  result.runs = plan_runs(result.spec, program);
  print_plan(result.spec, result.runs);
  if (options.dry) return 0;
  if (!options.slurm.empty()) return write_array(result, program, options);
  std::signal(SIGINT, note_study_signal);
  std::signal(SIGTERM, note_study_signal);
  result.outcome = make_runs(result.spec, program, result.runs, study_signal);
  analyse(result);
  write_study(result);
  fmt::print("{}\n{}/study.html shows it in pictures\n", study_text(result), result.spec.out);
  if (result.outcome.stopped) {
    fmt::print(stderr, "stopped by a signal; the same command goes on\n");
    return 130;
  }
  if (result.outcome.out_of_budget) {
    fmt::print("the budget of {} ended the study before all runs were made\n",
               wall_text(result.spec.budget));
  }
  return 0;
}

}  // namespace gannet
