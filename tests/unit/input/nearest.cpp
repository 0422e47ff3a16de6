#include "input/nearest.hpp"

#include <catch2/catch.hpp>

using namespace gannet;

TEST_CASE("nearest: distance counts inserted, deleted, replaced and swapped letters", "[input]") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("thickness", "thickness") == 0);
  CHECK(edit_distance("thicknes", "thickness") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("fiel", "file") == 1);
  CHECK(edit_distance("file", "fiel") == 1);
}

TEST_CASE("nearest: finds a mistyped word, and none where none is near", "[input]") {
  const std::vector<std::string> known = {"material", "thickness", "points", "x"};
  CHECK(nearest("thicknes", known) == "thickness");
  CHECK(nearest("mateiral", known) == "material");
  CHECK(nearest("colour", known).empty());
  CHECK(nearest("y", known).empty());
  CHECK(did_you_mean("point", known) == "; did you mean 'points'?");
  CHECK(comma_list({}) == "none");
  CHECK(comma_list({"a", "b"}) == "a, b");
}
