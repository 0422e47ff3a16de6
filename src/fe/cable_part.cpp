#include "fe/cable_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "fe/element_part.hpp"
#include "material/elastic_plastic.hpp"

namespace gannet {

namespace {

constexpr Dimension mass_per_length{{-1, 1, 0, 0, 0}};

/// One point of a law: strain and force [N], beyond the point before it. False after a mistake.
bool read_point(const Keys& cable, const Value& item, std::array<double, 2>& point) {
  const std::array<double, 2> before = point;
  if (item.children.size() == 2) {
    point = {cable.quantity(item.children[0], dim::none),
             cable.quantity(item.children[1], dim::force)};
    if (point[0] > before[0] && point[1] >= before[1]) return true;
  }
  cable.complain(item,
                 "a pair is wanted, [strain, force], of a larger strain and no smaller force "
                 "than before it");
  return false;
}

/// A law of straight pieces and the mass per length. False after a mistake.
bool read_law(const Keys& cable, TrussBlock& block) {
  for (const char* key : {"EA", "material", "area"}) {
    if (!cable.has(key)) continue;
    cable.complain(key, "stands beside 'law', which says the stiffness");
    return false;
  }
  if (!cable.has("mass_per_length")) {
    cable.complain("law", "wants mass_per_length beside it");
    return false;
  }
  std::vector<std::array<double, 2>> points;
  std::array<double, 2> point{0, 0};
  for (const Value& item : cable.value("law").children) {
    if (!read_point(cable, item, point)) return false;
    points.push_back(point);
  }
  block.law = law_through(points);
  double slope = 0;
  for (const TrussCorner& corner : block.law) {
    slope += corner.slope;
    block.EA = std::max(block.EA, slope);
  }
  if (!(block.EA > 0)) {
    cable.complain("law", "never rises: pairs of strain and force are wanted");
    return false;
  }
  block.mu = cable.number("mass_per_length");
  return true;
}

/// EA and mass per length: said, or of a material over an area. False after a mistake.
bool read_stiffness(const Keys& root, const Keys& cable, TrussBlock& block) {
  if (cable.has("law")) return read_law(cable, block);
  const bool said = cable.has("EA") || cable.has("mass_per_length");
  const bool solid = cable.has("material") || cable.has("area");
  const char* pair = said ? "EA and mass_per_length" : "material and area";
  if (said == solid) {
    cable.mistakes().add(cable.where(),
                         fmt::format("{}: its stiffness is {}; either EA and mass_per_length, or "
                                     "material and area, are wanted",
                                     cable.path(), said ? "said twice" : "missing"));
    return false;
  }
  for (const char* key : {said ? "EA" : "material", said ? "mass_per_length" : "area"}) {
    if (cable.has(key)) continue;
    cable.mistakes().add(cable.where(),
                         fmt::format("{}: {} is missing; {} go together", cable.path(), key, pair));
    return false;
  }
  if (said) {
    block.EA = cable.number("EA");
    block.mu = cable.number("mass_per_length");
    return true;
  }
  const ElasticPlastic material = read_but_rubber(root, cable);
  block.EA = material.E * cable.number("area");
  block.mu = material.rho * cable.number("area");
  return true;
}

}  // namespace

std::vector<Key> cable_keys() {
  return {
      {.name = "material",
       .kind = Kind::reference,
       .text = "solid that it is made of, with 'area'; else EA and mass_per_length",
       .refers_to = "materials"},
      {.name = "area",
       .unit = dim::area,
       .text = "area of the section, with 'material'",
       .limits = positive()},
      {.name = "EA", .unit = dim::force, .text = "axial stiffness", .limits = positive()},
      {.name = "law",
       .kind = Kind::any,
       .text = "force over strain in straight pieces from (0, 0) on, in place of EA: [[0.01, 20 "
               "kN], [0.02, 100 kN]]; the last goes on"},
      {.name = "mass_per_length",
       .unit = mass_per_length,
       .text = "mass per unstretched length",
       .limits = positive()},
      {.name = "tension_only",
       .kind = Kind::flag,
       .text = "shortened elements carry nothing; no: a truss that also pushes",
       .fallback = "yes"},
      {.name = "prestrain",
       .text = "strain in the positions at the start; below 0 the line is slack",
       .fallback = "0",
       .limits = {.lowest = -1, .highest = 1, .lowest_open = true, .highest_open = true}},
      {.name = "damping_ratio",
       .text = "internal damping, as a ratio of the highest mode of each element (0.05 where "
               "tension_only: a line that snaps taut needs it; else 0)",
       .limits = between(0, 2)},
      {.name = "damping_time",
       .unit = dim::time,
       .text = "internal damping over stiffness (beta)",
       .fallback = "0 s",
       .limits = at_least(0)},
      {.name = "strength",
       .unit = dim::force,
       .text = "force at which an element breaks; never unless said",
       .limits = positive()},
      {.name = "dt_factor",
       .text = "share of the stable step of the elements that is used",
       .fallback = "0.9",
       .limits = {.lowest = 0, .highest = 1, .lowest_open = true}}};
}

bool read_cable(const Keys& root, const Keys& cable, TrussBlock& block) {
  block.tension_only = !cable.has("tension_only") || cable.flag("tension_only");
  block.prestrain = cable.number_or("prestrain", 0);
  block.damping_ratio = cable.number_or("damping_ratio", block.tension_only ? 0.05 : 0.0);
  block.damping_time = cable.number("damping_time");
  block.strength = cable.number_or("strength", 0);
  block.dt_factor = cable.number("dt_factor");
  if (block.EA > 0) return true;
  return read_stiffness(root, cable, block);
}

void track_cable(Scene& scene, TrussBlock& block, const std::string& owner) {
  const auto cells = [&](const char* name, const char* unit, const char* vtk, TrussValue which) {
    Field field = element_field(block.name + "." + name, unit, block.part, block.state,
                                truss_values, which, 1, [&block] { return block.n_elements(); });
    field.vtk = vtk;
    field.owner = owner;
    scene.fields.push_back(std::move(field));
  };
  cells("length", "m", "", truss_length);
  cells("force", "N", "AxialForce", truss_force);
  cells("energy", "J", "", truss_energy);
  if (block.damping_ratio > 0 || block.damping_time > 0) {
    cells("damping", "N", "", truss_damping);
  }
  if (block.strength > 0) cells("broken", "", "Broken", truss_broken);
}

void add_cable_measures(Scene& scene, const TrussBlock& block) {
  scene.measures.push_back(
      {"cable." + block.name + ".tension", "N", {"value"}, [&block](double* value) {
         *value = 0;
         for (Index e = 0; e < block.n_elements(); ++e) {
           *value = std::max(*value, block.value(e, truss_force));
         }
       }});
  if (!(block.strength > 0)) return;
  scene.measures.push_back(
      {"cable." + block.name + ".broken", "", {"value"}, [&block](double* value) {
         *value = 0;
         for (Index e = 0; e < block.n_elements(); ++e) *value += block.value(e, truss_broken);
       }});
}

void add_cable_operation(const Keys& root, Scene& scene, Models& models, TrussBlock& block,
                         const std::string& reason) {
  ElementPart part{.kind = "cable",
                   .part = block.part,
                   .reason = reason,
                   .reads = {"x"},
                   .damping = block.damping_ratio > 0 || block.damping_time > 0,
                   .eroded = block.strength > 0};
  part.pass = [&scene, &block](const Step& step) {
    return truss_pass(block, scene.nodes, step.dt_old);
  };
  part.stable_dt = [&block] { return block.dt_factor * block.shortest; };
  part.limiting = [&block] { return block.limiting; };
  add_element_operation(root, scene, models, std::move(part));
}

}  // namespace gannet
