#include "study/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "input/case.hpp"
#include "input/resolved.hpp"
#include "study/study_axes.hpp"

namespace gannet {

namespace {

/// The same for the same results: the case without what only tells of it, and the program.
std::string hash_of(const Case& read, const std::string& version) {
  return fmt::format("{:016x}",
                     fnv1a(resolved_text(read.root, {"title", "study"}) + "\n" + version));
}

std::vector<std::string> all_overrides(const StudySpec& spec, const StudyRun& run) {
  std::vector<std::string> set = spec.set;
  const std::vector<std::string> chosen = overrides_of(spec.axes, run.choices);
  set.insert(set.end(), chosen.begin(), chosen.end());
  if (!spec.jitter_part.empty()) {
    const std::string fill = "parts." + spec.jitter_part + ".fill.";
    set.push_back(fmt::format("{}jitter={}", fill, spec.jitter));
    set.push_back(fmt::format("{}seed={}", fill, run.repeat + 1));
  }
  set.push_back("output.vtk=never");  // pictures are no part of what accuracy costs
  return set;
}

/// What the axes of one setting are in numbers: the size of each, where it has one.
struct AxisNumbers {
  double number = unknown;
  Dimension dimension;
};

AxisNumbers numbers_at(const Case& read, const std::string& key) {
  const Value* value = value_at(read.root, key);
  if (value == nullptr) return {};
  const Value& first =
      value->numbers.empty() && !value->children.empty() ? value->children.front() : *value;
  if (first.numbers.empty()) return {};
  return {first.numbers.front(), first.dimension};
}

using NumbersOfRun = std::vector<AxisNumbers>;  ///< one entry an axis

/// Size of each value of an axis by the value's text; empty where it is no resolution.
std::map<std::string, double> sizes_along(const StudySpec& spec, std::size_t axis, bool asked_for,
                                          const std::vector<StudyRun>& runs,
                                          const std::vector<NumbersOfRun>& numbers) {
  std::vector<std::string> names;
  std::vector<double> values;
  bool resolution = asked_for;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& choice = runs[i].choices[axis];
    if (std::find(names.begin(), names.end(), choice) != names.end()) continue;
    names.push_back(choice);
    values.push_back(numbers[i][axis].number);
    resolution = resolution || is_resolution(spec.axes[axis].key, numbers[i][axis].dimension);
  }
  std::map<std::string, double> sizes;
  const std::vector<double> found = sizes_of(values);
  if (!resolution || found.size() < 2) return sizes;
  for (std::size_t i = 0; i < names.size(); ++i) sizes[names[i]] = found[i];
  return sizes;
}

/// Finds the axis of refinement and gives every run its size along it.
void refine(StudySpec& spec, const std::vector<NumbersOfRun>& numbers,
            std::vector<StudyRun>& runs) {
  const std::string wanted = spec.refine;
  for (std::size_t axis = 0; axis < spec.axes.size(); ++axis) {
    const std::string& key = spec.axes[axis].key;
    if (!wanted.empty() && key != wanted) continue;
    const auto sizes = sizes_along(spec, axis, key == wanted, runs, numbers);
    if (sizes.empty()) continue;
    spec.refine = key;
    for (StudyRun& run : runs) run.h = sizes.at(run.choices[axis]);
    spec.refine_counts = std::all_of(numbers.begin(), numbers.end(), [axis](const NumbersOfRun& n) {
      return n[axis].number >= 1 && n[axis].number == std::floor(n[axis].number);
    });
    return;
  }
  if (wanted.empty()) return;
  throw InputError({"study.refine", 0, 0},
                   fmt::format("'{}' is not varied over different numbers above 0", wanted));
}

}  // namespace

std::vector<StudyRun> plan_runs(StudySpec& spec, const StudyProgram& program) {
  std::vector<StudyRun> runs;
  std::vector<NumbersOfRun> numbers;
  std::vector<std::string> mistakes;
  for (const std::vector<std::string>& choices : combinations(spec.axes)) {
    for (int repeat = 0; repeat < spec.repeats; ++repeat) {
      StudyRun run;
      run.choices = choices;
      run.repeat = repeat;
      run.set = all_overrides(spec, run);
      try {
        const auto read = read_case(spec.case_file, program.schema, run.set);
        // Repeats without another start differ in nothing but the time that they take.
        run.hash = hash_of(*read, program.version);
        if (repeat > 0 && spec.jitter_part.empty()) run.hash += fmt::format("_{}", repeat);
        run.folder = spec.out + "/runs/" + run.hash;
        run.size = program.size(spec.case_file, run.set);
        NumbersOfRun of_axes;
        for (const StudyAxis& axis : spec.axes) of_axes.push_back(numbers_at(*read, axis.key));
        numbers.push_back(of_axes);
        runs.push_back(run);
      } catch (const InputError& e) {
        mistakes.insert(mistakes.end(), e.messages().begin(), e.messages().end());
      }
    }
  }
  std::set<std::string> said;  // the same mistake in many settings is one mistake
  std::erase_if(mistakes, [&](const std::string& m) { return !said.insert(m).second; });
  if (!mistakes.empty()) throw InputError(mistakes);
  refine(spec, numbers, runs);
  std::stable_sort(runs.begin(), runs.end(), [](const StudyRun& a, const StudyRun& b) {
    return a.size.work() < b.size.work();
  });
  return runs;
}

double predict_wall(const std::vector<StudyRun>& runs, const StudyRun& next) {
  const StudyRun* large = nullptr;
  const StudyRun* small = nullptr;
  for (const StudyRun& run : runs) {  // by rising work
    if (run.state != StudyState::done || !(run.wall > 0) || !(run.size.work() > 0)) continue;
    if (large != nullptr && run.size.work() > 1.2 * large->size.work()) small = large;
    large = &run;
  }
  if (large == nullptr) return unknown;
  double exponent = 1;
  if (small != nullptr) {
    exponent = std::clamp(
        std::log(large->wall / small->wall) / std::log(large->size.work() / small->size.work()),
        0.7, 1.5);
  }
  return large->wall * std::pow(next.size.work() / large->size.work(), exponent);
}

}  // namespace gannet
