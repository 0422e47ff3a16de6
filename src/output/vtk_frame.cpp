#include "output/vtk_frame.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "base/parallel.hpp"
#include "output/files.hpp"

namespace gannet {

namespace {

constexpr const char* ids_name = "GlobalIds";

/// Entries of a field that a part shows: `base` as it is now, and the index of each.
struct Selection {
  const Field& field;
  const std::vector<Index>& entries;
};

/// Copies the entries of a field into a VTK array of the same type.
template <class VtkArray, class T>
vtkSmartPointer<vtkDataArray> copy_entries(const Selection& from) {
  const Field& f = from.field;
  const auto n = static_cast<Index>(from.entries.size());
  auto array = vtkSmartPointer<VtkArray>::New();
  array->SetNumberOfComponents(f.components);
  array->SetNumberOfTuples(n);
  if (n == 0) return array;
  auto* to = reinterpret_cast<std::byte*>(array->GetPointer(0));
  const std::byte* base = f.base();
  const Layout& l = f.layout;
  parallel_for(n, node_chunk, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Index e = from.entries[static_cast<std::size_t>(k)];
      const std::byte* at = base + (e / l.lanes) * l.block_stride + (e % l.lanes) * l.entry_stride;
      std::byte* tuple = to + static_cast<std::size_t>(k) * f.components * sizeof(T);
      for (int c = 0; c < f.components; ++c) {
        std::memcpy(tuple + c * sizeof(T), at + c * l.component_stride, sizeof(T));
      }
    }
  });
  return array;
}

vtkSmartPointer<vtkDataArray> array_of(const Selection& from) {
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t));
  switch (from.field.type) {
    case Type::f64:
      return copy_entries<vtkDoubleArray, double>(from);
    case Type::i32:
      return copy_entries<vtkIntArray, std::int32_t>(from);
    case Type::i64:
      return copy_entries<vtkIdTypeArray, std::int64_t>(from);
    case Type::u8:
      return copy_entries<vtkUnsignedCharArray, std::uint8_t>(from);
  }
  throw std::logic_error("field " + from.field.name + " has no type");
}

/// Replaces lines at n+1/2 by lines at n: u - (load w) dt/2, w the inverse mass or inertia beside
/// u.
vtkSmartPointer<vtkDataArray> rates_at_level(const Array<Line>& u, const Array<Line>& load,
                                             const std::vector<Index>& nodes, double dt) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto i = static_cast<std::size_t>(nodes[k]);
    const double s = 0.5 * dt * u[i].w;
    const double value[3] = {u[i].x - s * load[i].x, u[i].y - s * load[i].y,
                             u[i].z - s * load[i].z};
    array->SetTypedTuple(static_cast<vtkIdType>(k), value);
  }
  return array;
}

void name_array(vtkDataArray& array, const Field& field) {
  static const char* const tensor[6] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  array.SetName(field.vtk.c_str());
  if (field.components != 6) return;
  for (int c = 0; c < 6; ++c) array.SetComponentName(c, tensor[c]);
}

void add_array(vtkDataSetAttributes& to, const Field& field, vtkDataArray& array) {
  name_array(array, field);
  if (field.vtk == ids_name && field.type == Type::i64) {
    to.SetGlobalIds(&array);
  } else {
    to.AddArray(&array);
  }
}

/// What of the scene a part shows.
struct View {
  const Scene& scene;
  int part = 0;
  const Step& step;
  std::vector<Index> nodes;      ///< its nodes, in the node table
  std::vector<Index> particles;  ///< the same from scene.particles.begin, where it has particles
};

View view_of(const Scene& scene, int part, const Step& step) {
  View view{scene, part, step, {}, {}};
  const Part& p = scene.parts[static_cast<std::size_t>(part)];
  if (!p.is_particles()) {
    view.nodes.resize(static_cast<std::size_t>(p.nodes.size()));
    std::iota(view.nodes.begin(), view.nodes.end(), p.nodes.begin);
    return view;
  }
  for (Index k = 0; k < scene.particles.size(); ++k) {
    if (scene.particle_part[static_cast<std::size_t>(k)] != part) continue;
    view.particles.push_back(k);
    view.nodes.push_back(scene.particles.begin + k);
  }
  return view;
}

/// The entries have to exist: a field of rotating nodes ends before the others.
bool covers(const Field& field, const std::vector<Index>& entries) {
  return entries.empty() || entries.back() < field.count();
}

void add_node_field(const View& view, const Field& field, vtkDataSetAttributes& to) {
  const Nodes& n = view.scene.nodes;
  if (!covers(field, view.nodes)) return;
  vtkSmartPointer<vtkDataArray> array;
  if (field.name == "v") {
    array = rates_at_level(n.v, n.f, view.nodes, view.step.dt);
  } else if (field.name == "omega") {
    array = rates_at_level(n.omega, n.torque, view.nodes, view.step.dt);
  } else {
    array = array_of({field, view.nodes});
  }
  add_array(to, field, *array);
}

