// Nothing is paid for what is off: operations, fields and bytes of the smallest scenes, against a
// list that is kept beside this file.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "app/simulation.hpp"

using namespace gannet;

namespace {

const char* water = R"(gannet: 1
materials: {water: {card: water, c0: 20 m/s}}
parts: {drop: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [40 mm, 40 mm, 40 mm]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

const char* sheet = R"(gannet: 1
materials: {steel: {card: steel}}
parts: {sheet: {shell: {material: steel, thickness: 1 mm}, shape: {plate: {size: [40 mm, 40 mm], elements: [4, 4]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

/// Operations by stage, then fields with their bytes.
std::string inventory(const std::string& name, const char* text) {
  const auto simulation = make_simulation_of_text(text);
  std::ostringstream out;
  out << "scene " << name << "\n";
  for (const Model& model : simulation->models.list) {
    for (int s = 0; s < n_stages; ++s) {
      const auto stage = static_cast<Stage>(s);
      for (const Operation& op : model.plan.at(stage)) {
        out << "  " << name_of(stage) << ": " << op.name << "\n";
      }
    }
  }
  for (const Field& f : simulation->scene.fields) {
    out << "  field " << f.name << ": " << bytes_of(f) << " B\n";
  }
  return out.str();
}

}  // namespace

TEST_CASE("minimal scenes hold the operations, fields and bytes of the list, and no others",
          "[app]") {
  std::ifstream list("tests/unit/app/minimal_scene.txt");
  REQUIRE(list.good());
  const std::string expected((std::istreambuf_iterator<char>(list)), {});
  CHECK(inventory("water", water) + inventory("sheet", sheet) == expected);
}
