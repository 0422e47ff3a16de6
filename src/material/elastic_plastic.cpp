#include "material/elastic_plastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

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

J2Law j2_law(const ElasticPlastic& material) {
  J2Law law;
  law.shear = material.G();
  law.bulk = material.E / (3 * (1 - 2 * material.nu));
  law.mean_rate = material.E / (3 * (1 - material.nu));
  law.yield = material.sigma_y;
  const auto add_bend = [&](double strain, double change) {
    if (change == 0) return;
    law.knot[law.n_bends] = strain;
    law.bend[law.n_bends++] = change;
  };
  double slope = 0;
  const std::size_t n = material.curve_strain.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto& e = material.curve_strain;
    const auto& s = material.curve_stress;
    const double next = k + 1 < n ? (s[k + 1] - s[k]) / (e[k + 1] - e[k]) : 0;
    add_bend(e[k], next - slope);
    slope = next;
  }
  if (n == 0) add_bend(0, (1 - material.kinematic_fraction) * material.H);
  law.kinematic = material.kinematic_fraction * material.H;
  law.power_factor = material.power_factor;
  law.power = material.power;
  law.rate = material.rate_law;
  law.inverse_rate = 1 / material.rate;
  law.rate_power = material.rate_power;
  const AdiabaticHeating& heating = material.heating;
  if (heating.specific_heat > 0) {
    law.heat = heating.fraction / (material.rho * heating.specific_heat);
  }
  law.inverse_range = 1 / heating.range;
  law.thermal_power = heating.power;
  const Failure& failure = material.failure;
  law.fails = failure.given();
  for (int k = 0; k < 5; ++k) {
    law.failure[k] = failure.strain[k];
    law.fails_by_state = law.fails_by_state || (k > 0 && failure.strain[k] != 0);
  }
  law.inverse_rate_fail = 1 / failure.rate;
  return law;
}

namespace {

bool is_curve(const ElasticPlastic& solid) {
  const auto& e = solid.curve_strain;
  return e.size() == solid.curve_stress.size() && e.size() <= max_hardening_points &&
         std::is_sorted(e.begin(), e.end(), std::less_equal<>());
}

void read_curve(const Keys& material, ElasticPlastic& solid) {
  const Keys curve = material.map("hardening_curve");
  solid.curve_strain = curve.numbers("plastic_strain");
  solid.curve_stress = curve.numbers("stress");
  const auto& e = solid.curve_strain;
  const auto& s = solid.curve_stress;
  if (e.size() != s.size() || e.empty()) {
    curve.complain("stress", fmt::format("{} stresses for {} plastic strains", s.size(), e.size()));
  } else if (e.size() > max_hardening_points) {
    curve.complain("plastic_strain",
                   fmt::format("{} points; at most {}", e.size(), max_hardening_points));
  } else if (e[0] != 0) {
    curve.complain("plastic_strain", fmt::format("starts at {:g}; the first is 0, where the metal "
                                                 "begins to yield",
                                                 e[0]));
  }
  for (std::size_t k = 1; k < std::min(e.size(), s.size()); ++k) {
    if (!(e[k] > e[k - 1])) {
      curve.complain("plastic_strain",
                     fmt::format("{:g} after {:g}; they must rise", e[k], e[k - 1]));
    }
    if (s[k] < s[k - 1]) {
      curve.complain("stress",
                     fmt::format("{:g} Pa after {:g} Pa; they may not fall", s[k], s[k - 1]));
    }
  }
  if (!s.empty()) solid.sigma_y = s[0];
  // A curve with a mistake in it is left out of what is built before all mistakes are told.
  if (!is_curve(solid)) solid.curve_strain.clear();
}

void read_johnson_cook(const Keys& material, ElasticPlastic& solid) {
  const Keys jc = material.map("johnson_cook");
  solid.sigma_y = jc.number("A");
  solid.power_factor = jc.number("B");
  solid.power = jc.number("n");
  solid.rate_power = jc.number_or("C", 0);
  solid.rate = jc.number_or("rate0", 1);
  if (solid.rate_power > 0) solid.rate_law = RateLaw::johnson_cook;
  if (jc.given("rate0") && !(solid.rate_power > 0)) {
    jc.complain("rate0", "has no meaning without C");
  }
  if (!jc.has("specific_heat")) {
    for (const char* key : {"melting", "m", "room", "heat_fraction"}) {
      if (jc.given(key)) jc.complain(key, "has no meaning without specific_heat");
    }
    return;
  }
  solid.heating.specific_heat = jc.number("specific_heat");
  solid.heating.fraction = jc.number_or("heat_fraction", 0.9);
  solid.heating.power = jc.number_or("m", 1);
  if (!jc.has("melting")) {
    jc.complain("melting", "missing; with specific_heat the metal warms towards it");
    return;
  }
  solid.heating.range = jc.number("melting") - jc.number_or("room", 298);
  if (!(solid.heating.range > 0)) jc.complain("melting", "must be above 'room'");
}

void read_failure(const Keys& material, ElasticPlastic& solid) {
  const Keys failure = material.map("failure");
  if (failure.has("plastic_strain") == failure.has("johnson_cook")) {
    material.complain("failure", "either plastic_strain or johnson_cook is wanted");
    return;
  }
  solid.failure.rate = failure.number_or("rate0", 1);
  if (failure.has("plastic_strain")) {
    solid.failure.strain[0] = failure.number("plastic_strain");
    return;
  }
  const std::vector<double>& D = failure.numbers("johnson_cook");
  if (D.size() != 5) {
    failure.complain("johnson_cook", fmt::format("{} numbers; D1 ... D5 are wanted", D.size()));
    return;
  }
  for (std::size_t k = 0; k < 5; ++k) solid.failure.strain[k] = D[k];
}

/// Rubber of the law under `name`.
void read_rubber(const Keys& material, const char* name, ElasticPlastic& solid) {
  const Keys keys = material.map(name);
  HyperelasticLaw& law = solid.rubber;
  law.C10 = keys.number_or("C10", 0);
  law.C01 = keys.number_or("C01", 0);
  law.C20 = keys.number_or("C20", 0);
  law.C30 = keys.number_or("C30", 0);
  const double mu = 2 * (law.C10 + law.C01);
  if (!(mu > 0)) keys.complain("C10", "the shear modulus 2 (C10 + C01) must be above 0");
  if (keys.has("bulk_modulus") == keys.has("poisson")) {
    material.complain(name, "either bulk_modulus or poisson says how its volume changes");
  }
  const double nu = keys.number_or("poisson", 0.49);
  law.bulk = keys.number_or("bulk_modulus", 2 * mu * (1 + nu) / (3 * (1 - 2 * nu)));
  if (!(law.bulk > 0)) law.bulk = 1;  // after a mistake
  solid.E = 9 * law.bulk * mu / (3 * law.bulk + mu);
  solid.nu = (3 * law.bulk - 2 * mu) / (2 * (3 * law.bulk + mu));
  for (const char* key :
       {"young", "poisson", "yield_stress", "hardening_modulus", "kinematic_fraction",
        "hardening_curve", "johnson_cook", "cowper_symonds", "failure"}) {
    if (material.given(key)) material.complain(key, std::string("has no meaning beside ") + name);
  }
}

/// What a key needs beside it, and what may not stand there.
void check_company(const Keys& material, const ElasticPlastic& solid) {
  int ways = 0;
  const char* last = "";
  for (const char* key : {"yield_stress", "hardening_curve", "johnson_cook"}) {
    if (!material.has(key)) continue;
    ++ways;
    last = key;
  }
  if (ways > 1) {
    material.complain(last,
                      "one of yield_stress, hardening_curve and johnson_cook says when the "
                      "solid yields, not two");
  }
  for (const char* key : {"hardening_modulus", "kinematic_fraction"}) {
    if (material.has(key) && !material.has("yield_stress")) {
      material.complain(key, "has no meaning without yield_stress");
    }
  }
  if (material.given("kinematic_fraction") && material.has("yield_stress") &&
      !material.has("hardening_modulus")) {
    material.complain("kinematic_fraction", "has no meaning without hardening_modulus");
  }
  for (const char* key : {"cowper_symonds", "failure"}) {
    if (material.has(key) && !solid.plastic()) {
      material.complain(key, "has no meaning for a solid that does not yield");
    }
  }
  if (material.has("cowper_symonds") && solid.rate_law == RateLaw::johnson_cook) {
    material.complain("cowper_symonds",
                      "beside johnson_cook with its own C; one rate law, not two");
  }
}

}  // namespace

