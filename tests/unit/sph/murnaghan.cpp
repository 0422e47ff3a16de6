#include "material/murnaghan.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gannet;

namespace {

/// B = 1000 60^2/7 = 514285.714... Pa
Murnaghan water() { return {1000, 7, 0, stiffness(1000, 7, 60)}; }

}  // namespace

TEST_CASE("murnaghan: pressures by hand", "[material]") {
  const Murnaghan eos = water();
  CHECK(eos.B == Approx(514285.7142857143).epsilon(1e-15));
  CHECK(pressure(eos, 1000) == 0);
  // 1.01^7 = 1.07213535210701
  CHECK(pressure(eos, 1010) == Approx(514285.7142857143 * 0.07213535210701).epsilon(1e-13));
  // 0.5^7 = 1/128
  CHECK(pressure(eos, 500) == Approx(-514285.7142857143 * 127 / 128).epsilon(1e-14));
  const Murnaghan air{1.2, 1.4, 101325, 1000};
  // 2^1.4 = 2.639015821545789
  CHECK(pressure(air, 2.4) == Approx(101325 + 1639.015821545789).epsilon(1e-14));
}

TEST_CASE("murnaghan: the density is the inverse of the pressure", "[material]") {
  for (const double gamma : {1.0, 1.4, 7.0}) {
    const Murnaghan eos{998, gamma, 2e4, 5e5};
    for (const double rho : {700.0, 998.0, 1003.7, 1400.0}) {
      // p - p0 loses digits against B near rho0: 1e-15 p/B/gamma.
      CHECK(density(eos, pressure(eos, rho)) == Approx(rho).epsilon(1e-14));
    }
  }
}

TEST_CASE("murnaghan: the speed of sound is c0 at rho0 and the slope of p elsewhere",
          "[material]") {
  const Murnaghan eos = water();
  CHECK(sound_speed(eos, 1000) == Approx(60).epsilon(1e-14));
  // c = c0 s^3 for gamma = 7
  CHECK(sound_speed(eos, 1020) == Approx(60 * 1.061208).epsilon(1e-14));
  const double d = 1e-3;  // central difference: error of order (d/rho)^2 gamma^2 = 5e-11
  const double slope = (pressure(eos, 1020 + d) - pressure(eos, 1020 - d)) / (2 * d);
  CHECK(std::pow(sound_speed(eos, 1020), 2) == Approx(slope).epsilon(1e-8));
}

TEST_CASE("murnaghan: internal energy is the work of compression, de/drho = p/rho^2",
          "[material]") {
  for (const double gamma : {1.0, 1.4, 7.0}) {
    const Murnaghan eos{1000, gamma, 3e4, 5e5};
    CHECK(internal_energy(eos, 1000) == 0);
    for (const double rho : {900.0, 1001.0, 1100.0}) {
      const double d = 1e-2;  // central difference of the fourth order: error (d/rho)^4, 1e-12
      const auto e = [&](int k) { return internal_energy(eos, rho + k * d); };
      const double slope = (8 * (e(1) - e(-1)) - (e(2) - e(-2))) / (12 * d);
      CHECK(slope == Approx(pressure(eos, rho) / (rho * rho)).epsilon(1e-9).margin(1e-11));
    }
  }
  // By hand, gamma = 7, p0 = 0, s = 2: (B/rho0) (63/6 - 1/2) = 10 B/rho0
  CHECK(internal_energy(water(), 2000) == Approx(10 * 514.2857142857143).epsilon(1e-14));
}

TEST_CASE("equation of state: linear is gamma = 1", "[material]") {
  Murnaghan eos{.rho0 = 1000, .gamma = 1, .p0 = 5, .B = stiffness(1000, 1, 30)};
  CHECK(pressure(eos, 1010) == Approx(5 + 900 * 10));
  CHECK(density(eos, 5 + 900 * 10) == Approx(1010));
  CHECK(sound_speed(eos, 990) == Approx(30));
}

TEST_CASE("equation of state: below the pressure of cavitation it stays there", "[material]") {
  Murnaghan eos{.rho0 = 1000, .gamma = 7, .p0 = 0, .B = stiffness(1000, 7, 50)};
  const double uncut = internal_energy(eos, 990);
  cut_pressure(eos, -1000);
  CHECK(eos.rho_min == Approx(1000 * std::pow(1 - 1000 / eos.B, 1.0 / 7)));
  CHECK(pressure(eos, 990) == -1000);
  CHECK(pressure(eos, 1001) > 0);
  // The work of expansion from rho_min to 990 against the constant pressure: p dV.
  const double step = internal_energy(eos, 990) - internal_energy(eos, eos.rho_min);
  CHECK(step == Approx(-1000 * (1 / eos.rho_min - 1 / 990.0)));
  CHECK(internal_energy(eos, 990) < uncut);
}

TEST_CASE("equation of state: enthalpy is the integral of dp/rho", "[material]") {
  for (const double gamma : {1.0, 1.4, 7.0}) {
    const Murnaghan eos{.rho0 = 1000, .gamma = gamma, .p0 = 0, .B = stiffness(1000, gamma, 50)};
    const int n = 1000;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double low = 1000 + 30.0 * k / n;
      const double high = 1000 + 30.0 * (k + 1) / n;
      sum += (pressure(eos, high) - pressure(eos, low)) / (0.5 * (low + high));
    }
    CHECK(enthalpy(eos, 1030) == Approx(sum).epsilon(1e-6));
    CHECK(enthalpy(eos, 1000) == 0);
  }
}
