#include "mesh/msh_file.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "case_values.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

const std::string data = "tests/unit/mesh/data/";

std::string content(const std::string& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// What the reader says of the good file after `old_text` in it has become `new_text`.
std::string answer(const std::string& file, const std::string& old_text,
                   const std::string& new_text, const std::string& group = "") {
  std::string text = content(data + file);
  const std::size_t at = text.find(old_text);
  REQUIRE(at != std::string::npos);
  text.replace(at, old_text.size(), new_text);
  const auto folder = std::filesystem::temp_directory_path() /
                      ("gannet_msh_" + std::to_string(std::hash<std::string>{}(text)));
  std::filesystem::create_directories(folder);
  const std::string broken = (folder / "broken.msh").string();
  std::ofstream(broken) << text;
  Mistakes mistakes;
  CHECK(read_msh(broken, group, mistakes).empty());
  std::filesystem::remove_all(folder);
  const std::string said = messages(mistakes);
  return said.starts_with(broken) ? said.substr(broken.size()) : said;
}

}  // namespace

TEST_CASE("msh: cells of all surfaces, points that they use, triangles end twice", "[mesh]") {
  const std::vector<Vec3> points = {{0, 0, 0},   {100, 0, 0},   {100, 100, 0}, {0, 100, 0},
                                    {200, 0, 0}, {200, 100, 0}, {300, 50, 25}};
  const std::vector<Index> quads = {0, 1, 2, 3, 1, 4, 5, 2, 4, 6, 5, 5};
  for (const std::string file : {"panel_41.msh", "panel_22.msh"}) {
    Mistakes mistakes;
    const SurfaceMesh mesh = read_msh(data + file, "", mistakes);
    CHECK(messages(mistakes).empty());
    CHECK(mesh.points == points);
    CHECK(mesh.quads == quads);
  }
}

TEST_CASE("msh: one physical surface by its name, whatever its sense", "[mesh]") {
  for (const std::string file : {"panel_41.msh", "panel_22.msh"}) {
    Mistakes mistakes;
    CHECK(read_msh(data + file, "skin", mistakes).quads ==
          std::vector<Index>{0, 1, 2, 3, 1, 4, 5, 2});
    const SurfaceMesh tip = read_msh(data + file, "nose tip", mistakes);
    CHECK(tip.quads == std::vector<Index>{0, 1, 2, 2});
    CHECK(tip.points.size() == 3);
    CHECK(mistakes.empty());
  }
}

TEST_CASE("mesh of a part: unit and move of the case are applied", "[mesh]") {
  const Value asked = part({map("mesh", {word("file", data + "panel_41.msh"), word("unit", "mm"),
                                         word("group", "nose tip"), numbers("move", {0, 0, -1})})});
  Mistakes mistakes;
  const SurfaceMesh mesh = surface_mesh(Keys(asked, mistakes));
  REQUIRE(mesh.points.size() == 3);
  CHECK((mesh.points[1] - Vec3(0.3, 0.05, -0.975)).norm() < 1e-15);
  CHECK(mistakes.empty());
}

TEST_CASE("msh: hexahedra and tetrahedra of a physical volume", "[mesh]") {
  for (const std::string file : {"block_41.msh", "block_22.msh"}) {
    Mistakes mistakes;
    const VolumeMesh core = read_msh_volume(data + file, "core", mistakes);
    CHECK(core.nodes_per_cell == 8);
    CHECK(core.cells == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7});
    CHECK(core.points[6] == Vec3(1, 1, 1));
    const VolumeMesh cap = read_msh_volume(data + file, "cap", mistakes);
    CHECK(cap.nodes_per_cell == 4);
    CHECK(cap.cells == std::vector<Index>{0, 1, 2, 3, 0, 2, 4, 3});
    CHECK(cap.points[3] == Vec3(0.5, 0.5, 2));
    CHECK(messages(mistakes).empty());
    CHECK(read_msh_volume(data + file, "", mistakes).empty());
    CHECK(
        messages(mistakes).find("tetrahedra and hexahedra stand in one part; take a part for each "
                                "by its 'group'") != std::string::npos);
    Mistakes none;
    CHECK(read_msh_volume(data + file, "foot", none).empty());
    CHECK(
        messages(none).find("no volume cell belongs to the group 'foot'; physical volumes of this "
                            "file: cap, core") != std::string::npos);
    Mistakes of_surface;
    CHECK(read_msh(data + file, "foot", of_surface).quads.size() == 4);
    CHECK(messages(of_surface).empty());
  }
  Mistakes mistakes;
  CHECK(read_msh_volume(data + "panel_41.msh", "", mistakes).empty());
  CHECK(messages(mistakes).find("the file holds no tetrahedra and no hexahedra") !=
        std::string::npos);
}

