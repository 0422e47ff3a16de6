// How a case asks for a pressure: loads.NAME.pressure: {on, value, side, from, ramp}.
#include <fmt/format.h>

#include <deque>

#include "body/effects.hpp"
#include "body/pressure.hpp"

namespace gannet {

namespace {
namespace pressure {

struct PressureLoads {
  std::deque<PressureLoad> list;
};

Schema schema() {
  Key pressure{.name = "pressure",
               .kind = Kind::map,
               .text = "pressure on a surface; it follows the surface as it moves and turns"};
  pressure.keys = {
      Key{.name = "on",
          .kind = Kind::reference,
          .text = "the part with the surface",
          .required = true,
          .refers_to = "parts"},
      Key{.name = "value",
          .kind = Kind::function,
          .unit = dim::pressure,
          .text = "the pressure; x, y and z are those of the middle of an element now",
          .required = true,
          .variables = {"t", "x", "y", "z"}},
      Key{.name = "side",
          .kind = Kind::choice,
          .text = "the side it acts on: front is where the normals point to, and pressure there "
                  "pushes against them",
          .fallback = "front",
          .choices = {"front", "back"}},
      Key{.name = "from", .unit = dim::time, .text = "when it starts (from the beginning)"},
      Key{.name = "ramp",
          .unit = dim::time,
          .text = "how long it takes to rise evenly to its value",
          .limits = at_least(0)}};
  return {{"loads.*", pressure}};
}

/// p(t, x) as the case gives it, from the time `from` on and rising within `ramp`.
Function pressure_in_time(const Keys& pressure) {
  const Function& value = pressure.function("value");
  if (!pressure.has("from") && !pressure.has("ramp")) return value;
  return product(value,
                 Function(step_from(pressure.number_or("from", 0), pressure.number_or("ramp", 0))));
}

void read_load(const Keys& keys, const std::string& name, Scene& scene) {
  PressureLoad load;
  load.name = name;
  load.where = keys.where();
  load.side = keys.word("side") == "back" ? 1 : -1;
  load.pressure = pressure_in_time(keys);
  load.part = scene.part_number(keys.word("on"));
  if (load.part < 0) {
    keys.complain("on", fmt::format("there is no part '{}'", keys.word("on")));
    return;
  }
  const Part& part = scene.parts[static_cast<std::size_t>(load.part)];
  if (part.kind == "solid" || (part.cell != Cell::quad && part.cell != Cell::triangle)) {
    keys.complain("on", fmt::format("part '{}' has no surface for a pressure", part.name));
    return;
  }
  scene.store.get<PressureLoads>().list.push_back(std::move(load));
}

void state(const Keys& root, Scene& scene) {
  if (!root.has("loads")) return;
  const Keys loads = root.map("loads");
  for (const std::string& name : loads.names()) {
    if (!loads.value(name).is_map || !loads.map(name).has("pressure")) continue;
    read_load(loads.map(name).map("pressure"), name, scene);
  }
}

void operations(const Keys& /*root*/, Scene& scene, Models& models) {
  if (!scene.store.has<PressureLoads>()) return;
  for (PressureLoad& load : scene.store.get<PressureLoads>().list) {
    add_pressure_load(load, scene, models);
  }
}

}  // namespace pressure
}  // namespace

Effect pressure_effect() {
  return {.name = "pressure",
          .schema = pressure::schema,
          .state = pressure::state,
          .operations = pressure::operations};
}

}  // namespace gannet
