// Nothing is paid for what is off: operations, fields and bytes of the smallest scenes, against a
// list that is kept beside this file. The bytes of an effect are all that it allocated in arrays,
// lists and copies included, as they were counted.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "app/simulation.hpp"

using namespace gannet;

namespace {

const std::string water = R"(gannet: 1
materials: {water: {card: water, c0: 20 m/s}}
parts: {drop: {sph: {material: water, spacing: 10 mm}, fill: {box: {from: [0, 0, 0], to: [40 mm, 40 mm, 40 mm]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

const std::string sheet = R"(gannet: 1
materials: {steel: {card: steel}}
parts: {sheet: {shell: {material: steel, thickness: 1 mm}, shape: {plate: {size: [40 mm, 40 mm], elements: [4, 4]}}}}
output: {until: 1 ms, vtk: never, history: never, checkpoint: never}
)";

/// Operations by stage with the effect that each belongs to, fields with their bytes, and what each
/// effect allocates.
std::string inventory(const std::string& name, const std::string& text) {
  const auto simulation = make_simulation_of_text(text);
  std::ostringstream out;
  out << "scene " << name << "\n";
  for (const Model& model : simulation->models.list) {
    for (int s = 0; s < n_stages; ++s) {
      const auto stage = static_cast<Stage>(s);
      for (const Operation& op : model.plan.at(stage)) {
        out << "  " << name_of(stage) << ": " << op.name << " (" << op.effect << ")\n";
      }
    }
  }
  for (const Field& f : simulation->scene.fields) {
    out << "  field " << f.name << ": " << bytes_of(f) << " B\n";
  }
  for (const EffectMemory& m : simulation->memory) {
    if (m.bytes != 0) out << "  " << m.effect << " allocates " << m.bytes << " B\n";
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

TEST_CASE("every operation and every field of a scene belongs to an effect of the table", "[app]") {
  const auto simulation =
      make_simulation_of_text(water + "effects: {viscosity: {alpha: 0.1}, xsph: {epsilon: 0.5}}\n");
  const auto known = [&](const std::string& name) {
    return std::any_of(simulation->memory.begin(), simulation->memory.end(),
                       [&](const EffectMemory& m) { return m.effect == name; });
  };
  for (const Field& f : simulation->scene.fields) {
    INFO(f.name);
    CHECK(known(f.effect));
  }
  CHECK(simulation->scene.field("X")->effect == "xsph");
  for (int s = 0; s < n_stages; ++s) {
    for (const Operation& op : simulation->models.list.front().plan.at(static_cast<Stage>(s))) {
      INFO(op.name);
      CHECK(known(op.effect));
      if (op.name == "XSPH drift") CHECK(op.effect == "xsph");
    }
  }
}

TEST_CASE("what an effect that is off would hold is not allocated", "[app]") {
  const auto bytes = [](const std::string& text, const std::string& effect) {
    const auto simulation = make_simulation_of_text(text);
    std::int64_t sum = 0;
    for (const EffectMemory& m : simulation->memory) {
      if (effect.empty() || m.effect == effect) sum += m.bytes;
    }
    return sum;
  };
  const std::string with = water + "effects: {xsph: {epsilon: 0.5}}\n";
  CHECK(bytes(water, "xsph") == 0);
  CHECK(bytes(with, "xsph") == 64 * 32);  // X: one line of 32 bytes for each of 64 particles
  CHECK(bytes(with, "") - bytes(water, "") == 64 * 32);
}
