// Is what stands in an output folder whole? For tests that kill a run.
#pragma once

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gannet::test {

inline std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Counts the errors that a VTK object reports, instead of printing them.
class ErrorCount : public vtkCommand {
 public:
  static ErrorCount* New() { return new ErrorCount; }
  void Execute(vtkObject*, unsigned long, void*) override { ++n; }
  int n = 0;
};

/// What is wrong with the arrays of points or cells; empty: nothing.
inline std::string array_problem(vtkDataSetAttributes* data, vtkIdType n) {
  if (data->GetNumberOfArrays() == 0) return "no arrays";
  for (int k = 0; k < data->GetNumberOfArrays(); ++k) {
    const vtkDataArray* array = data->GetArray(k);
    if (array == nullptr || array->GetNumberOfTuples() != n) return "an array is cut off";
  }
  return "";
}

/// Reads a VTK file to its last number. Returns what is wrong with it; empty: nothing.
template <class Reader>
std::string vtk_problem(const std::string& path) {
  vtkNew<ErrorCount> errors;
  vtkNew<vtkXMLDataParser> parser;
  parser->AddObserver(vtkCommand::ErrorEvent, errors);
  parser->SetFileName(path.c_str());
  if (parser->Parse() != 1) return "not XML";
  vtkNew<Reader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->AddObserver(vtkCommand::WarningEvent, errors);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (errors->n > 0 || reader->GetErrorCode() != 0) return "VTK cannot read it";
  vtkDataSet* data = reader->GetOutput();
  if (data->GetNumberOfPoints() == 0 || data->GetNumberOfCells() == 0) return "empty";
  const std::string of_points = array_problem(data->GetPointData(), data->GetNumberOfPoints());
  const bool has_cell_data = data->GetCellData()->GetNumberOfArrays() > 0;
  return of_points.empty() && has_cell_data
             ? array_problem(data->GetCellData(), data->GetNumberOfCells())
             : of_points;
}

/// Parses a .pvd and looks for the files that it names.
inline std::string pvd_problem(const std::filesystem::path& path) {
  vtkNew<ErrorCount> errors;
  vtkNew<vtkXMLDataParser> parser;
  parser->AddObserver(vtkCommand::ErrorEvent, errors);
  parser->SetFileName(path.c_str());
  if (parser->Parse() != 1) return "not XML";
  vtkXMLDataElement* sets = parser->GetRootElement()->FindNestedElementWithName("Collection");
  if (sets == nullptr) return "no collection";
  for (int k = 0; k < sets->GetNumberOfNestedElements(); ++k) {
    const std::string file = sets->GetNestedElement(k)->GetAttribute("file");
    if (!std::filesystem::exists(path.parent_path() / file)) return "names " + file;
  }
  return "";
}

/// Commas that part columns, not those in quotes.
inline std::ptrdiff_t n_commas(std::string_view line) {
  bool quoted = false;
  std::ptrdiff_t n = 0;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++n;
  }
  return n;
}

/// Every line has the columns of the header; only the last may be cut off.
inline std::string csv_problem(const std::string& path) {
  const std::string text = bytes_of_file(path);
  std::ptrdiff_t columns = -1;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) return "";
    const auto n = n_commas(std::string_view(text).substr(begin, end - begin));
    if (columns < 0) columns = n;
    if (n != columns) return "a line has another number of columns";
    begin = end + 1;
  }
}

inline std::string json_problem(const std::string& path) {
  return nlohmann::json::accept(bytes_of_file(path)) ? "" : "not JSON";
}

/// A PNG begins with its signature and ends with its last chunk.
inline std::string png_problem(const std::string& path) {
  using namespace std::string_literals;
  const std::string bytes = bytes_of_file(path);
  const bool whole =
      bytes.starts_with("\x89PNG\r\n\x1a\n"s) && bytes.ends_with("\0\0\0\0IEND\xae\x42\x60\x82"s);
  return whole ? "" : "cut off";
}

/// What there was in an output folder.
struct FolderState {
  int n_files = 0;        ///< under final names
  int n_temporaries = 0;  ///< a kill fell into a write
  std::vector<std::string> problems;
};

/// Looks at every file under a final name. checkpoint_problem: says what is wrong with one.
inline FolderState look_into(
    const std::string& folder,
    const std::function<std::string(const std::string&)>& checkpoint_problem) {
  FolderState state;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string path = entry.path().string();
    const std::string ending = entry.path().extension().string();
    if (ending == ".tmp") {
      ++state.n_temporaries;
      continue;
    }
    ++state.n_files;
    std::string problem = "a file that no run writes";
    if (ending == ".vtp") problem = vtk_problem<vtkXMLPolyDataReader>(path);
    if (ending == ".vtu") problem = vtk_problem<vtkXMLUnstructuredGridReader>(path);
    if (ending == ".pvd") problem = pvd_problem(entry.path());
    if (ending == ".csv") problem = csv_problem(path);
    if (ending == ".png") problem = png_problem(path);
    if (ending == ".json") problem = json_problem(path);
    if (ending == ".h5") problem = checkpoint_problem(path);
    if (!problem.empty()) state.problems.push_back(path + ": " + problem);
  }
  return state;
}

}  // namespace gannet::test
