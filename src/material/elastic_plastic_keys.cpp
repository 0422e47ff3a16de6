// What a case may say of a solid under "materials.*".
#include <string>
#include <utility>
#include <vector>

#include "material/elastic_plastic.hpp"

namespace gannet {

namespace {

constexpr Dimension specific_heat{{2, 0, -2, -1, 0}};

std::vector<Key> johnson_cook_keys() {
  return {{.name = "A",
           .unit = dim::pressure,
           .text = "yield stress at rest and at room temperature",
           .required = true,
           .limits = positive()},
          {.name = "B",
           .unit = dim::pressure,
           .text = "factor of the plastic strain to the power n",
           .required = true,
           .limits = at_least(0)},
          {.name = "n",
           .text = "power of the plastic strain",
           .required = true,
           .limits = {.lowest = 0, .highest = 1, .lowest_open = true}},
          {.name = "C", .text = "factor of ln(rate/rate0)", .fallback = "0", .limits = at_least(0)},
          {.name = "rate0",
           .unit = dim::frequency,
           .text = "rate of the plastic strain up to which it does not count",
           .fallback = "1 1/s",
           .limits = positive()},
          {.name = "m",
           .text = "power of (T - room)/(melting - room)",
           .fallback = "1",
           .limits = positive()},
          {.name = "room",
           .unit = dim::temperature,
           .text = "temperature at the start",
           .fallback = "298 K",
           .limits = at_least(0)},
          {.name = "melting",
           .unit = dim::temperature,
           .text = "temperature at which the metal melts; with specific_heat",
           .limits = positive()},
          {.name = "specific_heat",
           .unit = specific_heat,
           .text = "heat of a mass per temperature; without it the temperature stays",
           .limits = positive()},
          {.name = "heat_fraction",
           .text = "share of the plastic work that becomes heat (Taylor and Quinney)",
           .fallback = "0.9",
           .limits = between(0, 1)}};
}

std::vector<Key> curve_keys() {
  return {{.name = "plastic_strain",
           .kind = Kind::numbers,
           .text = "plastic strains (true), from 0, rising",
           .required = true,
           .limits = at_least(0)},
          {.name = "stress",
           .kind = Kind::numbers,
           .unit = dim::pressure,
           .text = "true stresses there; beyond the last the metal hardens no more",
           .required = true,
           .limits = positive()}};
}

std::vector<Key> cowper_symonds_keys() {
  return {{.name = "D",
           .unit = dim::frequency,
           .text = "rate that doubles the yield stress",
           .required = true,
           .limits = positive()},
          {.name = "p",
           .text = "exponent: the yield stress grows by 1 + (rate/D)^(1/p)",
           .required = true,
           .limits = at_least(1)}};
}

/// Keys of a law of rubber with these constants.
std::vector<Key> rubber_keys(const std::vector<std::string>& constants) {
  std::vector<Key> keys;
  for (const std::string& c : constants) {
    keys.push_back({.name = c,
                    .unit = dim::pressure,
                    .text = "constant of the energy W(I1, I2)",
                    .required = true});
  }
  keys.push_back({.name = "bulk_modulus",
                  .unit = dim::pressure,
                  .text = "resistance to a change of the volume; or poisson",
                  .limits = positive()});
  keys.push_back(
      {.name = "poisson",
       .text = "Poisson's ratio at the start; or bulk_modulus",
       .limits = {.lowest = 0, .highest = 0.5, .lowest_open = true, .highest_open = true}});
  return keys;
}

std::vector<Key> failure_keys() {
  return {{.name = "plastic_strain",
           .text = "plastic strain at which a point carries no more",
           .limits = positive()},
          {.name = "johnson_cook",
           .kind = Kind::numbers,
           .text = "D1 ... D5: plastic strain at failure (D1 + D2 exp(D3 mean/von Mises)) (1 + D4 "
                   "ln(rate/rate0)) (1 + D5 T*)"},
          {.name = "rate0",
           .unit = dim::frequency,
           .text = "of D4",
           .fallback = "1 1/s",
           .limits = positive()}};
}

}  // namespace

Schema elastic_plastic_schema() {
  Schema s;
  const auto add = [&](Key key) { s.push_back({"materials.*", std::move(key)}); };
  add({.name = "density",
       .kind = Kind::number,
       .unit = dim::density,
       .text = "density",
       .limits = positive()});
  add({.name = "young",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "Young's modulus of a solid",
       .limits = positive()});
  add({.name = "poisson",
       .kind = Kind::number,
       .text = "Poisson's ratio of a solid",
       .limits = {.lowest = -1, .highest = 0.5, .lowest_open = true, .highest_open = true}});
  add({.name = "yield_stress",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "yield stress of a solid (von Mises); without it the solid stays elastic",
       .limits = positive()});
  add({.name = "hardening_modulus",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "plastic modulus of a solid: growth of the yield stress per plastic strain",
       .limits = at_least(0)});
  add({.name = "kinematic_fraction",
       .text = "share of hardening_modulus that moves the yield surface instead of widening it",
       .limits = between(0, 1)});
  add({.name = "hardening_curve",
       .kind = Kind::map,
       .text = "yield stress of a solid by points over the plastic strain, straight between them",
       .keys = curve_keys()});
  add({.name = "cowper_symonds",
       .kind = Kind::map,
       .text = "yield stress that grows with the rate of the plastic strain",
       .keys = cowper_symonds_keys()});
  add({.name = "johnson_cook",
       .kind = Kind::map,
       .text = "yield stress (A + B eps_p^n) (1 + C ln(rate/rate0)) (1 - T*^m)",
       .keys = johnson_cook_keys()});
  add({.name = "neo_hookean",
       .kind = Kind::map,
       .text = "rubber: W = C10 (I1 - 3)",
       .keys = rubber_keys({"C10"})});
  add({.name = "mooney_rivlin",
       .kind = Kind::map,
       .text = "rubber: W = C10 (I1 - 3) + C01 (I2 - 3)",
       .keys = rubber_keys({"C10", "C01"})});
  add({.name = "yeoh",
       .kind = Kind::map,
       .text = "rubber: W = C10 (I1 - 3) + C20 (I1 - 3)^2 + C30 (I1 - 3)^3",
       .keys = rubber_keys({"C10", "C20", "C30"})});
  add({.name = "failure",
       .kind = Kind::map,
       .text = "when a point carries no more; an element leaves with its last point",
       .keys = failure_keys()});
  return s;
}

}  // namespace gannet
