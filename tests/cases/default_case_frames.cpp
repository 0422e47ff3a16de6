// Every frame of the default case, read back with VTK's own readers.
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "support/temporary_folder.hpp"

using namespace gannet;

namespace {

struct Entry {
  double t;
  std::string part;
  std::string file;
};

std::vector<Entry> entries_of(const std::string& pvd) {
  std::ifstream in(pvd);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::regex form(R"re(<DataSet([^>]*)/>)re");
  const auto attribute = [](const std::string& of, const std::string& name) {
    std::smatch m;
    REQUIRE(std::regex_search(of, m, std::regex(name + "=\"([^\"]*)\"")));
    return m[1].str();
  };
  std::vector<Entry> entries;
  for (std::sregex_iterator it(text.begin(), text.end(), form), end; it != end; ++it) {
    const std::string a = (*it)[1];
    entries.push_back(
        {std::stod(attribute(a, "timestep")), attribute(a, "name"), attribute(a, "file")});
  }
  return entries;
}

template <class Reader>
auto read(const std::string& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  REQUIRE(reader->GetErrorCode() == 0);
  return vtkSmartPointer(reader->GetOutput());
}

/// An array that must be there, with that many components and only finite values; its range.
std::pair<double, double> range_of(vtkDataSetAttributes* data, const char* name, int components) {
  INFO(name);
  vtkDataArray* array = data->GetArray(name);
  REQUIRE(array != nullptr);
  REQUIRE(array->GetNumberOfComponents() == components);
  double lo = 1e300;
  double hi = -1e300;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    for (int c = 0; c < components; ++c) {
      const double v = array->GetComponent(i, c);
      REQUIRE(std::isfinite(v));
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  }
  return {lo, hi};
}

void check_ids(vtkDataSetAttributes* data, vtkIdType n) {
  vtkDataArray* ids = data->GetGlobalIds();
  REQUIRE(ids != nullptr);
  std::set<double> seen;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i) seen.insert(ids->GetComponent(i, 0));
  CHECK(static_cast<vtkIdType>(seen.size()) == n);
}

void check_pool(const std::string& path) {
  const auto pool = read<vtkXMLPolyDataReader>(path);
  const vtkIdType n = pool->GetNumberOfPoints();
  CHECK(n == 25 * 15 * 10);
  CHECK(pool->GetNumberOfCells() == 1);  // one poly-vertex
  const auto rho = range_of(pool->GetPointData(), "Density", 1);
  CHECK(rho.first > 900);
  CHECK(rho.second < 1100);
  const auto v = range_of(pool->GetPointData(), "Velocity", 3);
  CHECK(std::max(-v.first, v.second) < 60);  // three times the spray root's speed
  range_of(pool->GetPointData(), "Pressure", 1);
  check_ids(pool->GetPointData(), n);
  double box[6];
  pool->GetBounds(box);
  CHECK(box[0] > -0.5 - 0.02);  // half a spacing into the walls at most
  CHECK(box[1] < 0.5 + 0.02);
  CHECK(box[4] > -0.4 - 0.02);
}

void check_panel(const std::string& path) {
  const auto panel = read<vtkXMLUnstructuredGridReader>(path);
  CHECK(panel->GetNumberOfPoints() == 31 * 21);
  CHECK(panel->GetNumberOfCells() == 30 * 20);
  range_of(panel->GetPointData(), "Velocity", 3);
  check_ids(panel->GetPointData(), panel->GetNumberOfPoints());
  range_of(panel->GetCellData(), "Stress", 6);
  const auto eps_p = range_of(panel->GetCellData(), "PlasticStrain", 1);
  CHECK(eps_p.first >= 0);
  CHECK(eps_p.second < 0.2);
  const auto t = range_of(panel->GetCellData(), "Thickness", 1);
  CHECK(t.first == Approx(3e-3));
  CHECK(t.second == Approx(3e-3));
}

}  // namespace

TEST_CASE("panel_slam: every frame reads back with VTK: arrays, ranges, times", "[case]") {
  const TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  RunOptions options;
  options.case_file = "cases/panel_slam/case.yaml";
  options.set = {"let.dx=40 mm"};
  options.until = "5 ms";
  options.out = out;
  REQUIRE(run_command(options) == 0);

  const std::vector<Entry> entries = entries_of(out + "/panel_slam.pvd");
  REQUIRE(entries.size() == 2 * 11);  // two parts, a frame every 0.5 ms and one at the start
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Entry& e = entries[k];
    INFO(e.file);
    // Written at the first level at or past its time: at most a step (5 us) late.
    const double due = 0.5e-3 * static_cast<double>(k / 2);
    CHECK(e.t >= due);
    CHECK(e.t < due + 1e-5);
    if (e.part == "pool") {
      check_pool(out + "/" + e.file);
    } else {
      REQUIRE(e.part == "panel");
      check_panel(out + "/" + e.file);
    }
  }
}
