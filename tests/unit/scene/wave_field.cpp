#include "scene/wave_field.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace gannet;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double g = 9.81;

/// One wave of a plane case, k = 2 /m on 0.5 m of water: kd = 1.
WaveField field_of(double a, bool second_order, double depth = 0.5) {
  WaveField field{.second_order = second_order, .depth = depth, .level = 0.3, .g = g, .up = 1};
  field.waves = {{.a = a, .k = 2, .omega = dispersion(2, depth, g), .phase = 0.4}};
  return field;
}

/// Determinant of X -> x by central differences.
double jacobian(const WaveField& field, const Vec3& X, double t) {
  const double e = 1e-5;
  const auto at = [&](double dx, double dy) {
    const Vec3 here = X + Vec3(dx, dy, 0);
    return Vec3(here + displacement_at(field, here, t));
  };
  const Vec3 along = (at(e, 0) - at(-e, 0)) / (2 * e);
  const Vec3 up = (at(0, e) - at(0, -e)) / (2 * e);
  return along.x() * up.y() - along.y() * up.x();
}

/// Velocity of the potential at a place: Dean and Dalrymple's second-order sum, written out anew.
Vec3 eulerian(const WaveField& field, const Vec3& x, double t) {
  const WaveComponent& w = field.waves.front();
  const double K = w.k * (x.y() - field.level + field.depth);
  const double S = std::sinh(w.k * field.depth);
  const double theta = w.k * x.x() - w.omega * t + w.phase;
  const double first = w.a * w.omega / S;
  const double second = 0.75 * w.a * w.a * w.omega * w.k / (S * S * S * S);
  return {first * std::cosh(K) * std::cos(theta) + second * std::cosh(2 * K) * std::cos(2 * theta),
          first * std::sinh(K) * std::sin(theta) + second * std::sinh(2 * K) * std::sin(2 * theta),
          0};
}

}  // namespace

TEST_CASE("waves: dispersion, in deep and in shallow water", "[scene]") {
  CHECK(dispersion(2, 0.5, g) == Approx(std::sqrt(9.81 * 2 * 0.7615941559557649)).epsilon(1e-14));
  CHECK(dispersion(2, 500, g) == Approx(std::sqrt(19.62)).epsilon(1e-14));
  CHECK(dispersion(2, 1e-4, g) == Approx(2 * std::sqrt(g * 1e-4)).epsilon(1e-7));
}

TEST_CASE("waves: way, pressure and height of a linear wave, by hand", "[scene]") {
  WaveField field = field_of(0.01, false);
  field.waves.front().phase = 0;
  const Vec3 surface{0, 0.3, 0};
  // Under the crest the surface is a higher, and by the mean rise a^2 k coth(kd)/2.
  const double rise = 0.5 * 1e-4 * 2 / std::tanh(1.0);
  CHECK(displacement_at(field, surface, 0).y() == Approx(0.01 + rise).epsilon(1e-13));
  CHECK(displacement_at(field, surface, 0).x() == 0);
  // A quarter of a wave on: a coth(kd) back.
  const Vec3 quarter{pi / 4, 0.3, 0};
  CHECK(displacement_at(field, quarter, 0).x() == Approx(-0.01 / std::tanh(1.0)).epsilon(1e-13));
  CHECK(pressure_of(field, surface, 0) == Approx(0).margin(1e-14));
  // On the floor: g (d + a/cosh kd); and the water there moves along it alone.
  const Vec3 floor{0, -0.2, 0};
  CHECK(pressure_of(field, floor, 0) == Approx(g * (0.5 + 0.01 / std::cosh(1.0))).epsilon(1e-13));
  CHECK(displacement_at(field, Vec3(0.3, -0.2, 0), 0.1).y() == Approx(0).margin(1e-16));
  CHECK(elevation_at(field, surface, 0) == 0.01);
  // Deep water: radius a exp(kZ), as tabulated for 365 m waves of 7.8 m height at 55 m depth.
  WaveField deep{.depth = 310, .g = g, .up = 1};
  const double k = 2 * pi / 365;
  deep.waves = {{.a = 3.9, .k = k, .omega = dispersion(k, 310, g)}};
  CHECK(displacement_at(deep, Vec3(365.0 / 4, -55, 0), 0).norm() == Approx(1.5132).epsilon(2e-3));
  CHECK(velocity_of(deep, Vec3(0, -55, 0), 0).norm() == Approx(0.62181).epsilon(2e-3));
  // Nothing overflows.
  CHECK(std::isfinite(displacement_at(deep, Vec3(1, -1, 0), 0).y()));
  deep.depth = 1e5;
  const double mean_rise = 0.5 * 3.9 * 3.9 * k * std::exp(-2 * k * 55);
  CHECK(displacement_at(deep, Vec3(0, -55, 0), 0).y() == Approx(1.5132 + mean_rise).epsilon(1e-4));
}