void add_point_fields(const View& view, vtkPointData& to) {
  for (const Field& f : view.scene.fields) {
    if (f.vtk.empty()) continue;
    if (f.over == Over::nodes || f.name == "omega") {
      if (f.prepare) f.prepare();
      add_node_field(view, f, to);
    } else if (f.over == Over::particles && !view.particles.empty() && covers(f, view.particles)) {
      if (f.prepare) f.prepare();
      add_array(to, f, *array_of({f, view.particles}));
    }
  }
}

void add_cell_fields(const View& view, vtkCellData& to) {
  const Part& part = view.scene.parts[static_cast<std::size_t>(view.part)];
  std::vector<Index> cells(static_cast<std::size_t>(part.n_cells()));
  std::iota(cells.begin(), cells.end(), 0);
  for (const Field& f : view.scene.fields) {
    if (f.vtk.empty() || f.over != Over::cells || f.part != view.part) continue;
    if (f.prepare) f.prepare();
    if (covers(f, cells)) add_array(to, f, *array_of({f, cells}));
  }
  if (part.cell_id.size() != cells.size()) return;
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(ids_name);
  ids->SetNumberOfTuples(static_cast<vtkIdType>(cells.size()));
  std::copy(part.cell_id.begin(), part.cell_id.end(), ids->GetPointer(0));
  to.SetGlobalIds(ids);
}

vtkSmartPointer<vtkPoints> points_of(const View& view) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(view.nodes.size()));
  for (std::size_t k = 0; k < view.nodes.size(); ++k) {
    const Line& x = view.scene.nodes.x[static_cast<std::size_t>(view.nodes[k])];
    points->SetPoint(static_cast<vtkIdType>(k), x.x, x.y, x.z);
  }
  return points;
}

void add_time(vtkDataObject& data, double t) {
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(t);
  data.GetFieldData()->AddArray(time);
}

/// Frames below this go to the disk in one piece. VTK flushes after every element of XML, some 190
/// times a frame, which is most of the time of a small one; a large one takes twice the time by way
/// of a string.
constexpr unsigned long in_one_piece = 1024;  // KiB, as VTK measures

template <class Writer>
void write_data(vtkDataObject& data, const std::string& path) {
  const std::string temporary = temporary_beside(path);
  const bool small = data.GetActualMemorySize() < in_one_piece;
  vtkNew<Writer> writer;
  writer->SetInputDataObject(&data);
  writer->SetWriteToOutputString(small);
  if (!small) writer->SetFileName(temporary.c_str());
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToLZ4();
  writer->SetHeaderTypeToUInt64();
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) {
    throw std::runtime_error(path + ": cannot write the frame (is the disk full?)");
  }
  if (small) return write_whole_file(path, writer->GetOutputString(), Durable::no);
  rename_whole_file(temporary, path, Durable::no);
}

void write_particles(const View& view, const std::string& path) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(view));
  vtkNew<vtkCellArray> cells;
  const auto n = static_cast<vtkIdType>(view.nodes.size());
  if (n > 0) {
    std::vector<vtkIdType> all(view.nodes.size());
    std::iota(all.begin(), all.end(), vtkIdType{0});
    cells->InsertNextCell(n, all.data());
  }
  data->SetVerts(cells);
  add_point_fields(view, *data->GetPointData());
  add_time(*data, view.step.t);
  write_data<vtkXMLPolyDataWriter>(*data, path);
}

int vtk_cell_type(Cell cell) {
  switch (cell) {
    case Cell::point:
      return VTK_VERTEX;
    case Cell::line:
      return VTK_LINE;
    case Cell::triangle:
      return VTK_TRIANGLE;
    case Cell::quad:
      return VTK_QUAD;
    case Cell::tetrahedron:
      return VTK_TETRA;
    case Cell::hexahedron:
      return VTK_HEXAHEDRON;
    case Cell::none:
      break;
  }
  throw std::logic_error("particles have no cells");
}

void write_elements(const View& view, const std::string& path) {
  const Part& part = view.scene.parts[static_cast<std::size_t>(view.part)];
  vtkNew<vtkUnstructuredGrid> data;
  data->SetPoints(points_of(view));
  vtkNew<vtkCellArray> cells;
  const auto n = static_cast<std::size_t>(nodes_per(part.cell));
  std::vector<vtkIdType> corners(n);
  for (std::size_t k = 0; k < part.connectivity.size(); k += n) {
    for (std::size_t a = 0; a < n; ++a) {
      corners[a] = part.connectivity[k + a] - part.nodes.begin;
    }
    cells->InsertNextCell(static_cast<vtkIdType>(n), corners.data());
  }
  data->SetCells(vtk_cell_type(part.cell), cells);
  add_point_fields(view, *data->GetPointData());
  add_cell_fields(view, *data->GetCellData());
  add_time(*data, view.step.t);
  write_data<vtkXMLUnstructuredGridWriter>(*data, path);
}

}  // namespace

const char* vtk_extension(const Part& part) { return part.is_particles() ? "vtp" : "vtu"; }

void write_vtk(const Scene& scene, int part, const Step& step, const std::string& path) {
  const View view = view_of(scene, part, step);
  const bool particles = scene.parts[static_cast<std::size_t>(part)].is_particles();
  if (particles) {
    write_particles(view, path);
  } else {
    write_elements(view, path);
  }
}

}  // namespace gannet
