#include "input/case.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "input/resolved.hpp"
#include "small_language.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

const char* const text = R"(gannet: 1
title: A plate
let: {V: 6 m/s, dx: 10 mm, h: "1.2*dx"}

materials:
  skin: {density: 2.7 g/cm^3, young: 70 GPa, poisson: 0.33}
  water: {density: 1000, c0: auto}
parts:
  panel:
    shell: {material: skin, thickness: 3 mm, points: 3}   # a comment
    velocity: [0, 0, "-V"]
  pool:
    sph: {material: water, spacing: h}
boundaries:
  edges:
    velocity: [free, free, "-V", {at: 0.5 m, between: [panel, pool]}]
    fix: rx
    planes: {x: [-0.5 m, 0.5 m]}
contacts: {slam: {between: [panel, pool]}}
effects: {xsph: }
)";

}  // namespace

TEST_CASE("case: values are SI, formulas worked out, defaults filled in", "[input]") {
  const auto c = read(text);
  const Keys root = c->keys();
  CHECK(c->title == "A plate");
  CHECK(c->folder == "tests");
  CHECK(root.map("let").number("h") == Approx(0.012).epsilon(1e-15));
  const Keys shell = root.map("parts").map("panel").map("shell");
  CHECK(shell.path() == "parts.panel.shell");
  CHECK(shell.number("thickness") == 0.003);
  CHECK(shell.integer("points") == 3);
  CHECK(shell.word("material") == "skin");
  CHECK(shell.word("formulation") == "belytschko_lin_tsay");
  CHECK_FALSE(shell.given("formulation"));
  CHECK(root.map("parts").names() == std::vector<std::string>{"panel", "pool"});
  CHECK(root.map("parts").map("panel").vector("velocity") == Vec3(0, 0, -6));
  CHECK(root.map("materials").map("water").word("c0") == "auto");
  CHECK(root.map("materials").map("water").number_or("c0", 42) == 42);
  CHECK(root.map("materials").map("skin").number("density") == 2700);
  CHECK(root.map("boundaries").map("edges").words("fix") == std::vector<std::string>{"rx"});
  CHECK(root.map("boundaries").map("edges").map("planes").numbers("x") ==
        std::vector<double>{-0.5, 0.5});
}

TEST_CASE("case: a map without a value takes the defaults, an absent one stays absent", "[input]") {
  const auto c = read(text);
  const Keys xsph = c->keys().map("effects").map("xsph");
  CHECK(xsph.number("epsilon") == 0.5);
  CHECK(xsph.flag("on"));
  const auto without = read("gannet: 1\n");
  CHECK_FALSE(without->keys().has("effects"));
  CHECK(without->title == "a");
}

TEST_CASE("case: every value knows its place; a default that of its map", "[input]") {
  const auto c = read(text);
  const Keys shell = c->keys().map("parts").map("panel").map("shell");
  CHECK(shell.where().text() == "tests/a.yaml:10:5");
  CHECK(shell.where("thickness").text() == "tests/a.yaml:10:40");
  CHECK(shell.where("formulation").text() == "tests/a.yaml:10:5");
  CHECK(c->keys().map("parts").where("panel").text() == "tests/a.yaml:9:3");
}

TEST_CASE("case: mixed lists are kept, with numbers where they parse", "[input]") {
  const auto c = read(text);
  const Keys edges = c->keys().map("boundaries").map("edges");
  const Value& list = edges.value("velocity");
  REQUIRE(list.is_list);
  REQUIRE(list.children.size() == 4);
  CHECK(list.children[0].words == std::vector<std::string>{"free"});
  CHECK(list.children[0].numbers.empty());
  CHECK(list.children[0].where.text() == "tests/a.yaml:16:16");
  CHECK(edges.quantity(list.children[2], dim::velocity) == -6);
  REQUIRE(list.children[3].is_map);
  CHECK(list.children[3].children[0].path == "boundaries.edges.velocity.at");
  CHECK(list.children[3].children[0].numbers == std::vector<double>{0.5});
  CHECK(list.children[3].children[1].children[1].words == std::vector<std::string>{"pool"});
  CHECK(c->mistakes.empty());
  CHECK(edges.quantity(list.children[2], dim::length) == 0);
  CHECK(c->mistakes.messages().at(0) ==
        "tests/a.yaml:16:28: boundaries.edges.velocity: '-V' is a velocity; a length is wanted "
        "(m, mm, ft, ...)");
}

