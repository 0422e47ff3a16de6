#include "contact/tie_buffer.hpp"

#include <catch2/catch.hpp>

using namespace gannet;

TEST_CASE("ties: layers of elements behind the nodes that are tied", "[contact]") {
  Part part;  // three quads in a row, and one beside the middle one; nodes from 10 on
  part.cell = Cell::quad;
  part.nodes = {10, 20};
  for (const Index k : {0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 5, 6, 9, 8}) {
    part.connectivity.push_back(10 + k);
  }
  constexpr int many = 99;
  CHECK(layers_from(part, {}, many) == 0);
  CHECK(layers_from(part, {10, 14}, many) == 3);          // the left end
  CHECK(layers_from(part, {10, 11, 12, 13}, many) == 2);  // the lower side
  CHECK(layers_from(part, {11, 15}, many) == 2);
  CHECK(layers_from(part, {10, 14}, 2) == 2);  // no further than is asked for
  CHECK(layers_from(part, {10, 14}, 3) == 3);
}
