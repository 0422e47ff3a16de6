// Every kind of mistake in a case file, and exactly what the user is told.
#include <catch2/catch.hpp>

#include "small_language.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

/// What is said about one line that stands behind a version, two materials and a part.
std::string mistakes_with(const std::string& lines) {
  return mistakes_in(
      "gannet: 1\n"
      "let: {dx: 10 mm, V: 6 m/s}\n"
      "materials: {skin: {density: 2700}, water: {density: 1000}}\n" +
      lines);
}

}  // namespace

TEST_CASE("mistake: the version is missing, not first, or another", "[input]") {
  CHECK(mistakes_in("title: x\n") ==
        "tests/a.yaml:1:1: gannet: missing; a case starts with 'gannet: 1'");
  CHECK(mistakes_in("title: x\ngannet: 1\n") ==
        "tests/a.yaml:2:1: gannet: must be the first key of the file");
  CHECK(mistakes_in("gannet: 2\n") ==
        "tests/a.yaml:1:9: gannet: '2' is not a version of the case language that this program "
        "reads; it reads 1");
}

TEST_CASE("mistake: the file is no map or no YAML", "[input]") {
  CHECK(mistakes_in("- a\n- b\n") ==
        "tests/a.yaml:1:1: a case is a map of keys, the first 'gannet: 1'");
  CHECK(mistakes_in("gannet: 1\nlet: {a: [1, 2}\n").find("tests/a.yaml:2:15: this is not YAML: ") ==
        0);
  CHECK(mistakes_in("gannet: 1\nlet:\n\ta: 1\n").find("tests/a.yaml:3:3: this is not YAML: ") == 0);
  CHECK(mistakes_in("gannet: 1\ntitle: 'it''s\nlet: {a: 1}\n") ==
        "tests/a.yaml:2:8: this is not YAML: the quote that starts here is not closed");
  CHECK(mistakes_in("gannet: 1\ntitle: \"a \\\"\n") ==
        "tests/a.yaml:2:8: this is not YAML: the quote that starts here is not closed");
  CHECK(mistakes_in("\xef\xbb\xbfgannet: 1\r\ntitle: 'it''s \"so\"'\r\n").empty());
  CHECK(
      mistakes_in("gannet: 1\n---\ngannet: 1\n").find("a second YAML document (---) is not read") !=
      std::string::npos);
}

TEST_CASE("mistake: YAML that would be dropped without a word", "[input]") {
  CHECK(mistakes_with("parts:\n  a: &x {velocity: [0, 0, 0]}\n  b: *x\n") ==
        "tests/a.yaml:6:6: aliases (*name) are not read; write the value out, or use 'let'");
  CHECK(mistakes_with("parts:\n  a: {<<: {velocity: [0, 0, 0]}}\n") ==
        "tests/a.yaml:5:7: merge keys (<<) are not read; write the keys out");
  CHECK(mistakes_with("parts:\n  ? [a, b]\n  : {velocity: [0, 0, 0]}\n") ==
        "tests/a.yaml:5:5: a key must be a word");
}

TEST_CASE("mistake: an unknown key names the nearest and lists the allowed", "[input]") {
  CHECK(mistakes_with("parts: {p: {shell: {material: skin, thickness: 3 mm, point: 3}}}\n") ==
        "tests/a.yaml:4:54: parts.p.shell.point: unknown key; did you mean 'points' (whole number, "
        "in [1, 9])? Allowed here: material, thickness, points, formulation");
  CHECK(mistakes_with("colour: red\n") ==
        "tests/a.yaml:4:1: colour: unknown key; allowed here: gannet, title, let, curves, "
        "materials, parts, "
        "contacts, boundaries, loads, effects");
  CHECK(mistakes_with("effects: {xsph: {epsilonn: 1}}\n") ==
        "tests/a.yaml:4:18: effects.xsph.epsilonn: unknown key; did you mean 'epsilon' (plain "
        "number, in [0, 1])? Allowed here: epsilon, on");
}

TEST_CASE("mistake: a misspelt key among names of the user's", "[input]") {
  CHECK(mistakes_with("loads: {gravty: [0, 0, -9.81], push: {pressure: 1 bar}}\n") ==
        "tests/a.yaml:4:9: loads.gravty: unknown key; did you mean 'gravity' ([x, y, z], each an "
        "acceleration)? Allowed here: gravity, and names of your own");
  CHECK(mistakes_with("loads: {push: 3}\n") ==
        "tests/a.yaml:4:15: loads.push: '3' is not a map; a map of pressure is wanted");
}

