#include "study/study_axes.hpp"

#include <catch2/catch.hpp>

using namespace gannet;

TEST_CASE("axes: values are parted at commas outside of brackets", "[study]") {
  const StudyAxis axis = parse_axis("let.dx=8mm, 4 mm,a/20");
  CHECK(axis.key == "let.dx");
  CHECK(axis.values == std::vector<std::string>{"8mm", "4 mm", "a/20"});
  CHECK(parse_axis("parts.p.shape.plate.elements=[8, 8],[16, 16]").values ==
        std::vector<std::string>{"[8, 8]", "[16, 16]"});
  CHECK(parse_axis("effects.xsph=on,off").values == std::vector<std::string>{"on", "off"});
}

TEST_CASE("axes: what is no axis is refused", "[study]") {
  CHECK_THROWS_AS(parse_axis("let.dx"), std::invalid_argument);
  CHECK_THROWS_AS(parse_axis("=8mm"), std::invalid_argument);
  CHECK_THROWS_AS(parse_axis("let.dx=8mm,,4mm"), std::invalid_argument);
  CHECK_THROWS_WITH(parse_axis("let.dx=8mm,8mm"), "'8mm' stands twice");
}

TEST_CASE("axes: settings are all combinations, each with its overrides", "[study]") {
  const std::vector<StudyAxis> axes = {{"let.dx", {"2", "1"}}, {"effects.xsph", {"on", "off"}}};
  const auto all = combinations(axes);
  REQUIRE(all.size() == 4);
  CHECK(all[1] == std::vector<std::string>{"2", "off"});
  CHECK(overrides_of(axes, all[2]) == std::vector<std::string>{"let.dx=1", "effects.xsph=on"});
  CHECK(setting_text(axes, all[1]) == "dx = 2, xsph = off");
  CHECK(short_key(axes, "parts.plate.shape.plate.elements") == "plate.elements");
  CHECK(short_key({{"parts.a.sph.h", {}}, {"parts.b.sph.h", {}}}, "parts.a.sph.h") ==
        "parts.a.sph.h");
  CHECK(combinations({}).size() == 1);
}

TEST_CASE("axes: whole numbers count elements, others are sizes", "[study]") {
  CHECK(sizes_of({8, 16}) == std::vector<double>{1.0 / 8, 1.0 / 16});
  CHECK(sizes_of({0.02, 0.01}) == std::vector<double>{0.02, 0.01});
  CHECK(sizes_of({0.02, 0.02}).empty());
  CHECK(sizes_of({0.02, 0}).empty());
  CHECK(is_resolution("let.width", dim::length));
  CHECK(is_resolution("let.dx", dim::none));
  CHECK_FALSE(is_resolution("effects.xsph.epsilon", dim::none));
}
