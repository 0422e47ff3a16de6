// Functions of time and place: formulas, tables, curves, and the mistakes made with them.
#include "input/functions.hpp"

#include <catch2/catch.hpp>

#include <fstream>

#include "../../support/temporary_folder.hpp"
#include "input/case.hpp"

using namespace gannet;

namespace {

Schema language_of_functions() {
  return {{"loads",
           {.name = "g",
            .kind = Kind::vector_function,
            .unit = dim::acceleration,
            .choices = {"free"},
            .variables = {"t"}}},
          {"loads",
           {.name = "p",
            .kind = Kind::function,
            .unit = dim::pressure,
            .variables = {"t", "x", "y", "z"}}},
          {"loads",
           {.name = "u", .kind = Kind::function, .unit = dim::velocity, .variables = {"x", "y"}}},
          {"loads", {.name = "when", .kind = Kind::formula}}};
}

std::unique_ptr<Case> read_functions(const std::string& text, const std::string& file = "a.yaml") {
  return read_case_text("gannet: 1\n" + text, file, language_of_functions());
}

std::string mistakes(const std::string& text) {
  try {
    read_functions(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("functions: formulas of time and place with names under let", "[input]") {
  const auto c = read_functions(
      "let: {A: 20 mm, w: 3 rad/s}\n"
      "loads: {g: [\"A*w^2*sin(w*t)\", -9.81, free], p: \"2*x + 3*y^2 - t\", u: \"y\"}\n");
  const Keys loads = c->keys().map("loads");
  const VectorFunction g = loads.vector_function("g");
  CHECK(value_at(g, 0.5).x() == Approx(0.02 * 9 * std::sin(1.5)).epsilon(1e-15));
  CHECK(value_at(g, 0.5).y() == -9.81);
  CHECK(!g.component[0].constant());
  CHECK(g.component[1].constant());
  CHECK(!g.component[0].of_place);
  CHECK(loads.words("g") == std::vector<std::string>{"", "", "free"});
  CHECK(value_at(loads.function("p"), 4, {5, 6, 7}) == 10 + 108 - 4);
  CHECK(loads.function("p").of_place);
  CHECK(value_at(loads.function("u"), 4, {5, 6, 7}) == 6);
}

TEST_CASE("functions: tables in place, as a list or a map with a factor", "[input]") {
  const auto c = read_functions(
      "let: {p1: 5 bar}\n"
      "loads:\n"
      "  p: [[0 s, 0], [1 ms, p1]]\n"
      "  g: [{table: [[0, 1], [1 s, 3 m/s^2]], factor: 2}, 0, 0]\n");
  const Keys loads = c->keys().map("loads");
  CHECK(loads.function("p").table == TimeTable{{0, 0.001}, {0, 5e5}});
  CHECK(value_at(loads.vector_function("g"), 0.5).x() == 4);
  // A plain number is a function that does not change, and still a number.
  const auto plain = read_functions("loads: {p: 2 kPa, g: [0, 0, -9.81 m/s^2]}\n");
  CHECK(plain->keys().map("loads").number("p") == 2000);
  CHECK(plain->keys().map("loads").vector("g") == Vec3(0, 0, -9.81));
}

TEST_CASE("functions: curves by name, alone with their unit, in formulas in SI", "[input]") {
  const auto c = read_functions(
      "curves: {pulse: [[0 s, 0 kPa], [10 ms, 4 kPa]], ramp: {table: [[0, 0], [1, 1]]}}\n"
      "loads: {p: pulse, g: [\"2*ramp(t - 1)\", 0, 0]}\n");
  const Keys loads = c->keys().map("loads");
  CHECK(value_at(loads.function("p"), 0.005) == Approx(2000).epsilon(1e-14));
  CHECK(value_at(loads.vector_function("g"), 1.25).x() == 0.5);
}

TEST_CASE("functions: a column of a CSV file with its units", "[input]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/m.csv") << "time [ms],force x [N],force z [kN]\n0,1,2\n10,3,4\n";
  const Curve z = read_csv_curve((folder.path() + "/m.csv"), "z");
  CHECK(z.table == TimeTable{{0, 0.01}, {2000, 4000}});
  CHECK(z.dimension == dim::force);
  const auto c = read_functions(
      "curves: {f: {csv: m.csv, column: force x, factor: 10}}\nloads: {p: \"f(t)\"}\n",
      folder.path() + "/a.yaml");
  CHECK(value_at(c->keys().map("loads").function("p"), 0.005) == Approx(20).epsilon(1e-14));
  CHECK_THROWS_WITH(read_csv_curve((folder.path() + "/m.csv"), "q"),
                    Catch::Contains("no column 'q'") && Catch::Contains("force x, force z"));
  CHECK_THROWS_WITH(read_csv_curve((folder.path() + "/m.csv"), ""),
                    Catch::Contains("say which column"));
}

TEST_CASE("functions: a formula whose names come from its owner", "[input]") {
  const auto c =
      read_functions("let: {limit: 5 kN}\nloads: {when: \"force_z > limit && t > 0.1\"}\n");
  const FormulaMaker& make = c->keys().map("loads").value("when").formula;
  const auto when = make({"t", "force_z"});
  const double late[] = {0.2, 6000};
  const double early[] = {0.05, 6000};
  CHECK(when(late) == 1);
  CHECK(when(early) == 0);
  CHECK_THROWS_WITH(make({"t", "force_y"}), Catch::Contains("unknown name 'force_z'") &&
                                                Catch::Contains("variables: t, force_y"));
}

TEST_CASE("functions: the resolved case reads back to the same functions", "[input]") {
  const auto c = read_functions(
      "let: {w: 3}\n"
      "loads: {p: [[0 s, 0], [1 ms, 5 bar]], g: [\"sin(w*t)\", -9.81 m/s^2, free]}\n");
  const auto again = read_case_text(c->resolved, "b.yaml", language_of_functions());
  CHECK(again->resolved == c->resolved);
  CHECK(again->keys().map("loads").function("p") == c->keys().map("loads").function("p"));
}

TEST_CASE("functions: mistakes name their place and what is allowed", "[input]") {
  CHECK_THAT(mistakes("loads: {g: [\"sin(w*t)\", 0, 0]}"),
             Catch::Contains("a.yaml:2:13: loads.g: 'sin(w*t)': unknown name 'w'") &&
                 Catch::Contains("variables: t;"));
  CHECK_THAT(mistakes("loads: {g: [\"2*x\", 0, 0]}"), Catch::Contains("unknown name 'x'"));
  CHECK_THAT(mistakes("loads: {u: \"2*t\"}"),
             Catch::Contains("unknown name 't'") && Catch::Contains("variables: x, y;"));
  CHECK_THAT(mistakes("let: {t: 3 mm}\nloads: {p: \"2*t\"}"),
             Catch::Contains("'t' is a variable here and a name under let"));
  CHECK_THAT(mistakes("loads: {p: \"1/t\"}"), Catch::Contains("not a finite number"));
  CHECK_THAT(mistakes("loads: {p: \"2*(t\"}"), Catch::Contains("cannot be worked out"));
  CHECK_THAT(mistakes("loads: {p: [[0 s, 1 m]]}"),
             Catch::Contains("'1 m' is a length; a pressure is wanted"));
  CHECK_THAT(mistakes("loads: {p: [[1 s, 1], [1 s, 2]]}"),
             Catch::Contains("times must rise: 1 s comes after 1 s"));
  CHECK_THAT(mistakes("loads: {p: [1, 2]}"), Catch::Contains("list of pairs"));
  CHECK_THAT(mistakes("loads: {p: {tabel: [[0, 1]]}}"), Catch::Contains("did you mean 'table'"));
  CHECK_THAT(mistakes("loads: {p: {csv: none.csv}}"), Catch::Contains("no file 'none.csv'"));
  CHECK_THAT(mistakes("curves: {sin: [[0, 1]]}"), Catch::Contains("means something in formulas"));
  CHECK_THAT(mistakes("curves: {f: [[0, 1 N]]}\nloads: {p: f}"),
             Catch::Contains("the curve 'f' is a force; a pressure is wanted"));
  CHECK_THAT(mistakes("curves: {f: [[0, 1 N], [1, 2 m]]}"), Catch::Contains("a force is wanted"));
  CHECK_THAT(mistakes("loads: {g: 5}"), Catch::Contains("[x, y, z] is wanted"));
}
