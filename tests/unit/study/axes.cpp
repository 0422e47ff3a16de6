#include "study/study_axes.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "study/study_analysis.hpp"
#include "study/study_short_keys.hpp"
#include "study/study_slurm.hpp"

using namespace gannet;

TEST_CASE("axes: values are parted at commas outside of brackets", "[study]") {
  const StudyAxis axis = parse_axis("let.dx=8mm, 4 mm,a/20");
  CHECK(axis.key == "let.dx");
  CHECK(axis.values == std::vector<std::string>{"8mm", "4 mm", "a/20"});
  CHECK(parse_axis("parts.p.shape.plate.elements=[8, 8],[16, 16]").values ==
        std::vector<std::string>{"[8, 8]", "[16, 16]"});
  CHECK(parse_axis("effects.xsph=on,off").values == std::vector<std::string>{"on", "off"});
}

namespace {

/// let: {dx, c0}, parts: {pool: {sph: {spacing}}, panel: {shell: {points (default)}}},
/// study: {dx}; the language also knows effects.time_step.scale and parts.*.shell.offset.
Value small_case() {
  const auto map = [](const std::string& name, std::vector<Value> children) {
    Value v{.name = name, .is_map = true};
    v.children = std::move(children);
    return v;
  };
  Value points{.name = "points", .given = false};
  return map("", {map("let", {{.name = "dx"}, {.name = "c0"}}),
                  map("parts", {map("pool", {map("sph", {{.name = "spacing"}, {.name = "c0"}})}),
                                map("panel", {map("shell", {points})})}),
                  map("study", {{.name = "dx"}})});
}

Key small_keys() {
  const auto map = [](const std::string& name, std::vector<Key> keys) {
    return Key{.name = name, .kind = Kind::map, .keys = std::move(keys)};
  };
  return map("", {map("let", {}), map("effects", {map("time_step", {{.name = "scale"}})}),
                  map("parts", {map("*", {map("shell", {{.name = "offset"}})})})});
}

}  // namespace

TEST_CASE("axes: the end of a key stands for the whole where one key has it", "[study]") {
  const auto whole = [](const std::string& name) {
    return whole_key(name, small_keys(), small_case());
  };
  CHECK(whole("dx") == "let.dx");  // the one under `study` does not count
  CHECK(whole("spacing") == "parts.pool.sph.spacing");
  CHECK(whole("pool.sph") == "parts.pool.sph");
  CHECK(whole("points") == "parts.panel.shell.points");          // a default of the case
  CHECK(whole("time_step.scale") == "effects.time_step.scale");  // in no place of the case
  CHECK(whole("panel.shell.offset") == "parts.panel.shell.offset");
  CHECK(whole("let.nothing") == "let.nothing");  // whole already
  CHECK(whole("pacing") == "pacing");            // half a name is none
  CHECK_THROWS_WITH(whole("c0"), Catch::Contains("let.c0 or parts.pool.sph.c0"));
  CHECK_THROWS_WITH(whole("offset"), Catch::Contains("panel") && Catch::Contains("pool"));
}

TEST_CASE("axes: a key that stands twice after its name is completed is refused", "[study]") {
  StudySpec spec;
  spec.axes = {{"dx", {"1"}}, {"let.dx", {"2"}}};
  spec.set = {"spacing=8 mm"};
  CHECK_THROWS_AS(complete_keys(small_keys(), small_case(), spec), InputError);
  CHECK(spec.set.front() == "parts.pool.sph.spacing=8 mm");
}

TEST_CASE("axes: words that a shell reads back as they were", "[study]") {
  CHECK(shell_word("let.dx=20mm") == "let.dx=20mm");
  CHECK(shell_word("let.dx=20 mm") == "'let.dx=20 mm'");
  CHECK(shell_word("a'b") == "'a'\\''b'");
  CHECK(shell_word("") == "''");
}

TEST_CASE("axes: quantiles lie linearly between samples", "[study]") {
  CHECK(quantile_of({4, 1, 3, 2}, 0.5) == 2.5);
  CHECK(quantile_of({0, 10}, 0.9) == Approx(9));
  CHECK(quantile_of({7}, 0.1) == 7);
  CHECK(std::isnan(quantile_of({}, 0.5)));
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
