#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <catch2/catch.hpp>
#include <set>

#include "output/vtk_frame.hpp"
#include "output/vtk_series.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// Pool: 5 and 3 particles of 8 lie as 0 3 0 0 3 0 0 3.
const std::vector<Index> pool_particles{0, 2, 3, 5, 6};

template <class Reader>
void read(Reader& reader, const std::string& path) {
  reader.SetFileName(path.c_str());
  reader.Update();
  REQUIRE(reader.GetErrorCode() == 0);
}

double time_of(vtkDataObject& data) {
  auto* time = vtkDataArray::SafeDownCast(data.GetFieldData()->GetAbstractArray("TimeValue"));
  REQUIRE(time != nullptr);
  return time->GetTuple1(0);
}

/// Writes one frame in the middle of a step: after the kick, as in look.
void write_in_look(SmallScene& small, const std::string& folder) {
  small.record().folder = folder;
  small.record().name = "small";
  small.models.list.front().plan.add(
      {.name = "frame", .stage = Stage::look, .run = [&small](const Step&) {
         write_frame(small.scene, small.models, small.record());
       }});
}

}  // namespace

TEST_CASE("vtk: particles come back with points, arrays and ids bit for bit", "[output]") {
  const EmptyFolder folder("vtp");
  SmallScene small;
  Scene& scene = small.scene;
  for (std::size_t i = 0; i < scene.nodes.v.size(); ++i) {
    set_xyz(scene.nodes.v[i], {1.0 / 3 * static_cast<double>(i), 2, -3});
    set_xyz(scene.nodes.f[i], {4, 0, 8.0 * static_cast<double>(i)});
  }
  Step step;
  step.t = 0.125;
  step.dt = 0.5;
  write_vtk(scene, 0, step, folder.path + "/a.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  read(*reader, folder.path + "/a.vtp");
  vtkPolyData* data = reader->GetOutput();
  REQUIRE(data->GetNumberOfPoints() == 5);
  REQUIRE(data->GetNumberOfVerts() == 1);  // one poly-vertex cell over all points
  REQUIRE(data->GetNumberOfCells() == 1);
  CHECK(data->GetCell(0)->GetNumberOfPoints() == 5);
  CHECK(time_of(*data) == 0.125);

  vtkPointData* arrays = data->GetPointData();
  vtkDataArray* v = arrays->GetArray("Velocity");
  vtkDataArray* rho = arrays->GetArray("Density");
  vtkDataArray* p = arrays->GetArray("Pressure");
  vtkDataArray* ids = arrays->GetGlobalIds();
  REQUIRE(v != nullptr);
  REQUIRE(rho != nullptr);
  REQUIRE(p != nullptr);
  REQUIRE(ids != nullptr);
  CHECK(std::string(ids->GetName()) == "GlobalIds");
  CHECK(arrays->GetArray("Stress") == nullptr);
  for (int k = 0; k < 5; ++k) {
    const Index particle = pool_particles[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(scene.particles.begin + particle);
    double x[3];
    data->GetPoint(k, x);
    CHECK(Vec3(x[0], x[1], x[2]) == xyz(scene.nodes.x[i]));
    CHECK(rho->GetTuple1(k) == 1000.0 + particle);
    CHECK(p->GetTuple1(k) == 10.0 * particle);
    CHECK(static_cast<std::int64_t>(ids->GetTuple1(k)) == scene.nodes.id[i]);
    // v(n) = v(n+1/2) - f/m dt/2 with m = 2, dt = 0.5: z is -3 - 8 i / 2 * 0.25 = -3 - i.
    CHECK(v->GetComponent(k, 0) == 1.0 / 3 * static_cast<double>(i) - 0.5);
    CHECK(v->GetComponent(k, 1) == 2);
    CHECK(v->GetComponent(k, 2) == -3.0 - static_cast<double>(i));
  }
}

TEST_CASE("vtk: elements come back renumbered, with arrays of nodes and cells", "[output]") {
  const EmptyFolder folder("vtu");
  SmallScene small;
  Scene& scene = small.scene;
  Step step;
  step.t = 3;
  for (const int part : {1, 2}) {
    const Part& panel = scene.parts[static_cast<std::size_t>(part)];
    const std::string path = folder.path + "/" + std::to_string(part) + ".vtu";
    write_vtk(scene, part, step, path);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    read(*reader, path);
    vtkUnstructuredGrid* data = reader->GetOutput();
    REQUIRE(data->GetNumberOfPoints() == panel.nodes.size());
    REQUIRE(data->GetNumberOfCells() == panel.n_cells());
    CHECK(time_of(*data) == 3);
    const int n = nodes_per(panel.cell);
    for (int c = 0; c < panel.n_cells(); ++c) {
      CHECK(data->GetCellType(c) == (part == 1 ? VTK_QUAD : VTK_LINE));
      for (int a = 0; a < n; ++a) {
        const Index node = panel.connectivity[static_cast<std::size_t>(c * n + a)];
        double x[3];
        data->GetCell(c)->GetPoints()->GetPoint(a, x);
        CHECK(Vec3(x[0], x[1], x[2]) == xyz(scene.nodes.x[static_cast<std::size_t>(node)]));
      }
      CHECK(data->GetCellData()->GetGlobalIds()->GetTuple1(c) ==
            static_cast<double>(panel.cell_id[static_cast<std::size_t>(c)]));
    }
    CHECK(data->GetPointData()->GetGlobalIds() != nullptr);
    CHECK(data->GetPointData()->GetArray("Density") == nullptr);
    CHECK((data->GetCellData()->GetArray("Stress") != nullptr) == (part == 1));
  }
}

TEST_CASE("vtk: cell arrays are read through their layout, tensors have named components",
          "[output]") {
  const EmptyFolder folder("cells");
  SmallScene small;
  write_vtk(small.scene, 1, Step{}, folder.path + "/a.vtu");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(*reader, folder.path + "/a.vtu");
  vtkCellData* arrays = reader->GetOutput()->GetCellData();
  vtkDataArray* stress = arrays->GetArray("Stress");
  vtkDataArray* eps_p = arrays->GetArray("PlasticStrain");
  REQUIRE(stress != nullptr);
  REQUIRE(eps_p != nullptr);
  REQUIRE(stress->GetNumberOfComponents() == 6);
  REQUIRE(eps_p->GetNumberOfComponents() == 2);
  CHECK(std::string(stress->GetComponentName(3)) == "XY");
  CHECK(std::string(stress->GetComponentName(5)) == "XZ");
  for (int c = 0; c < 4; ++c) {
    for (int k = 0; k < 6; ++k) CHECK(stress->GetComponent(c, k) == 1e6 + 6 * c + k);
    CHECK(eps_p->GetComponent(c, 0) == 0.01 * c);
    CHECK(eps_p->GetComponent(c, 1) == 0.01 * (8 + c));
  }
}

TEST_CASE("vtk: a field is prepared before it is read", "[output]") {
  const EmptyFolder folder("prepare");
  SmallScene small;
  for (Field& f : small.scene.fields) {
    if (f.name == "panel.stress") f.prepare = [&small] { small.stress.assign(24, 7.0); };
  }
  write_vtk(small.scene, 1, Step{}, folder.path + "/a.vtu");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  read(*reader, folder.path + "/a.vtu");
  CHECK(reader->GetOutput()->GetCellData()->GetArray("Stress")->GetComponent(3, 5) == 7.0);
}

TEST_CASE("vtk: a part without particles is an empty, valid file", "[output]") {
  const EmptyFolder folder("empty");
  SmallScene small;
  for (Index& part : small.scene.particle_part) part = 0;
  write_vtk(small.scene, 3, Step{}, folder.path + "/a.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  read(*reader, folder.path + "/a.vtp");
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
}

TEST_CASE("pvd: after each frame it is valid and names every part with its true time", "[output]") {
  const EmptyFolder folder("pvd");
  SmallScene small;
  write_in_look(small, folder.path);
  std::vector<double> times;
  for (int step = 0; step < 4; ++step) {
    times.push_back(small.models.list.front().step.t);
    advance(small.models);
    vtkNew<vtkXMLDataParser> parser;
    parser->SetFileName((folder.path + "/small.pvd").c_str());
    REQUIRE(parser->Parse() == 1);
    vtkXMLDataElement* sets = parser->GetRootElement()->FindNestedElementWithName("Collection");
    REQUIRE(sets != nullptr);
    REQUIRE(sets->GetNumberOfNestedElements() == 4 * (step + 1));
    std::set<std::string> names;
    for (int k = 0; k < sets->GetNumberOfNestedElements(); ++k) {
      vtkXMLDataElement* set = sets->GetNestedElement(k);
      double t = -1;
      REQUIRE(set->GetScalarAttribute("timestep", t) == 1);
      CHECK(t == times[static_cast<std::size_t>(k / 4)]);
      names.insert(set->GetAttribute("name"));
      CHECK(fs::exists(folder.path + "/" + set->GetAttribute("file")));
    }
    CHECK(names == std::set<std::string>{"pool", "panel", "bars & more", "drop"});
  }
  CHECK(times.back() > 0);
}
