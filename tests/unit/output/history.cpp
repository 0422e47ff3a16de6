#include <catch2/catch.hpp>
#include <charconv>

#include "base/error.hpp"
#include "output/history.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("history: measures of probes and contacts have files, others have none", "[output]") {
  const auto name = [](const std::string& measure) {
    return history_name({measure, "N", {"value"}, {}});
  };
  CHECK(name("probe.keel") == "keel");
  CHECK(name("probe.a/b") == "a_b");
  CHECK(name("contact.slam.force") == "contact_slam_force");
  CHECK(name("mass.pool").empty());
}

TEST_CASE("history: header with names and units, numbers that read back to the same bits",
          "[output]") {
  const EmptyFolder folder("history");
  SmallScene small;
  Ledger& ledger = small.models.ledger;
  for (LedgerEntry& e : ledger.entries()) e.value = 0;
  ledger.entry("internal", "springs").value = 1.0 / 3;
  LedgerEntry& work = ledger.entry("external", "gravity");
  work.external = true;
  work.value = 0.1;
  EnergyBalance balance;
  balance.largest_total = 4;
  balance.imbalance = -1;
  small.scene.nodes.x[0] = {0.1 + 0.2, 0, 1e-300, 1};
  History history(small.scene, ledger);
  history.write(0, balance, folder.path);
  history.write(0.1 + 0.2, balance, folder.path);

  CHECK(read_file(folder.path + "/history/tip.csv") ==
        "time [s],tip x [m],tip z [m]\n"
        "0,0.30000000000000004,1e-300\n"
        "0.30000000000000004,0.30000000000000004,1e-300\n");
  const std::string contact = read_file(folder.path + "/history/contact_slam_force.csv");
  CHECK(contact.starts_with("time [s],contact_slam_force [N]\n0,0\n"));
  const std::string energy = read_file(folder.path + "/history/energy.csv");
  CHECK(energy.starts_with("time [s],held [J],external [J],error [-]"));
  CHECK(energy.find(",springs internal [J]") != std::string::npos);
  CHECK(energy.find(",gravity external [J]\n") != std::string::npos);
  CHECK(energy.find("\n0,0.3333333333333333,0.1,-0.25,") != std::string::npos);
  CHECK(energy.ends_with(",0.1\n"));
  CHECK_FALSE(fs::exists(folder.path + "/history/mass_pool.csv"));
}

TEST_CASE("history: a measure may have a unit for each component", "[output]") {
  const EmptyFolder folder("units");
  SmallScene small;
  small.scene.measures.push_back({"probe.flow", "m^3/s,m^3", {"rate", "volume"}, [](double* to) {
                                    to[0] = 2;
                                    to[1] = 3;
                                  }});
  History history(small.scene, small.models.ledger);
  history.write(0, {}, folder.path);
  CHECK(read_file(folder.path + "/history/flow.csv") ==
        "time [s],flow rate [m^3/s],flow volume [m^3]\n0,2,3\n");
}

TEST_CASE("history: a new ledger entry in the middle of a run is an error", "[output]") {
  const EmptyFolder folder("late");
  SmallScene small;
  History history(small.scene, small.models.ledger);
  history.write(0, {}, folder.path);
  small.models.ledger.entry("friction", "slam");
  CHECK_THROWS_WITH(history.write(1, {}, folder.path), Catch::Contains("'slam friction'"));
}

TEST_CASE("history: cut at the level of a checkpoint, with the partial last line", "[output]") {
  const EmptyFolder folder("cut");
  const std::string path = folder.path + "/history/a.csv";
  const std::string whole = "time [s],x [m]\n0,1\n0.25,2\n0.5,3\n";
  const auto cut = [&](const std::string& text, double t) {
    write_file(path, text);
    cut_histories(folder.path, t);
    return read_file(path);
  };
  CHECK(cut(whole, 1) == whole);
  CHECK(cut(whole + "0.7", 1) == whole);
  CHECK(cut(whole + "0.75,4", 1) == whole);
  // The checkpoint stands at level 0.5 before that level was looked at: its line is written anew.
  CHECK(cut(whole, 0.5) == "time [s],x [m]\n0,1\n0.25,2\n");
  CHECK(cut(whole, 0) == "time [s],x [m]\n");
  CHECK(cut("time [s", 1).empty());
}

TEST_CASE("history: a resumed run continues the table, another table is refused", "[output]") {
  const EmptyFolder folder("continue");
  SmallScene small;
  const std::string path = folder.path + "/history/tip.csv";
  History(small.scene, small.models.ledger).write(0, {}, folder.path);
  const std::string first = read_file(path);
  History(small.scene, small.models.ledger).write(1, {}, folder.path);
  CHECK(read_file(path) == first + "1,0,0\n");
  write_file(path, "time [s],other [m]\n0,1\n");
  History other(small.scene, small.models.ledger);
  CHECK_THROWS_AS(other.write(2, {}, folder.path), InputError);
}
