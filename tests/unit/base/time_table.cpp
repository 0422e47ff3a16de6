#include "base/time_table.hpp"

#include <catch2/catch.hpp>

using namespace gannet;

TEST_CASE("time table: straight lines, constant outside, and exact means", "[base]") {
  const TimeTable table{{1, 3, 4}, {2, 6, 0}};
  CHECK(value_at(table, 0) == 2);
  CHECK(value_at(table, 2) == 4);
  CHECK(value_at(table, 3.5) == 3);
  CHECK(value_at(table, 9) == 0);
  // Integral from 0 to 5: 2 + (2 + 6)/2 2 + (6 + 0)/2 1 + 0 = 13.
  CHECK(mean_over(table, 0, 5) == Approx(13.0 / 5).epsilon(1e-15));
  CHECK(mean_over(table, 1.5, 2.5) == 4);
  CHECK(mean_over(table, -3, 0) == 2);
  // From 2 to 3.5: (4 + 6)/2 1 + (6 + 3)/2 0.5 = 7.25.
  CHECK(mean_over(table, 2, 3.5) == Approx(7.25 / 1.5).epsilon(1e-15));
  CHECK(value_at(TimeTable{}, 7) == 1);
  CHECK(mean_over(TimeTable{}, 7, 8) == 1);
}

TEST_CASE("time table: a step rises at its time, at once or within a ramp", "[base]") {
  CHECK(value_at(step_from(2, 0), 1.999) == 0);
  CHECK(value_at(step_from(2, 0), 2) == 1);
  CHECK(mean_over(step_from(2, 0), 1, 4) == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(value_at(step_from(2, 4), 3) == 0.25);
  CHECK(value_at(step_from(2, 4), 100) == 1);
}
