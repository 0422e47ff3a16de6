#include "study/study_prices.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "study/study_plan.hpp"

using namespace gannet;

namespace {

/// Settings of dx = 8, 4, 2 mm with errors of 2 h % (h in mm) and wall times (8 mm / h)^2 s.
/// s.
StudyResult made_up() {
  StudyResult result;
  result.spec.axes = {{"let.dx", {"8 mm", "4 mm", "2 mm"}}};
  result.spec.refine = "let.dx";
  MeasureResult m;
  m.measure = {.name = "peak", .kind = "peak"};
  m.reference = 1;
  m.reference_text = "1 N";
  StudySeries series;
  std::vector<double> h;
  std::vector<double> error;
  std::vector<double> wall;
  for (const int mm : {8, 4, 2}) {
    StudyPoint point;
    point.choices = {std::to_string(mm) + " mm"};
    point.h = 1e-3 * mm;
    point.wall = std::pow(8.0 / mm, 2);
    point.runs = {result.points.size()};
    m.values.push_back({1 + 0.02 * mm, 0, 0, 0.02 * mm});
    series.points.push_back(result.points.size());
    h.push_back(point.h);
    error.push_back(m.values.back().error);
    wall.push_back(point.wall);
    result.points.push_back(point);
  }
  series.order = fit_order(h, error);
  series.cost = fit_power(h, wall, 2);
  m.series = {series};
  result.measures = {m};
  return result;
}

}  // namespace

TEST_CASE("prices: 5 % is measured, 2 and 1 % follow from the fitted order", "[study]") {
  const StudyResult result = made_up();
  const auto said = price_sentences(result, result.measures[0]);
  REQUIRE(said.size() == 3);
  CHECK(said[0] ==
        "peak: the cheapest setting within 5 % of 1 N takes 16 s: dx = 2 mm (measured, error "
        "4 %).");
  // Order 1: 2 % at 1 mm, in (8/1)^2 = 64 s; 1 % at 0.5 mm, in 256 s = 4.3 min.
  CHECK(said[1] ==
        "peak: 2 % was not reached by a run; it would take about 64 s: dx = 1 mm (not measured: "
        "from the fitted order 1, 95 % interval 1 to 1).");
  CHECK(said[2].find("about 4.3 min: dx = 0.5 mm") == std::string::npos);  // 500 um
  CHECK(said[2].find("about 4.3 min: dx = 500 um") != std::string::npos);
}

TEST_CASE("prices: a hit that a finer run misses is called luck", "[study]") {
  StudyResult result = made_up();
  result.measures[0].values[1].error = 0.015;  // 4 mm; 2 mm has 4 %
  CHECK_THAT(price_sentences(result, result.measures[0])[1],
             Catch::Contains("dx = 4 mm (measured, error 1.5 %; a finer run of these settings "
                             "misses it, so this one may be luck)"));
}

TEST_CASE("prices: what cannot be said is not said", "[study]") {
  StudyResult result = made_up();
  result.measures[0].series[0].order = {};
  result.measures[0].series[0].order.reason = "errors do not shrink like a power of the size";
  CHECK(
      price_sentences(result, result.measures[0])[2] ==
      "peak: 1 % was not reached, and nothing can be said of its cost: errors do not shrink like a "
      "power of the size.");
}

TEST_CASE("prices: the reference itself is no setting within 5 %", "[study]") {
  StudyResult result = made_up();
  result.measures[0].reference_point = 2;
  CHECK(price_of(result, result.measures[0], 0.05).from == StudyPrice::From::fitted);
  CHECK(price_of(result, result.measures[0], 0.09).point == 1);
}

TEST_CASE("pareto front: none in it is beaten in time and error", "[study]") {
  const std::vector<double> time = {1, 2, 3, 4, 5, 6};
  const std::vector<double> error = {9, 10, 5, 5, unknown, 0};
  CHECK(pareto_front(time, error) == std::vector<std::size_t>{0, 2, 5});
  CHECK(pareto_front(time, error, 5) == std::vector<std::size_t>{0, 2});
}

TEST_CASE("medians", "[study]") {
  CHECK(median_of({3, 1, 2}) == 2);
  CHECK(median_of({4, 1, 2, 3}) == 2.5);
  CHECK(std::isnan(median_of({})));
}

TEST_CASE("prediction: along the power of the work that was measured", "[study]") {
  std::vector<StudyRun> runs(3);
  for (std::size_t i = 0; i < 3; ++i) runs[i].size = {std::pow(10.0, i), 0, 1, 1};
  CHECK(std::isnan(predict_wall(runs, runs[0])));
  runs[0].state = StudyState::done;
  runs[0].wall = 2;
  CHECK(predict_wall(runs, runs[1]) == Approx(20));  // one run: in proportion
  runs[1].state = StudyState::done;
  runs[1].wall = 2 * std::pow(10.0, 1.2);
  CHECK(predict_wall(runs, runs[2]) == Approx(2 * std::pow(10.0, 2.4)));
  runs[1].wall = 2000;  // a disturbed run does not make the next one impossible
  CHECK(predict_wall(runs, runs[2]) == Approx(2000 * std::pow(10.0, 1.5)));
}

TEST_CASE("times and sizes as a person says them", "[study]") {
  CHECK(wall_text(41.2) == "41 s");
  CHECK(wall_text(1.24) == "1.2 s");
  CHECK(wall_text(186) == "3.1 min");
  StudySpec spec;
  CHECK(size_text(spec, 0.0031) == "3.1 mm");
  spec.refine_counts = true;
  CHECK(size_text(spec, 1.0 / 57) == "57");
}
