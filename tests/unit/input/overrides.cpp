#include <catch2/catch.hpp>

#include "small_language.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {
const std::string pool_case =
    "gannet: 1\n"
    "let: {dx: 10 mm, h: 2*dx}\n"
    "materials: {water: {density: 1000}}\n"
    "parts: {pool: {sph: {material: water, spacing: h}}}\n";
}

TEST_CASE("override: a value replaces that of the file, and what rests on it follows", "[input]") {
  const auto c = read(pool_case, {"let.dx=8mm"});
  CHECK(c->keys().map("parts").map("pool").map("sph").number("spacing") ==
        Approx(0.016).epsilon(1e-15));
}

TEST_CASE("override: keys that the file does not have are added; lists are YAML", "[input]") {
  const auto c =
      read(pool_case, {"effects.xsph.epsilon=0.25", "parts.pool.velocity=[0, 0, -2 m/s]"});
  CHECK(c->keys().map("effects").map("xsph").number("epsilon") == 0.25);
  CHECK(c->keys().map("parts").map("pool").vector("velocity") == Vec3(0, 0, -2));
}

TEST_CASE("override: off takes a map out of the case, on keeps it or makes one", "[input]") {
  CHECK_FALSE(read(pool_case, {"effects.xsph=off"})->keys().map("effects").given("xsph"));
  CHECK_FALSE(read(pool_case, {"effects=off"})->keys().given("effects"));
  const auto kept = read(pool_case, {"effects.xsph.epsilon=0.25", "effects.xsph=on"});
  CHECK(kept->keys().map("effects").map("xsph").number("epsilon") == 0.25);
  CHECK(
      read(pool_case, {"effects.xsph=off", "effects.xsph=on"})->keys().map("effects").has("xsph"));
  CHECK(read(pool_case, {"effects.xsph=off"})->hash != read(pool_case, {"effects.xsph=on"})->hash);
}

TEST_CASE("override: a mistake names the option", "[input]") {
  CHECK(mistakes_in(pool_case, {"let.dx=8 mss"}) ==
        "--set let.dx=8 mss: let.dx: '8 mss': unknown unit 'mss'");
  CHECK(mistakes_in(pool_case, {"effects.xsph.epsilon=2"}) ==
        "--set effects.xsph.epsilon=2: effects.xsph.epsilon: '2' = 2 [-], must lie in [0, 1]");
  CHECK(mistakes_in(pool_case, {"efects.xsph.epsilon=2"})
            .find("--set efects.xsph.epsilon=2: efects: unknown key; did you mean 'effects'") == 0);
  CHECK(mistakes_in(pool_case, {"let.dxx=1"}) ==
        "--set let.dxx=1: the case has no 'dxx' under 'let'; did you mean 'dx'? (there: dx, h)");
  CHECK(mistakes_in(pool_case, {"parts.pol.sph.spacing=1"}) ==
        "--set parts.pol.sph.spacing=1: the case has no 'pol' under 'parts'; did you mean 'pool'? "
        "(there: pool)");
  CHECK(mistakes_in(pool_case, {"let.dx"}) ==
        "--set let.dx: key.path=value is wanted, such as let.dx=8mm");
  CHECK(mistakes_in(pool_case, {"let..dx=1"}) ==
        "--set let..dx=1: key.path=value is wanted, such as let.dx=8mm");
  CHECK(mistakes_in(pool_case, {"gannet=2"}) ==
        "--set gannet=2: gannet: the version belongs to the file and cannot be set");
  CHECK(mistakes_in(pool_case, {"let.dx.a=2"}) ==
        "--set let.dx.a=2: 'dx' is not a map; it has no 'a'");
  CHECK(mistakes_in(pool_case, {"let.dx=[1"}).find("--set let.dx=[1: this is not YAML: ") == 0);
}
