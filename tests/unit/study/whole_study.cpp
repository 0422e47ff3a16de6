// A whole study of a plate, made by the program itself: seconds.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/temporary_folder.hpp"
#include "support/well_formed.hpp"

using namespace gannet;

namespace {

namespace fs = std::filesystem;

const char* const plate = R"(gannet: 1
title: Small plate & a "name"
materials: {steel: {card: steel}}
parts:
  plate:
    shell: {material: steel, thickness: 10 mm, points: 3}
    shape: {plate: {size: [1 m, 1 m], elements: [4, 4]}}
boundaries: {clamp: {nodes: {edge_of: plate}, fix: [x, y, z, rx, ry, rz]}}
loads: {step: {pressure: {on: plate, value: 1 kPa}}}
probes: {centre: {displacement: {node: {nearest: [0, 0, 0], of: plate}}}}
output: {until: 4 ms, history: every 50 us}
)";

struct Answer {
  int code = -1;
  std::string text;
};

Answer study(const std::string& folder, const std::string& more) {
  const std::string log = folder + "/log.txt";
  const std::string command = std::string(GANNET_PROGRAM) + " study " + folder + "/case.yaml " +
                              "--vary 'parts.plate.shape.plate.elements=[4, 4],[8, 8],[16, 16]' " +
                              "--measure peak:centre:z --measure distance:centre:z --out " +
                              folder + "/s " + more + " > " + log + " 2>&1";
  Answer answer;
  answer.code = WEXITSTATUS(std::system(command.c_str()));
  std::ifstream stream(log);
  std::ostringstream text;
  text << stream.rdbuf();
  answer.text = text.str();
  return answer;
}

nlohmann::json results(const std::string& folder) {
  std::ifstream stream(folder + "/s/study.json");
  return nlohmann::json::parse(stream);
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("study: three plates give errors that shrink, and all files", "[study]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/case.yaml") << plate;
  const Answer first = study(folder.path(), "--threads 1");
  INFO(first.text);
  REQUIRE(first.code == 0);
  const nlohmann::json json = results(folder.path());
  REQUIRE(json["runs"].size() == 3);
  for (const auto& run : json["runs"]) {
    CHECK(run["state"] == "done");
    CHECK(run["cpu"].get<double>() > 0);
    CHECK(run["wall"].get<double>() > 0);
    CHECK(run["steps"].get<double>() > 10);
  }
  CHECK(json["refined"] == "parts.plate.shape.plate.elements");
  CHECK(json["runs"][0]["elements"] == 16);
  CHECK(json["runs"][2]["elements"] == 256);
  const auto& distance = json["measures"][1]["values"];
  CHECK(distance[0]["error"].get<double>() > distance[1]["error"].get<double>());
  CHECK(distance[2]["error"].get<double>() == 0);
  CHECK(json["measures"][0]["sentences"].size() == 3);

  const std::string out = folder.path() + "/s";
  CHECK(why_not_well_formed(text_of(out + "/convergence_peak_centre_z.svg")) == "");
  CHECK(why_not_well_formed(text_of(out + "/work_peak_centre_z.svg")) == "");
  CHECK(why_not_well_formed(text_of(out + "/study.html")) == "");
  CHECK(text_of(out + "/study.csv").rfind("run,repeat,parts.plate.shape.plate.elements,state", 0) ==
        0);

  // A second call makes nothing again; a run that was cut short is made again, alone.
  const Answer second = study(folder.path(), "--threads 1");
  CHECK_THAT(second.text, Catch::Contains("done before"));
  CHECK(results(folder.path())["runs"][2]["wall"] == json["runs"][2]["wall"]);
  fs::remove(out + "/runs/" + json["runs"][1]["hash"].get<std::string>() + "/summary.json");
  REQUIRE(study(folder.path(), "--threads 1").code == 0);
  CHECK(results(folder.path())["runs"][1]["state"] == "done");
  CHECK(results(folder.path())["runs"][0]["wall"] == json["runs"][0]["wall"]);

  // Against formulas: the distance from nothing is the root mean square itself.
  const Answer known =
      study(folder.path(),
            "--threads 1 --measure 'distance:centre:z,reference=0*t,scale=1,name=from_nothing' "
            "--measure rms:centre:z --measure 'final:centre:z,reference=0.002*t'");
  INFO(known.text);
  REQUIRE(known.code == 0);
  const nlohmann::json with_formulas = results(folder.path());
  const auto measure = [&](const std::string& name) {
    for (const auto& m : with_formulas["measures"]) {
      if (m["name"] == name) return m;
    }
    FAIL("no measure " << name);
    return nlohmann::json();
  };
  CHECK(measure("from_nothing")["values"][2]["error"].get<double>() ==
        Approx(measure("rms_centre_z")["values"][2]["median"].get<double>()).epsilon(0.01));
  CHECK(measure("final_centre_z")["reference"].get<double>() == Approx(8e-6).epsilon(0.001));
}

