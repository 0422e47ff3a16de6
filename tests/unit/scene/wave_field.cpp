#include "scene/wave_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "../../support/temporary_folder.hpp"
#include "input/case.hpp"
#include "scene/wave_keys.hpp"
#include "scene/wave_spectrum.hpp"

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

namespace {

/// The sea of a plane case that repeats after 400 m.
WaveField sea_of(const std::string& wave, std::string* mistakes = nullptr) {
  Schema schema = sea_schema();
  schema.push_back({"loads",
                    {.name = "gravity",
                     .kind = Kind::vector_function,
                     .unit = dim::acceleration,
                     .variables = {"t"}}});
  Key periodic{.name = "periodic", .kind = Kind::map};
  periodic.keys = {{.name = "x", .kind = Kind::numbers, .unit = dim::length}};
  schema.push_back({"boundaries.*", periodic});
  const auto c = read_case_text(
      "gannet: 1\nloads: {gravity: [0, -9.81, 0]}\nboundaries: {b: {periodic: {x: [0, 400 m]}}}\n"
      "sea: {depth: 30 m, wave: " +
          wave + "}\n",
      "sea.yaml", schema);
  const WaveField field = read_wave_field(c->keys(), 2);
  for (const std::string& m : c->mistakes.messages()) {
    if (mistakes != nullptr) *mistakes += m + "\n";
  }
  return field;
}

double energy_of(const std::vector<WaveComponent>& waves) {
  double m0 = 0;
  for (const WaveComponent& w : waves) m0 += 0.5 * w.a * w.a;
  return m0;
}

}  // namespace

TEST_CASE("waves: the wave number of a frequency", "[scene]") {
  for (const double k : {1e-3, 0.02, 0.3, 5.0}) {
    CHECK(wave_number(dispersion(k, 10, g), 10, g) == Approx(k).epsilon(1e-13));
  }
}

TEST_CASE("waves: components of a sea state from a file", "[scene]") {
  const TemporaryFolder folder;
  const std::string file = folder.path() + "/sea.csv";
  const double f = dispersion(2 * pi / 100, 30, g) / (2 * pi);
  std::ofstream(file) << "# a record\nfrequency [Hz],amplitude [cm],phase [deg],direction [deg]\n"
                      << fmt::format("{:.17g},20,90,0\n", f)
                      << fmt::format("{:.17g},5,-45,180\n",
                                     dispersion(2 * pi / 50, 30, g) / (2 * pi));
  std::string mistakes;
  const WaveField field = sea_of("{components: " + file + "}", &mistakes);
  CHECK(mistakes.empty());
  REQUIRE(field.waves.size() == 2);
  CHECK(field.waves[0].a == Approx(0.2).epsilon(1e-14));
  CHECK(field.waves[0].k == Approx(2 * pi / 100).epsilon(1e-12));
  CHECK(field.waves[0].phase == Approx(pi / 2).epsilon(1e-14));
  CHECK(field.waves[0].along.x() == 1);
  CHECK(field.waves[1].omega == Approx(dispersion(2 * pi / 50, 30, g)).epsilon(1e-12));
  CHECK(field.waves[1].along.x() == -1);

  const auto complaint = [&](const std::string& text) {
    std::ofstream(file) << text;
    std::string what;
    sea_of("{components: " + file + "}", &what);
    return what;
  };
  CHECK_THAT(complaint("speed,height\n1,2\n"),
             Catch::Contains("sea.yaml:4:") && Catch::Contains("one column of length, period"));
  CHECK_THAT(complaint("length [s],height\n1,2\n"), Catch::Contains("the column 'length' is a"));
  CHECK_THAT(complaint("length [m],height [m]\n100,x\n"), Catch::Contains("sea.csv:2: 'x'"));
  CHECK_THAT(complaint("length [m],height [m]\n100,20\n"), Catch::Contains("breaks"));
  CHECK_THAT(complaint("length [m],height [m]\n300,1\n"), Catch::Contains("a whole number"));
  CHECK_THAT(complaint("length [m],height [m]\n0,1\n"), Catch::Contains("greater than 0"));
}

TEST_CASE("waves: JONSWAP's spectrum, by hand", "[scene]") {
  // At the peak: exp(-5/4) gamma, without enhancement far from it.
  CHECK(jonswap_shape(1, 1, 3.3) == Approx(3.3 * std::exp(-1.25)).epsilon(1e-14));
  CHECK(jonswap_shape(2, 1, 3.3) == Approx(std::exp(-1.25 / 16) / 32).epsilon(1e-12));
  CHECK(jonswap_shape(0.93, 1, 3.3) / jonswap_shape(0.93, 1, 1) ==
        Approx(std::pow(3.3, std::exp(-0.5))).epsilon(1e-12));

  const SeaState sea{.height = 4, .period = 10, .n = 80};
  const std::vector<WaveComponent> waves = components_of(sea, 30, g);
  REQUIRE(waves.size() == 80);
  CHECK(4 * std::sqrt(energy_of(waves)) == Approx(4).epsilon(1e-12));
  const auto highest = std::max_element(waves.begin(), waves.end(),
                                        [](const auto& a, const auto& b) { return a.a < b.a; });
  CHECK(highest->omega == Approx(2 * pi / 10).epsilon(0.03));
  double cosines = 0;
  for (const WaveComponent& w : waves) {
    CHECK((w.phase >= 0 && w.phase < 2 * pi));
    cosines += std::cos(w.phase);
  }
  CHECK(std::abs(cosines) < 3 * std::sqrt(40));  // three deviations of 80 phases
  SeaState other = sea;
  CHECK(components_of(other, 30, g)[7].phase == waves[7].phase);
  other.seed = 2;
  CHECK(components_of(other, 30, g)[7].phase != waves[7].phase);
}

TEST_CASE("waves: a spectrum where the sea repeats", "[scene]") {
  std::string mistakes;
  const WaveField field = sea_of(
      "{spectrum: {type: pierson_moskowitz, height: 1 m, period: 6 s, shortest: 20 m}}", &mistakes);
  CHECK(mistakes.empty());
  REQUIRE(field.waves.size() > 10);
  for (const WaveComponent& w : field.waves) {
    const double n = w.k * 400 / (2 * pi);
    CHECK(n == Approx(std::round(n)).epsilon(1e-12));
    CHECK(n < 20.5);
  }
  CHECK(energy_of(field.waves) == Approx(1.0 / 16).epsilon(1e-12));
  sea_of("{spectrum: {height: 1 m, period: 6 s}, height: 1 m, length: 40 m}", &mistakes);
  CHECK_THAT(mistakes, Catch::Contains("sea.wave: waves are given by height and length"));
}
