#include "gannet/embedded_run.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

using gannet::EmbeddedRun;

TEST_CASE("embedding: a case advances and can be looked at from another program", "[app]") {
  EmbeddedRun run("cases/plate_step_pressure/case.yaml",
                  {"parts.plate.shape.plate.elements=[8, 8]"});
  CHECK(run.parts() == std::vector<std::string>{"plate"});
  const std::vector<double> start = run.positions("plate");
  REQUIRE(start.size() == 3 * 81);
  CHECK(run.ids("plate").size() == 81);
  CHECK(run.last_step() == 0);
  for (int k = 0; k < 20; ++k) run.advance();
  CHECK(run.steps() == 20);
  CHECK(run.time() == Approx(20 * run.last_step()));
  // The pressure on the front (where z points) pushes the free nodes down; the edge is held.
  const std::vector<double> later = run.positions("plate");
  double lowest = 0;
  for (std::size_t k = 2; k < later.size(); k += 3) lowest = std::min(lowest, later[k] - start[k]);
  CHECK(lowest < 0);
  CHECK(run.measure("probe.centre").size() == 3);
  CHECK_THROWS_AS(run.measure("probe.nothing"), std::invalid_argument);
  CHECK_THROWS_AS(run.positions("nothing"), std::invalid_argument);
}
