#include "output/picture_data.hpp"

#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.hpp"

namespace gannet {

namespace fs = std::filesystem;

namespace {

/// "PlasticStrain" and "plastic_strain": "plasticstrain".
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return out;
}

fs::path pvd_in(const std::string& path) {
  if (fs::is_regular_file(path)) return path;
  if (!fs::is_directory(path)) {
    throw InputError({path + ": is not a folder that a run has written, nor a .pvd file"});
  }
  std::set<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".pvd") found.insert(entry.path());
  }
  if (found.size() == 1) return *found.begin();
  throw InputError(
      {path + (found.empty() ? ": holds no .pvd file; is it the output folder of a run?"
                             : ": holds several .pvd files; name one of them")});
}

std::string attribute(vtkXMLDataElement& element, const char* name) {
  const char* value = element.GetAttribute(name);
  return value == nullptr ? "" : value;
}

vtkSmartPointer<vtkPointSet> read_points(const std::string& path) {
  const auto read = [&](auto reader) {
    reader->SetFileName(path.c_str());
    reader->Update();
    if (!fs::exists(path) || reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr) {
      throw InputError({path + ": cannot be read as a VTK file"});
    }
    return vtkSmartPointer<vtkPointSet>(reader->GetOutput());
  };
  if (!fs::exists(path)) throw InputError({path + ": is named by the .pvd, but is not there"});
  if (path.ends_with(".vtp")) return read(vtkSmartPointer<vtkXMLPolyDataReader>::New());
  return read(vtkSmartPointer<vtkXMLUnstructuredGridReader>::New());
}

void add_piece(DrawnPart& part, vtkCell& cell, Index number) {
  DrawnPart::Piece piece{.corners = {}, .cell = number};
  for (vtkIdType k = 0; k < cell.GetNumberOfPoints(); ++k) {
    piece.corners.push_back(static_cast<Index>(cell.GetPointId(k)));
  }
  part.pieces.push_back(std::move(piece));
}

void add_pieces(DrawnPart& part, vtkPointSet& data) {
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    vtkCell* cell = data.GetCell(c);
    const auto number = static_cast<Index>(c);
    if (cell->GetCellDimension() == 3) {
      for (int f = 0; f < cell->GetNumberOfFaces(); ++f) add_piece(part, *cell->GetFace(f), number);
    } else if (cell->GetCellDimension() > 0) {
      add_piece(part, *cell, number);
    }
  }
}

vtkDataArray* array_named(vtkDataSetAttributes& attributes, const std::string& name) {
  for (int k = 0; k < attributes.GetNumberOfArrays(); ++k) {
    vtkDataArray* array = attributes.GetArray(k);
    if (array != nullptr && array->GetName() != nullptr && plain(array->GetName()) == name) {
      return array;
    }
  }
  return nullptr;
}

double one_number(const std::array<double, 9>& v, int components) {
  if (components == 1) return v[0];
  if (components == 6) {
    const double direct = (v[0] - v[1]) * (v[0] - v[1]) + (v[1] - v[2]) * (v[1] - v[2]) +
                          (v[2] - v[0]) * (v[2] - v[0]);
    return std::sqrt(direct / 2 + 3 * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]));
  }
  double sum = 0;
  for (int c = 0; c < components; ++c)
    sum += v[static_cast<std::size_t>(c)] * v[static_cast<std::size_t>(c)];
  return std::sqrt(sum);
}

std::vector<double> numbers_of(vtkDataArray& array) {
  std::vector<double> numbers;
  const int components = array.GetNumberOfComponents();
  if (components > 9) return numbers;
  numbers.reserve(static_cast<std::size_t>(array.GetNumberOfTuples()));
  std::array<double, 9> tuple{};
  for (vtkIdType k = 0; k < array.GetNumberOfTuples(); ++k) {
    array.GetTuple(k, tuple.data());
    numbers.push_back(one_number(tuple, components));
  }
  return numbers;
}

/// Values of cells, from those of points: the mean over the points of the cell's pieces.
std::vector<double> means_over_cells(const DrawnPart& part, const std::vector<double>& of_points,
                                     std::size_t n_cells) {
  std::vector<double> sum(n_cells, 0);
  std::vector<double> n(n_cells, 0);
  for (const DrawnPart::Piece& piece : part.pieces) {
    for (const Index point : piece.corners) {
      sum[static_cast<std::size_t>(piece.cell)] += of_points[static_cast<std::size_t>(point)];
      n[static_cast<std::size_t>(piece.cell)] += 1;
    }
  }
  for (std::size_t c = 0; c < n_cells; ++c) sum[c] /= std::max(n[c], 1.0);
  return sum;
}