TEST_CASE("msh: lines that meet, of a physical curve", "[mesh]") {
  for (const std::string file : {"frame_41.msh", "frame_22.msh"}) {
    Mistakes mistakes;
    const LineMesh legs = read_msh_lines(data + file, "legs", mistakes);
    CHECK(messages(mistakes).empty());
    CHECK(legs.cells == std::vector<Index>{0, 1, 2, 1});
    CHECK(legs.points == std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}});
    const LineMesh all = read_msh_lines(data + file, "", mistakes);
    CHECK(all.cells == std::vector<Index>{0, 1, 2, 1, 0, 2});
    CHECK(read_msh_lines(data + file, "feet", mistakes).empty());
    CHECK(messages(mistakes).find("no curve cell belongs to the group 'feet'; physical curves of "
                                  "this file: braces, legs") != std::string::npos);
  }
  Mistakes mistakes;
  CHECK(read_msh_lines(data + "block_22.msh", "", mistakes).empty());
  CHECK(messages(mistakes).find("the file holds no lines") != std::string::npos);
}

TEST_CASE("msh 4.1: each way to be broken has its line and reason", "[mesh][errors]") {
  const std::string file = "panel_41.msh";
  const auto said = [&](const char* old_text, const char* new_text, const char* group = "") {
    return answer(file, old_text, new_text, group);
  };
  CHECK(said("4.1 0 8", "4.0 0 8") == ":2: format 4.0 is not read; save the mesh as 4.1 or 2.2");
  CHECK(said("4.1 0 8", "4.1 1 8") == ":2: the file is binary; save the mesh as ASCII");
  CHECK(said("$MeshFormat", "solid") == ":1: 'solid' stands outside of a section");
  CHECK(said("$MeshFormat", "$Nodes") ==
        ":1: '$Nodes' comes before $MeshFormat; is this a gmsh file?");
  CHECK(said("\"nose tip\"", "nose") == ":8: a name in quotes is wanted");
  CHECK(said("100 0 0\n", "100 0\n") == ":30: a number is missing behind 2 word(s)");
  CHECK(said("100 0 0\n", "100 nan 0\n") == ":30: 'nan' is not finite");
  CHECK(said("100 0 0\n", "100 1,5 0\n") == ":30: '1,5' stands where a number is wanted");
  CHECK(said("2 1 0 6", "2 1 0 -6") == ":22: '-6' is not a count");
  CHECK(said("2 1 0 6\n1\n2", "2 1 0 6\n1\n1") == ":30: node 1 is there twice");
  CHECK(said("3 8 1 20", "4 8 1 20") ==
        ":38: '$EndNodes' comes before all that $Nodes announces has been given");
  CHECK(said("3 8 1 20", "2 8 1 20") == ":35: $EndNodes is wanted here");
  CHECK(said("5 3 11 6", "5 3 12 6") == ":49: element 5 uses node 12, which is not there");
  CHECK(said("5 3 11 6", "5 3 11 3") == ":49: element 5 uses node 3 twice");
  CHECK(said("3 1 2 5 4", "3 1 2 5 2") == ":46: element 3 uses node 2 twice");
  CHECK(said("5 3 11 6", "5 3 11") == ":49: the element needs 3 nodes");
  CHECK(said("2 2 2 1\n", "2 2 9 1\n") ==
        ":49: element type 9 is of higher order; mesh with order 1");
  CHECK(said("5 3 11 6\n$EndElements\n", "") == ":48: the file ends within $Elements");
  CHECK(said("rim", "rim", "hull") ==
        ":50: no surface cell belongs to the group 'hull'; physical surfaces of this file: nose "
        "tip, skin");
}

TEST_CASE("msh 2.2: each way to be broken has its line and reason", "[mesh][errors]") {
  const std::string file = "panel_22.msh";
  CHECK(answer(file, "6 200 100 0\n", "") ==
        ":20: '$EndNodes' comes before all that $Nodes announces has been given");
  CHECK(answer(file, "$EndComments", "") == ":28: the file ends before $EndComments");
  CHECK(answer(file, "3 200 0 0", "3 x 0 0") == ":16: 'x' stands where a number is wanted");
  CHECK(answer(file, "3 3 2 1 1 2 3 6 5", "3 3 2 1 1 2 3 6") == ":26: the element needs 4 nodes");
  CHECK(answer(file, "4\n1 1", "1\n1 1") == ":25: $EndElements is wanted here");
}

TEST_CASE("msh: a file without surfaces, an empty one and a missing one", "[mesh][errors]") {
  Mistakes mistakes;
  CHECK(read_msh("no/such/file.msh", "", mistakes).empty());
  CHECK(messages(mistakes) == "no/such/file.msh: the file cannot be opened");
  CHECK(answer("panel_22.msh", content(data + "panel_22.msh"), "") ==
        ": the file holds no $MeshFormat; is this a gmsh file?");
  const std::string text = content(data + "panel_22.msh");
  const std::size_t elements = text.find("$Elements");
  CHECK(answer("panel_22.msh", text.substr(elements), "") ==
        ":21: the file holds no quadrilaterals and no triangles");
}
