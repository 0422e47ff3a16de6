#include "body/time_table.hpp"

#include <catch2/catch.hpp>

#include "small_world.hpp"

using namespace gannet;

TEST_CASE("time table: straight lines, constant outside, and exact means", "[body]") {
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
  CHECK(value_at({}, 7) == 1);
  CHECK(mean_over({}, 7, 8) == 1);
}

TEST_CASE("time table: a step rises at its time, at once or within a ramp", "[body]") {
  CHECK(value_at(step_from(2, 0), 1.999) == 0);
  CHECK(value_at(step_from(2, 0), 2) == 1);
  CHECK(mean_over(step_from(2, 0), 1, 4) == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(value_at(step_from(2, 4), 3) == 0.25);
  CHECK(value_at(step_from(2, 4), 100) == 1);
}

TEST_CASE("time table: a table is read with its units and its mistakes located", "[body]") {
  const Schema schema{{"loads.*", table_key("table", "")}};
  const auto read = [&](const std::string& text) {
    const auto c =
        read_case_text("gannet: 1\nloads: {a: {table: " + text + "}}\n", "case.yaml", schema);
    const TimeTable table = read_table(c->keys().map("loads").map("a"), "table", dim::pressure);
    std::string all;
    for (const std::string& m : c->mistakes.messages()) all += m + "\n";
    return std::make_pair(table, all);
  };
  const auto [table, none] = read("[[0 s, 1 Pa], [2 ms, 3 kPa]]");
  CHECK(none.empty());
  CHECK(table == TimeTable{{0, 0.002}, {1, 3000}});
  CHECK_THAT(read("[[0 s, 1 m]]").second, Catch::Contains("case.yaml:2:") &&
                                              Catch::Contains("'1 m' is a length") &&
                                              Catch::Contains("pressure"));
  CHECK_THAT(read("[[1 s, 1 Pa], [1 s, 2 Pa]]").second, Catch::Contains("times must rise"));
  CHECK_THAT(read("[1, 2]").second, Catch::Contains("list of pairs"));
  CHECK_THAT(read("5 Pa").second, Catch::Contains("list of pairs"));
}