void collect_names(vtkDataSetAttributes& attributes, std::set<std::string>& names) {
  for (int k = 0; k < attributes.GetNumberOfArrays(); ++k) {
    if (attributes.GetArrayName(k) != nullptr) names.insert(attributes.GetArrayName(k));
  }
}

DrawnPart read_part(const std::string& path, const std::string& name, const Shown& shown,
                    std::set<std::string>& names) {
  const auto data = read_points(path);
  DrawnPart part;
  part.name = name;
  part.particles = path.ends_with(".vtp");
  part.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    data->GetPoint(static_cast<vtkIdType>(i), part.points[i].data());
  }
  if (!part.particles) add_pieces(part, *data);
  vtkDataArray* of_points = array_named(*data->GetPointData(), shown.array);
  vtkDataArray* of_cells = array_named(*data->GetCellData(), shown.array);
  if (part.particles && of_points != nullptr) part.values = numbers_of(*of_points);
  if (!part.particles && of_cells != nullptr) {
    part.values = numbers_of(*of_cells);
  } else if (!part.particles && of_points != nullptr) {
    part.values = means_over_cells(part, numbers_of(*of_points),
                                   static_cast<std::size_t>(data->GetNumberOfCells()));
  }
  collect_names(*data->GetPointData(), names);
  collect_names(*data->GetCellData(), names);
  return part;
}

}  // namespace

Series read_series(const std::string& path) {
  const fs::path pvd = pvd_in(path);
  vtkNew<vtkXMLDataParser> parser;
  parser->SetFileName(pvd.c_str());
  // VTK would print its own complaint beside the one below.
  const int warns = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);
  const bool parsed = parser->Parse() != 0 && parser->GetRootElement() != nullptr;
  vtkObject::SetGlobalWarningDisplay(warns);
  vtkXMLDataElement* list =
      parsed ? parser->GetRootElement()->FindNestedElementWithName("Collection") : nullptr;
  if (list == nullptr) throw InputError({pvd.string() + ": cannot be read as a .pvd file"});
  Series series{.name = pvd.stem().string(), .folder = pvd.parent_path().string(), .frames = {}};
  for (int k = 0; k < list->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& data = *list->GetNestedElement(k);
    double t = 0;
    data.GetScalarAttribute("timestep", t);
    if (series.frames.empty() || series.frames.back().t != t) {
      series.frames.push_back(
          {.number = static_cast<int>(series.frames.size()), .t = t, .files = {}});
    }
    series.frames.back().files.push_back({attribute(data, "name"), attribute(data, "file")});
  }
  if (series.frames.empty()) throw InputError({pvd.string() + ": names no frame"});
  return series;
}

Shown shown_quantity(const std::string& name) {
  static constexpr std::array<std::array<const char*, 3>, 9> known{
      {{"speed", "velocity", "m/s"},
       {"velocity", "velocity", "m/s"},
       {"pressure", "pressure", "Pa"},
       {"density", "density", "kg/m^3"},
       {"stress", "stress", "Pa"},
       {"thickness", "thickness", "m"},
       {"smoothing length", "", "m"},
       {"plastic strain", "", ""},
       {"part", "", ""}}};
  for (const auto& [label, array, unit] : known) {
    if (plain(label) != plain(name)) continue;
    return {label, *array == '\0' ? plain(label) : array, unit};
  }
  return {name, plain(name), ""};
}

DrawnFrame read_frame(const Series& series, const Frame& frame, const Shown& shown) {
  DrawnFrame drawn{.t = frame.t, .parts = {}};
  std::set<std::string> names;
  bool found = false;
  for (const Frame::File& file : frame.files) {
    const std::string path = (fs::path(series.folder) / file.path).string();
    drawn.parts.push_back(read_part(path, file.part, shown, names));
    found |= !drawn.parts.back().values.empty();
  }
  if (!found) {
    throw InputError({fmt::format("--colour {}: no part has this quantity; there is: speed, {}",
                                  shown.label, fmt::join(names, ", "))});
  }
  return drawn;
}

}  // namespace gannet