ElasticPlastic read_elastic_plastic(const Keys& material) {
  ElasticPlastic solid;
  const auto need = [&](const char* key, const std::string& what, double otherwise) {
    if (material.has(key)) return material.number(key);
    material.complain(key, "missing; a solid needs " + what);
    return otherwise;
  };
  solid.rho = need("density", "its density (kg/m^3)", 1);
  for (const char* name : {"neo_hookean", "mooney_rivlin", "yeoh"}) {
    if (!material.has(name)) continue;
    if (solid.hyperelastic()) material.complain(name, "one law of rubber, not two");
    read_rubber(material, name, solid);
  }
  if (solid.hyperelastic()) return solid;
  solid.E = need("young", "Young's modulus (Pa)", 1);
  solid.nu = need("poisson", "Poisson's ratio", 0);
  solid.sigma_y = material.number_or("yield_stress", 0);
  solid.H = material.number_or("hardening_modulus", 0);
  solid.kinematic_fraction = material.number_or("kinematic_fraction", 0);
  if (material.has("hardening_curve")) read_curve(material, solid);
  if (material.has("johnson_cook")) read_johnson_cook(material, solid);
  if (material.has("failure")) read_failure(material, solid);
  check_company(material, solid);
  if (material.has("cowper_symonds")) {
    const Keys rate = material.map("cowper_symonds");
    solid.rate_law = RateLaw::cowper_symonds;
    solid.rate = rate.number("D");
    solid.rate_power = 1 / rate.number("p");
  }
  return solid;
}

ElasticPlastic read_but_rubber(const Keys& root, const Keys& part) {
  const ElasticPlastic material =
      read_elastic_plastic(root.map("materials").map(part.word("material")));
  if (material.hyperelastic()) {
    part.complain("material", "'" + part.word("material") +
                                  "' is rubber, which only solids are made of: its stress follows "
                                  "from the deformation since the start");
  }
  return material;
}

}  // namespace gannet
