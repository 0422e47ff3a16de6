#include "output/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/error.hpp"

namespace gannet {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view checkpoint_begin = "checkpoint_";
constexpr std::string_view checkpoint_end = ".h5";

/// The number in "checkpoint_001200.h5"; -1 for any other name.
long long checkpoint_number(const std::string& name) {
  if (!name.starts_with(checkpoint_begin) || !name.ends_with(checkpoint_end)) return -1;
  const char* begin = name.data() + checkpoint_begin.size();
  const char* end = name.data() + name.size() - checkpoint_end.size();
  long long number = -1;
  const auto read = std::from_chars(begin, end, number);
  return read.ec == std::errc() && read.ptr == end && begin != end ? number : -1;
}

void remove_files(const fs::path& folder, auto&& is_ours) {
  if (!fs::is_directory(folder)) return;
  std::vector<fs::path> ours;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_ours(entry.path())) ours.push_back(entry.path());
  }
  for (const fs::path& file : ours) fs::remove(file);
}

void remove_temporaries(const fs::path& folder) {
  const auto temporary = [](const fs::path& file) { return file.extension() == ".tmp"; };
  for (const fs::path& f : {folder, folder / "vtk", folder / "history"}) {
    remove_files(f, temporary);
  }
}

/// Removes what an earlier run wrote; indexes before what they name.
void remove_results(const fs::path& folder) {
  remove_files(folder, [](const fs::path& file) {
    return file.extension() == ".pvd" || file.filename() == "summary.json" ||
           file.filename() == "effects.csv" || checkpoint_number(file.filename().string()) >= 0;
  });
  remove_files(folder / "vtk", [](const fs::path& file) {
    return file.extension() == ".vtp" || file.extension() == ".vtu";
  });
  remove_files(folder / "history", [](const fs::path& file) { return file.extension() == ".csv"; });
  remove_temporaries(folder);
}

[[noreturn]] void refuse(const std::string& folder) {
  const std::string newest = newest_checkpoint(folder);
  std::string message =
      "the output folder is not empty; give --force to replace the results in it, or --out DIR "
      "to write elsewhere";
  if (!newest.empty()) message += ", or --restart " + newest + " to go on from its last checkpoint";
  throw InputError(Location{folder}, message);
}

}  // namespace

std::string case_name(const std::string& case_file) {
  const fs::path path = fs::absolute(case_file).lexically_normal();
  const std::string stem = path.stem().string();
  const std::string parent = path.parent_path().filename().string();
  return stem == "case" && !parent.empty() ? parent : stem;
}

std::string default_output_folder(const std::string& case_file) {
  return (fs::path(case_file).parent_path() / (case_name(case_file) + ".out")).string();
}

void prepare_output_folder(const std::string& folder, bool force, bool resuming) {
  std::error_code error;
  const fs::path path(folder);
  if (fs::exists(path) && !fs::is_directory(path)) {
    throw InputError(Location{folder}, "the output folder is a file; give --out DIR");
  }
  fs::create_directories(path, error);
  if (error) {
    throw InputError(Location{folder}, "cannot make the output folder: " + error.message());
  }
  remove_temporaries(path);
  if (!resuming && !fs::is_empty(path)) {
    if (!force) refuse(folder);
    remove_results(path);
  }
  fs::create_directories(path / "vtk", error);
  if (!error) fs::create_directories(path / "history", error);
  if (error) {
    throw InputError(Location{folder}, "cannot write to the output folder: " + error.message());
  }
}

std::string checkpoint_path(const std::string& folder, long long number) {
  return fmt::format("{}/{}{:06}{}", folder, checkpoint_begin, number, checkpoint_end);
}

std::vector<long long> checkpoints_in(const std::string& folder) {
  std::vector<long long> numbers;
  if (!fs::is_directory(folder)) return numbers;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const long long number = checkpoint_number(entry.path().filename().string());
    if (number >= 0) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string newest_checkpoint(const std::string& folder) {
  const std::vector<long long> numbers = checkpoints_in(folder);
  return numbers.empty() ? "" : checkpoint_path(folder, numbers.back());
}

}  // namespace gannet
