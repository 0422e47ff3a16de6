#include "study/study_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "study/study_axes.hpp"
#include "support/temporary_folder.hpp"

using namespace gannet;

namespace {

std::unique_ptr<Case> read(const std::string& study) {
  return read_case_text("gannet: 1\nlet: {a: 20 mm}\nstudy:\n" + study, "s.yaml", study_schema());
}

}  // namespace

TEST_CASE("study file: what is varied and measured", "[study]") {
  const auto c = read(
      "  vary: {let.dx: [8 mm, a/4], effects.xsph: [on, off], p.elements: [[8, 8], [16, 16]]}\n"
      "  set: {output.until: 10 ms}\n"
      "  measure:\n"
      "    peak: slam_force\n"
      "    up: {peak: slam_force, column: z, from: 1 ms, until: 9 ms, reference: 2 kN}\n"
      "    far: {distance: front, scale: \"2*a\", shift: 3 ms}\n"
      "  reference: richardson\n"
      "  budget: 30 min\n"
      "  jitter: {part: pool, amount: 0.05}\n"
      "  repeats: 5\n");
  const StudySpec spec = study_of(*c);
  CHECK(c->mistakes.messages().empty());
  REQUIRE(spec.axes.size() == 3);
  CHECK(spec.axes[0].values == std::vector<std::string>{"8 mm", "a/4"});
  CHECK(spec.axes[1].values == std::vector<std::string>{"on", "off"});
  CHECK(spec.axes[2].values == std::vector<std::string>{"[8, 8]", "[16, 16]"});
  CHECK(spec.set == std::vector<std::string>{"output.until=10 ms"});
  REQUIRE(spec.measures.size() == 3);
  CHECK(spec.measures[0].kind == "peak");
  CHECK(spec.measures[0].history == "slam_force");
  CHECK(spec.measures[1].name == "up");
  CHECK(spec.measures[1].column == "z");
  CHECK(spec.measures[1].until == Approx(0.009));
  REQUIRE(spec.measures[1].reference);
  CHECK(spec.measures[1].reference->value == Approx(2000));
  CHECK(spec.measures[2].scale == Approx(0.04));
  CHECK(spec.measures[2].max_shift == Approx(0.003));
  CHECK(spec.reference.kind == StudyReference::Kind::richardson);
  CHECK(spec.budget == Approx(1800));
  CHECK(spec.repeats == 5);
  CHECK(spec.jitter_part == "pool");
  CHECK(spec.jitter == Approx(0.05));
}

TEST_CASE("study file: variants set several keys under one name", "[study]") {
  const auto c = read(
      "  vary:\n"
      "    build:\n"
      "      whole: on\n"
      "      bare: {parts.frame: off, models.fast.parts: [a, b]}\n"
      "    models: [on, off]\n");
  const StudySpec spec = study_of(*c);
  CHECK(c->mistakes.messages().empty());
  REQUIRE(spec.axes.size() == 2);
  CHECK(spec.axes[0].values == std::vector<std::string>{"whole", "bare"});
  REQUIRE(spec.axes[0].sets.size() == 2);
  CHECK(overrides_of(spec.axes, {"whole", "off"}) == std::vector<std::string>{"models=off"});
  CHECK(overrides_of(spec.axes, {"bare", "on"}) ==
        std::vector<std::string>{"parts.frame=off", "models.fast.parts=[a, b]", "models=on"});
  const auto wrong = read("  vary: {build: {whole: 3, bare: {}}}\n");
  (void)study_of(*wrong);
  CHECK(wrong->mistakes.messages().size() == 1);
}

TEST_CASE("study file: a formula of t is a history, one without t a number", "[study]") {
  const auto c = read(
      "  vary: {let.dx: [8 mm]}\n"
      "  measure:\n"
      "    a: {final: h, reference: {formula: \"a*cos(2*t)\"}}\n"
      "    b: {final: h, reference: {formula: \"2*a\"}}\n"
      "    c: {final: h, reference: {formula: \"a*cos(2*x)\"}}\n"
      "  reference: finest\n");
  const StudySpec spec = study_of(*c);
  REQUIRE(spec.measures[0].reference);
  CHECK(spec.measures[0].reference->kind == StudyReference::Kind::formula);
  const double t = 0.3;
  CHECK(spec.measures[0].reference->formula(&t) == Approx(0.02 * std::cos(0.6)));
  CHECK(spec.measures[1].reference->kind == StudyReference::Kind::number);
  CHECK(spec.measures[1].reference->value == Approx(0.04));
  REQUIRE(c->mistakes.messages().size() == 1);
  CHECK_THAT(c->mistakes.messages()[0], Catch::Contains("s.yaml:8:") && Catch::Contains("x"));
}

TEST_CASE("study file: mistakes are said with what is known", "[study]") {
  const auto c = read(
      "  vary: {let.dx: 8 mm}\n"
      "  measure: {up: {peek: slam_force}, down: {column: z}}\n"
      "  reference: finst\n");
  study_of(*c);
  std::string all;
  for (const std::string& m : c->mistakes.messages()) all += m + "\n";
  CHECK_THAT(all, Catch::Contains("s.yaml:4:") && Catch::Contains("a list of values is wanted"));
  CHECK_THAT(all, Catch::Contains("did you mean 'peak'?"));
  CHECK_THAT(all, Catch::Contains("what is measured is missing"));
  CHECK_THAT(all, Catch::Contains("finest, richardson, a number"));
}

TEST_CASE("study: measures and references of the command line", "[study]") {
  const StudyMeasure m = parse_measure("percentile:keel:z,percent=95,from=1 ms,name=p95");
  CHECK(m.kind == "percentile");
  CHECK(m.history == "keel");
  CHECK(m.column == "z");
  CHECK(m.percent == 95);
  CHECK(m.from == Approx(0.001));
  CHECK(m.name == "p95");
  CHECK(parse_measure("peak:keel").name == "peak_keel");
  CHECK_THROWS_WITH(parse_measure("peek:keel"), Catch::Contains("did you mean 'peak'?"));
  CHECK_THROWS_WITH(parse_measure("peak"), Catch::Contains("KIND:HISTORY is wanted"));
  CHECK_THROWS_WITH(parse_measure("peak:keel,from=1 m"), Catch::Contains("a time is wanted"));
  CHECK(parse_reference("finest").kind == StudyReference::Kind::finest);
  CHECK(parse_reference("2 kN").value == Approx(2000));
  const double t = 2;
  CHECK(parse_reference("3*t^2").formula(&t) == Approx(12));
  CHECK_THROWS_AS(parse_reference("none.csv"), std::invalid_argument);
  CHECK_THROWS_AS(parse_reference("fines"), std::invalid_argument);
}

TEST_CASE("study: a file is a study file where it names a case", "[study]") {
  const TemporaryFolder folder;
  const std::string file = folder.path() + "/s.yaml";
  std::ofstream(file) << "gannet: 1\nstudy: {case: c.yaml}\n";
  CHECK(is_study_file(file));
  std::ofstream(file) << "gannet: 1\nstudy: {vary: {let.dx: [1, 2]}}\n";
  CHECK_FALSE(is_study_file(file));
  CHECK_FALSE(is_study_file(folder.path() + "/none.yaml"));
}
