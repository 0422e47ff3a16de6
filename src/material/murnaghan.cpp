#include "material/murnaghan.hpp"

#include <algorithm>
#include <string>

namespace gannet {

namespace {

/// How many times faster than the flow sound must be for density changes of 1 % (Mach 0.1).
constexpr double sound_over_flow = 10;

}  // namespace

Schema murnaghan_schema() {
  Schema s;
  const auto add = [&](Key key) { s.push_back({"materials.*", std::move(key)}); };
  add({.name = "density",
       .kind = Kind::number,
       .unit = dim::density,
       .text = "density; of a fluid, at the reference pressure",
       .limits = positive()});
  add({.name = "eos",
       .kind = Kind::choice,
       .text = "equation of state of a fluid: p0 + B [(density/density0)^gamma - 1], or linear, "
               "p0 + c0^2 (density - density0)",
       .choices = {"murnaghan", "linear"}});
  add({.name = "gamma",
       .kind = Kind::number,
       .text = "exponent of the equation of state of a fluid (7 where absent)",
       .limits = between(1, 20)});
  add({.name = "p0",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "pressure of a fluid at its reference density (0 where absent)"});
  add({.name = "c0",
       .kind = Kind::number,
       .unit = dim::velocity,
       .text = "speed of sound of a fluid; auto: 10 times the largest expected speed",
       .limits = positive(),
       .choices = {"auto"}});
  add({.name = "bulk",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "stiffness B of the equation of state, in place of c0",
       .limits = positive()});
  add({.name = "bulk_modulus",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "density0 c0^2 of a fluid, in place of c0",
       .limits = positive()});
  add({.name = "cavitation",
       .kind = Kind::number,
       .unit = dim::pressure,
       .text = "smallest pressure of a fluid, relative to the same zero as p0; without it any "
               "tension is held"});
  add({.name = "void",
       .text = "largest share of void in a fluid that cavitates: its density falls no further, and "
               "wider voids are forgotten (default: 0.1)",
       .limits = between(0, 1)});
  add({.name = "expected_speed",
       .kind = Kind::number,
       .unit = dim::velocity,
       .text = "largest speed that is expected in a fluid, for c0: auto",
       .limits = positive()});
  return s;
}

namespace {

/// The stiffness B from what the card gives.
double read_stiffness(const Keys& material, const Murnaghan& eos, double largest_speed) {
  const bool automatic = !material.has("c0") || material.word("c0") == "auto";
  const char* given = automatic ? nullptr : "c0";
  for (const char* key : {"bulk", "bulk_modulus"}) {
    if (!material.has(key)) continue;
    if (given != nullptr) {
      material.complain(key, std::string(given) +
                                 " is given too; give one of them (B = density c0^2 / gamma, "
                                 "bulk_modulus = density c0^2)");
    }
    given = key;
  }
  const std::string from = given == nullptr ? "auto" : given;
  if (from == "bulk") return material.number("bulk");
  if (from == "bulk_modulus") return material.number("bulk_modulus") / eos.gamma;
  if (from == "c0") return stiffness(eos.rho0, eos.gamma, material.number("c0"));
  const double speed = std::max(largest_speed, material.number_or("expected_speed", 0));
  if (speed == 0) {
    material.complain("c0",
                      "auto needs a speed: nothing moves and there is no gravity; give "
                      "expected_speed or c0 (m/s)");
    return stiffness(eos.rho0, eos.gamma, 1);
  }
  return stiffness(eos.rho0, eos.gamma, sound_over_flow * speed);
}

}  // namespace

void cut_pressure(Murnaghan& eos, double p_min) {
  eos.p_min = p_min;
  eos.rho_min = density(eos, p_min);
}

Murnaghan read_murnaghan(const Keys& material, double largest_speed) {
  Murnaghan eos;
  if (!material.has("density")) {
    material.complain("density", "missing; a fluid needs its density (kg/m^3)");
    return eos;
  }
  eos.rho0 = material.number("density");
  const bool linear = material.has("eos") && material.word("eos") == "linear";
  if (linear && material.number_or("gamma", 1) != 1) {
    material.complain("gamma", "the linear equation of state has no exponent");
  }
  eos.gamma = linear ? 1 : material.number_or("gamma", 7);
  eos.p0 = material.number_or("p0", 0);
  eos.B = read_stiffness(material, eos, largest_speed);
  if (material.has("cavitation")) {
    const double p_min = material.number("cavitation");
    if (p_min > eos.p0 || p_min <= eos.p0 - eos.B) {
      material.complain("cavitation",
                        "must lie above p0 - B and not above p0, the pressure at the "
                        "reference density");
    } else {
      cut_pressure(eos, p_min);
      eos.rho_void = (1 - material.number_or("void", 0.1)) * eos.rho_min;
    }
  } else if (material.given("void")) {
    material.complain("void", "only a fluid with a smallest pressure (cavitation) has voids");
  }
  return eos;
}

}  // namespace gannet
