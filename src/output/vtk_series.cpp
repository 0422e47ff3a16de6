#include "output/vtk_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "output/files.hpp"
#include "output/vtk_frame.hpp"
#include "plan/model_of_part.hpp"

namespace gannet {

namespace fs = std::filesystem;

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Safe and unique: where another name was changed into the same, the part's number is added.
std::string file_stem(const Scene& scene, std::size_t part) {
  const std::string& name = scene.parts[part].name;
  const std::string safe = file_name_of(name);
  return safe == name ? safe : fmt::format("{}-{}", safe, part);
}

void write_pvd(RunRecord& record) {
  const std::string path = pvd_path(record);
  write_whole_file(path, pvd_text(record));
  auto& waiting = record.output.not_on_disk;
  if (std::find(waiting.begin(), waiting.end(), path) == waiting.end()) waiting.push_back(path);
}

bool all_there(const Frame& frame, const std::string& folder) {
  return std::all_of(frame.files.begin(), frame.files.end(), [&](const Frame::File& file) {
    return fs::exists(fs::path(folder) / file.path);
  });
}

}  // namespace

std::string pvd_path(const RunRecord& record) {
  return record.folder + "/" + file_name_of(record.name.empty() ? "frames" : record.name) + ".pvd";
}

std::string pvd_text(const RunRecord& record) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const Frame& frame : record.output.frames) {
    int number = 0;
    for (const Frame::File& file : frame.files) {
      text += fmt::format(
          "    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
          frame.t, number++, escaped(file.part), escaped(file.path));
    }
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

void write_frame(const Scene& scene, Models& models, RunRecord& record) {
  const auto& frames = record.output.frames;
  const int number = frames.empty() ? 0 : frames.back().number + 1;
  Frame frame{number, models.list.front().step.t, {}};
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const Part& part = scene.parts[p];
    const auto k = static_cast<int>(p);
    const std::string path =
        fmt::format("vtk/{}_{:06}.{}", file_stem(scene, p), number, vtk_extension(part));
    const std::string whole = record.folder + "/" + path;
    write_vtk(scene, k, model_of_part(scene, models, k).step, whole);
    record.output.not_on_disk.push_back(whole);
    frame.files.push_back({part.name, path});
  }
  record.output.frames.push_back(std::move(frame));
  write_pvd(record);
}

void rewind_frames(RunRecord& record) {
  auto& frames = record.output.frames;
  std::set<fs::path> keep;
  for (const Frame& frame : frames) {
    if (!all_there(frame, record.folder)) continue;
    for (const Frame::File& file : frame.files) keep.insert(fs::path(file.path).filename());
  }
  std::erase_if(frames, [&](const Frame& f) { return !all_there(f, record.folder); });
  write_pvd(record);
  const fs::path folder = fs::path(record.folder) / "vtk";
  std::vector<fs::path> later;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool frame = file.extension() == ".vtp" || file.extension() == ".vtu";
    if (frame && !keep.contains(file.filename())) later.push_back(file);
  }
  for (const fs::path& file : later) fs::remove(file);
}

}  // namespace gannet