TEST_CASE("mistake: a key that is set aside is not built yet", "[input]") {
  CHECK(mistakes_with("moorings: {a: {from: b}}\n") ==
        "tests/a.yaml:4:1: moorings: not built yet; the key is set aside for a later version");
}

TEST_CASE("mistake: a required key is missing", "[input]") {
  CHECK(mistakes_with("parts:\n  p:\n    shell: {material: skin}\n") ==
        "tests/a.yaml:6:5: parts.p.shell.thickness: missing; a length is wanted (m, mm, ft, ...): "
        "of the sheet");
}

TEST_CASE("mistake: wrong unit, wrong kind, no value", "[input]") {
  const auto shell = [](const std::string& keys) {
    return mistakes_with("parts: {p: {shell: {material: skin, " + keys + "}}}\n");
  };
  const std::string at = "tests/a.yaml:4:48: parts.p.shell.thickness: ";
  CHECK(shell("thickness: 0.5 s") == at + "'0.5 s' is a time; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: V") == at + "'V' is a velocity; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: 3 mss") ==
        at + "'3 mss': unknown unit 'mss'; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: thin") ==
        at + "'thin' is not a number; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: .nan") ==
        at + "'.nan' is not a number; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: [1]") == at + "a list stands here; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: dxx") ==
        at + "'dxx' is not a number; a length is wanted (m, mm, ft, ...); did you mean 'dx'?");
  CHECK(
      shell("thickness: ") ==
      "tests/a.yaml:4:37: parts.p.shell.thickness: no value; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: ''") == at + "no value; a length is wanted (m, mm, ft, ...)");
  CHECK(shell("thickness: 1 mm, points: 2.5") ==
        "tests/a.yaml:4:62: parts.p.shell.points: '2.5' is not a whole number");
  CHECK(shell("thickness: 1 mm, formulation: hughes_lui") ==
        "tests/a.yaml:4:67: parts.p.shell.formulation: unknown word 'hughes_lui'; did you mean "
        "'hughes_liu'? allowed: belytschko_lin_tsay, hughes_liu");
}

TEST_CASE("mistake: out of range, with the value in SI and what is allowed", "[input]") {
  CHECK(mistakes_with("effects: {xsph: {epsilon: 1.5}}\n") ==
        "tests/a.yaml:4:27: effects.xsph.epsilon: '1.5' = 1.5 [-], must lie in [0, 1]");
  CHECK(mistakes_with("parts: {p: {shell: {material: skin, thickness: -3 mm}}}\n") ==
        "tests/a.yaml:4:48: parts.p.shell.thickness: '-3 mm' = -0.003 [m], must be > 0");
  CHECK(mistakes_with("parts: {p: {sph: {material: water, spacing: dx-20e-3}}}\n") ==
        "tests/a.yaml:4:45: parts.p.sph.spacing: 'dx-20e-3' = -0.01 [m], must be > 0");
  CHECK(
      mistakes_with("parts: {p: {shell: {material: skin, thickness: 1, points: 99999999999}}}\n") ==
      "tests/a.yaml:4:59: parts.p.shell.points: '99999999999' = 1e+11 [-], must lie in [1, 9]");
}

TEST_CASE("mistake: formulas", "[input]") {
  CHECK(mistakes_with("parts: {p: {sph: {material: water, spacing: 2*dy}}}\n") ==
        "tests/a.yaml:4:45: parts.p.sph.spacing: '2*dy': unknown name 'dy'; did you mean 'dx'? "
        "(names under let: dx, V)");
  CHECK(
      mistakes_with("parts: {p: {sph: {material: water, spacing: '2*(dx'}}}\n") ==
      "tests/a.yaml:4:45: parts.p.sph.spacing: '2*(dx' cannot be worked out: Missing parenthesis");
}

TEST_CASE("mistake: names under let", "[input]") {
  CHECK(mistakes_in("gannet: 1\nlet: {a: 3 mss, b: 2*a, sin: 1, c: 2*d, d: 1, a: 2}\n") ==
        "tests/a.yaml:2:10: let.a: '3 mss': unknown unit 'mss'\n"
        "tests/a.yaml:2:30: let.sin: 'sin' means something in formulas already; choose another "
        "name\n"
        "tests/a.yaml:2:36: let.c: '2*d': unknown name 'd' (names under let: a, b, sin)\n"
        "tests/a.yaml:2:47: let.a: duplicate name; it stands at line 2 already");
}