TEST_CASE("waves: velocity and acceleration are the rates of the way", "[scene]") {
  for (const bool second : {false, true}) {
    WaveField field = field_of(0.02, second);
    field.current = {0.3, 0, 0};
    const Vec3 X{0.2, 0.15, 0};
    const double e = 1e-5;
    const Vec3 v =
        (displacement_at(field, X, 0.7 + e) - displacement_at(field, X, 0.7 - e)) / (2 * e);
    const Vec3 a = (velocity_of(field, X, 0.7 + e) - velocity_of(field, X, 0.7 - e)) / (2 * e);
    CHECK((v - velocity_of(field, X, 0.7)).norm() < 1e-8);
    CHECK((a - acceleration_of(field, X, 0.7)).norm() < 1e-7);
    const Vec3 x = X + displacement_at(field, X, 0.7);
    CHECK((rest_place_of(field, x, 0.7) - X).norm() < 1e-14);
  }
}

TEST_CASE("waves: of second order, paths follow the potential and keep volume to a^3", "[scene]") {
  double velocity[2];
  double volume[2];
  double pressure[2];
  for (const int n : {0, 1}) {
    const WaveField field = field_of(n == 0 ? 0.02 : 0.01, true);
    velocity[n] = volume[n] = pressure[n] = 0;
    for (const double t : {0.0, 0.2, 0.55}) {
      for (const Vec3& X : {Vec3(0.1, 0.25, 0), Vec3(0.9, 0.0, 0), Vec3(2.3, 0.3, 0)}) {
        const Vec3 x = X + displacement_at(field, X, t);
        velocity[n] += (velocity_of(field, X, t) - eulerian(field, x, t)).norm();
        volume[n] += std::abs(jacobian(field, X, t) - 1);
        const Vec3 top{X.x(), 0.3, 0};
        pressure[n] += std::abs(pressure_of(field, top, t));
        const Vec3 there = top + displacement_at(field, top, t);
        pressure[n] += g * std::abs(there.y() - 0.3 - elevation_at(field, there, t));
      }
    }
  }
  INFO(velocity[0] << " " << volume[0] << " " << pressure[0]);
  // Half the height: an eighth.
  CHECK(velocity[0] / velocity[1] == Approx(8).epsilon(0.25));
  CHECK(volume[0] / volume[1] == Approx(8).epsilon(0.25));
  CHECK(pressure[0] / pressure[1] == Approx(8).epsilon(0.25));
}

TEST_CASE("waves: a current carries them", "[scene]") {
  WaveField field = field_of(0.02, false);
  field.current = {0.3, 0, 0};
  const WaveField still = field_of(0.02, false);
  // In the frame of the water nothing has changed.
  const Vec3 X{0.2, 0.15, 0};
  CHECK((displacement_at(field, X, 2) - displacement_at(still, X, 2) - Vec3(0.6, 0, 0)).norm() <
        1e-14);
  CHECK(elevation_at(field, Vec3(1, 0, 0), 2) ==
        Approx(elevation_at(still, Vec3(0.4, 0, 0), 2)).epsilon(1e-12));
}
