#include "output/summary.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "output/report.hpp"
#include "small_scene.hpp"

using namespace gannet;
using namespace gannet::test;

TEST_CASE("summary: all keys that scripts rely on, with the numbers of the run", "[output]") {
  const EmptyFolder folder("summary");
  SmallScene small;
  RunRecord& record = small.record();
  record.folder = folder.path;
  record.version = "0.1.0";
  record.revision = "abc";
  record.threads = 3;
  record.status = "stopped";
  record.exit_reason = "SIGINT";
  begin_run(record, small.models);
  record.wall_start -= std::chrono::seconds(10);
  for (int k = 0; k < 4; ++k) advance(small.models);
  for (Line& v : small.scene.nodes.v) set_xyz(v, {0.5, 0, -1});
  GuardState& guards = small.scene.store.get<GuardState>();
  guards.balance.largest_total = 8;
  guards.balance.imbalance = 2;
  write_summary(small.scene, small.models, record);

  const auto json = nlohmann::json::parse(read_file(folder.path + "/summary.json"));
  CHECK(json.at("status") == "stopped");
  CHECK(json.at("exit_reason") == "SIGINT");
  CHECK(json.at("version") == "0.1.0 (abc)");
  CHECK(json.at("steps") == 4);
  CHECK(json.at("time") == small.models.list.front().step.t);
  CHECK(json.at("threads") == 3);
  CHECK(json.at("energy_error") == 0.25);
  // 20 nodes of 2 kg: 9 of the panel, 3 of the bars, 8 particles.
  CHECK(json.at("mass") == 40.0);
  CHECK(json.at("momentum") == std::vector<double>{20, 0, -40});
  CHECK(json.at("peak_memory_bytes") > 1000000);
  CHECK(json.at("cpu_time").get<double>() > 0);
  CHECK(json.at("cpu_time_before") == 0);
  CHECK(json.at("lost_particles") == 0);
  CHECK(json.at("deepest_penetration").is_null());  // no wall, no contact
  const double wall = json.at("wall_time");
  CHECK(wall >= 10);
  CHECK(wall < 60);
  // 4 steps of 8 particles, and of 4 quads and 2 bars.
  CHECK(json.at("particle_steps_per_second").get<double>() == Approx(32 / wall));
  CHECK(json.at("element_steps_per_second").get<double>() == Approx(24 / wall));
  const auto& operations = json.at("operations");
  REQUIRE(operations.size() == operation_costs(small.models, wall).size());
  double seconds = 0;
  bool springs = false;
  for (const auto& op : operations) {
    CHECK(op.at("share").get<double>() == Approx(op.at("seconds").get<double>() / wall));
    CHECK(op.at("model") == "main");
    seconds += op.at("seconds").get<double>();
    if (op.at("name") == "springs") springs = op.at("stage") == "force" && op.at("calls") == 4;
  }
  CHECK(springs);
  CHECK(seconds < wall);
}

TEST_CASE("report: one line an operation in the order of the plan, and how the run ended",
          "[output]") {
  SmallScene small;
  RunRecord& record = small.record();
  record.status = "completed";
  record.exit_reason = "reached the end";
  begin_run(record, small.models);
  for (int k = 0; k < 3; ++k) advance(small.models);
  const std::string text = report(small.scene, small.models, record);
  CHECK_THAT(text, Catch::StartsWith("completed: reached the end\n"));
  std::size_t at = 0;
  for (const OperationCost& c : operation_costs(small.models, 1)) {
    const std::size_t next = text.find(c.name + " ", at);
    INFO(c.name);
    REQUIRE(next != std::string::npos);
    at = next + 1;
  }
  CHECK_THAT(text, Catch::Contains("all else"));
  CHECK_THAT(text, Catch::EndsWith("no frame was written\n"));
}

TEST_CASE("report: times, durations and counts as a person reads them", "[output]") {
  CHECK(time_text(0) == "0 s");
  CHECK(time_text(0.0123) == "12.3 ms");
  CHECK(time_text(1e-3) == "1 ms");
  CHECK(time_text(1.25e-6) == "1.25 us");
  CHECK(time_text(2.5) == "2.5 s");
  CHECK(time_text(3e-9) == "3 ns");
  CHECK(duration_text(12.34) == "12.3 s");
  CHECK(duration_text(65) == "1 min 05 s");
  CHECK(duration_text(7384) == "2 h 03 min");
  CHECK(duration_text(std::numeric_limits<double>::infinity()) == "unknown");
  CHECK(count_text(1.25e6) == "1.25 M");
  CHECK(count_text(12) == "12");
}

TEST_CASE("report: what subcycling gains follows from the costs of the models' steps", "[output]") {
  // r = 20 and f = 1e-3: r (1 + f)/(1 + r f).
  const std::vector<ModelCost> two{{"sea", 40, 4.0}, {"structure", 800, 0.08}};
  CHECK(subcycling_gain(two) == Approx(20 * 1.001 / 1.02));
  const std::vector<ModelCost> three{{"a", 1, 1.0}, {"b", 2, 1.0}, {"c", 4, 1.0}};
  CHECK(subcycling_gain(three) == Approx(4 * (1 + 0.5 + 0.25) / 3));
  CHECK(subcycling_gain({{"sea", 0, 0.0}, {"structure", 0, 0.0}}) == 1);
}

TEST_CASE("report: what runs where all models meet counts with the slowest", "[output]") {
  Models models;
  models.list.emplace_back().name = "slow";
  models.list.emplace_back().name = "fast";
  const auto add = [](Model& model, bool meet, double seconds, std::int64_t calls) {
    Operation& op = model.plan.add({.name = "op", .where_all_meet = meet});
    op.watch = {seconds, calls};
  };
  add(models.list[0], false, 3, 10);
  add(models.list[1], false, 2, 50);
  add(models.list[1], true, 1, 10);
  const std::vector<ModelCost> costs = model_costs(models);
  CHECK(costs[0].steps == 10);
  CHECK(costs[0].seconds == 4);
  CHECK(costs[1].steps == 50);
  CHECK(costs[1].seconds == 2);
}