TEST_CASE("mistake: duplicate keys and names", "[input]") {
  CHECK(mistakes_with("parts:\n  p: {velocity: [0, 0, 0], velocity: [1, 0, 0]}\n  p: {}\n") ==
        "tests/a.yaml:5:28: parts.p.velocity: duplicate key; it stands at line 5 already\n"
        "tests/a.yaml:6:3: parts.p: duplicate name; it stands at line 5 already");
  CHECK(mistakes_with("boundaries: {e: {velocity: {a: 1, a: 2}}}\n") ==
        "tests/a.yaml:4:35: boundaries.e.velocity.a: duplicate key");
  CHECK(mistakes_with("effects: {}\neffects: {}\n") ==
        "tests/a.yaml:5:1: effects: duplicate key; it stands at line 4 already");
}

TEST_CASE("mistake: a name that could not name a file", "[input]") {
  CHECK(mistakes_with("parts: {../p: {}}\n") ==
        "tests/a.yaml:4:9: parts.../p: '../p' cannot be a name: letters, digits, '_' and '-' are "
        "allowed, a letter or digit first");
}

TEST_CASE("mistake: references to what is not in the case", "[input]") {
  CHECK(mistakes_with("parts: {p: {sph: {material: watr}}}\n") ==
        "tests/a.yaml:4:29: parts.p.sph.material: no 'watr' under 'materials'; did you mean "
        "'water'? (there: skin, water)");
  CHECK(mistakes_with("contacts: {c: {between: [a]}}\n") ==
        "tests/a.yaml:4:26: contacts.c.between: no 'a' under 'parts' (there: none)");
}

TEST_CASE("mistake: lists and files", "[input]") {
  CHECK(mistakes_with("parts: {p: {velocity: [0, 1]}}\n") ==
        "tests/a.yaml:4:23: parts.p.velocity: 2 numbers stand here; three are wanted: [x, y, z]");
  CHECK(mistakes_with("parts: {p: {velocity: 3 m/s}}\n") ==
        "tests/a.yaml:4:23: parts.p.velocity: '3 m/s'; [x, y, z] is wanted, each a velocity (m/s, "
        "km/h, kn, ...)");
  CHECK(mistakes_with("boundaries: {b: {planes: {x: [-0.5 m, 0.5 s]}}}\n") ==
        "tests/a.yaml:4:39: boundaries.b.planes.x: '0.5 s' is a time; a length is wanted (m, mm, "
        "ft, ...)");
  CHECK(mistakes_with("boundaries: {b: {planes: {x: []}}}\n") ==
        "tests/a.yaml:4:30: boundaries.b.planes.x: the list is empty; a list of numbers is wanted, "
        "each a length (m, mm, ft, ...)");
  CHECK(mistakes_with("boundaries: {b: {fix: [x, rz]}}\n") ==
        "tests/a.yaml:4:27: boundaries.b.fix: unknown word 'rz'; did you mean 'rx'? allowed: x, y, "
        "rx");
  CHECK(mistakes_with("parts: {p: {mesh: hull.msh}}\n") ==
        "tests/a.yaml:4:19: parts.p.mesh: no file 'hull.msh' (looked for tests/hull.msh)");
  CHECK(mistakes_with("parts: [a]\n") ==
        "tests/a.yaml:4:8: parts: a list stands here; a map is wanted");
  CHECK(mistakes_with("effects: {xsph: 0.5}\n") ==
        "tests/a.yaml:4:17: effects.xsph: '0.5' is not a map; a map of epsilon, on is wanted");
  CHECK(mistakes_with("effects: {xsph: {on: maybe}}\n") ==
        "tests/a.yaml:4:22: effects.xsph.on: 'maybe'; yes or no is wanted");
}

TEST_CASE("mistake: all of a file are told at once, from top to bottom", "[input]") {
  CHECK(mistakes_with("study: {}\n"
                      "effects: {xsph: {epsilon: 2}}\n"
                      "parts: {p: {shell: {thickness: -1}}}\n") ==
        "tests/a.yaml:4:1: study: not built yet; the key is set aside for a later version\n"
        "tests/a.yaml:5:27: effects.xsph.epsilon: '2' = 2 [-], must lie in [0, 1]\n"
        "tests/a.yaml:6:13: parts.p.shell.material: missing; a name under 'materials' is wanted: "
        "what it is made of\n"
        "tests/a.yaml:6:32: parts.p.shell.thickness: '-1' = -1 [m], must be > 0");
}
