#include "study/study_history.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "support/temporary_folder.hpp"

using namespace gannet;

namespace {

double measured(const std::string& kind, const TimeSeries& s, double percent = 50) {
  return evaluate({.name = kind, .kind = kind, .percent = percent}, s);
}

std::string write(const TemporaryFolder& folder, const std::string& text) {
  const std::string path = folder.path() + "/h.csv";
  std::ofstream(path) << text;
  return path;
}

}  // namespace

TEST_CASE("history: columns are found by their last word, vectors by their length", "[study]") {
  const TemporaryFolder folder;
  const std::string file = write(folder,
                                 "time [s],slam_force x [N],slam_force y [N],slam_force z [N]\n"
                                 "0,3,0,4\n0.5,1,2,2\n");
  CHECK(read_time_series(file, "z").y == std::vector<double>{4, 2});
  CHECK(read_time_series(file, "slam_force x").y == std::vector<double>{3, 1});
  const TimeSeries length = read_time_series(file, "");
  CHECK(length.y == std::vector<double>{5, 3});
  CHECK(length.t == std::vector<double>{0, 0.5});
  CHECK(length.unit == "N");
  CHECK_THROWS_WITH(read_time_series(file, "w"),
                    Catch::Contains("no one column 'w'") && Catch::Contains("slam_force y"));
  CHECK_THROWS_WITH(read_time_series(folder.path() + "/none.csv", ""),
                    Catch::Contains("cannot be read"));
}

TEST_CASE("history: a last line that is still being written is left out", "[study]") {
  const TemporaryFolder folder;
  const TimeSeries s = read_time_series(write(folder, "time [s],a [m],b [m]\n0,1,2\n1,3"), "a");
  CHECK(s.y == std::vector<double>{1});
}

TEST_CASE("measures: hand-made numbers", "[study]") {
  // Unequal steps: areas 0.5 (0+2) 1 = 1, 0.5 (2-4) 2 = -2, 0.5 (-4+1) 1 = -1.5.
  const TimeSeries s{{0, 1, 3, 4}, {0, 2, -4, 1}, "N"};
  CHECK(measured("peak", s) == -4);
  CHECK(measured("time_of_peak", s) == 3);
  CHECK(measured("maximum", s) == 2);
  CHECK(measured("minimum", s) == -4);
  CHECK(measured("final", s) == 1);
  CHECK(measured("rise", s) == 2);
  CHECK(measured("impulse", s) == Approx(-2.5));
  CHECK(measured("mean", s) == Approx(-2.5 / 4));
  // Squares 0, 4, 16, 1: 2 + 20 + 8.5 = 30.5 over 4 s.
  CHECK(measured("rms", s) == Approx(std::sqrt(30.5 / 4)));
  // Sorted -4, 0, 1, 2: the median is 0.5, 75 % lies at index 2.25.
  CHECK(measured("percentile", s, 50) == Approx(0.5));
  CHECK(measured("percentile", s, 75) == Approx(1.25));
  CHECK(measured("percentile", s, 100) == 2);
  // t mean 2, y mean -0.25; sum dt dy = -2*0.25 - 1*2.25 + 1*-3.75 + 2*1.25 = -4, sum dt^2 = 10.
  CHECK(measured("slope", s) == Approx(-0.4));
}

TEST_CASE("measures: the largest mean over a width, by hand", "[study]") {
  // A triangle over 2 to 4 s, 3 high at 3 s, in unequal steps: over the middle second the mean is
  // 3 - 0.25 * 3. Windows begin or end at samples: [2.5, 3.5] begins at one.
  const TimeSeries s{{0, 2, 2.5, 3, 4, 6}, {0, 0, 1.5, 3, 0, 0}, "Pa"};
  StudyMeasure m{.name = "m", .kind = "largest_mean", .width = 1};
  CHECK(evaluate(m, s) == Approx(2.25).epsilon(1e-14));
  m.kind = "time_of_largest_mean";
  CHECK(evaluate(m, s) == Approx(3).epsilon(1e-14));
  CHECK(unit_of(m, "Pa") == "s");
  // The whole series: an area of 3 over 6 s. Nothing is wider.
  m.kind = "largest_mean";
  m.width = 6;
  CHECK(evaluate(m, s) == Approx(0.5).epsilon(1e-14));
  m.width = 7;
  CHECK(std::isnan(evaluate(m, s)));
}

