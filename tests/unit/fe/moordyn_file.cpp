#include "fe/moordyn_file.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace gannet;

namespace {

const std::string second_version =
    R"(--------------------- MoorDyn Input File ------------------------------------
A chain and a rope
----------------------- LINE TYPES ------------------------------------------
TypeName   Diam    Mass/m     EA         BA/-zeta    EI     Cd     Ca     CdAx    CaAx
(name)     (m)     (kg/m)     (N)        (N-s/-)     (N-m^2) (-)   (-)    (-)     (-)
chain      0.252   390        1.674e9    -0.8        0      1.37   1.0    0.64    0.1
rope       0.1     7          5e7        2.5e6       0      1.6    0.9    0.0     0.0
---------------------- POINTS -----------------------------------------------
ID  Attachment  X     Y     Z      M      V      CdA    CA
(#) (word/ID)   (m)   (m)   (m)    (kg)   (m^3)  (m^2)  (-)
1   Fixed       400   0     -50    0      0      0      0
2   Coupled     0     0     0      0      0      0      0
---------------------- LINES ------------------------------------------------
ID  LineType  AttachA  AttachB  UnstrLen  NumSegs  Outputs
(#) (name)    (ID)     (ID)     (m)       (-)      (-)
1   chain     1        2        410       20       p
7   rope      2        1        405       10       -
---------------------- OPTIONS ----------------------------------------------
0.001    dtM           time step
9.81     g             gravity
1000     rhoW          water density
50       WtrDpth       depth
1e5      kBot          bottom stiffness
1e4      cBot          bottom damping
0.5      FrictionCoefficient
---------------------- OUTPUTS ----------------------------------------------
FairTen1
------------------------- END -----------------------------------------------
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("moordyn file: types, points, lines and options of version 2", "[fe]") {
  const MoorDynFile file = read_moordyn(second_version, "lines.txt", true);
  REQUIRE(file.mistakes.empty());
  REQUIRE(file.lines.size() == 2);
  CHECK(file.g == 9.81);
  const MooringLine& chain = file.lines[0];
  CHECK(chain.name == "line_1");
  CHECK(chain.n == 20);
  CHECK(chain.length == 410);
  CHECK(chain.diameter == 0.252);
  CHECK(chain.block.EA == 1.674e9);
  CHECK(chain.block.mu == 390);
  CHECK(chain.block.damping_ratio == 0.8);
  CHECK(chain.ends[0].at == Vec3(400, 0, -50));
  CHECK(chain.ends[1].at == Vec3(0, 0, 0));
  CHECK(chain.water.density == 1000);
  CHECK(chain.water.Cdn == 1.37);
  CHECK(chain.water.Cdt == 0.64);
  CHECK(chain.water.Cat == 0.1);
  CHECK(chain.bed.level == -50);
  CHECK(chain.bed.stiffness == 1e5);
  CHECK(chain.bed.friction == 0.5);
  const MooringLine& rope = file.lines[1];  // written from the vessel to the anchor
  CHECK(rope.name == "line_7");
  CHECK(rope.ends[0].at == Vec3(400, 0, -50));
  CHECK(rope.block.damping_time == Approx(0.05));  // BA/EA
  CHECK(rope.ends[1].held);
  CHECK_FALSE(read_moordyn(second_version, "lines.txt", false).lines[1].ends[1].held);
}

TEST_CASE("moordyn file: the columns of version 1", "[fe]") {
  const MoorDynFile file = read_moordyn(R"(a mooring
---------------------- LINE DICTIONARY -----------------------
LineType  Diam   MassDenInAir   EA       BA/-zeta  Can  Cat  Cdn  Cdt
(-)       (m)    (kg/m)         (N)      (Pa-s/-)  (-)  (-)  (-)  (-)
main      0.09   77.7066        384.243E6  -0.8    1.0  0.0  1.6  0.1
---------------------- NODE PROPERTIES -----------------------
Node  Type    X       Y    Z      M  V  FX  FY  FZ  CdA  CA
(-)   (-)     (m)     (m)  (m)    (kg) (m^3) (kN) (kN) (kN) (m^2) (-)
1     Fix     853.87  0    -320.0 0  0  0   0   0   0    0
2     Vessel  5.2     0    -70.0  0  0  0   0   0   0    0
---------------------- LINE PROPERTIES -----------------------
Line  LineType  UnstrLen  NumSegs  NodeAnch  NodeFair  Flags/Outputs
(-)   (-)       (m)       (-)      (-)       (-)       (-)
1     main      902.2     20       1         2         p
---------------------- SOLVER OPTIONS ------------------------
0.001  dtM
)",
                                        "lines.txt", true);
  REQUIRE(file.mistakes.empty());
  REQUIRE(file.lines.size() == 1);
  CHECK(file.lines[0].water.Cdn == 1.6);
  CHECK(file.lines[0].water.Can == 1);
  CHECK(file.lines[0].water.density == 1025);
  CHECK(file.lines[0].bed.level == -320);  // the lowest point
  CHECK(file.lines[0].bed.stiffness == 3e6);
}

TEST_CASE("moordyn file: what is not supported is told with its line", "[fe]") {
  const auto mistake = [](const std::string& from, const std::string& to) {
    const MoorDynFile file = read_moordyn(replaced(second_version, from, to), "lines.txt", true);
    CHECK(file.lines.empty());
    return file.mistakes.empty() ? std::string("none") : file.mistakes.front();
  };
  CHECK(mistake("2   Coupled", "2   Free   ") ==
        "lines.txt:12: points of the kind 'free' are not supported: Fixed, Coupled or Vessel is "
        "wanted");
  CHECK(mistake("-0.8        0 ", "-0.8        9 ") ==
        "lines.txt:6: bending stiffness (EI) is not supported: 0 is wanted");
  CHECK(mistake("1   chain ", "1   chian ") ==
        "lines.txt:16: line 1 has a type or a point that is not there");
  CHECK(mistake("390 ", "39O ") == "lines.txt:6: '39O' is not a number (massden)");
  CHECK(mistake("Mass/m", "Gewicht") == "lines.txt:6: there is no column 'massden'");
  CHECK(read_moordyn("nothing", "lines.txt", true).mistakes.front() ==
        "lines.txt:1: there are no lines in it");
}
