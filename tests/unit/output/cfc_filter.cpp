#include "output/cfc_filter.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "output/files.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("CFC filter: gain of SAE J211 at every class, and no delay", "[output]") {
  for (const double cfc : {60.0, 180.0, 600.0, 1000.0}) {
    for (const double f : {0.2 * cfc, cfc, 1.65 * cfc, 2.0775 * cfc, 6 * cfc}) {
      const double dt = 1 / (40 * cfc);
      std::vector<double> x(4000);
      for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] = std::sin(2 * std::numbers::pi * f * dt * static_cast<double>(k));
      }
      std::vector<double> y = x;
      cfc_filter(y, cfc, dt);
      const double ratio =
          std::tan(std::numbers::pi * f * dt) / std::tan(std::numbers::pi * 2.0775 * cfc * dt);
      const double gain = 1 / (1 + std::pow(ratio, 4));
      double worst = 0;
      for (std::size_t k = 1000; k < 3000; ++k) {
        worst = std::max(worst, std::abs(y[k] - gain * x[k]));
      }
      CHECK(worst < 1e-9);
      // The corridor of the standard: within 0.5 dB up to the class, -3 dB at 1.65 of it.
      if (f <= cfc) CHECK(gain > 0.94);
      if (f == 1.65 * cfc) CHECK(20 * std::log10(gain) == Approx(-3).margin(0.2));
    }
  }
}

TEST_CASE("CFC filter: gain by hand at 0.1, 1 and 5 times the corner", "[output]") {
  // 1/(1 + r^4), r = tan(pi f dt)/tan(pi f_d dt), f_d = 2.0775 * 100 Hz, dt = 1/4000 s.
  const std::vector<std::pair<double, double>> expected{
      {0.1, 0.9999034840}, {1, 0.5}, {5, 5.754162485e-4}};
  for (const auto& [times, gain] : expected) {
    std::vector<double> x(8000);
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = std::sin(2 * std::numbers::pi * times * 207.75 * static_cast<double>(k) / 4000);
    }
    std::vector<double> y = x;
    cfc_filter(y, 100, 1.0 / 4000);
    double worst = 0;  // of gain and phase alike: the phase is zero
    for (std::size_t k = 2000; k < 6000; ++k) worst = std::max(worst, std::abs(y[k] - gain * x[k]));
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("CFC filter: straight lines stay as they are, up to both ends", "[output]") {
  std::vector<double> x(200);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = 3 - 0.5 * static_cast<double>(k);
  std::vector<double> y = x;
  cfc_filter(y, 100, 1e-4);
  double worst = 0;
  for (std::size_t k = 0; k < x.size(); ++k) worst = std::max(worst, std::abs(y[k] - x[k]));
  CHECK(worst < 2e-3);  // what the filter still remembers of the start of the padding
  std::vector<double> one{4};
  cfc_filter(one, 100, 1e-4);
  CHECK(one[0] == 4);
}

TEST_CASE("CFC filter: a table beside the history, at equal intervals", "[output]") {
  const EmptyFolder folder("filtered");
  RunRecord record;
  record.folder = folder.path;
  record.plan.history.interval = 0.25e-3;
  record.filters = {{"keel", 60}, {"not_there", 60}};
  fs::create_directories(folder.path + "/history");
  std::string text = "time [s],keel x [Pa],keel y [Pa]\n";
  for (int k = 0; k <= 100; ++k) {
    const double t = 0.25e-3 * k + (k % 2 == 1 && k < 99 ? 1e-5 : 0);  // lines are a little late
    text += std::to_string(t) + "," + std::to_string(4e3 * t) + ",7\n";
  }
  write_whole_file(folder.path + "/history/keel.csv", text);
  write_filtered_histories(record);
  const std::string filtered = read_file(folder.path + "/history/keel_filtered.csv");
  CHECK(filtered.starts_with("time [s],keel x [Pa],keel y [Pa]\n0,"));
  CHECK(std::count(filtered.begin(), filtered.end(), '\n') == 102);
  CHECK(filtered.find("\n0.00025,") != std::string::npos);
  CHECK_FALSE(fs::exists(folder.path + "/history/not_there_filtered.csv"));
  write_filtered_histories(record);  // again: the same bytes
  CHECK(read_file(folder.path + "/history/keel_filtered.csv") == filtered);
}
