#include "material/murnaghan.hpp"

#include <algorithm>

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
       .text = "equation of state of a fluid",
       .choices = {"murnaghan"}});
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
  add({.name = "expected_speed",
       .kind = Kind::number,
       .unit = dim::velocity,
       .text = "largest speed that is expected in a fluid, for c0: auto",
       .limits = positive()});
  return s;
}

Murnaghan read_murnaghan(const Keys& material, double largest_speed) {
  Murnaghan eos;
  if (!material.has("density")) {
    material.complain("density", "missing; a fluid needs its density (kg/m^3)");
    return eos;
  }
  eos.rho0 = material.number("density");
  eos.gamma = material.number_or("gamma", 7);
  eos.p0 = material.number_or("p0", 0);
  const bool automatic = !material.has("c0") || material.word("c0") == "auto";
  if (material.has("bulk")) {
    if (!automatic) {
      material.complain("bulk", "c0 is given too; give one of them (B = density c0^2 / gamma)");
    }
    eos.B = material.number("bulk");
    return eos;
  }
  double c0 = 0;
  if (automatic) {
    c0 = sound_over_flow * std::max(largest_speed, material.number_or("expected_speed", 0));
    if (c0 == 0) {
      material.complain("c0",
                        "auto needs a speed: nothing moves and there is no gravity; give "
                        "expected_speed or c0 (m/s)");
      c0 = 1;
    }
  } else {
    c0 = material.number("c0");
  }
  eos.B = stiffness(eos.rho0, eos.gamma, c0);
  return eos;
}

}  // namespace gannet
