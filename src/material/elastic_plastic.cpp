#include "material/elastic_plastic.hpp"

#include <string>
#include <utility>

namespace gannet {

PlaneStressLaw plane_stress_law(const ElasticPlastic& material) {
  const double E = material.E;
  const double nu = material.nu;
  PlaneStressLaw law;
  law.c11 = E / (1 - nu * nu);
  law.c12 = nu * law.c11;
  law.shear = material.G();
  law.mean_rate = E / (3 * (1 - nu));
  law.yield = material.sigma_y;
  law.hardening = material.H;
  law.compliance = (1 - 2 * nu) / E;
  return law;
}

SolidLaw solid_law(const ElasticPlastic& material) {
  return {.bulk = material.E / (3 * (1 - 2 * material.nu)),
          .shear = material.G(),
          .yield = material.sigma_y,
          .hardening = material.H};
}

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
  return s;
}

ElasticPlastic read_elastic_plastic(const Keys& material) {
  ElasticPlastic solid;
  const auto need = [&](const char* key, const std::string& what, double otherwise) {
    if (material.has(key)) return material.number(key);
    material.complain(key, "missing; a solid needs " + what);
    return otherwise;
  };
  solid.rho = need("density", "its density (kg/m^3)", 1);
  solid.E = need("young", "Young's modulus (Pa)", 1);
  solid.nu = need("poisson", "Poisson's ratio", 0);
  solid.sigma_y = material.number_or("yield_stress", 0);
  solid.H = material.number_or("hardening_modulus", 0);
  if (material.has("hardening_modulus") && !material.has("yield_stress")) {
    material.complain("hardening_modulus", "has no meaning without yield_stress");
  }
  return solid;
}

}  // namespace gannet
