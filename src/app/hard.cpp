// gannet hard: hard cases against their limits, and stability maps.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/commands.hpp"
#include "app/effects.hpp"
#include "app/simulation.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/units.hpp"
#include "input/language.hpp"
#include "study/hard_run.hpp"
#include "study/stability_map.hpp"
#include "study/study_short_keys.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

/// tests/hard here or in a folder above.
fs::path default_folder() {
  for (fs::path at = fs::current_path();; at = at.parent_path()) {
    if (fs::is_directory(at / "tests" / "hard")) return at / "tests" / "hard";
    if (at == at.parent_path()) break;
  }
  throw InputError(
      "there is no folder tests/hard here or above; name case files, or the folder with --cases");
}

std::vector<std::string> cases_in(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(fmt::format("there is no case in {}", folder.string()));
  return files;
}

/// The case files that the user named, by file or by name in the folder; all without names.
std::vector<std::string> chosen_cases(const HardOptions& options) {
  std::vector<std::string> files;
  for (const std::string& name : options.names) {
    if (fs::is_regular_file(name)) files.push_back(name);
  }
  if (files.size() == options.names.size() && !files.empty()) return files;
  const fs::path folder = options.folder.empty() ? default_folder() : fs::path(options.folder);
  if (options.names.empty()) return cases_in(folder);
  files.clear();
  for (const std::string& name : options.names) {
    const fs::path known = folder / (name + ".yaml");
    if (!fs::is_regular_file(name) && !fs::is_regular_file(known)) {
      throw InputError(fmt::format("there is no hard case '{}' in {}", name, folder.string()));
    }
    files.push_back(fs::is_regular_file(name) ? name : known.string());
  }
  return files;
}

HardBuilder builder_of(const std::string& file) {
  return [file](const std::vector<std::string>& overrides) {
    std::shared_ptr<Simulation> s = make_simulation(file, overrides);
    const Keys root = s->source->keys();
    return HardSubject{s, &s->scene, &s->models, root};
  };
}

/// Follows a dotted path through the values of the case; nullptr where it ends.
const Value* value_at(const Value& root, const std::vector<std::string>& path) {
  const Value* at = &root;
  for (const std::string& name : path) {
    const auto found = std::find_if(at->children.begin(), at->children.end(),
                                    [&](const Value& child) { return child.name == name; });
    if (found == at->children.end()) return nullptr;
    at = &*found;
  }
  return at;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// What a key has where nothing is set: the case's value, or the default of the language.
std::optional<double> standard_value(const Value& root, const std::string& key) {
  const std::vector<std::string> path = split(key);
  if (const Value* value = value_at(root, path)) {
    if (value->numbers.size() == 1) return value->numbers.front();
    return {};
  }
  const Key all = language(whole_schema());
  const Key* at = &all;
  for (const std::string& name : path) {
    at = find_key(*at, name);
    if (at == nullptr) return {};
  }
  if (at->kind != Kind::number || at->fallback.empty()) return {};
  try {
    return parse_quantity(at->fallback).value;
  } catch (const std::invalid_argument&) {
    return {};  // a word or a formula
  }
}

std::string map_file(const HardOptions& options, const std::string& case_name) {
  return options.out.empty() ? case_name + "_map.svg" : options.out;
}

int draw_map(const HardOptions& options) {
  if (options.names.size() != 1) throw InputError("--map: name the one case that the map is of");
  if (options.maps.size() > 2) throw InputError("--map: a map has one or two parameters");
  const std::string file = chosen_cases(options).front();
  const std::string name = fs::path(file).stem().string();
  const HardBuilder build = builder_of(file);
  const HardSubject standard = build({});
  std::vector<MapAxis> axes;
  for (const std::string& text : options.maps) {
    axes.push_back(read_map_axis(text));
    const auto* simulation = static_cast<const Simulation*>(standard.owner.get());
    const Value& root = simulation->source->root;
    try {
      axes.back().key = whole_key(axes.back().key, language(whole_schema()), root);
    } catch (const std::invalid_argument& e) {
      throw InputError(fmt::format("--map {}: {}", text, e.what()));
    }
    axes.back().standard = standard_value(root, axes.back().key);
  }
  const StabilityMap map =
      make_stability_map(name, build, axes, options.points, options.steps,
                         [](const std::string& line) { fmt::print("{}\n", line); });
  const std::string path = map_file(options, name);
  std::ofstream out(path);
  out << svg_of(map);
  if (!out.flush()) throw InputError(fmt::format("{} cannot be written", path));
  for (const std::string& line : margins_of(map)) fmt::print("{}\n", line);
  fmt::print("map: {}\n", path);
  return 0;
}

}  // namespace

int hard_command(const HardOptions& options) {
  set_threads(options.threads);
  if (!options.maps.empty()) return draw_map(options);
  int failed = 0;
  int runs = 0;
  fmt::print("{:<22} {:<24} {:<7} {:>8} {:>7}  margin of each limit, or what broke\n", "case",
             "start", "result", "steps", "s");
  for (const std::string& file : chosen_cases(options)) {
    const std::string name = fs::path(file).stem().string();
    const HardBuilder build = builder_of(file);
    run_hard_case(build, options.long_form, [&](const HardResult& result) {
      fmt::print("{}\n", result_line(name, result));
      std::fflush(stdout);
      ++runs;
      if (!result.passed) ++failed;
    });
  }
  fmt::print("{} runs, {} failed\n", runs, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace gannet
