#include "base/keys.hpp"

#include <catch2/catch.hpp>

using namespace gannet;

namespace {

Value scalar(const std::string& name, double number, int line) {
  Value v;
  v.name = name;
  v.path = "part." + name;
  v.where = {"a.yaml", line, 3};
  v.kind = Kind::number;
  v.numbers = {number};
  return v;
}

Value map_value() {
  Value map;
  map.name = map.path = "part";
  map.where = {"a.yaml", 4, 1};
  map.kind = Kind::map;
  map.is_map = true;
  map.children = {scalar("b", 2, 5), scalar("a", 1.5, 6)};
  map.children[1].given = false;
  Value word = scalar("mode", 0, 7);
  word.numbers.clear();
  word.words = {"auto"};
  map.children.push_back(word);
  return map;
}

}  // namespace

TEST_CASE("keys: values, defaults and words of a map", "[base]") {
  const Value map = map_value();
  Mistakes mistakes;
  const Keys keys(map, mistakes);
  CHECK(keys.number("b") == 2);
  CHECK(keys.given("b"));
  CHECK(keys.has("a"));
  CHECK_FALSE(keys.given("a"));
  CHECK_FALSE(keys.has("c"));
  CHECK(keys.number_or("c", 7) == 7);
  CHECK(keys.number_or("mode", 7) == 7);
  CHECK(keys.word("mode") == "auto");
  CHECK(keys.word("b").empty());
  CHECK(keys.names() == std::vector<std::string>{"b", "a", "mode"});
  CHECK(keys.map("sub").names().empty());
  CHECK(keys.where("b").text() == "a.yaml:5:3");
  CHECK(keys.where("c").text() == "a.yaml:4:1");
}

TEST_CASE("keys: asking for what is not there throws with the place of the map", "[base]") {
  const Value map = map_value();
  Mistakes mistakes;
  const Keys keys(map, mistakes);
  CHECK_THROWS_WITH(keys.number("c"), "a.yaml:4:1: part.c: missing; a value is wanted here");
  CHECK_THROWS_AS(keys.vector("b"), InputError);
  CHECK_THROWS_AS(keys.map("b"), InputError);
}

TEST_CASE("mistakes: all are listed once, by file and place", "[base]") {
  const Value map = map_value();
  Mistakes mistakes;
  const Keys keys(map, mistakes);
  mistakes.throw_if_any();
  keys.complain("a", "later");
  keys.complain("b", "earlier");
  keys.complain("b", "earlier");
  keys.complain("", "the map");
  mistakes.add({"0.yaml", 90, 1}, "other file");
  CHECK_FALSE(mistakes.empty());
  CHECK_THROWS_WITH(mistakes.throw_if_any(),
                    "0.yaml:90:1: other file\n"
                    "a.yaml:4:1: part: the map\n"
                    "a.yaml:5:3: part.b: earlier\n"
                    "a.yaml:6:3: part.a: later");
}

TEST_CASE("keys: a kept number is checked against what its owner wants", "[base]") {
  Mistakes mistakes;
  const Value map = map_value();
  const Keys keys(map, mistakes);
  Value item = scalar("x", 0.5, 9);
  item.kind = Kind::any;
  CHECK(keys.quantity(item, dim::length) == 0.5);
  item.bare = false;
  item.dimension = dim::length;
  item.text = "0.5 m";
  CHECK(keys.quantity(item, dim::length) == 0.5);
  CHECK(mistakes.empty());
  CHECK(keys.quantity(item, dim::time) == 0);
  item.numbers.clear();
  item.trouble = "'free' is not a number";
  CHECK(keys.quantity(item, dim::length) == 0);
  CHECK_THROWS_WITH(mistakes.throw_if_any(),
                    "a.yaml:9:3: part.x: '0.5 m' is a length; a time is wanted (s, ms, us, ...)\n"
                    "a.yaml:9:3: part.x: 'free' is not a number; a length is wanted (m, mm, ft, "
                    "...)");
}