TEST_CASE("study: the tasks of a job array make the runs that a study then collects", "[study]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/case.yaml") << plate;
  // One run is there already: the array holds the two others, coarse ones first.
  const std::string array = folder.path() + "/job array";
  REQUIRE(study(folder.path(), "--threads 1").code == 0);
  const nlohmann::json alone = results(folder.path());
  const std::string out = folder.path() + "/s";
  for (const int k : {0, 2}) {
    fs::remove_all(out + "/runs/" + alone["runs"][k]["hash"].get<std::string>());
  }
  const Answer written = study(folder.path(), "--threads 1 --slurm '" + array + "'");
  INFO(written.text);
  REQUIRE(written.code == 0);
  CHECK_THAT(written.text, Catch::Contains("2 runs are to be made"));
  const std::string script = text_of(array + "/study.sbatch");
  CHECK_THAT(script, Catch::Contains("#SBATCH --array=1-2\n") &&
                         Catch::Contains("#SBATCH --cpus-per-task=1\n"));

  const auto task = [&](const std::string& number) {
    return WEXITSTATUS(std::system(("cd / && SLURM_ARRAY_TASK_ID=" + number + " bash '" + array +
                                    "/study.sbatch' 2> /dev/null")
                                       .c_str()));
  };
  REQUIRE(task("2") == 0);
  CHECK(task("3") == 2);  // there is none
  const Answer half = study(folder.path(), "--threads 1 --collect");
  CHECK_THAT(half.text, Catch::Contains("not there yet"));
  CHECK(results(folder.path())["runs"][0]["state"] == "not run");
  CHECK(results(folder.path())["runs"][2]["state"] == "done");
  REQUIRE(task("1") == 0);
  const Answer whole = study(folder.path(), "--threads 1");
  const nlohmann::json json = results(folder.path());
  CHECK_THAT(whole.text, Catch::Contains("[3/3]") && Catch::Contains("done before"));
  CHECK(json["measures"][0]["values"] == alone["measures"][0]["values"]);
  CHECK(json["runs"][0]["cpu"].get<double>() > 0);
  CHECK_THAT(study(folder.path(), "--threads 1 --slurm '" + array + "'").text,
             Catch::Contains("all runs are done"));
}

TEST_CASE("study: short names of keys, and repeats as distributions", "[study]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/case.yaml") << R"(gannet: 1
dimension: 2
let: {dx: 10 mm}
materials: {water: {card: water, c0: 20 m/s}}
parts:
  pool:
    sph: {material: water, spacing: dx}
    fill: {box: {from: [0, 0, 0], to: [0.1 m, 0.1 m, 0]}}
    start: hydrostatic
boundaries: {tank: {planes: {x: [0, 0.1 m], y: 0}}}
loads: {gravity: [0, -9.81 m/s^2, 0]}
probes: {at_floor: {pressure: {at: [50 mm, 10 mm, 0]}}}
output: {until: 20 ms, history: every 1 ms}
study:
  vary: {spacing: [10 mm]}
  measure: {peak: at_floor}
  repeats: 3
  jitter: {part: pool, amount: 0.05}
)";
  const std::string out = folder.path() + "/s";
  const std::string command = std::string(GANNET_PROGRAM) + " study " + folder.path() +
                              "/case.yaml --threads 1 --out " + out + " > " + folder.path() +
                              "/log.txt 2>&1";
  const int code = WEXITSTATUS(std::system(command.c_str()));
  INFO(text_of(folder.path() + "/log.txt"));
  REQUIRE(code == 0);
  const nlohmann::json json = results(folder.path());
  REQUIRE(json["runs"].size() == 3);
  CHECK(json["runs"][0]["settings"].contains("parts.pool.sph.spacing"));
  for (const auto& run : json["runs"]) {
    CHECK(run["lost_particles"] == 0);
    CHECK(run["deepest_penetration"].get<double>() < 0.005);  // half a spacing
  }
  const auto& value = json["measures"][0]["values"][0];
  REQUIRE(value["of_repeats"].size() == 3);
  CHECK(value["percentiles"]["50"] == value["median"]);
  CHECK(value["percentiles"]["10"].get<double>() < value["percentiles"]["90"].get<double>());
  CHECK(why_not_well_formed(text_of(out + "/spread_peak_at_floor.svg")) == "");
  CHECK(why_not_well_formed(text_of(out + "/study.html")) == "");
  // Each line of the table is one run's own.
  CHECK_THAT(text_of(out + "/study.csv"),
             Catch::Contains("energy_error,lost_particles,deepest_penetration [m],version"));
}

TEST_CASE("study: a budget that is too small is kept and said", "[study]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/case.yaml") << plate;
  const Answer answer = study(folder.path(), "--threads 1 --budget '1 ms'");
  INFO(answer.text);
  REQUIRE(answer.code == 0);
  const nlohmann::json json = results(folder.path());
  CHECK(json["runs"][2]["state"] == "not run");
  CHECK_THAT(answer.text, Catch::Contains("the budget of 0.001 s ended the study"));
}

TEST_CASE("study: mistakes of all settings are said before anything runs", "[study]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/case.yaml") << plate;
  const Answer answer = study(folder.path(), "--vary parts.plate.shell.thicknes=1mm,2mm");
  CHECK(answer.code == 2);
  CHECK_THAT(answer.text, Catch::Contains("thicknes"));
  CHECK_FALSE(fs::exists(folder.path() + "/s"));
}