TEST_CASE("case: the hash sees values, not comments, white space or units", "[input]") {
  const std::string base = "gannet: 1\nlet: {a: 3 mm}\neffects: {xsph: {epsilon: 0.25}}\n";
  const std::string other =
      "# why\ngannet: 1\n\nlet:\n  a: 0.3 cm   # how\neffects:\n  xsph:\n    epsilon: 25 %\n";
  CHECK(read(base)->hash == read(other)->hash);
  CHECK(read(base)->hash != read(base, {"let.a=4mm"})->hash);
  CHECK(read(base)->hash == read(base, {"effects.xsph.on=true"})->hash);  // the default
  CHECK(read(base)->hash != read(base, {"effects.xsph.on=no"})->hash);
}

TEST_CASE("case: FNV-1a of known texts", "[input]") {
  // Test vectors of the algorithm's authors: "" and "a" and "foobar".
  CHECK(fnv1a("") == 0xcbf29ce484222325ULL);
  CHECK(fnv1a("a") == 0xaf63dc4c8601ec8cULL);
  CHECK(fnv1a("foobar") == 0x85944171f73967e8ULL);
}

TEST_CASE("case: the resolved text reads back into the same case", "[input]") {
  const auto c = read(text);
  const auto again = read(c->resolved);
  CHECK(again->resolved == c->resolved);
  CHECK(again->hash == c->hash);
  CHECK(c->resolved.find("      thickness: 0.003 m\n") != std::string::npos);
  CHECK(c->resolved.find("      points: 3\n") != std::string::npos);
  CHECK(
      c->resolved.find("    velocity: [free, free, -6 m/s, {at: 0.5 m, between: [panel, pool]}]") !=
      std::string::npos);
  CHECK(resolved_text(c->root, {"title", "parts"}).find("panel:") == std::string::npos);
}

TEST_CASE("case: texts with quotes, colons and lines survive the round trip", "[input]") {
  const auto c = read("gannet: 1\ntitle: \"a: \\\"b\\\" # \\\\ \\n c\"\n");
  CHECK(c->title == "a: \"b\" # \\ \n c");
  CHECK(read(c->resolved)->title == c->title);
}

TEST_CASE("case: paths are taken from the folder of the case file", "[input]") {
  const auto folder = std::filesystem::temp_directory_path() / "gannet_test_case";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "hull.msh") << "x";
  std::ofstream(folder / "case.yaml") << "gannet: 1\nparts: {hull: {mesh: hull.msh}}\n";
  const auto c = read_case((folder / "case.yaml").string(), small_language());
  CHECK(c->keys().map("parts").map("hull").word("mesh") == (folder / "hull.msh").string());
  CHECK(c->resolved.find("mesh: hull.msh") != std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST_CASE("case: a missing file, a folder and an empty file are told apart", "[input]") {
  CHECK_THROWS_WITH(read_case("no/such.yaml", {}), "no/such.yaml: no such file");
  CHECK_THROWS_WITH(read_case("/tmp", {}), "/tmp: is not a file");
  CHECK(mistakes_in("# nothing\n") ==
        "tests/a.yaml:1:1: the file is empty; a case starts with 'gannet: 1'");
}

TEST_CASE("case: tables that contradict each other are a fault of the program", "[input]") {
  const Schema two = {{"effects", {.name = "a", .unit = dim::length}},
                      {"effects", {.name = "a", .unit = dim::time}}};
  CHECK_THROWS_AS(read_case_text("gannet: 1", "a.yaml", two), std::logic_error);
}

TEST_CASE("case: choices of one key from several tables are joined", "[input]") {
  const Schema two = {{"effects", {.name = "a", .kind = Kind::choice, .choices = {"one"}}},
                      {"effects", {.name = "a", .kind = Kind::choice, .choices = {"two"}}}};
  CHECK(read_case_text("gannet: 1\neffects: {a: two}", "a.yaml", two)
            ->keys()
            .map("effects")
            .word("a") == "two");
}
