#include "study/svg_plot.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <vector>

#include "support/well_formed.hpp"

using namespace gannet;

TEST_CASE("pictures: well-formed XML whatever the names are", "[study]") {
  Plot plot{"a < b & \"c\"",
            "it's",
            "x",
            "y",
            {{.label = "<&>", .x = {1, 2}, .y = {3, 4}, .tips = {"5 < 6", "&"}}}};
  const std::string svg = log_plot(plot);
  CHECK(why_not_well_formed(svg) == "");
  CHECK(svg.find("<&>") == std::string::npos);
  CHECK(why_not_well_formed(bar_plot("t & u", {"a", "b"}, {{"<r>", {0.1, -0.2}}})) == "");
}

TEST_CASE("pictures: even axes hold what is 0 and below, at its place", "[study]") {
  Plot plot{"t", "", "x", "y", {{.label = "", .x = {-1, 0, 1}, .y = {-2, 0, 2}, .markers = false}}};
  const std::string svg = even_plot(plot);
  CHECK(why_not_well_formed(svg) == "");
  CHECK(svg.find("nan") == std::string::npos);
  // The frame is 78 to 652 by 66 to 372, with a margin of 4 % of the values on either side.
  const double w = 574 / 1.08;
  const double h = 306 / 1.08;
  CHECK(svg.find(fmt::format("<polyline points=\"{:.1f},{:.1f} 365.0,219.0 {:.1f},{:.1f}\"",
                             365 - w / 2, 219 + h / 2, 365 + w / 2, 219 - h / 2)) !=
        std::string::npos);
  CHECK(svg.find(">0<") != std::string::npos);
  CHECK(svg.find(">-1<") != std::string::npos);
  // Of logarithmic ones only the last point is left, in the middle.
  CHECK(log_plot(plot).find("points=\"365.0,219.0\"") != std::string::npos);
  // A single value still has an axis.
  plot.series[0].x = {3};
  plot.series[0].y = {5};
  CHECK(even_plot(plot).find("nan") == std::string::npos);
}

TEST_CASE("pictures: a strip shows a dot a repeat, and a box from the percentiles", "[study]") {
  const std::string svg = strip_plot("a & b", "p [Pa]",
                                     {{"8 < 9", {10, 20, 30}, {12, 15, 20, 25, 28}},
                                      {"one alone", {15}, {15, 15, 15, 15, 15}},
                                      {"none", {}, {}}});
  CHECK(why_not_well_formed(svg) == "");
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++dots;
  }
  CHECK(dots == 4);
  CHECK(svg.find("width=\"36\"") == svg.rfind("width=\"36\""));  // one box: no box of one value
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("pictures: the check of well-formedness finds what is wrong", "[study]") {
  CHECK(why_not_well_formed("<a><b></a></b>") != "");
  CHECK(why_not_well_formed("<a>&</a>") != "");
  CHECK(why_not_well_formed("<a>") != "");
  CHECK(why_not_well_formed("<a b=\"1\"/>") == "");
}

TEST_CASE("pictures: points that logarithms cannot show are left out", "[study]") {
  Plot plot{"t", "", "x", "y", {{.x = {0, -1, 1, 10}, .y = {1, 1, 1, 2}}}};
  const std::string svg = log_plot(plot);
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++circles;
  }
  CHECK(circles == 2);
  CHECK(svg.find("nan") == std::string::npos);
  plot.series[0].y = {0, 0, 0, 0};
  CHECK(log_plot(plot).find("There is nothing to show") != std::string::npos);
}