TEST_CASE("measures: the sine of a period that fits best", "[study]") {
  TimeSeries s;
  s.unit = "Pa";
  for (int k = 0; k < 50; ++k) {
    const double t = 0.013 * k + 0.0001 * k * k;  // uneven, no whole number of periods
    s.t.push_back(t);
    s.y.push_back(7 + 2 * std::sin(5 * t - 0.4));
  }
  StudyMeasure m{.name = "m", .kind = "amplitude", .period = 2 * M_PI / 5};
  CHECK(evaluate(m, s) == Approx(2).epsilon(1e-10));
  CHECK(unit_of(m, "Pa") == "Pa");
  m.kind = "phase";
  CHECK(evaluate(m, s) == Approx(-0.4).epsilon(1e-10));
  CHECK(unit_of(m, "Pa") == "rad");
  m.kind = "midline";
  CHECK(evaluate(m, s) == Approx(7).epsilon(1e-10));
}

TEST_CASE("measures: when a level is reached", "[study]") {
  const TimeSeries s{{0, 1, 3, 4}, {0, 2, -4, 10}, "N"};
  StudyMeasure m{.name = "m", .kind = "arrival", .level = 0.5};
  CHECK(evaluate(m, s) == Approx(0.25));
  m.from = 3;
  CHECK(evaluate(m, s) == Approx(3 + 4.5 / 14));
  m.level = 11;
  CHECK(std::isnan(evaluate(m, s)));
  CHECK(unit_of(m, "N") == "s");
}

TEST_CASE("history: comments above the header are left out, and lines counted", "[study]") {
  const TemporaryFolder folder;
  const std::string head = "# from a book\n# two lines\ntime [s],a [kPa]\n";
  CHECK(read_time_series(write(folder, head + "0,1\n2,4\n"), "a").y == std::vector<double>{1, 4});
  CHECK_THROWS_WITH(read_time_series(write(folder, head + "0,1\n2,x\n"), "a"),
                    Catch::Contains("h.csv:5: 'x' is no number"));
}

TEST_CASE("measures: a window leaves out what is outside, and must hold something", "[study]") {
  const TimeSeries s{{0, 1, 3, 4}, {0, 2, -4, 1}, "N"};
  StudyMeasure m{.name = "p", .kind = "peak", .from = 0.5, .until = 1};
  CHECK(evaluate(m, s) == 2);
  m.from = m.until = 2;
  CHECK_THROWS_WITH(evaluate(m, s), "p: too few samples in its window");
}

TEST_CASE("distance: over common times, between samples linearly", "[study]") {
  const TimeSeries a{{0, 2}, {0, 2}, ""};                // y = t
  const TimeSeries b{{0, 1, 2, 3}, {1, 2, 3, 100}, ""};  // y = t + 1; the last is beyond a
  const Distance d = distance_of(a, b, 0);
  CHECK(d.rms == Approx(1));
  CHECK(d.range == 99);
  CHECK_THROWS(distance_of(a, {{5, 6}, {0, 0}, ""}, 0));
  // Where there is no value there is no difference.
  const double none = std::nan("");
  CHECK(distance_of({{0, 1, 2, 3}, {none, none, 5, 6}, ""}, {{0, 2, 3}, {9, 4, 5}, ""}, 0).rms ==
        Approx(1));
}

TEST_CASE("distance: the best shift in time is found", "[study]") {
  TimeSeries a;
  TimeSeries b;
  for (int k = 0; k <= 400; ++k) {
    const double t = 0.01 * k;
    a.t.push_back(t);
    b.t.push_back(t);
    a.y.push_back(std::exp(-10 * std::pow(t - 2.137, 2)));
    b.y.push_back(std::exp(-10 * std::pow(t - 2, 2)));
  }
  CHECK(distance_of(a, b, 0).rms > 0.1);
  const Distance d = distance_of(a, b, 0.5);
  CHECK(d.shift == Approx(0.137).margin(0.001));  // a tenth of the sampling
  CHECK(d.rms < 0.001);  // what linear interpolation leaves: h^2/8 y'' = 1e-4/8 * 20
}

TEST_CASE("measures: units", "[study]") {
  CHECK(unit_of({.kind = "impulse"}, "N") == "N s");
  CHECK(unit_of({.kind = "slope"}, "m") == "m/s");
  CHECK(unit_of({.kind = "time_of_peak"}, "Pa") == "s");
  CHECK(unit_of({.kind = "peak"}, "Pa") == "Pa");
}
