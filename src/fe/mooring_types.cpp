#include "fe/mooring_types.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace gannet {

namespace {

constexpr std::array<MooringType, 6> types{{
    {"chain", 0.25, 20.0e3, 85.6e9, -3.93e7, 1.80, 9.11e2, 1.21e9, -2.19e9, 1.333, 0.639, 1.0, 0.5},
    {"studlink_chain", 0.25, 21.9e3, 88.0e9, 0, 1.89, 9.11e2, 1.21e9, -2.19e9, 1.376, 0.741, 1.0,
     0.5},
    {"wire", 0.25, 5293, 97.1e9, 0, 1.18, 0, 1022e6, 0, 1.021, 0, 1.0, 0},
    {"polyester", 0.4, 679, 14 * 308e6, 0, 0.7915, 0, 308e6, 0, 2.021, 0, 1.1, 0.15},
    {"nylon", 0.4, 585, 5 * 207e6, 5 * 230e6, 0.8083, 0, 207e6, 230e6, 1.979, 0, 1.1, 0.15},
    {"hmpe", 0.4, 496, 56 * 580e6, 56 * 651e6, 0.8048, 0, 580e6, 651e6, 1.988, 0, 1.1, 0.15},
}};

void fill_open(const Keys& keys, const char* name, double value, double& coefficient) {
  const bool said = keys.has("water") && keys.map("water").given(name);
  if (!said) coefficient = value;
}

}  // namespace

std::span<const MooringType> mooring_types() { return types; }

Key mooring_type_key() {
  Key key{.name = "type",
          .kind = Kind::choice,
          .text =
              "what the line is made of; with its 'nominal' size it says mass, stiffness, "
              "diameter and the coefficients of the water"};
  for (const MooringType& type : types) key.choices.emplace_back(type.name);
  return key;
}

Key nominal_key() {
  return {.name = "nominal",
          .unit = dim::length,
          .text = "diameter of the bar of a chain, or of a rope, with 'type'",
          .limits = positive()};
}

const MooringType* type_of_line(const Keys& keys) {
  if (!keys.has("type")) return nullptr;
  for (const MooringType& type : types) {
    if (keys.word("type") == type.name) return &type;
  }
  return nullptr;
}

double breaking_load(const MooringType& type, double d) {
  return d * (type.breaks_1 + d * (type.breaks_2 + d * type.breaks_3));
}

bool read_mooring_type(const Keys& keys, MooringLine& line) {
  const MooringType* type = type_of_line(keys);
  if (type == nullptr) {
    if (keys.has("nominal")) keys.complain("nominal", "goes with the 'type' of the line");
    return !keys.has("nominal");
  }
  if (!keys.has("nominal")) {
    keys.complain("type", "wants the 'nominal' diameter of the line beside it");
    return false;
  }
  for (const char* key : {"EA", "mass_per_length", "material", "area", "law", "diameter"}) {
    if (!keys.has(key)) continue;
    keys.complain(key, "stands beside 'type', which says it");
    return false;
  }
  const double d = keys.number("nominal");
  if (d > type->largest) {
    keys.complain("nominal", fmt::format("{:g} m is more than is made of {}: up to {:g} mm", d,
                                         type->name, 1e3 * type->largest));
    return false;
  }
  line.block.mu = type->mass * d * d;
  line.block.EA = d * d * (type->EA_2 + d * type->EA_3);
  line.diameter = type->displaces * d;
  return true;
}

void read_coefficients_of_type(const Keys& keys, LineWater& water) {
  const MooringType* type = type_of_line(keys);
  if (type == nullptr) return;
  fill_open(keys, "Cdn", type->Cdn, water.Cdn);
  fill_open(keys, "Cdt", type->Cdt, water.Cdt);
  fill_open(keys, "Can", type->Can, water.Can);
  fill_open(keys, "Cat", type->Cat, water.Cat);
}

}  // namespace gannet
