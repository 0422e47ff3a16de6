#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "output/schedule.hpp"

using namespace gannet;

namespace {

constexpr double never_looked = -1;

/// Levels at which output acts, for steps drawn from [0.2, 1.8] dt until t passes `until`.
std::vector<double> levels_hit(const Every& every, double dt, double until, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> factor(0.2, 1.8);
  std::vector<double> hits;
  double last = never_looked;
  for (double t = 0; t <= until; t += dt * factor(random)) {
    if (due(every, last, t)) hits.push_back(t);
    last = t;
  }
  return hits;
}

}  // namespace

TEST_CASE("schedule: due at the first level, then once for each interval passed", "[output]") {
  const Every every{0.25};
  CHECK(due(every, never_looked, 0.0));
  CHECK_FALSE(due(every, 0.0, 0.2499));
  CHECK(due(every, 0.2499, 0.25));
  CHECK_FALSE(due(every, 0.25, 0.26));
  CHECK(due(every, 0.26, 1.6));  // several due times in one step: one look
  CHECK_FALSE(due(every, 1.6, 1.74));
  CHECK_FALSE(due(Every{}, never_looked, 0.0));
}

TEST_CASE("schedule: due times are products, so they never drift", "[output]") {
  // 0.1 added up a million times is off by 1e-6; its product with a million is 1e5 exactly.
  CHECK(intervals_until(0.1, 1e5) == 1000000);
  CHECK(intervals_until(0.1, std::nextafter(1e5, 0.0)) == 999999);
  for (int k = 0; k < 5000; ++k) {
    const double interval = 1e-5 / 3;
    CHECK(intervals_until(interval, k * interval) == k);
    CHECK(intervals_until(interval, std::nextafter(k * interval, -1.0)) == k - 1);
  }
}

TEST_CASE("schedule: every due time is met at the first level past it, whatever the steps",
          "[output]") {
  const Every every{1e-3};
  for (unsigned seed = 0; seed < 20; ++seed) {
    const double dt = 1e-5 * (1 + seed);
    const std::vector<double> hits = levels_hit(every, dt, 0.1, seed);
    REQUIRE(hits.size() >= 100);
    REQUIRE(hits.size() <= 101);
    for (std::size_t k = 0; k < hits.size(); ++k) {
      // The level at or past k intervals: less than one step late (the largest is 1.8 dt).
      CHECK(hits[k] >= static_cast<double>(k) * every.interval);
      CHECK(hits[k] < static_cast<double>(k) * every.interval + 1.8 * dt);
    }
  }
}

TEST_CASE("schedule: intervals are read as a person writes them", "[output]") {
  CHECK(parse_every("every 0.25 ms").interval == Approx(0.25e-3).epsilon(1e-15));
  CHECK(parse_every(" 10 us ").interval == Approx(1e-5).epsilon(1e-15));
  CHECK(parse_every("0.5").interval == 0.5);
  CHECK(parse_every("never").interval == 0);
  CHECK(parse_checkpoint_every("every 5 min of wall time").wall_interval == 300);
  CHECK(parse_checkpoint_every("every 5 min of wall time").interval == 0);
  CHECK(parse_checkpoint_every("every 2 ms").interval == Approx(2e-3).epsilon(1e-15));
  CHECK(parse_checkpoint_every("never").wall_interval == 0);
}

TEST_CASE("schedule: what is no interval is refused with what is allowed", "[output]") {
  CHECK_THROWS_WITH(parse_every("every 3 m"),
                    Catch::Contains("'every 3 m' is") && Catch::Contains("a time is wanted"));
  CHECK_THROWS_WITH(parse_every("every -3 s"), Catch::Contains("must be above 0"));
  CHECK_THROWS_WITH(parse_every("often"), Catch::Contains("allowed: 'every 0.25 ms', 'never'"));
  CHECK_THROWS_AS(parse_checkpoint_every("every kg of wall time"), std::invalid_argument);
}
